"""The tree of objects and their points: glyph, state in this frame, key, doubt, review. The same on every page."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QSize, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QIcon, QPainter, QPixmap
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTreeWidget, QTreeWidgetItem

from genmojo_core.tracks.annotation import CONFIRMED, KEY, UNCERTAIN
from genmojo_studio.annotate.colours import object_colour, point_colour
from genmojo_studio.annotate.eliding import Distinct
from genmojo_studio.annotate.overlay import glyph_path
from genmojo_studio.annotate.session import Session
from genmojo_studio.translate import tr

_POINT = Qt.ItemDataRole.UserRole


def state_name(state: int) -> str:
    """A state as a person says it."""
    return {1: tr("visible"), 2: tr("occluded"), 3: tr("out of view")}.get(state, tr("none"))


def review_name(review: str) -> str:
    """Where a track's review stands, as a person says it."""
    names = {"draft": tr("draft"), "in_progress": tr("in progress"), "needs_fix": tr("needs a fix"),
             "fixed": tr("fixed"), "approved": tr("approved"), "rejected": tr("rejected")}  # fmt: skip
    return names.get(review, review)


def _rounds(count: int) -> str:
    """How often a track went back to its annotator, "" for never."""
    return tr("sent back {n} times").format(n=count) if count > 1 else tr("sent back once") if count else ""


def point_icon(place: int, number: int, size: int = 16) -> QIcon:
    """A point's glyph in its colour; number from 1, 0 for the object itself."""
    pixmap = QPixmap(size * 2, size * 2)
    pixmap.setDevicePixelRatio(2)
    pixmap.fill(Qt.GlobalColor.transparent)
    painter = QPainter(pixmap)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, on=True)
    painter.setPen(QColor(20, 22, 26, 120))
    painter.setBrush(QColor(*(point_colour(place, number - 1) if number else object_colour(place))))
    if number:
        painter.drawPath(glyph_path(number - 1, size * 0.36).translated(QPointF(size / 2, size / 2)))
    else:
        painter.drawRoundedRect(2, 4, size - 4, size - 8, 3, 3)
    painter.end()
    return QIcon(pixmap)


