"""The annotator's window part: four panels as movable docks, four steps, one clip at a time."""

from __future__ import annotations

import getpass
from collections.abc import Iterator
from pathlib import Path

from PySide6.QtCore import QPoint, Qt, QTimer
from PySide6.QtGui import QCloseEvent, QResizeEvent
from PySide6.QtWidgets import (
    QDockWidget,
    QFrame,
    QLabel,
    QMainWindow,
    QScrollArea,
    QStackedWidget,
    QToolBar,
    QVBoxLayout,
    QWidget,
)

from genmojo_core.errors import GenmojoError
from genmojo_studio import notify, theme
from genmojo_studio.actions import ActionTable
from genmojo_studio.annotate import steps
from genmojo_studio.annotate.bindings import Hands, bind, position_text
from genmojo_studio.annotate.button_panel import ButtonPanel, StepBar
from genmojo_studio.annotate.canvas import Canvas, Tool
from genmojo_studio.annotate.focus import KeyboardManners, give_back
from genmojo_studio.annotate.held import HeldKeys
from genmojo_studio.annotate.keeping import found_clip
from genmojo_studio.annotate.objects_page import ObjectsPage
from genmojo_studio.annotate.play_panel import PlayPanel
from genmojo_studio.annotate.points_page import PointsPage
from genmojo_studio.annotate.refine_page import RefinePage
from genmojo_studio.annotate.review_page import ReviewPage
from genmojo_studio.annotate.screen import Screen
from genmojo_studio.annotate.session import Session, open_session
from genmojo_studio.annotate.strip import Strip
from genmojo_studio.annotate.tour import Tour, begin
from genmojo_studio.annotate.tour_clip import TourClip
from genmojo_studio.annotate.trackability import measure
from genmojo_studio.annotate.work import Work
from genmojo_studio.panels import Pages, Panels
from genmojo_studio.settings import Settings
from genmojo_studio.state import AppState
from genmojo_studio.translate import tr

_DOCKS = (("buttons", "Buttons", Qt.DockWidgetArea.LeftDockWidgetArea),
          ("information", "Information", Qt.DockWidgetArea.RightDockWidgetArea),
          ("play", "Video play", Qt.DockWidgetArea.BottomDockWidgetArea))  # fmt: skip
_LOW = 850  # pixels of height


