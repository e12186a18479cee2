"""The video play panel: one row with transport, frame and time, speed; below it the dope sheet or the graphs.

All of them, and the timeline below, show the same frames (`TimeView`).
"""

from __future__ import annotations

import time

from PySide6.QtCore import QObject, Qt, QTimer, Signal
from PySide6.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QSizePolicy,
    QStackedWidget,
    QTabBar,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.tracks.model import NONE, OCCLUDED, OUT_OF_VIEW, VISIBLE
from genmojo_studio.actions import ActionTable
from genmojo_studio.annotate.dope_sheet import DopeSheet
from genmojo_studio.annotate.graphs import Graphs
from genmojo_studio.annotate.session import Session
from genmojo_studio.annotate.sheet_legend import SheetLegend
from genmojo_studio.annotate.sheet_order import ORDERS
from genmojo_studio.annotate.sheet_painter import LABEL
from genmojo_studio.annotate.stride_marks import StrideMarks
from genmojo_studio.annotate.time_view import TimeView
from genmojo_studio.annotate.timeline import Timeline
from genmojo_studio.icons import icon
from genmojo_studio.translate import tr

SPEEDS = (0.1, 0.25, 0.5, 1.0, 2.0)
_TRANSPORT = (("move.first", "first"), ("move.stride_previous", "stride-previous"), ("move.previous", "previous"),
              ("move.play", "play"), ("move.next", "next"), ("move.stride_next", "stride-next"),
              ("move.last", "last"))  # fmt: skip


class Player(QObject):
    """Moves the session's frame along the clip's own clock; drops frames rather than time."""

    toggled = Signal(bool)

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.speed = 1.0
        self.loop: tuple[int, int] | None = None
        self._timer = QTimer(self)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.setInterval(8)
        self._timer.timeout.connect(self._tick)
        self._began, self._from = 0.0, 0

    @property
    def playing(self) -> bool:
        """True while time runs."""
        return self._timer.isActive()

    def toggle(self, loop: tuple[int, int] | None = None) -> None:
        """Play or pause; with `loop`, first and last frame are repeated."""
        if self.playing and loop == self.loop:
            self.stop()
            return
        self.loop = loop
        last = self._session.annotation.frames - 1
        if loop is None and self._session.frame >= last:
            self._session.go(0)
        if loop is not None and not loop[0] <= self._session.frame < loop[1]:
            self._session.go(loop[0])
        self._began, self._from = time.monotonic(), self._session.frame
        self._timer.start()
        self._session.state.set(playing=True)
        self.toggled.emit(True)

    def stop(self) -> None:
        """Pause."""
        self._timer.stop()
        self._session.state.set(playing=False)
        self.toggled.emit(False)

    def _tick(self) -> None:
        seconds = self._session.cache.seconds
        now = seconds[self._from] + (time.monotonic() - self._began) * self.speed
        last = self.loop[1] if self.loop else len(seconds) - 1
        frame = int(seconds.searchsorted(now, side="right")) - 1
        if frame <= last and now <= seconds[last] + 0.04:
            if frame != self._session.frame:
                self._session.go(min(frame, last))
        elif self.loop:
            self._session.go(self.loop[0])
            self._began, self._from = time.monotonic(), self.loop[0]
        else:
            self._session.go(last)
            self.stop()


