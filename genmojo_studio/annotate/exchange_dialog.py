"""Swap, split, join: with which point and in which frames, shown in the frame before it is done, as one step."""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
from PySide6.QtCore import QSize, Qt
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_core.tracks import exchange
from genmojo_core.tracks.annotation import Annotation
from genmojo_core.tracks.edits import CellsChange, Edit
from genmojo_core.tracks.model import NONE
from genmojo_studio.annotate.colours import point_colour
from genmojo_studio.annotate.frame_keys import FrameKeys
from genmojo_studio.annotate.session import Other, Session
from genmojo_studio.annotate.track_tree import point_icon
from genmojo_studio.annotate.verbs import in_work, marked_run
from genmojo_studio.translate import fault, tr

Kind = Literal["swap", "split", "join"]
KINDS: tuple[Kind, ...] = get_args(Kind)
Point = tuple[int, int]  # object id, number
_POINT = Qt.ItemDataRole.UserRole


def hindrance(session: Session, kind: Kind) -> str:
    """Why the active track cannot be swapped, split or joined, in a sentence; "" if it can."""
    annotation, track = session.annotation, session.track
    if track is None:
        return tr("Choose a point that has a track first.")
    if annotation.tracks[track].locked:
        return tr("This track is locked; unlock it first (Ctrl+L).")
    if kind == "split" and not annotation.track(track).state[session.frame :].any():
        return tr("This track has nothing from this frame on; go to an earlier frame.")
    if kind != "split" and not any(not i.locked for i in annotation.active() if i.id != track):
        return tr("There is no other track that is not locked.")
    return ""


