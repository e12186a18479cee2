"""What the actions of the workspace Watch do."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QDockWidget, QFileDialog, QMessageBox

from genmojo_core.errors import GenmojoError
from genmojo_core.store.atomic import write_bytes
from genmojo_studio import notify
from genmojo_studio.actions import ActionTable
from genmojo_studio.translate import tr
from genmojo_studio.view3d.look import Mode
from genmojo_studio.watch.actions import COMPARES, MODES, VIEWS
from genmojo_studio.worker import runs

if TYPE_CHECKING:
    from genmojo_studio.watch.workspace import WatchWorkspace


def bind(w: WatchWorkspace) -> None:
    """Gives every action of `watch/actions.py` its meaning."""
    _bind_view(w)
    _bind_time(w)
    _bind_run(w)
    bind_to, take = w.table.bind, w.take_away
    for action_id, call, file_only in (
        ("save.hdf5", take.save_hdf5, True),
        ("save.ply", take.save_ply, True),
        ("save.ply_sequence", take.save_ply_sequence, True),
        ("save.screenshot", take.screenshot, False),
        ("save.turntable", take.turntable, True),
        ("save.path", take.camera_path, False),
    ):
        bind_to(action_id, call, partial(_has_scene, w, file_only))


def open_run(w: WatchWorkspace, folder: Path) -> None:
    """Attaches to a run that lives; opens the scene of one that has ended; resumes one that was cut short."""
    if runs.live_run(folder) is not None:
        w.control.attach(folder)
        w.run_tabs.setCurrentIndex(1)
    elif (folder / runs.SCENE).exists():
        w.session.open_scene(folder / runs.SCENE)
    elif (folder / "checkpoint.json").exists():
        w.control.resume(folder)
        w.run_tabs.setCurrentIndex(1)
    else:
        notify.tell(
            GenmojoError("empty", "holds neither a scene nor a checkpoint", str(folder), "start the run anew"), w
        )


def _bind_view(w: WatchWorkspace) -> None:
    bind_to, appearance = w.table.bind, w.appearance
    bind_to("edit.undo", w.undo.undo, lambda: bool(w.undo.undo_text))
    bind_to("edit.redo", w.undo.redo, lambda: bool(w.undo.redo_text))
    for name, _, _ in VIEWS:
        bind_to(f"view.{name}", partial(w.view.preset, name))
    for action_id, mode in MODES.items():
        text = tr(w.table[action_id].text)
        bind_to(action_id, partial(appearance.set_mode, mode, text), checked=partial(_shows, w, Mode(mode)))
    for name in COMPARES:
        bind_to(f"compare.{name}", partial(w.center.set_mode, name), checked=partial(_compares, w, name))
    bind_to("view.background", partial(_toggle, w, "show_background"), checked=lambda: appearance.look.show_background)
    bind_to("view.canonical", partial(_toggle, w, "canonical"), checked=lambda: appearance.look.canonical)
    bind_to("view.tracks", partial(_toggle_tracks, w), checked=lambda: w.tracks_shown)
    bind_to("view.all", lambda: appearance.show_all(tr("Show all objects")))
    bind_to(
        "view.solo",
        lambda: appearance.toggle_solo(w.state.selected_object or 0, tr("Solo")),
        lambda: w.state.selected_object is not None,
        lambda: bool(appearance.look.solo),
    )
    for name, dock in w.docks.items():
        bind_to(f"panel.{name}", partial(_show_panel, dock), checked=partial(_is_shown, dock))
    bind_to("view.edit_mask", partial(_edit_mask, w), lambda: w.state.clip is not None)


def _bind_time(w: WatchWorkspace) -> None:
    bind_to, player, state = w.table.bind, w.player, w.state
    bind_to("time.play", player.toggle)
    bind_to("time.next", partial(player.step, 1))
    bind_to("time.previous", partial(player.step, -1))
    bind_to("time.first", lambda: state.set(playing=False, frame=0))
    bind_to("time.last", lambda: state.set(playing=False, frame=state.frame_count - 1))
    bind_to("time.faster", partial(player.change_speed, 1))
    bind_to("time.slower", partial(player.change_speed, -1))


def _bind_run(w: WatchWorkspace) -> None:
    bind_to, control = w.table.bind, w.control
    bind_to("run.start", partial(_start, w), lambda: w.state.clip_path is not None and not control.live)
    bind_to("run.pause", control.pause_or_resume, _in(w, "running", "paused", "stepping"))
    bind_to("run.step", control.step, _in(w, "paused"))
    bind_to("run.next_stage", control.run_to_next_stage, _in(w, "running", "paused"))
    bind_to("run.checkpoint", control.checkpoint, _in(w, "running", "paused"))
    ending = _in(w, "starting", "ready", "running", "paused", "stepping", "lost")
    bind_to("run.stop_keep", partial(control.stop, True), ending)
    bind_to("run.stop_discard", partial(_discard, w), ending)
    bind_to("run.csv", partial(_save_csv, w), lambda: bool(control.log.step))
    bind_to("run.attach", partial(_ask_run, w), lambda: not control.live)


def _start(w: WatchWorkspace) -> None:
    request = w.setup.request()
    if request is None:
        return
    w.session.clear()
    w.control.start(replace(request, look_at=w.state.frame))
    w.run_tabs.setCurrentIndex(1)
    w.docks["curves"].raise_()


def _discard(w: WatchWorkspace) -> None:
    question = tr("Stop the run and throw its scene away?")
    if QMessageBox.question(w, "GenMOJO Studio", question) == QMessageBox.StandardButton.Yes:
        w.control.stop(False)


def _save_csv(w: WatchWorkspace) -> None:
    path, _ = QFileDialog.getSaveFileName(w, tr("Save the curves"), "curves.csv", "CSV (*.csv)")
    if path:
        try:
            write_bytes(path, w.control.log.to_csv().encode())
        except GenmojoError as error:
            notify.tell(error, w)


def _ask_run(w: WatchWorkspace) -> None:
    chosen = QFileDialog.getExistingDirectory(w, tr("Open a run folder"), str(runs.runs_folder()))
    if chosen:
        open_run(w, Path(chosen))


def _edit_mask(w: WatchWorkspace) -> None:
    """The annotator takes over where the selected mask is drawn anew; selection and frame are shared."""
    w.table.trigger("window.annotate")
    _do_once_bound(w.table, "annotate.step.edit_mask")


def _do_once_bound(table: ActionTable, action_id: str) -> None:
    """Does an action, or will as soon as the workspace that it belongs to is loaded."""
    if table.trigger(action_id):
        return

    def look() -> None:
        if table.is_bound(action_id):
            end()
            QTimer.singleShot(0, lambda: table.trigger(action_id))  # not amid the binding of others

    end = table.subscribe(look)


def _toggle(w: WatchWorkspace, name: str) -> None:
    look = w.appearance.look
    texts = {"show_background": tr("Background"), "canonical": tr("Without motion")}
    changed = (
        replace(look, show_background=not look.show_background)
        if name == "show_background"
        else replace(look, canonical=not look.canonical)
    )
    w.appearance.set(changed, texts[name])


def _toggle_tracks(w: WatchWorkspace) -> None:
    w.tracks_shown = not w.tracks_shown
    w.tracks.changed.emit()


def _show_panel(dock: QDockWidget) -> None:
    """To the front, wherever it is; one that is in front already goes away."""
    if not dock.isHidden() and not dock.visibleRegion().isEmpty():
        dock.close()
    else:
        dock.show()
        dock.raise_()


def _is_shown(dock: QDockWidget) -> bool:
    return not dock.isHidden()


def _shows(w: WatchWorkspace, mode: Mode) -> bool:
    return w.appearance.look.mode == mode


def _compares(w: WatchWorkspace, name: str) -> bool:
    return w.center.mode == name


def _in(w: WatchWorkspace, *states: str) -> Callable[[], bool]:
    return lambda: w.control.state in states


def _has_scene(w: WatchWorkspace, file_only: bool) -> bool:
    return w.take_away.ready if file_only else w.session.snapshot is not None