class TrackTree(QTreeWidget):
    """Objects and points; choosing one makes it active."""

    chosen = Signal(int, int)  # object id, number

    def __init__(self, session: Session, columns: tuple[str, ...] = ("state", "doubt")) -> None:
        super().__init__()
        self._session, self._columns = session, columns
        titles = {"state": tr("state"), "doubt": tr("doubt"), "review": tr("review"), "frame": tr("placed")}
        self.setColumnCount(1 + len(columns))
        self.setHeaderLabels([tr("point"), *(titles[c] for c in columns)])
        self.header().setStretchLastSection(False)
        self.header().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        for column in range(1, 1 + len(columns)):
            self.header().setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        self.setIndentation(14)
        self.setUniformRowHeights(True)
        self.setTextElideMode(Qt.TextElideMode.ElideMiddle)
        self.setItemDelegateForColumn(0, Distinct(self))
        self.setIconSize(QSize(16, 16))
        self.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        self.setAccessibleName(tr("Objects and points"))
        self._items: dict[tuple[int, int], QTreeWidgetItem] = {}
        self._quiet = False
        self._later = QTimer(self, singleShot=True, interval=60)
        self._later.timeout.connect(self._update_states)
        self.itemClicked.connect(self._clicked)
        self.currentItemChanged.connect(self._moved)
        session.edited.connect(self._edited)
        session.selected.connect(self._select)
        session.shown.connect(self._later.start)
        session.frame_changed.connect(self._frame_changed)
        self.verticalScrollBar().valueChanged.connect(self._frame_changed)
        self.destroyed.connect(session.state.subscribe(self._dress, "theme"))
        self.rebuild()

    def showEvent(self, event: object) -> None:
        """Made up to date when it is looked at."""
        self._later.start()

    def rebuild(self) -> None:
        """Objects or points have come or gone."""
        session = self._session
        self._quiet = True
        self.clear()
        self._items = {}
        for place, info in enumerate(session.objects()):
            top = QTreeWidgetItem(self, [info.name or tr("object {n}").format(n=info.id)])
            top.setIcon(0, point_icon(place, 0))
            top.setData(0, _POINT, (info.id, 0))
            numbers = {t.number: t for t in session.annotation.tracks_of(info.id)}
            for number in range(1, max([session.limit("points"), *numbers]) + 1):
                name = numbers[number].name if number in numbers else ""
                item = QTreeWidgetItem(top, [f"{number}  {name}".rstrip()])
                item.setIcon(0, point_icon(place, number))
                item.setData(0, _POINT, (info.id, number))
                self._items[info.id, number] = item
            top.setExpanded(True)
        self._quiet = False
        self._update_states()
        self._select()

    def _edited(self, touched: object) -> None:
        wanted = {(o.id, n) for o in self._session.objects() for n in range(1, self._session.limit("points") + 1)}
        wanted |= {(i.object, i.number) for i in self._session.annotation.tracks.values()
                   if self._session.annotation.objects.get(i.object) in self._session.objects()}  # fmt: skip
        if wanted != set(self._items) or getattr(touched, "objects", None):
            self.rebuild()

    def _dress(self) -> None:
        """Another theme, other colours of the states."""
        self._later.start()

    def _frame_changed(self, _frame: int) -> None:
        self._later.start()

    def _update_states(self) -> None:
        """The rows that show; the others are filled when they are scrolled to."""
        view = self._session.annotation.at(self._session.frame)
        known = dict(zip(view.ids.tolist(), zip(view.state.tolist(), view.flags.tolist(), strict=True), strict=True))
        item = self.itemAt(2, 2) or self.topLevelItem(0)
        while item is not None and self.visualItemRect(item).top() <= self.viewport().height():
            object_id, number = item.data(0, _POINT)
            if number:
                track = self._session.track_of(object_id, number)
                name = "" if track is None else self._session.annotation.tracks[track].name
                item.setText(0, f"{number}  {name}".rstrip())
                for column, kind in enumerate(self._columns, 1):
                    text, colour = self._cell(track, kind, known)
                    item.setText(column, text)
                    item.setForeground(column, colour)
                    if kind == "review" and track is not None:
                        item.setToolTip(column, _rounds(self._session.annotation.tracks[track].rounds))
            item = self.itemBelow(item)

    def _cell(self, track: int | None, kind: str, known: dict[int, tuple[int, int]]) -> tuple[str, QColor]:
        if track is None:
            return ("–" if kind != "doubt" else ""), self.palette().placeholderText().color()
        session, info = self._session, self._session.annotation.tracks[track]
        plain = self.palette().text().color()
        if kind == "review":
            return review_name(info.review) + (f"  ↩{info.rounds}" if info.rounds else ""), plain
        if kind == "frame":
            keys = session.annotation.keys(track)
            late = tr("frame {n}, late") if len(keys) and keys[0] else tr("frame {n}")
            return (late.format(n=keys[0]) if len(keys) else "–"), plain
        if kind == "doubt":
            values = session.suspicion.get(track)
            doubt = float(values[session.frame]) if values is not None else 0.0
            return (f"!{round(9 * doubt)}" if doubt >= 0.3 else ""), QColor(220, 70, 60)
        state, flags = known.get(track, (0, 0))
        marks = (" ◆" if flags & KEY else " ✓" if flags & CONFIRMED else "") + ("?" if flags & UNCERTAIN else "")
        return state_name(state) + marks, plain

    def _select(self) -> None:
        item = self._items.get(self._session.active)
        if item is not None and item is not self.currentItem():
            self._quiet = True
            owner = item.parent()
            if owner is not None:
                self.scrollToItem(owner)  # whose point it is, as far as there is room for both
            self.setCurrentItem(item)
            self.scrollToItem(item)
            self._quiet = False

    def _clicked(self, item: QTreeWidgetItem) -> None:
        object_id, number = item.data(0, _POINT)
        self.chosen.emit(object_id, number or 1)

    def _moved(self, item: QTreeWidgetItem | None) -> None:
        if item is not None and not self._quiet and self.hasFocus():
            self._clicked(item)
