"""Step 3: the active point in figures and words, and the queue of suspicious spots, worst first."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QSizePolicy,
    QSplitter,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.sentences import say
from genmojo_core.tracks.annotation import KEY
from genmojo_core.tracks.edit_tracks import update_track
from genmojo_core.tracks.suspicion import Spot
from genmojo_studio.annotate import returned
from genmojo_studio.annotate.button_panel import grid_of
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.spot_queue import SpotQueue, spot_at
from genmojo_studio.annotate.track_tree import TrackTree, state_name
from genmojo_studio.translate import decimal, told, tr

MOST_SHOWN = 200


class RefinePage(QWidget):
    """Tree, details, queue."""

    spot_chosen = Signal(object)  # Spot

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.spots: list[Spot] = []
        self.returned = returned.ReturnedBar(session)
        self.tree = TrackTree(session, ("state", "doubt"))
        self.place, self.state, self.seed, self.why = QLabel(), QLabel(), QLabel(), QLabel(wordWrap=True)
        self.note = QLineEdit(placeholderText=tr("note about this track"))
        self._pins = 0  # spots at the head of the queue that came back from the review
        self._noted: int | None = None  # the track that the note on show belongs to
        self.queue = QListWidget()
        self.queue.setAccessibleName(tr("Suspicious spots, worst first"))
        self.queue.setWordWrap(True)
        self.queue.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.queue.setSpacing(2)
        self.title = QLabel()
        self.title.setProperty("role", "dim")
        self.why.setMinimumHeight(34)
        self.why.setAlignment(Qt.AlignmentFlag.AlignTop)
        self._arrange()
        self._later = QTimer(self, singleShot=True, interval=60)
        self._later.timeout.connect(self.refresh)
        self.queue.itemActivated.connect(self._activated)
        self.queue.itemClicked.connect(self._activated)
        self.note.editingFinished.connect(self._keep_note)
        session.selected.connect(self._other_note)
        session.shown.connect(self._later.start)
        session.frame_changed.connect(self._frame_changed)
        self.show_queue(SpotQueue(session))

    def show_queue(self, queue: SpotQueue) -> None:
        """List the queue: the one on show selected, those looked at pale."""
        left, row = queue.left(), -1
        same = self.spots == queue.spots
        self.spots, self._pins = queue.spots, len(queue.pins)
        title = tr("Queue: {n} of {m} left (N goes to the next)").format(n=len(left), m=len(self.spots))
        if len(self.spots) > MOST_SHOWN:
            title += tr("; the worst {n} are listed").format(n=MOST_SHOWN)
        self.title.setText(title)
        self.title.setToolTip(title)
        if not same:
            self._list(self.spots)
        waiting = {id(s) for s in (*left, *queue.pins)}
        pale, full = self.palette().placeholderText(), self.palette().text()
        for n in range(self.queue.count()):
            item = self.queue.item(n)
            spot = self.spots[item.data(Qt.ItemDataRole.UserRole)]
            item.setForeground(full if id(spot) in waiting else pale)
            if spot == queue.current:
                row = n
        self.queue.setCurrentRow(row)
        self.refresh()

    def _list(self, spots: list[Spot]) -> None:
        self.queue.clear()
        for place, spot in enumerate(spots[:MOST_SHOWN]):
            info = self._session.annotation.tracks.get(spot.track)
            if info is None:
                continue
            where = f"{spot.first}–{spot.last}" if spot.last > spot.first else str(spot.first)
            why = ", ".join(map(told, spot.reasons[:2]))
            text = f"{self._session.title(info.object, info.number)}   {where}   {why}"
            item = QListWidgetItem(text, self.queue)
            item.setData(Qt.ItemDataRole.UserRole, place)
            item.setToolTip("\n".join(map(told, spot.reasons)))
            if place < self._pins:
                item.setText(f"↩ {text}")
                item.setBackground(returned.tint(60))

    def refresh(self) -> None:
        """The active point in this frame."""
        session, track = self._session, self._session.track
        if track is None:
            for label in (self.place, self.state, self.seed, self.why):
                label.setText("–")
            return
        cells = session.annotation.cells(track, np.array([session.frame]))
        x, y = cells.xy[0]
        self.place.setText(f"x {decimal(x, '.2f')}   y {decimal(y, '.2f')}" if cells.state[0] else "–")
        marks = ", ".join(name for bit, name in ((KEY, tr("key")), (4, tr("accepted")), (2, tr("uncertain")),
                                                 (8, tr("snapped"))) if cells.flags[0] & bit)  # fmt: skip
        self.state.setText(state_name(int(cells.state[0])) + (f"  ({marks})" if marks else ""))
        sources = ("–", tr("a person"), tr("tracker"), tr("flow"), tr("line"), tr("import"), tr("hold"),
                   tr("scene"), "CoTracker", tr("file"))  # fmt: skip
        made = sources[int(cells.source[0])] if int(cells.source[0]) < len(sources) else "?"
        self.seed.setText(f"{made}, {tr('confidence')} {decimal(cells.conf[0], '.2f')}")
        spot = spot_at(self.spots[self._pins :], track, session.frame)
        info = session.annotation.tracks[track]
        doubts = map(told, spot.reasons[:2]) if spot else ()
        back = returned.words(session, info) if info.review == "needs_fix" else ""
        self.why.setText("\n".join(filter(None, (back, "; ".join(doubts)))) or tr("nothing"))
        if not self.note.hasFocus():
            self.note.setText(info.note)

    def _arrange(self) -> None:
        below = QWidget()
        column = QVBoxLayout(below)
        column.setContentsMargins(0, 2, 0, 0)
        column.setSpacing(4)
        column.addWidget(grid_of([(tr("place"), self.place), (tr("state"), self.state), (tr("made by"), self.seed),
                                  (tr("why"), self.why), (tr("note"), self.note)]))  # fmt: skip
        column.addWidget(self.title)
        column.addWidget(self.queue, 1)
        for label in (self.title, self.place, self.state, self.seed):
            label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.tree.setMinimumHeight(80)
        self.queue.setMinimumHeight(60)
        split = QSplitter(Qt.Orientation.Vertical)
        split.addWidget(self.tree)
        split.addWidget(below)
        split.setStretchFactor(0, 3)
        split.setStretchFactor(1, 4)
        split.setChildrenCollapsible(False)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(8, 6, 8, 6)
        outer.addWidget(self.returned)
        outer.addWidget(split, 1)
        QWidget.setTabOrder(self.tree, self.note)

    def _frame_changed(self, _frame: int) -> None:
        self._later.start()

    def _activated(self, item: QListWidgetItem) -> None:
        self.spot_chosen.emit(self.spots[item.data(Qt.ItemDataRole.UserRole)])

    def _other_note(self) -> None:
        """Another track is active: what was typed is kept, and its own note is shown."""
        self._keep_note()
        self._noted = self._session.track
        info = self._session.annotation.tracks.get(self._noted or 0)
        self.note.setText(info.note if info is not None else "")

    def _keep_note(self) -> None:
        """A note goes to the track that it was typed for, whichever is active by now."""
        session, track = self._session, self._noted
        info = session.annotation.tracks.get(track or 0)
        if info is not None and self.note.isModified() and self.note.text() != info.note:
            self.note.setModified(False)
            edit = update_track(session.annotation, info.id, say("note"), session.frame, note=self.note.text()[:400])
            session.do(edit)