class PlayPanel(QWidget):
    """Transport above, dope sheet or graphs, and the timeline of the clip."""

    def __init__(self, session: Session, actions: ActionTable, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session, self._actions = session, actions
        self.player = Player(session, self)
        self.view = TimeView(session, self)
        self.marks = StrideMarks(session, self)
        self.sheet, self.graphs = DopeSheet(session, self.view, self.marks), Graphs(session, self.view)
        self.timeline = Timeline(session, self.view, self.marks, self._across)
        self.brush = QComboBox()
        self.legend: SheetLegend | None = None
        self.tabs, self.stack = QTabBar(), QStackedWidget()
        for title, widget in ((tr("Dope sheet"), self.sheet), (tr("Graphs"), self.graphs)):
            self.tabs.addTab(title)
            self.stack.addWidget(widget)
        self.tabs.setDocumentMode(True)
        self.tabs.setDrawBase(False)
        self.tabs.setExpanding(False)
        self.tabs.setAccessibleName(tr("Dope sheet or graphs"))
        self.tabs.currentChanged.connect(self.stack.setCurrentIndex)
        column = QVBoxLayout(self)
        column.setContentsMargins(4, 2, 4, 2)
        column.setSpacing(2)
        column.addLayout(self._transport())
        column.addWidget(self.stack, 1)
        column.addWidget(self.timeline)
        session.frame_changed.connect(self._show_frame)
        self.player.toggled.connect(self._show_playing)
        self.destroyed.connect(session.state.subscribe(self._dress, "theme"))
        self.destroyed.connect(actions.subscribe(self._name_keys))
        self._dress()
        self._name_keys()
        self._show_frame(session.frame)

    def _across(self) -> tuple[float, float]:
        """Where the cells of the dope sheet begin and how wide they are; the timeline stands below them."""
        bar, rim = self.sheet.verticalScrollBar(), self.sheet.frameWidth()
        aside = bar.sizeHint().width() if bar.maximum() else 0
        return LABEL + rim, max(self.stack.width() - LABEL - 2 * rim - aside - 6, 1)

    def brush_state(self) -> int:
        """The state that a drag over the dope sheet paints."""
        return int(self.brush.currentData())

    def _transport(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.setSpacing(3)
        row.addWidget(self.tabs)
        row.addSpacing(8)
        self.buttons: dict[str, QToolButton] = {}
        for name, _ in _TRANSPORT:
            action = self._actions[f"annotate.{name}"]
            button = QToolButton()
            button.setAccessibleName(tr(action.text))
            button.setObjectName(action.id)
            button.setAutoRepeat(action.repeats)
            button.clicked.connect(self._clicked)
            self.buttons[name] = button
            row.addWidget(button)
        self.position = QLabel()
        self.position.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred)
        self.position.setMinimumWidth(92)
        row.addSpacing(8)
        row.addWidget(self.position, 1)
        for state, title in ((OCCLUDED, tr("occluded")), (OUT_OF_VIEW, tr("out of view")), (VISIBLE, tr("visible")),
                             (NONE, tr("nothing"))):  # fmt: skip
            self.brush.addItem(tr("paint {state}").format(state=title), state)
        self.brush.setAccessibleName(tr("State that a drag paints"))
        self.brush.setToolTip(tr("What a drag over the dope sheet paints"))
        row.addWidget(self.brush)
        self.order = QComboBox()
        for name, (title, tip) in ORDERS.items():
            self.order.addItem(tr(title), name)
            self.order.setItemData(self.order.count() - 1, tr(tip), Qt.ItemDataRole.ToolTipRole)
        self.order.setAccessibleName(tr("Order of the rows"))
        self.order.setToolTip(tr("Order of the rows of the dope sheet"))
        self.order.activated.connect(lambda n: self.sheet.set_order(str(self.order.itemData(n))))
        row.addWidget(self.order)
        self.speed = QComboBox()
        for speed in SPEEDS:
            self.speed.addItem(f"{speed:g}×", speed)
        self.speed.setCurrentIndex(SPEEDS.index(1.0))
        self.speed.setAccessibleName(tr("Speed"))
        self.speed.currentIndexChanged.connect(self._take_speed)
        row.addWidget(self.speed)
        self.help = QToolButton()
        self.help.setText("?")
        self.help.setObjectName("annotate.view.legend")
        self.help.setAccessibleName(tr("Signs of the dope sheet"))
        self.help.setToolTip(tr("What the signs mean, and what the mouse does"))
        self.help.clicked.connect(self._clicked)
        row.addWidget(self.help)
        return row

    def set_order(self, order: str) -> None:
        """Sort the rows of the dope sheet, one of `ORDERS`."""
        self.order.setCurrentIndex(self.order.findData(order))
        self.sheet.set_order(order)

    def show_legend(self) -> None:
        """What the signs of the dope sheet mean."""
        if self.legend is not None:
            self.legend.close()
            self.legend.deleteLater()
        self.legend = SheetLegend(self)  # drawn anew: the theme may have changed
        self.legend.show()

    def _clicked(self) -> None:
        sender = self.sender()
        if sender is not None:
            self._actions.trigger(sender.objectName())

    def _take_speed(self) -> None:
        self.player.speed = float(self.speed.currentData())
        if self.player.playing:
            self.player.toggle(self.player.loop)
            self.player.toggle(self.player.loop)

    def _show_frame(self, frame: int) -> None:
        last = self._session.annotation.frames - 1
        seconds = self._session.cache.seconds[min(frame, len(self._session.cache.seconds) - 1)]
        self.position.setText(tr("frame {n} of {last}   {s:.2f} s").format(n=frame, last=last, s=seconds))
        self.position.setToolTip(self.position.text())

    def _show_playing(self, _playing: bool) -> None:
        self._dress()

    def _name_keys(self) -> None:
        """The keys that do the same, as they are now."""
        for name, button in self.buttons.items():
            action = self._actions[f"annotate.{name}"]
            keys = ", ".join(self._actions.keys(action.id))
            button.setToolTip(f"{tr(action.text)} ({keys})" if keys else tr(action.text))

    def _dress(self) -> None:
        """Icons in the theme's colours."""
        for name, picture in _TRANSPORT:
            shown = "pause" if name == "move.play" and self.player.playing else picture
            self.buttons[name].setIcon(icon(shown, self._session.state.theme))
