"""A second annotator's project beside this one: how far they agree, and a merge that is looked at before it is done."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
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

from genmojo_core.tracks.agreement import agreement, pairs
from genmojo_core.tracks.annotation import Annotation
from genmojo_core.tracks.edits import Edit
from genmojo_core.tracks.merge import Choice, Difference, MergeRun, MergeThing, locked, merge, preview
from genmojo_studio.annotate.frame_keys import FrameKeys
from genmojo_studio.annotate.picture_watch import spans
from genmojo_studio.annotate.session import Other, Session
from genmojo_studio.annotate.track_tree import review_name
from genmojo_studio.translate import decimal, tr

_CHOICES: tuple[Choice, ...] = ("mine", "theirs", "middle")


class MergeDialog(QDialog):
    """Figures of agreement above, one row per difference below; a click shows both sides of it in the frame.

    Args:
        session: the project that is open. theirs: the other annotator's. base: what both began from, or None.
        doubt: of `project_file.clip_doubt`; with one nothing is merged before a person said it is the same clip.
        differing, compared: frames whose pictures differ, and how many could be compared.
    Raises GenmojoError as `merge.preview`.
    """

    def __init__(self, session: Session, theirs: Annotation, base: Annotation | None, parent: QWidget | None = None,
                 doubt: str = "", differing: Sequence[int] = (), compared: int = 0) -> None:  # fmt: skip
        super().__init__(parent)
        self._session, self._theirs = session, theirs
        self.runs = preview(base, session.annotation, theirs)
        self.figures = agreement(session.annotation, theirs) if pairs(session.annotation, theirs) else {}
        self.choices: list[QComboBox] = []
        self.setWindowTitle(tr("Compare with a second annotator"))
        self.resize(720, 520)
        self.table = QTableWidget(len(self.runs), 5)
        self.table.setTabKeyNavigation(False)
        self._fill()
        note = QLabel(tr("What only they changed is taken over; of conflicts, what you choose (keys 1, 2, 3 for the "
                         "row). The frame shows their point beside yours; , and . step through it. One step; it can "
                         "be undone."), wordWrap=True)  # fmt: skip
        note.setProperty("role", "dim")
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        self.take = buttons.addButton(tr("Merge"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self._merge)
        buttons.rejected.connect(self.reject)
        for n in range(len(_CHOICES)):
            QShortcut(QKeySequence(str(n + 1)), self, partial(self._choose, n))
        FrameKeys(session, self.table)
        self.sure = QCheckBox(tr("It is the same clip all the same"))
        self.sure.toggled.connect(self._allow)
        warning = QLabel(_doubt_text(doubt, differing, compared), wordWrap=True)
        warning.setProperty("role", "warn")
        column = QVBoxLayout(self)
        for widget in (QLabel(self._summary(), wordWrap=True), warning, self.sure, self.table, note, buttons):
            column.addWidget(widget)
        self._doubtful = bool(doubt)
        warning.setVisible(self._doubtful)
        self.sure.setVisible(self._doubtful)
        self._allow()
        self.finished.connect(self._forget)
        if self.runs:
            self.table.setCurrentCell(0, 0)

    def edit(self) -> Edit:
        """The merge as chosen."""
        chosen: dict[int, Choice] = {n: _CHOICES[box.currentIndex()] for n, box in enumerate(self.choices)}
        return merge(self._session.annotation, self._theirs, self.runs, chosen)

    def _summary(self) -> str:
        f = self.figures
        if not f:
            return tr("No point in common.")

        def told(key: str, form: str) -> str:
            return decimal(f[key], form) if math.isfinite(f[key]) else "–"

        return tr("{n} tracks in common. AJ {aj}, δ {delta}, OA {oa} %. Distance where both see the point: median "
                  "{median} px, 90 % below {p90} px (1080 lines). Same state in {states}.").format(
            n=int(f["tracks"]), aj=told("aj", ".1f"), delta=told("delta", ".1f"), oa=told("oa", ".1f"),
            median=told("median_px", ".2f"), p90=told("p90_px", ".2f"),
            states=told("states", ".1%"))  # fmt: skip

    def _fill(self) -> None:
        self.table.setHorizontalHeaderLabels([tr("point"), tr("what"), tr("changed by"), tr("distance"), tr("take")])
        self.table.verticalHeader().hide()
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setAccessibleName(tr("Differences between the two annotators"))
        self.table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        self.table.horizontalHeader().setSectionResizeMode(1, QHeaderView.ResizeMode.Stretch)
        who = {"mine": tr("you"), "theirs": tr("them"), "conflict": tr("both")}
        for row, one in enumerate(self.runs):
            gap = f"{decimal(one.gap, '.1f')} px" if isinstance(one, MergeRun) and math.isfinite(one.gap) else ""
            fixed = locked(self._session.annotation, one)
            texts = [self._title(one), _what(one), tr("locked") if fixed else who.get(one.kind, one.kind), gap]
            for column, text in enumerate(texts):
                item = QTableWidgetItem(text)
                if fixed:
                    item.setForeground(self.palette().placeholderText())
                    item.setToolTip(tr("This track is locked and stays as it is; unlock it to merge it."))
                self.table.setItem(row, column, item)
            box = QComboBox()
            box.addItems([tr("mine"), tr("theirs"), tr("the middle")][: 3 if isinstance(one, MergeRun) else 2])
            box.setCurrentIndex(1 if one.kind == "theirs" and not fixed else 0)
            box.setEnabled(not fixed)
            box.setAccessibleName(tr("What to take"))
            self.choices.append(box)
            self.table.setCellWidget(row, 4, box)
        self.table.currentCellChanged.connect(self._show)

    def _title(self, one: Difference) -> str:
        """What a person calls the point or object of a row."""
        if isinstance(one, MergeRun):
            info = self._session.annotation.tracks[one.track]
            return self._session.title(info.object, info.number)
        owner = self._session.annotation.objects.get(one.object) or self._theirs.objects.get(one.object)
        if not one.number:
            return owner.name if owner and owner.name else tr("object {n}").format(n=one.object)
        if one.object in self._session.annotation.objects or owner is None:
            return self._session.title(one.object, one.number)
        return f"{owner.name} · {one.number}"

    def _show(self, row: int) -> None:
        """Both sides of a row in the frame behind this window."""
        if not 0 <= row < len(self.runs):
            return
        one = self.runs[row]
        session, their = self._session, one.their
        session.others = (Other(self._theirs, their, tr("theirs")),) if their is not None else ()
        if one.track is not None:
            session.select_track(one.track)
        frame = session.frame
        if isinstance(one, MergeRun):
            frame = (one.first + one.last) // 2
        elif their is not None and one.track is None:
            known = self._theirs.track(their).state.nonzero()[0]
            frame = int(known[0]) if len(known) else frame
        session.go(frame, jump=True)
        session.shown.emit()

    def _choose(self, choice: int) -> None:
        """Take mine, theirs or the middle for the row, and go to the next."""
        row = self.table.currentRow()
        if 0 <= row < len(self.choices) and choice < self.choices[row].count():
            if self.choices[row].isEnabled():
                self.choices[row].setCurrentIndex(choice)
            self.table.selectRow(min(row + 1, len(self.choices) - 1))

    def _allow(self) -> None:
        free = [n for n, one in enumerate(self.runs) if not locked(self._session.annotation, one)]
        self.take.setEnabled(bool(free) and (self.sure.isChecked() or not self._doubtful))

    def _forget(self) -> None:
        """Nothing of theirs stays in the frame."""
        self._session.others = ()
        self._session.shown.emit()

    def _merge(self) -> None:
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._session.do(self.edit())
        self.accept()


def _doubt_text(doubt: str, differing: Sequence[int], compared: int) -> str:
    """Why two projects may be of different clips."""
    some = tr("The pictures differ in {n} of {all} frames compared ({frames}): the projects may be of different clips.")
    pictures = some.format(n=len(differing), all=compared, frames=spans(differing))
    if len(differing) == compared:
        pictures = tr("The pictures of the two projects differ in every frame: they are of different clips.")
    texts = {"pictures": pictures,
             "times": tr("The time stamps of the two projects differ: they may be of different clips."),
             "name": tr("The two projects are of clips of different names.")}  # fmt: skip
    return texts.get(doubt, "")


def _what(one: Difference) -> str:
    """What differs in a row."""
    if isinstance(one, MergeRun):
        if one.last > one.first:
            return tr("frames {first} to {last}").format(first=one.first, last=one.last)
        return tr("frame {n}").format(n=one.first)
    sides = [_words(one, words) for words in (one.mine, one.theirs)]
    titles = {"point": tr("whole point"), "name": tr("name"), "note": tr("note"), "review": tr("review"),
              "object": tr("object"), "object name": tr("name")}  # fmt: skip
    return f"{titles[one.what]}: {sides[0]} | {sides[1]}"


def _words(one: MergeThing, words: str) -> str:
    """One side of a difference, for a person."""
    if not words:
        return "–"
    if one.what == "point":
        return tr("{n} frames").format(n=words)
    if one.what == "review":
        return review_name(words)
    if one.what == "object":
        return {"chosen": tr("chosen"), "rejected": tr("rejected")}.get(words, words)
    return words
