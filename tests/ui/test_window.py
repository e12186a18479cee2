"""The window as a person meets it: start page, menus, palette, themes, dialogs, opening and closing."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QMessageBox

from genmojo_core.errors import GenmojoError
from genmojo_studio import notify
from genmojo_studio.about import About
from genmojo_studio.key_sheet import KeySheet
from genmojo_studio.palette import Palette
from genmojo_studio.shortcuts import KeyEditor

_ROOT = Path(__file__).resolve().parents[2]

_STARTED = """
import sys
from genmojo_studio import app
from genmojo_studio.settings import Settings
application = app.make_application()
window = app.make_window(application, Settings())
window.show()
application.processEvents()
loaded = [name for name in ("torch", "torchvision", "genmojo_core.optimise.run", "genmojo_core.scene.gaussians")
          if name in sys.modules]
window.show_workspace("watch")
application.processEvents()
loaded += [name for name in ("torch", "torchvision") if name in sys.modules]
print(loaded)
"""


def test_the_ui_process_never_loads_torch(qapp):
    environment = {**os.environ, "PYTHONPATH": str(_ROOT)}
    run = subprocess.run([sys.executable, "-c", _STARTED], env=environment, capture_output=True, text=True, timeout=120)
    assert run.returncode == 0, run.stderr
    assert run.stdout.strip() == "[]"


def test_the_start_page_offers_the_demo_and_the_menus_only_what_works(window):
    assert window.welcome.demo_button.isVisible()
    titles = [a.text() for a in window.menuBar().actions() if a.isVisible()]
    assert titles == ["File", "Window", "Help"]
    window.show_workspace("watch")
    titles = [a.text() for a in window.menuBar().actions() if a.isVisible()]
    assert {"View", "Time", "Run", "Take away"} <= set(titles)


def test_every_action_of_the_workspace_on_show_does_something(window):
    window.show_workspace("watch")
    unbound = [a.id for a in window.table if a.workspace in ("", "watch") and not window.table.is_bound(a.id)]
    assert unbound == []


def test_a_key_works_in_its_workspace_and_nowhere_else(window, qtbot):
    window.show_workspace("watch")
    window.activateWindow()
    window.state.set(frame_count=10)
    watch = window.workspaces["watch"]
    watch.setFocus()
    qtbot.waitUntil(window.isActiveWindow, timeout=60_000)
    QTest.keyClick(watch, Qt.Key.Key_Right)
    assert window.state.frame == 1
    window.show_workspace("")
    QTest.keyClick(window, Qt.Key.Key_Right)
    assert window.state.frame == 1


def test_the_palette_does_what_is_typed(window):
    window.show_workspace("watch")
    palette = Palette(window.table, "watch", window)
    palette.line.setText("canonical motion")
    palette.line.setText("without motion")
    QTest.keyClick(palette.line, Qt.Key.Key_Return)
    assert palette.chosen == "view.canonical"


def test_a_dropped_file_that_is_none_of_ours_is_told_in_one_sentence(window, told, tmp_path):
    strange = tmp_path / "notes.docx"
    strange.write_text("x")
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(strange))])
    copy, left, none = Qt.DropAction.CopyAction, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier
    window.dropEvent(QDropEvent(QPointF(5, 5), copy, data, left, none))
    assert len(told) == 1 and "notes.docx" in told[0][1] and told[0][1].count("\n") == 0


def test_our_own_fault_is_told_as_ours_and_a_users_as_its_sentence(told):
    notify.tell(GenmojoError("io", "cannot be read", "clip.mp4", "check the file"))
    notify.tell(ValueError("oops"))
    assert told[0][1] == "clip.mp4: cannot be read; check the file."
    assert "ValueError: oops" in told[1][1]


def test_a_clip_opens_in_both_workspaces_and_shares_its_frame(window, qtbot, tmp_path):
    from genmojo_core.clip import synthetic, synthetic_files

    clip, truth = synthetic.generate("crossing-shapes")
    synthetic_files.write(clip, truth, tmp_path / "clip")
    window.show_workspace("watch")
    window.open_path(tmp_path / "clip")
    qtbot.waitUntil(lambda: window.state.clip is not None, timeout=60_000)
    assert window.state.frame_count == len(clip) and window.workspace == "watch"
    window.state.set(frame=7)
    watch = window.workspaces["watch"]
    assert (watch.center.comparison.input == window.state.clip.frames[7]).all()
    assert window.windowTitle().startswith("clip")
    assert [path.name for path in window.settings.recent()][:1] == ["clip"]


def test_the_theme_changes_at_once_and_is_remembered(window):
    before = window.palette().window().color()
    window.table.trigger("window.theme")
    assert window.palette().window().color() != before
    assert window.settings.text("theme") == window.state.theme
    window.table.trigger("window.theme")


def test_the_screen_shows_the_theme_every_time_it_changes(window, qtbot):
    window.show_workspace("watch")
    qtbot.wait(300)

    def corner():
        return window.screen().grabWindow(window.winId(), 3, 3, 1, 1).toImage().pixelColor(0, 0).name()

    for _ in range(4):
        before = corner()
        window.table.trigger("window.theme")
        qtbot.waitUntil(lambda before=before: corner() != before, timeout=60_000)


def test_the_panels_go_away_and_come_back_as_they_were(window, qtbot):
    """By key, in both workspaces, remembered; the picture gets the room."""
    from genmojo_studio import app

    window.show_workspace("watch")
    watch = window.workspaces["watch"]
    watch.docks["tracks"].close()
    watch.docks["picking"].raise_()
    shown = {name for name, dock in watch.docks.items() if not dock.isHidden()}
    wide = watch.center.width()
    assert window.table.trigger("window.panels") and window.table.is_checked("window.panels")
    assert all(dock.isHidden() for dock in watch.docks.values())
    qtbot.waitUntil(lambda: watch.center.width() > wide + 400, timeout=60_000)
    window.show_workspace("annotate")
    assert not window.table.is_checked("window.panels")  # each workspace for itself
    other = app.make_window(app.QApplication.instance(), window.settings)
    qtbot.addWidget(other)
    other.show_workspace("watch")
    assert all(dock.isHidden() for dock in other.workspaces["watch"].docks.values())
    other.close()
    window.show_workspace("watch")
    window.table.trigger("window.panels")
    assert {name for name, dock in watch.docks.items() if not dock.isHidden()} == shown
    assert not window.settings.text("panels/watch")
    assert window.table.trigger("panel.tracks")  # the one that was closed by hand
    assert not watch.docks["tracks"].isHidden() and window.table.is_checked("panel.tracks")


def test_the_layout_comes_back(window):
    window.show_workspace("watch")
    watch = window.workspaces["watch"]
    watch.docks["tracks"].setFloating(True)
    watch.save_layout()
    watch.docks["tracks"].setFloating(False)
    watch.restore_layout()
    assert watch.docks["tracks"].isFloating()
    window.table.trigger("window.reset")
    assert not watch.docks["tracks"].isFloating()


def test_a_workspace_is_loaded_on_a_thread_before_it_is_shown(window, qtbot, monkeypatch):
    """In the first second after the start: the window answers while plots and readers are imported."""
    import importlib
    import threading

    from genmojo_studio import window as module

    real, on, go = importlib.import_module, [], threading.Event()

    def slow(name, *package):
        if name == module._MODULES["watch"]:
            on.append(threading.current_thread())
            assert go.wait(60)
        return real(name, *package)

    monkeypatch.setattr(module.importlib, "import_module", slow)
    window._loaded.clear()
    window.table.trigger("window.watch")
    qtbot.waitUntil(lambda: bool(on), timeout=60_000)
    assert window.workspace == "" and threading.main_thread() not in on
    go.set()
    qtbot.waitUntil(lambda: window.workspace == "watch", timeout=60_000)


@pytest.mark.parametrize(
    ("action", "kind"), [("help.keys", KeySheet), ("file.settings", KeyEditor), ("help.about", About)]
)
def test_dialogs_of_the_menus_leave_the_program_running(window, qtbot, action, kind):
    assert window.table.trigger(action)  # it returns: nothing waits for the dialog
    dialogs = window.findChildren(kind)
    assert len(dialogs) == 1 and dialogs[0].isVisible()
    dialogs[0].reject()
    qtbot.waitUntil(lambda: not window.findChildren(kind), timeout=60_000)


def test_a_fault_is_told_without_holding_anything_up(qapp, qtbot, window):
    notify._show(window, "That did not work", "clip.mp4: cannot be read.", "")
    boxes = window.findChildren(QMessageBox)
    assert len(boxes) == 1 and boxes[0].isVisible() and boxes[0].informativeText() == "clip.mp4: cannot be read."
    boxes[0].reject()
    qtbot.waitUntil(lambda: not window.findChildren(QMessageBox) and not notify._shown, timeout=60_000)


def test_a_changed_key_works_and_its_conflict_is_named(window):
    editor = KeyEditor(window.table, window.settings, window)
    window.table.set_keys("run.start", ("F11",))
    editor.say("", bad=False)
    assert "F11" in editor.notice.text()
    window.table.set_keys("run.start", None)
    editor.say("", bad=False)
    assert editor.notice.text() == ""


def test_the_sheet_lists_every_key_of_the_workspace(window):
    window.show_workspace("watch")
    sheet = KeySheet(window.table, "watch", window)
    sheet.line.setText("turntable")
    shown = [b for i in range(sheet.list.topLevelItemCount()) if not (b := sheet.list.topLevelItem(i)).isHidden()]
    assert len(shown) == 1


@pytest.mark.parametrize("count", [2000])
def test_references_to_none_stay_over_many_repaints(window, qapp, count):
    """Some versions of PySide6 drop a reference to None with every repaint until Python dies."""
    window.show_workspace("watch")
    watch = window.workspaces["watch"]
    before = sys.getrefcount(None)
    for i in range(count):
        watch.center.input_picture.update()
        if i % 10 == 0:
            qapp.processEvents()
    assert sys.getrefcount(None) > before - 200


def test_docks_float_and_come_back_many_times_without_anything_left_behind(window, qapp):
    window.show_workspace("watch")
    watch = window.workspaces["watch"]
    qapp.processEvents()
    before = len(qapp.allWidgets())
    for _ in range(25):
        for name in ("curves", "objects"):
            watch.docks[name].setFloating(True)
            qapp.processEvents()
            watch.docks[name].setFloating(False)
            qapp.processEvents()
    assert len(qapp.allWidgets()) <= before + 4


def test_a_run_that_goes_on_is_asked_about_when_the_window_closes(window, monkeypatch):
    from genmojo_studio.watch import workspace

    window.show_workspace("watch")
    answers = [False, True]
    monkeypatch.setattr(workspace, "may_leave", lambda _control, _parent: answers.pop(0))
    window.close()
    assert window.isVisible() and answers == [True]
    window.close()
    assert not window.isVisible()


def test_a_clip_that_is_half_open_in_the_annotator_opens_whole_or_not_at_all(window, qtbot, tmp_path):
    """Another workspace, another clip or the end comes between two parts: nothing is lost or left over."""
    from genmojo_core.clip import synthetic, synthetic_files

    clip, truth = synthetic.generate("crossing-shapes")
    for name in ("one", "two"):
        synthetic_files.write(clip, truth, tmp_path / name)
    window.read_clip(tmp_path / "one", "annotate")
    qtbot.waitUntil(lambda: window.state.clip is not None, timeout=60_000)
    annotate = window.workspaces["annotate"]
    parts = annotate.opening(tmp_path / "two")
    next(parts), next(parts)
    assert annotate.session is None  # not of use yet
    window.show_workspace("watch")
    window.show_workspace("annotate")
    for _ in parts:
        continue
    assert annotate.session is not None and annotate.session.project.info.path.endswith("two")
    parts = annotate.opening(tmp_path / "one")
    next(parts), next(parts)
    annotate.close_clip()
    assert annotate.session is None
    assert list(parts) == []
    list(annotate.opening(tmp_path / "one"))  # nobody holds its project
    assert not annotate.session.project.read_only and annotate.objects is not None


def test_the_project_of_a_clip_is_made_on_a_thread(window, qtbot, tmp_path, monkeypatch):
    """A slow disk does not hold up the window."""
    import threading

    from genmojo_core.clip import synthetic, synthetic_files
    from genmojo_core.store import project_file

    synthetic_files.write(*synthetic.generate("crossing-shapes"), tmp_path / "fresh")
    made, create = [], project_file.create
    monkeypatch.setattr(project_file, "create", lambda *a: (made.append(threading.current_thread()), create(*a)))
    window.read_clip(tmp_path / "fresh", "annotate")
    qtbot.waitUntil(lambda: getattr(window.workspaces.get("annotate"), "session", None) is not None, timeout=60_000)
    assert len(made) == 1 and threading.main_thread() not in made