class AnnotateWorkspace(QMainWindow):
    """Visualisation in the middle; buttons, information and video play around it. Parts exist once a clip is open."""

    canvas: Canvas
    strip: Strip
    screen_link: Screen
    work: Work
    buttons: ButtonPanel
    play: PlayPanel
    pages: QStackedWidget
    objects: ObjectsPage
    points: PointsPage
    refine: RefinePage
    review: ReviewPage

    def __init__(self, state: AppState, actions: ActionTable, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowFlags(Qt.WindowType.Widget)
        self.state, self.table = state, actions
        self.parts: Iterator[None] = iter(())  # all of it is there; a clip brings the rest
        self.settings = Settings()
        self.session: Session | None = None
        self._opening: Iterator[None] = iter(())
        self.hands: Hands | None = None
        self.tour: Tour | None = None
        self.tour_clip: TourClip | None = None
        self.step = 0
        self._low = False  # whether the window is so low that the frame comes first
        self.setDockNestingEnabled(True)
        self.bar: StepBar = StepBar()
        self._tool_bar = QToolBar(tr("Steps"))
        self._tool_bar.setObjectName("steps")
        self._tool_bar.setMovable(False)
        self._tool_bar.addWidget(self.bar)
        self.addToolBar(self._tool_bar)
        self.docks: dict[str, QDockWidget] = {}
        for name, title, area in _DOCKS:
            dock = QDockWidget(tr(title), self)
            dock.setObjectName(f"annotate-{name}")
            self.addDockWidget(area, dock)
            self.docks[name] = dock
        self.panels = Panels(self, self.docks, "annotate")
        self.setCorner(Qt.Corner.BottomRightCorner, Qt.DockWidgetArea.RightDockWidgetArea)
        self.setCorner(Qt.Corner.BottomLeftCorner, Qt.DockWidgetArea.BottomDockWidgetArea)
        self.setCentralWidget(_hint(tr("Open a clip to annotate it (Ctrl+O).")))
        self.held = HeldKeys(self, actions)
        self._manners = KeyboardManners(self)
        state.subscribe(self._theme_changed, "theme")
        actions.bind("annotate.file.tour", self.start_tour)
        self._steps_later = QTimer(self, singleShot=True, interval=150)
        self._steps_later.timeout.connect(self._show_steps)
        self.bar.chosen.connect(self.show_step)
        self.bar.stride.lineEdit().returnPressed.connect(self.back_to_frame)
        self.bar.setEnabled(False)

    # ---- opening and closing

    def opening(self, path: Path) -> Iterator[None]:
        """Open a clip or a project file, part by part; the one open now is closed. Faults are told."""
        try:
            if not self._may_close():
                return
            session = open_session(self.state, path, self.person(), clip=found_clip(path, self))
        except GenmojoError as error:
            notify.tell(error, self)
            return
        self.close_clip()
        self._opening = self._put_on_show(session)
        yield
        yield from self._opening

    def open_with(self, session: Session) -> None:
        """Put a session on show."""
        for _ in self._put_on_show(session):
            continue

    def _put_on_show(self, session: Session) -> Iterator[None]:
        """Everything that shows a session, part by part; it is of use when all are there."""
        session.setParent(self)
        self.canvas, self.strip = Canvas(), Strip(session)
        self.screen_link = Screen(session, self.canvas, self.strip)
        self.work = Work(session, self)
        yield
        self.buttons, self.play = ButtonPanel(self.table), PlayPanel(session, self.table)
        yield
        self.pages = Pages()
        self.objects, self.points = ObjectsPage(session), PointsPage(session)
        yield
        self.refine, self.review = RefinePage(session), ReviewPage(session)
        self._by_name: dict[str, QWidget] = {
            "objects": self.objects, "points": self.points, "refine": self.refine, "review": self.review,
        }  # fmt: skip
        for page in self._by_name.values():
            self.pages.addWidget(page)
        yield
        self._arrange()
        yield
        self._take(session)

    def _arrange(self) -> None:
        """The parts of a session in their places."""
        middle = QWidget()
        column = QVBoxLayout(middle)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.canvas, 1)
        column.addWidget(self.strip)
        self.setCentralWidget(middle)
        scroll = QScrollArea()  # on small screens pages scroll rather than push the window beyond the screen
        scroll.setWidgetResizable(True)
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setMinimumWidth(250)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # it follows what has the keyboard inside it
        scroll.setWidget(self.pages)
        for name, widget in (("buttons", self.buttons), ("information", scroll), ("play", self.play)):
            self.docks[name].setWidget(widget)

    def _take(self, session: Session) -> None:
        """All parts are there: the session can be worked on."""
        self.session = session
        self.bar.setEnabled(True)
        self.bar.stride.setValue(session.stride)
        for changed in (session.edited, session.selected):
            changed.connect(self._steps_later.start)
        session.said.connect(self.say)
        session.stored.connect(self._stored)
        bind(self)
        for panel in (self.pages, self.play):
            give_back(panel, self.canvas)
        self._theme_changed()
        # nothing of the step before is on show any more that could be remembered
        self.step = steps.first_open(session.annotation, session.limit("points"), session.stride)
        self.show_step(self.step)
        QTimer.singleShot(0, self.restore_layout)  # again, once the new panels have been laid out
        self.screen_link.show_frame(session.frame)
        self.bar.saved.setText(tr("read only") if session.project.read_only else tr("saved"))
        self.canvas.setFocus()

    def close_clip(self) -> None:
        """Store and let go of the clip that is open; one that is half open is opened first."""
        for _ in self._opening:
            continue
        session = self.session
        if session is None:
            return
        self.save_layout()
        self.session = None
        self.play.player.stop()
        self.work.close()
        for dock in self.docks.values():
            old = dock.widget()
            dock.setWidget(QWidget())
            if old is not None:
                old.deleteLater()
        self.setCentralWidget(_hint(tr("Open a clip to annotate it (Ctrl+O).")))
        session.close()
        session.deleteLater()
        if self.tour_clip is not None and self.tour_clip.session is session:
            self._end_tour()

    def person(self) -> str:
        """Who is named in projects."""
        return self.settings.text("person") or _person()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """A window that becomes low, or high again, takes the layout that belongs to it."""
        super().resizeEvent(event)
        low = self.height() <= _LOW
        if low != self._low:
            if self.session is not None:
                self.save_layout()  # of the height before
            self._low = low
            if self.session is not None:
                QTimer.singleShot(0, self.restore_layout)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Nothing is asked, everything is stored already; unless the disk takes nothing."""
        if not self._may_close():
            event.ignore()
            return
        self.close_clip()
        self._end_tour()
        event.accept()

    def _may_close(self) -> bool:
        return self.session is None or self.hands is None or self.hands.keeping.may_close()

    # ---- steps and layout

    def show_step(self, place: int) -> None:
        """Bring a step's buttons, page and layout to the front."""
        if self.session is None or not 0 <= place < len(steps.STEPS):
            return
        if place != self.step:
            self.save_layout()
        self.step = place
        step = steps.STEPS[place]
        self.buttons.show_step(step)
        self.pages.setCurrentWidget(self._by_name[step.page])
        self.docks["information"].setWindowTitle(f"{tr('Information')}: {tr(step.title)}")
        self.strip.setVisible(step.shows_strip)
        self.session.enter(step.name, sketching=not step.clicks)
        if step.clicks:
            self.objects.use_tool(None)
        self.canvas.places = step.places_points
        tracks = self.session.annotation.active()
        if step.needs_track and self.session.track is None and tracks:
            self.session.select_track(tracks[0].id)
        if step.places_points and self.hands is not None:
            self.hands.placing.begin()
        self.restore_layout()
        self._show_steps()
        self.canvas.setFocus()

    def save_layout(self) -> None:
        """Remember where the panels are in this step; empty ones are of no size of theirs."""
        if self.session is not None:
            self.settings.put_layout(self._layout_name(), self.panels.layout())

    def restore_layout(self) -> None:
        """Put the panels where they were in this step, or where they belong."""
        stored = self.settings.layout(self._layout_name())
        if stored is None or not self.restoreState(stored):
            for name, _title, area in _DOCKS:
                self.docks[name].setFloating(False)
                self.addDockWidget(area, self.docks[name])
                self.docks[name].show()
            QTimer.singleShot(0, self._size_docks)  # sizes count only after the docks have been laid out
        self.panels.arranged()

    def _layout_name(self) -> str:
        """Layouts are kept per step, those of low windows by themselves: sizes of one make no sense in the other."""
        return f"annotate-{steps.STEPS[self.step].name}{'-low' if self._low else ''}"

    def _size_docks(self) -> None:
        wide, high = max(self.width(), 1000), max(self.height(), 600)
        sizes = {"buttons": 194, "information": int(min(max(0.24 * wide, 310), 430))}
        self.resizeDocks([self.docks[n] for n in sizes], list(sizes.values()), Qt.Orientation.Horizontal)
        share = 0.27 if self._low else 0.3
        self.resizeDocks([self.docks["play"]], [int(share * high)], Qt.Orientation.Vertical)

    def use_tool(self, tool: Tool | None) -> None:
        """Draw with a tool on the canvas, or go back to points."""
        self.canvas.set_tool(tool or Tool.POINT)

    def set_stride(self, stride: int) -> None:
        """Frames that Enter, comma and full stop move by."""
        if self.session is not None:
            self.session.set_stride(stride)
            self._steps_later.start()

    def show_position(self, x: float, y: float) -> None:
        """Coordinates of the mouse, and in step 2 how well that place can be followed."""
        session = self.session
        if session is None:
            return
        self.bar.position.setText(position_text(x, y, session.annotation.size))
        frame = session.cache.get(session.frame)
        if not steps.STEPS[self.step].places_points or frame is None or self.canvas.mouse_raster() is None:
            return
        view = session.annotation.at(session.frame)
        others = view.xy[view.ids != (session.track or -1)]
        self.points.show_meter(measure(frame, (x, y), session.mask_at(session.frame), session.active[0], others))

    def next_panel(self, step: int = 1) -> None:
        """Move the keyboard on (-1: back): frame, steps, buttons, information, video play, and around."""
        page = self._by_name[steps.STEPS[self.step].page]
        panels: list[QWidget] = [self.canvas, self.bar, self.buttons, page, self.play]
        if self.tour is not None:
            panels.append(self.tour)
        stops = [panel for panel in panels if panel.isVisible()]
        focus = self.focusWidget()
        holding = (n for n, w in enumerate(stops) if focus is not None and (w is focus or w.isAncestorOf(focus)))
        at = next(holding, -1)
        target = stops[(at + step) % len(stops)]
        if target is self.tour:
            target = self.tour.next
        elif target is not self.canvas:
            inside = [c for c in target.findChildren(QWidget) if c.isVisible() and c.isEnabled()
                      and c.focusPolicy() & Qt.FocusPolicy.TabFocus]  # fmt: skip
            places = [c.mapTo(self, QPoint(0, 0)) for c in inside]
            target = min(zip(places, inside, strict=True), key=lambda p: (p[0].y(), p[0].x()))[1] if inside else target
        target.setFocus(Qt.FocusReason.TabFocusReason)

    def back_to_frame(self) -> None:
        """The keyboard belongs to the frame again; a drawing tool is put away."""
        self.objects.use_tool(None)
        self.canvas.setFocus(Qt.FocusReason.TabFocusReason)

    def start_tour(self) -> None:
        """Explain the annotator on a clip made on the spot."""
        begin(self)

    def _end_tour(self) -> None:
        clip, self.tour_clip = self.tour_clip, None
        if self.tour is not None:
            self.tour.vanish()
        if clip is not None:
            clip.remove()

    def say(self, sentence: str) -> None:
        """A sentence in the status line of the window."""
        window = self.window()
        if isinstance(window, QMainWindow):
            window.statusBar().showMessage(sentence, 8000)

    def _show_steps(self) -> None:
        if self.session is None:
            return
        session = self.session
        missing = [s.missing(session.annotation, session.limit("points"), session.stride) for s in steps.STEPS]
        self.bar.show_step(self.step, missing)
        self.buttons.refresh()

    def _stored(self, seconds: float) -> None:
        if self.session is not None and not self.session.project.read_only:  # else word of an earlier clip, too late
            self.bar.saved.setText(tr("saved in {ms:.0f} ms").format(ms=1000 * seconds))

    def _theme_changed(self) -> None:
        if self.session is not None:
            self.canvas.set_background(theme.colours(self.state.theme).canvas)


def _hint(text: str) -> QLabel:
    label = QLabel(text)
    label.setAlignment(Qt.AlignmentFlag.AlignCenter)
    label.setProperty("role", "dim")
    return label


def _person() -> str:
    """The name of the account, until a person gives another."""
    try:
        return getpass.getuser()
    except (OSError, KeyError):
        return ""
