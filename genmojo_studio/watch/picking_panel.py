"""stand-in"""

from PySide6.QtWidgets import QWidget


class PickingPanel(QWidget):
    def __init__(self, state):
        super().__init__()

    def clear(self):
        pass

    def show_pick(self, *a):
        pass
