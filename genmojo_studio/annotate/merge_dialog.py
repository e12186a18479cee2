"""A second annotator's project beside this one: how far they agree, and a merge that is looked at before it is done."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QHeaderView,
    QLabel,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.tracks import agreement
from genmojo_core.tracks.agreement import Choice, MergeRun
from genmojo_core.tracks.annotation import Annotation
from genmojo_core.tracks.edits import Edit
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import decimal, tr

_CHOICES: tuple[Choice, ...] = ("mine", "theirs", "middle")


class MergeDialog(QDialog):
    """Figures of agreement above, one row per run of frames that differs below; a click shows the run in the frame.

    Args:
        session: the project that is open. theirs: the other annotator's. base: what both began from, or None.
    Raises GenmojoError as `agreement.agreement` and `agreement.preview`.
    """

    def __init__(
        self, session: Session, theirs: Annotation, base: Annotation | None, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._session, self._theirs = session, theirs
        self.figures = agreement.agreement(session.annotation, theirs)
        self.runs = agreement.preview(base, session.annotation, theirs)
        self.choices: list[QComboBox] = []
        self.setWindowTitle(tr("Compare with a second annotator"))
        self.resize(720, 520)
        summary = QLabel(self._summary(), wordWrap=True)
        self.table = QTableWidget(len(self.runs), 5)
        self.table.setTabKeyNavigation(False)
        self._fill()
        note = QLabel(tr("What only they changed is taken over; of conflicts, what you choose (keys 1, 2, 3 for "
                         "the row). One step; it can be undone."), wordWrap=True)  # fmt: skip
        note.setProperty("role", "dim")
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.take = buttons.addButton(tr("Merge"), QDialogButtonBox.ButtonRole.AcceptRole)
        self.take.setEnabled(bool(self.runs))
        buttons.accepted.connect(self._merge)
        buttons.rejected.connect(self.reject)
        for n in range(len(_CHOICES)):
            QShortcut(QKeySequence(str(n + 1)), self, partial(self._choose, n))
        column = QVBoxLayout(self)
        for widget in (summary, self.table, note, buttons):
            column.addWidget(widget)

    def edit(self) -> Edit:
        """The merge as chosen."""
        chosen: dict[int, Choice] = {n: _CHOICES[box.currentIndex()] for n, box in enumerate(self.choices)}
        return agreement.merge(self._session.annotation, self._theirs, self.runs, chosen)

    def _summary(self) -> str:
        f = self.figures
        return tr("{n} tracks in common. AJ {aj:.1f}, δ {delta:.1f}, OA {oa:.1f} %. Distance where both see the point: "
                  "median {median:.2f} px, 90 % below {p90:.2f} px (1080 lines). Same state in {states:.1%}.").format(
            n=int(f["tracks"]), aj=f["aj"], delta=f["delta"], oa=f["oa"],
            median=f["median_px"], p90=f["p90_px"], states=f["states"])  # fmt: skip

    def _fill(self) -> None:
        self.table.setHorizontalHeaderLabels([tr("point"), tr("frames"), tr("changed by"), tr("distance"), tr("take")])
        self.table.verticalHeader().hide()
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setAccessibleName(tr("Differences between the two annotators"))
        self.table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.table.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        who = {"mine": tr("you"), "theirs": tr("them"), "conflict": tr("both")}
        for row, run in enumerate(self.runs):
            info = self._session.annotation.tracks[run.track]
            gap = "" if run.gap != run.gap else f"{decimal(run.gap, '.1f')} px"
            frames = f"{run.first}–{run.last}" if run.last > run.first else str(run.first)
            for column, text in enumerate([self._session.title(info.object, info.number), frames,
                                           who.get(run.kind, run.kind), gap]):  # fmt: skip
                self.table.setItem(row, column, QTableWidgetItem(text))
            box = QComboBox()
            box.addItems([tr("mine"), tr("theirs"), tr("the middle")])
            box.setCurrentIndex(1 if run.kind == "theirs" else 0)
            box.setAccessibleName(tr("What to take"))
            self.choices.append(box)
            self.table.setCellWidget(row, 4, box)
        self.table.currentCellChanged.connect(self._show)

    def _show(self, row: int) -> None:
        """The run in the frame behind this window."""
        if 0 <= row < len(self.runs):
            run: MergeRun = self.runs[row]
            self._session.select_track(run.track)
            self._session.go((run.first + run.last) // 2, jump=True)

    def _choose(self, choice: int) -> None:
        """Take mine, theirs or the middle for the row, and go to the next."""
        row = self.table.currentRow()
        if 0 <= row < len(self.choices):
            self.choices[row].setCurrentIndex(choice)
            self.table.selectRow(min(row + 1, len(self.choices) - 1))

    def _merge(self) -> None:
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._session.do(self.edit())
        self.accept()
