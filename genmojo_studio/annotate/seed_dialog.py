"""Before seeding: which tracker, which tracks, what it needs, what its licence says. While it runs: progress, cancel.

What a tracker finds is a proposal: places and states that a person gave are never overwritten.
"""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QButtonGroup,
    QDialog,
    QDialogButtonBox,
    QLabel,
    QProgressBar,
    QRadioButton,
    QVBoxLayout,
    QWidget,
)

from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.work import Work
from genmojo_studio.translate import tr


@dataclass(frozen=True)
class Choice:
    """A way to seed: name, title, what it does and needs."""

    name: str
    title: str
    about: str


CHOICES = (
    Choice("optical", "Optical (built in)", "Follows the points inside their masks by optical flow and matching, from "
           "both ends between your keys. Needs masks; nothing else."),
    Choice("scene", "Solve from scene", "Optimises a 4D scene of this clip and takes its tracks, which go on behind "
           "what hides them. Takes minutes."),
    Choice("cotracker", "CoTracker (yours)", "Runs a CoTracker that you have: its folder and weights. Its licence "
           "(CC BY-NC 4.0) forbids commercial use."),
    Choice("file", "From a file…", "Tracks of a file that belongs to this clip (TAP-Vid, CoTracker, ours)."),
)  # fmt: skip


class SeedDialog(QDialog):
    """Asks, starts, shows how far it is; closing it while it runs cancels."""

    def __init__(self, session: Session, work: Work, available: dict[str, str], parent: QWidget | None = None) -> None:
        """`available` says per choice why it cannot be used now, "" if it can."""
        super().__init__(parent)
        self._session, self._work = session, work
        self.setWindowTitle(tr("Seed tracks"))
        self.setMinimumWidth(460)
        column = QVBoxLayout(self)
        self._trackers, self._scope = QButtonGroup(self), QButtonGroup(self)
        for n, choice in enumerate(CHOICES):
            button = QRadioButton(tr(choice.title))
            button.setEnabled(not available.get(choice.name, ""))
            button.setChecked(n == 0)
            self._trackers.addButton(button, n)
            column.addWidget(button)
            text = tr(choice.about)
            missing = available.get(choice.name, "")
            label = QLabel(f"{text} {missing}".strip(), wordWrap=True)
            label.setProperty("role", "dim")
            label.setContentsMargins(24, 0, 0, 4)
            column.addWidget(label)
        column.addSpacing(6)
        for n, title in enumerate((tr("all objects"), tr("the active object only"))):
            button = QRadioButton(title)
            button.setChecked(n == 0)
            self._scope.addButton(button, n)
            column.addWidget(button)
        self.note = QLabel(tr("Your keys, accepted places and painted states stay as they are."), wordWrap=True)
        column.addWidget(self.note)
        self.progress = QProgressBar()
        self.progress.setMaximum(100)
        self.progress.hide()
        column.addWidget(self.progress)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.start = self.buttons.addButton(tr("Seed"), QDialogButtonBox.ButtonRole.ActionRole)
        self.start.setDefault(True)
        column.addWidget(self.buttons)
        self.start.clicked.connect(self._start)
        self.buttons.rejected.connect(self.reject)
        work.tracker.progressed.connect(self._progressed)
        work.tracker.seeded.connect(self._seeded)

    def choice(self) -> str:
        """Name of the tracker chosen."""
        return CHOICES[self._trackers.checkedId()].name

    def objects(self) -> list[int]:
        """Ids of the objects to seed."""
        return [o.id for o in self._session.objects()] if self._scope.checkedId() == 0 else [self._session.active[0]]

    def reject(self) -> None:
        """Close; what runs is cancelled."""
        self._work.tracker.cancel()
        super().reject()

    def _start(self) -> None:
        if self.choice() != "optical":
            self.accept()
            return
        self.progress.setVisible(True)
        self.start.setEnabled(False)
        for button in (*self._trackers.buttons(), *self._scope.buttons()):
            button.setEnabled(False)
        self.setWindowModality(Qt.WindowModality.NonModal)
        if not self._work.tracker.seed(self.objects()):
            self.accept()

    def _progressed(self, share: float) -> None:
        self.progress.setValue(round(100 * share))

    def _seeded(self, _tracks: int) -> None:
        if self.progress.isVisible():
            self.accept()
