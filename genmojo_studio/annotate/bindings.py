"""What the annotator's actions, clicks and buttons do: one table, so that every way leads to the same verb."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from genmojo_studio.annotate import steps, verbs
from genmojo_studio.annotate.accepting import Accepting
from genmojo_studio.annotate.actions import KEYED
from genmojo_studio.annotate.dialogs import Dialogs
from genmojo_studio.annotate.exchange_dialog import KINDS
from genmojo_studio.annotate.following import Following
from genmojo_studio.annotate.going import Going
from genmojo_studio.annotate.keeping import Keeping
from genmojo_studio.annotate.object_verbs import ObjectVerbs
from genmojo_studio.annotate.placing import Placing
from genmojo_studio.annotate.session import TRAILS
from genmojo_studio.annotate.sheet_menu import SheetMenu
from genmojo_studio.annotate.sheet_order import ORDERS
from genmojo_studio.translate import decimal, tr

if TYPE_CHECKING:
    from genmojo_studio.annotate.workspace import AnnotateWorkspace

Verb = Callable[[], object]


def bind(workspace: AnnotateWorkspace) -> None:
    """Connect a workspace that has just been given a session."""
    _connect(workspace)
    hands = Hands(workspace)
    workspace.hands = hands
    for name, verb in hands.table().items():
        workspace.table.bind(f"annotate.{name}", hands.guarded(name, verb), hands.enabled(name), hands.checked(name))
    held = workspace.held
    for name, state in verbs.STATES.items():
        begin, tapped = hands.guarded(name, hands.painter(state)), hands.guarded(name, hands.tapper(state))
        held.add(f"annotate.point.{name}", begin, tapped, hands.paint_end)
    held.add("annotate.view.loupe", hands.loupe_on, hands.loupe_toggle, hands.loupe_off)
    held.add("annotate.view.hide", hands.hide, hands.hide_toggle, hands.show)
    workspace.work.begin()


def _connect(w: AnnotateWorkspace) -> None:
    """Signals of the panels to each other."""
    session, canvas, work = w.session, w.canvas, w.work
    if session is None:
        return
    for scrubbed in (w.play.sheet, w.play.timeline):
        scrubbed.began.connect(session.remember)
        scrubbed.seek.connect(session.go)
    w.play.sheet.picked.connect(session.select_track)
    for seek in (w.play.graphs.seek, w.strip.seek):
        seek.connect(partial(session.go, jump=True))
    for page in (w.points, w.refine, w.review):
        page.tree.chosen.connect(lambda *_: session.remember())
        page.tree.chosen.connect(session.select)
    work.figures_ready.connect(w.objects.set_figures)
    work.tracker.measured.connect(w.play.graphs.set_measures)
    masks = work.masks
    masks.changed.connect(w.screen_link.presenter.forget_masks)
    masks.changed.connect(w.screen_link.refresh)
    work.busy_changed.connect(w.say)
    work.spots_ready.connect(w.play.sheet.refresh)
    masks.cutting.connect(w.objects.show_cutting)
    masks.sketched.connect(w.objects.show_sketched)
    w.objects.tool_wanted.connect(w.use_tool)
    w.objects.cut_wanted.connect(masks.cut)
    masks.target = w.objects.target
    canvas.boxed.connect(masks.add_box)
    canvas.stroked.connect(masks.add_stroke)
    w.bar.stride_changed.connect(w.set_stride)


class Hands:
    """The verbs of one session, in terms of the workspace's widgets."""

    def __init__(self, workspace: AnnotateWorkspace) -> None:
        if workspace.session is None:
            raise RuntimeError("a session is needed before its actions can be bound")
        self._w, self._s = workspace, workspace.session
        self.going = Going(workspace.session, workspace.play.player)
        self.objects = ObjectVerbs(workspace)
        self.placing = Placing(workspace, self.going)
        self.dialogs = Dialogs(workspace)
        self.keeping = Keeping(self._s, workspace)
        self.keeping.troubled.connect(workspace.bar.show_trouble)
        self.following = Following(self._s, workspace.bar)
        self.accepting = Accepting(self._s, workspace.screen_link, workspace.work.tracker)
        w = workspace
        w.canvas.picked.connect(self._s.select_track)
        w.canvas.toggled.connect(self.toggled)
        w.canvas.hovered.connect(self.hovered)
        w.canvas.cycled.connect(self.cycle)
        w.canvas.set_reticle(w.settings.whole("reticle", w.canvas.reticle))
        self._s.view = w.canvas.view
        self._s.view_wanted.connect(w.canvas.set_view)
        w.play.sheet.painted.connect(self.painted)
        self.sheet_menu = SheetMenu(w, self._s, self._solved_after)
        w.play.graphs.moved.connect(self.knot_moved)
        w.refine.spot_chosen.connect(self.going.show_spot)
        w.refine.returned.fixed_wanted.connect(self._fixed)
        w.work.spots_ready.connect(self.going.queue.set_spots)
        self.going.queue.changed.connect(lambda: w.refine.show_queue(self.going.queue))
        w.points.seed_wanted.connect(self.dialogs.seed)
        w.review.merge_wanted.connect(self.dialogs.merge)
        w.review.log_wanted.connect(self.dialogs.log)

    # ---- tables

    def table(self) -> dict[str, Verb]:
        """All verbs by the names of their actions."""
        return self.going.table() | self.objects.table() | self.points() | self.tracks() | self.rest()

    def points(self) -> dict[str, Verb]:
        """Verbs of points."""
        s = self._s
        steps = {"left": (-1, 0), "right": (1, 0), "up": (0, -1), "down": (0, 1)}
        table: dict[str, Verb] = {}
        for n in range(1, KEYED + 1):
            table[f"point.choose_{n}"] = partial(self._number, n)
            table[f"point.object_{n}"] = partial(self._object, n)
        for side, (dx, dy) in steps.items():
            table[f"point.nudge_{side}"] = partial(self.placing.nudge, 0.25 * dx, 0.25 * dy)
            table[f"point.push_{side}"] = partial(self.placing.nudge, dx, dy)
        return table | {
            "point.next": lambda: self.cycle(1),
            "point.previous": lambda: self.cycle(-1),
            "point.uncertain": lambda: verbs.toggle_uncertain(s),
            "point.run_start": lambda: self._mark_run(0),
            "point.run_end": lambda: self._mark_run(1),
            "point.key": lambda: self._solved_after(verbs.toggle_key),
            "point.delete_key": lambda: self._solved_after(verbs.delete_key),
            "point.snap": self._toggle_snap,
        }

    def tracks(self) -> dict[str, Verb]:
        """Verbs of tracks and of the review."""
        s, w, tracker = self._s, self._w, self._w.work.tracker
        return {
            "track.seed": self.dialogs.seed,
            "track.scene": self.dialogs.solve_from_scene,
            "track.next": lambda: tracker.one(1),
            "track.previous": lambda: tracker.one(-1),
            "track.on": lambda: tracker.run(1),
            "track.back": lambda: tracker.run(-1),
            "track.solve": lambda: tracker.run(0),
            "track.mode": lambda: self._solved_after(verbs.set_mode),
            "track.clear_after": lambda: verbs.clear(s, after=True),
            "track.clear_before": lambda: verbs.clear(s, after=False),
            **{f"track.{kind}": partial(self.dialogs.exchange, kind) for kind in KINDS},
            "track.lock": lambda: verbs.toggle_lock(s),
            "track.delete": lambda: verbs.delete_track(s),
            "review.fix": self.dialogs.fix,
            "review.fixed": self._fixed,
            "review.approve": w.review.approve,
            "review.reject": w.review.reject,
            "review.merge": self.dialogs.merge,
            "review.log": self.dialogs.log,
            "review.check_log": self.dialogs.check_log,
            "review.export_log": self.dialogs.export_log,
        }

    def rest(self) -> dict[str, Verb]:
        """Verbs of the view, of history, files and steps."""
        w = self._w
        return {
            "view.fit": w.canvas.fit,
            "view.one": w.canvas.one_to_one,
            "view.centre": lambda: self.placing.seek(self._s.track),
            "view.in": lambda: w.canvas.zoom_step(1),
            "view.out": lambda: w.canvas.zoom_step(-1),
            "view.time_in": lambda: w.play.view.zoom(2),
            "view.time_out": lambda: w.play.view.zoom(-2),
            "view.time_fit": w.play.view.fit,
            "view.legend": w.play.show_legend,
            **{f"view.order_{order}": partial(w.play.set_order, order) for order in ORDERS},
            "move.open_next": partial(w.play.marks.go, 1),
            "move.open_previous": partial(w.play.marks.go, -1),
            "view.follow": lambda: w.screen_link.set_follow(not w.screen_link.follow),
            "view.loupe_stay": self.loupe_toggle,
            "view.loupe_smooth": w.screen_link.switch_smooth,
            "view.masks": self._masks,
            "view.trails": self._trails,
            "view.strip": self._strip,
            "view.reticle_larger": lambda: self._reticle(4),
            "view.reticle_smaller": lambda: self._reticle(-4),
            "edit.checkpoint": self.dialogs.checkpoint,
            "edit.history": self.dialogs.history,
            "file.new_clip": lambda: w.table.trigger("file.open_clip"),
            "file.import": self.dialogs.import_tracks,
            "file.export": self.dialogs.export_tracks,
            "file.copy": self.keeping.save_copy,
            "file.take_over": self.following.take_over,
            "file.backup": self._open_backup,
            "file.folder": self.keeping.show_folder,
            "file.tour": w.start_tour,
            "move.panel": w.next_panel,
            "move.panel_back": lambda: w.next_panel(-1),
            "move.accept": self.accepting.accept,
            "move.accept_back": lambda: self.accepting.accept(-1),
            "move.frame": self._back_to_frame,
            **{f"panel.{name}": partial(self._panel, name) for name in w.docks},
            **{f"step.{n + 1}": partial(w.show_step, n) for n in range(len(steps.STEPS))},
        }

    def guarded(self, name: str, verb: Verb) -> Verb:
        """The verb, as far as what the hand is doing just now allows it (`Placing.guarded`)."""
        return self.placing.guarded(name, verb)

    def enabled(self, name: str) -> Callable[[], bool]:
        """When an action is possible."""
        s = self._s
        needs_track = name.startswith(("track.", "review.fix", "review.approve", "review.reject", "point.key",
                                       "point.delete", "point.uncertain", "move.key",
                                       "move.bisect"))  # fmt: skip
        if name.startswith("object."):
            return lambda: self._w.session is s and s.sketching
        if name == "file.take_over":
            return lambda: self._w.session is s and self.following.free
        if name in ("track.seed", "track.scene"):
            return lambda: self._w.session is s and bool(s.annotation.tracks)
        if name.startswith(("point.nudge", "point.push")):
            return lambda: self._w.session is s and s.nudged is not None
        if needs_track:
            return lambda: self._w.session is s and s.track is not None
        return lambda: self._w.session is s

    def checked(self, name: str) -> Callable[[], bool] | None:
        """Whether a switch is on."""
        s, w = self._s, self._w
        switches: dict[str, Callable[[], bool]] = {
            "point.snap": lambda: s.snap,
            "view.follow": lambda: w.screen_link.follow,
            "view.loupe_stay": lambda: w.canvas.loupe.on,
            "view.loupe_smooth": lambda: w.canvas.loupe.smooth,
            "view.strip": lambda: w.strip.isVisible(),
            "track.lock": lambda: s.track is not None and s.annotation.tracks[s.track].locked,
        }
        switches |= {f"view.order_{order}": partial(self._sorted_by, order) for order in ORDERS}
        switches |= {f"panel.{panel}": partial(w.docks[panel].isVisibleTo, w) for panel in w.docks}
        switch = switches.get(name)
        return None if switch is None else lambda: w.session is s and switch()

    def _sorted_by(self, order: str) -> bool:
        return self._w.play.sheet.order == order

    # ---- mouse

    def toggled(self, track: int) -> None:
        """A right click hides a point, or shows it again."""
        self._s.select_track(track)
        verbs.paint_here(self._s, verbs.STATES["occluded"])

    def hovered(self, x: float, y: float) -> None:
        """Coordinates and trackability of the place under the mouse."""
        self._w.show_position(x, y)

    def painted(self, track: int, first: int, last: int) -> None:
        """A drag over the dope sheet."""
        verbs.paint(self._s, track, self._w.play.brush_state(), first, last)

    def knot_moved(self, track: int, frame: int, x: float, y: float) -> None:
        """A knot of a curve was dragged: the key goes there, as if it had been dragged in its frame."""
        self._s.go(frame)
        self.placing.dragged(track, x, y)

    def cycle(self, step: int) -> None:
        """The next or previous point over all objects."""
        self.guarded("point.next", lambda: self.going.cycle(step))()

    # ---- keys that are held

    def painter(self, state: int) -> Verb:
        """Begins to paint a state."""
        return lambda: verbs.begin_painting(self._s, state)

    def tapper(self, state: int) -> Verb:
        """Paints a state here, once."""
        return lambda: verbs.paint_here(self._s, state)

    def paint_end(self) -> None:
        """Ends painting."""
        verbs.end_painting(self._s)

    def loupe_on(self) -> None:
        """Open the loupe."""
        self._w.screen_link.set_loupe(True)

    def loupe_off(self) -> None:
        """Close the loupe."""
        self._w.screen_link.set_loupe(False)

    def loupe_toggle(self) -> None:
        """Open or close the loupe."""
        self._w.screen_link.set_loupe(not self._w.canvas.loupe.on)

    def hide(self) -> None:
        """Show the bare frame."""
        self._w.canvas.set_overlay(False)

    def show(self) -> None:
        """Show what is drawn over the frame."""
        self._w.canvas.set_overlay(True)

    def hide_toggle(self) -> None:
        """Show or hide what is drawn."""
        self._w.canvas.set_overlay(not self._w.canvas.show_overlay)

    # ---- helpers

    def _number(self, number: int) -> None:
        self._s.select(self._s.active[0], number)

    def _object(self, place: int) -> None:
        objects = self._s.objects()
        if place <= len(objects):
            self._s.select(objects[place - 1].id, self._s.active[1])
        else:
            self._s.said.emit(tr("There is no object {n} in the order.").format(n=place))

    def _panel(self, name: str) -> None:
        """Show or hide a panel, as the cross in its title does."""
        dock = self._w.docks[name]
        dock.setVisible(not dock.isVisibleTo(self._w))

    def _mark_run(self, end: int) -> None:
        if self._s.run_track != self._s.track:
            self._s.run, self._s.run_track = (None, None), self._s.track
        ends = list(self._s.run)
        ends[end] = self._s.frame
        self._s.run = (ends[0], ends[1])
        self._s.settings_changed.emit()
        self._s.shown.emit()
        self._w.play.sheet.viewport().update()
        first, last = verbs.marked_run(self._s)
        self._s.said.emit(tr("Marked: frames {a} to {b}. A state or X applies to them.").format(a=first, b=last))

    def _back_to_frame(self) -> None:
        """The keyboard to the frame; what was begun there is forgotten, a point being dragged alone first."""
        if self._w.canvas.put_back():
            self._s.said.emit(tr("The point is back where it was."))
            return
        self._s.run = (None, None)
        self._s.settings_changed.emit()
        self._s.shown.emit()
        self._w.back_to_frame()

    def _solved_after(self, verb: Callable[..., object]) -> None:
        before = self._s.annotation.revision
        verb(self._s)
        if self._s.track is not None and self._s.annotation.revision != before:
            self._w.work.tracker.after_key(self._s.track, self._s.frame, self._s.project.log.head)

    def _open_backup(self) -> None:
        path = self.keeping.backup()
        if path is not None:
            for _ in self._w.opening(path):
                continue

    def _fixed(self) -> None:
        if self._s.track is not None:
            verbs.fixed(self._s, self._s.track)

    def _toggle_snap(self) -> None:
        self._s.snap = not self._s.snap
        self._w.screen_link.aim()
        self._w.canvas.update()

    def _masks(self) -> None:
        self._s.mask_mode = (self._s.mask_mode + 1) % 3
        self._s.shown.emit()

    def _trails(self) -> None:
        self._s.trail = TRAILS[(TRAILS.index(self._s.trail) + 1) % len(TRAILS)]
        self._s.shown.emit()

    def _reticle(self, more: int) -> None:
        """A longer or shorter reticle, kept for the next time."""
        self._w.canvas.set_reticle(self._w.canvas.reticle + more)
        self._w.settings.put("reticle", str(self._w.canvas.reticle))

    def _strip(self) -> None:
        self._w.strip.setVisible(not self._w.strip.isVisible())
        self._s.shown.emit()


def position_text(x: float, y: float, size: tuple[int, int]) -> str:
    """Raster position for the status line, "" outside the frame."""
    inside = 0 <= x <= size[0] and 0 <= y <= size[1] and np.isfinite([x, y]).all()
    return f"x {decimal(x, '.2f')}   y {decimal(y, '.2f')}" if inside else ""
