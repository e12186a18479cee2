"""The strip above both workspaces: which one is on show, what is open, what the app is doing."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QButtonGroup, QLabel, QProgressBar, QPushButton, QSizePolicy, QToolBar, QWidget

from genmojo_studio.translate import tr


class Header(QToolBar):
    """Workspace buttons, the clip's name, a line for what goes on."""

    workspace_wanted = Signal(str)
    palette_wanted = Signal()
    panels_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(tr("Workspaces"), parent)
        self.setObjectName("header")
        self.setMovable(False)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        self._group = QButtonGroup(self)
        self._buttons = {}
        for name, text, tip in (
            ("", tr("Start"), tr("The start page")),
            ("annotate", tr("Annotate"), tr("Points and masks by hand (Ctrl+1)")),
            ("watch", tr("Watch"), tr("Optimise, look at and compare scenes (Ctrl+2)")),
        ):
            button = QPushButton(text)
            button.setCheckable(True)
            button.setToolTip(tip)
            button.setObjectName(name or "start")
            button.setProperty("role", "workspace")
            button.setFocusPolicy(Qt.FocusPolicy.NoFocus)
            button.clicked.connect(self._clicked)
            self._group.addButton(button)
            self._buttons[name] = button
            self.addWidget(button)
        self._name = QLabel()
        self._name.setContentsMargins(18, 0, 18, 0)
        self._said = QLabel()
        self._said.setProperty("role", "dim")
        self._busy = QProgressBar()
        self._busy.setTextVisible(False)
        self._busy.setFixedSize(120, 10)
        self._busy.setRange(0, 0)
        gap = QWidget()
        gap.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        find = QPushButton(tr("Find a command…  Ctrl+K"))
        find.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        find.clicked.connect(self.palette_wanted)
        self._panels = QPushButton(tr("Panels"))
        self._panels.setCheckable(True)
        self._panels.setToolTip(tr("Hides all panels, so that the pictures fill the window, or shows them (Ctrl+B)"))
        self._panels.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._panels.clicked.connect(self.panels_wanted)
        self.addWidget(self._name)
        self.addWidget(gap)
        self.addWidget(self._said)
        self._busy_action = self.addWidget(self._busy)
        self._panels_action = self.addWidget(self._panels)
        self.addWidget(find)
        self.say("")

    def show_workspace(self, name: str) -> None:
        """Marks the button of the workspace on show."""
        self._buttons[name].setChecked(True)

    def show_name(self, name: str) -> None:
        """Says what is open."""
        self._name.setText(name)

    def show_panels(self, shown: bool | None) -> None:
        """Marks whether the panels are on show; None where there are none."""
        self._panels_action.setVisible(shown is not None)
        self._panels.setChecked(bool(shown))

    def say(self, text: str, busy: bool = False) -> None:
        """Says what the app is doing, with a bar that moves while it is busy."""
        self._said.setText(text)
        self._busy_action.setVisible(busy)

    def _clicked(self) -> None:
        name = self.sender().objectName()
        self.workspace_wanted.emit("" if name == "start" else name)