class ExchangeDialog(QDialog):
    """Partners in a list, frames or the side that wins below it; the frame behind shows what would come of it.

    Args:
        session: its active track is the one that is changed; it has one. kind: what is done.
    """

    def __init__(self, session: Session, kind: Kind, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._kind, self._track = session, kind, int(session.track or 0)
        self._from = session.frame
        self._runs = self._choices_of_frames()
        titles = {"swap": tr("Swap two points"), "split": tr("Split a track"), "join": tr("Join two tracks")}
        asked = {"swap": tr("{point} changes places with:"), "join": tr("{point} takes the frames of:"),
                 "split": tr("{point} is, from frame {n} on:")}  # fmt: skip
        self.setWindowTitle(titles[kind])
        self.resize(340, 430)
        own = session.annotation.tracks[self._track]
        head = QLabel(asked[kind].format(point=session.label(own.object, own.number), n=self._from), wordWrap=True)
        self.partners = QListWidget()
        self.partners.setAccessibleName(tr("Points"))
        self.partners.setIconSize(QSize(16, 16))
        self.frames, self.winner = QComboBox(), QComboBox()
        self.frames.addItems([text for text, _ in self._runs])
        self.frames.setAccessibleName(tr("Frames"))
        self.winner.setAccessibleName(tr("Whose places stand where both have some"))
        self.about = QLabel(wordWrap=True)
        self.about.setMinimumHeight(52)
        note = QLabel(tr("The frame shows what comes of it; , and . step through it. One step; it can be undone."),
                      wordWrap=True)  # fmt: skip
        note.setProperty("role", "dim")
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        texts = {"swap": tr("Swap"), "split": tr("Split"), "join": tr("Join")}
        self.take = buttons.addButton(texts[kind], QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self._apply)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        for widget in (head, self.partners, self.frames, self.winner, self.about, note, buttons):
            column.addWidget(widget)
        self.frames.setVisible(kind == "swap")
        self.winner.setVisible(kind == "join")
        self._fill()
        FrameKeys(session, self.partners)
        self.partners.currentItemChanged.connect(self._chosen)
        self.frames.currentIndexChanged.connect(self.refresh)
        self.winner.currentIndexChanged.connect(self.refresh)
        self.finished.connect(self._forget)
        self._chosen()
        self.partners.setFocus()

    def beside(self, canvas: QWidget) -> None:
        """Stand where the frame is seen: at its right edge, over the panel beside it."""
        corner = canvas.mapToGlobal(canvas.rect().topRight())
        window = canvas.window()
        right = window.mapToGlobal(window.rect().topRight()).x()
        self.move(max(min(corner.x() + 8, right - self.width() - 8), 0), corner.y() + 30)

    def partner(self) -> Point | None:
        """The point chosen: object id and number."""
        item = self.partners.currentItem()
        return item.data(_POINT) if item is not None else None

    def edit(self) -> Edit:
        """What would be done. Raises GenmojoError as the functions of `exchange`."""
        session, point = self._session, self.partner()
        if point is None:
            return Edit(self._kind, "")
        if self._kind == "split":
            return exchange.split(session.annotation, self._track, self._from, point[1], point[0])
        other = int(session.track_of(*point) or 0)
        if self._kind == "join":
            return exchange.join_tracks(session.annotation, self._track, other, self.winner.currentIndex() == 1)
        first, last = self._runs[max(self.frames.currentIndex(), 0)][1]
        return exchange.swap(session.annotation, self._track, other, first, last)

    def refresh(self) -> None:
        """Say what the choice would do, and show it in the frame."""
        try:
            edit = self.edit()
        except GenmojoError as error:
            self.about.setText(fault(error))
            self.take.setEnabled(False)
            self._show(None)
            return
        changed = {c.track: len(c.frames) for c in edit.changes if isinstance(c, CellsChange)}
        self.take.setEnabled(bool(edit.changes))
        self.about.setText(self._words(edit, max(changed.values(), default=0)))
        self._show(edit)

    def _words(self, edit: Edit, count: int) -> str:
        """What an edit does to how many frames."""
        if not edit.changes:
            return tr("Neither point has a place in these frames; nothing would change.")
        if self._kind == "split":
            return tr("{n} frames move.").format(n=count)
        point = self.partner() or (0, 0)
        if self._kind == "swap":
            return tr("{n} frames change places.").format(n=count)
        both, keyed = exchange.conflicts(
            self._session.annotation, self._track, int(self._session.track_of(*point) or 0)
        )
        if not len(both):
            return tr("{n} frames are taken over; no frame has both.").format(n=count)
        said = tr("{n} frames are taken over. In {both} frames both have a place, in {keyed} of them both were placed "
                  "by hand; otherwise what a person placed or accepted goes first.")  # fmt: skip
        return said.format(n=count, both=len(both), keyed=len(keyed))

    def _choices_of_frames(self) -> list[tuple[str, tuple[int, int]]]:
        """The marked run first, if there is one."""
        session, last = self._session, self._session.annotation.frames - 1
        found = []
        if session.run != (None, None) and session.run_track == session.track:
            run = marked_run(session)
            found.append((tr("in the marked frames {a} to {b}").format(a=run[0], b=run[1]), run))
        found.append((tr("from this frame on ({a} to {b})").format(a=self._from, b=last), (self._from, last)))
        found.append((tr("up to this frame ({a} to {b})").format(a=0, b=self._from), (0, self._from)))
        found.append((tr("in this frame only ({a})").format(a=self._from), (self._from, self._from)))
        found.append((tr("in all frames"), (0, last)))
        return found

    def _fill(self) -> None:
        """Points to choose from: for a split those that are free from here on, the first free one chosen."""
        session = self._session
        places = session.places()
        points = self._free() if self._kind == "split" else sorted(
            ((i.object, i.number) for i in session.annotation.active() if i.id != self._track),
            key=lambda p: (places.get(p[0], len(places)), p[1]))  # fmt: skip
        for point in points:
            track = session.track_of(*point)
            text = session.label(*point)
            item = QListWidgetItem(point_icon(places.get(point[0], len(places)), point[1]), text)
            item.setData(_POINT, point)
            if track is not None and session.annotation.tracks[track].locked:
                item.setText(f"{text}   ({tr('locked')})")
                item.setFlags(item.flags() & ~(Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable))
            self.partners.addItem(item)
        own = session.active[0]
        rows = [r for r in range(self.partners.count()) if self.partners.item(r).flags() & Qt.ItemFlag.ItemIsEnabled]
        first = next((r for r in rows if self.partners.item(r).data(_POINT)[0] == own), rows[0] if rows else -1)
        self.partners.setCurrentRow(first)

    def _free(self) -> list[Point]:
        """Points without a place in the frames that would move; one more number where an object has none left."""
        session, annotation = self._session, self._session.annotation
        moved = np.flatnonzero(annotation.track(self._track).state[self._from :] != NONE) + self._from
        found = []
        for owner in session.objects():
            taken = {i.number: i.id for i in annotation.tracks_of(owner.id)}
            numbers = [
                n
                for n in range(1, max([session.limit("points"), *taken]) + 1)
                if n not in taken or (taken[n] != self._track and not annotation.track(taken[n]).state[moved].any())
            ]
            found += [(owner.id, n) for n in numbers or [max(taken) + 1]]
        return found

    def _chosen(self, *_: object) -> None:
        """Another partner: who may win is named anew."""
        own, point = self._session.annotation.tracks[self._track], self.partner()
        if point is not None:
            chosen = max(self.winner.currentIndex(), 0)
            self.winner.blockSignals(True)
            self.winner.clear()
            both = tr("where both were placed: {point}")
            names = (self._session.label(own.object, own.number), self._session.label(*point))
            self.winner.addItems([both.format(point=name) for name in names])
            self.winner.setCurrentIndex(chosen)
            self.winner.blockSignals(False)
        self.refresh()

    def _show(self, edit: Edit | None) -> None:
        """The tracks as they would be, in the frames that change, over the frame."""
        self._session.others = () if edit is None else tuple(_ghosts(self._session, edit))
        self._session.shown.emit()

    def _forget(self) -> None:
        self._session.others = ()
        self._session.shown.emit()

    def _apply(self) -> None:
        session = self._session
        edit = self.edit()
        self.accept()
        step = session.do(edit)
        if step is None:
            return
        session.run = (None, None)
        for track in {c.track for c in edit.changes if isinstance(c, CellsChange)} & set(session.annotation.tracks):
            in_work(session, track, step)
        session.select_track(edit.track or self._track)
        session.settings_changed.emit()
        said = {"swap": tr("Swapped; Ctrl+Z takes it back."), "split": tr("Split; the new part is active now."),
                "join": tr("Joined; Ctrl+Z takes it back.")}  # fmt: skip
        session.said.emit(said[self._kind])


def _ghosts(session: Session, edit: Edit) -> list[Other]:
    """Every track of an edit as it would be, in the frames that it changes; made beside the annotation."""
    now = session.annotation
    then = Annotation(now.frames, now.size)
    for owner in now.objects.values():
        then.put_object(owner.id, owner)
    changes = [c for c in edit.changes if isinstance(c, CellsChange)]
    for track in {c.track for c in changes} & set(now.tracks):
        then.put_track(track, now.tracks[track])
        then.write_cells(track, np.arange(now.frames), now.track(track))
    edit.do(then)
    places, found = session.places(), []
    for change in changes:
        if change.track not in then.tracks:
            continue
        info = then.tracks[change.track]
        alone = Annotation(now.frames, now.size)
        alone.put_track(change.track, info)
        alone.write_cells(change.track, change.frames, then.cells(change.track, change.frames))
        colour = point_colour(places.get(info.object, len(places)), info.number - 1)
        found.append(Other(alone, change.track, f"→ {session.label(info.object, info.number)}", colour))
    return found
