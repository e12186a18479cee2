"""stand-in"""

from PySide6.QtWidgets import QWidget


class ComparePanel(QWidget):
    def __init__(self, state, view):
        super().__init__()
