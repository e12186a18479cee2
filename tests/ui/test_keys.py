"""Keys of one's own: no key means two things, none is lost, and the sheet tells what mouse and keys do here.

Not covered: keys that a desktop takes before the app sees them.
"""

import json

import pytest
from PySide6.QtGui import QKeySequence

from genmojo_core.errors import GenmojoError
from genmojo_studio import app, key_rules
from genmojo_studio.actions import PRESETS, Action, ActionTable
from genmojo_studio.key_sheet import KeySheet
from genmojo_studio.settings import Settings
from genmojo_studio.shortcuts import KeyEditor

NEXT = "annotate.move.next"
PUBLISHED = {  # the other tools' keys that ANNOTATOR.md §2 lists, where ours mean the same
    "CVAT": {"move.next": "F", "move.previous": "D", "move.stride_next": "V", "move.stride_previous": "C",
             "move.play": "Space", "move.key_next": "R", "move.key_previous": "E", "point.occluded": "Q /",
             "point.outside": "O", "point.key": "K", "point.delete_key": "Del", "track.delete": "Shift+Del",
             "track.lock": "L", "edit.undo": "Ctrl+Z", "edit.redo": "Ctrl+Shift+Z", "edit.checkpoint": "Ctrl+S"},
    "labelme": {"move.next": "D", "move.previous": "A", "point.delete_key": "Del", "view.fit": "Ctrl+F",
                "view.hide": "T", "edit.undo": "Ctrl+Z", "edit.checkpoint": "Ctrl+S"},
    "Blender": {"move.next": "Right", "move.previous": "Left", "move.ten_next": "Ctrl+Right",
                "move.ten_previous": "Ctrl+Left", "move.first": "Shift+Left", "move.last": "Shift+Right",
                "move.play": "Space", "move.key_next": "Up", "move.key_previous": "Down",
                "move.worst_back": "Shift+Alt+Left", "point.occluded": "Shift+D", "point.key": "I",
                "point.delete_key": "Shift+X Alt+I", "track.delete": "X", "track.next": "Alt+Right",
                "track.previous": "Alt+Left", "track.on": "Ctrl+T", "track.back": "Ctrl+Shift+T", "track.solve": "T",
                "track.clear_after": "Alt+T", "track.clear_before": "Shift+T", "track.lock": "Ctrl+L Alt+L",
                "view.follow": "L", "view.fit": "Home", "view.hide": "Alt+Shift+Z", "edit.undo": "Ctrl+Z",
                "edit.redo": "Ctrl+Shift+Z"},
}  # fmt: skip


@pytest.fixture
def table():
    return ActionTable(app.all_actions())


@pytest.fixture
def editor(qapp, qtbot, table):
    Settings().put_own_keys({})
    made = KeyEditor(table, Settings())
    qtbot.addWidget(made)
    made.show()
    yield made
    Settings().put_own_keys({})
    Settings().put("keys/preset", "")


def typed(editor, action_id, key):
    editor.choose(action_id)
    editor.key.setKeySequence(QKeySequence(key))


def same(one, other):
    return QKeySequence(one) == QKeySequence(other)


@pytest.mark.parametrize("preset", PRESETS)
def test_no_preset_has_a_clash_of_any_kind(table, preset):
    table.set_preset(preset)
    found = [(a.id, c) for a in table for c in key_rules.clashes(table, a.id, table.keys(a.id))]
    assert found == [] and table.conflicts() == []


@pytest.mark.parametrize("preset", PUBLISHED)
def test_a_preset_has_the_keys_of_its_tool(table, preset):
    table.set_preset(preset)
    for name, keys in PUBLISHED[preset].items():
        for key in keys.split():
            assert any(same(key, own) for own in table.keys(f"annotate.{name}")), (name, key)


def test_a_sequence_and_its_beginning_cannot_both_be_had():
    table = ActionTable([Action("a", "A", keys=("Ctrl+K, O",)), Action("b", "B", keys=("Ctrl+K",), workspace="watch"),
                         Action("c", "C", keys=("K",), workspace="annotate")])  # fmt: skip
    assert [(c.first, c.second) for c in table.conflicts()] == [("a", "b")]


@pytest.mark.parametrize(
    ("action_id", "key", "words"),
    [
        (NEXT, "A", "belongs to “Previous frame”"),  # an alternate of another action
        (NEXT, "F11", "belongs to “Full screen”"),  # of the whole app
        (NEXT, "Ctrl+K, X", "begins with"),
        ("annotate.point.occluded", "Ctrl+F12, X", "takes a single key"),
        (NEXT, "Tab", "cannot be given away"),
        ("annotate.view.fit", "Z", "belongs to “Loupe while held”"),
    ],
)
def test_a_key_that_clashes_is_refused_by_name_and_nothing_is_stored(editor, table, action_id, key, words):
    before = {a.id: table.keys(a.id) for a in table}
    typed(editor, action_id, key)
    editor.add_button.click()
    assert words in editor.notice.text()
    assert {a.id: table.keys(a.id) for a in table} == before and Settings().own_keys() == {}
    assert editor.take_button.isVisible() == ("belongs" in words or "begins" in words)


def test_the_key_of_another_action_is_taken_over_when_the_offer_is_taken(editor, table):
    typed(editor, NEXT, "A")
    editor.add_button.click()
    editor.take_button.click()
    assert table.keys(NEXT) == ("Right", "D", "A") and table.keys("annotate.move.previous") == ("Left",)
    assert table.conflicts() == [] and editor.notice.text() == ""
    assert Settings().own_keys() == table.own_keys()


def test_alternates_are_changed_one_by_one(editor, table):
    typed(editor, NEXT, "F12")
    editor.keys.setCurrentRow(1)
    editor.replace_button.click()
    assert table.keys(NEXT) == ("Right", "F12")
    typed(editor, NEXT, "Ctrl+F12")
    editor.add_button.click()
    assert table.keys(NEXT) == ("Right", "F12", "Ctrl+F12")
    editor.keys.setCurrentRow(0)
    editor.remove_button.click()
    assert table.keys(NEXT) == ("F12", "Ctrl+F12")
    editor.reset_button.click()
    assert table.keys(NEXT) == ("Right", "D") and Settings().own_keys() == {}


def test_delivered_keys_that_somebody_else_has_by_now_are_asked_for(editor, table):
    typed(editor, "annotate.view.fit", "D")
    editor.add_button.click()
    editor.take_button.click()
    editor.choose(NEXT)
    editor.reset_button.click()
    assert "“Fit the frame”" in editor.notice.text() and table.keys(NEXT) == ("Right",)
    editor.take_button.click()
    assert table.keys(NEXT) == ("Right", "D") and "D" not in table.keys("annotate.view.fit")


def test_a_preset_that_clashes_with_own_keys_is_asked_about(editor, table):
    typed(editor, "annotate.view.trails", "F12")
    editor.add_button.click()
    typed(editor, "annotate.view.masks", "/")  # CVAT's second key for occluded
    editor.add_button.click()
    editor.preset.textActivated.emit("CVAT")
    assert table.preset == "Studio" and "Masks" in editor.notice.text() and editor.preset.currentText() == "Studio"
    editor.take_button.click()
    assert table.preset == "CVAT" and table.conflicts() == [] and "F12" in table.keys("annotate.view.trails")
    assert editor.preset.currentText() == Settings().text("keys/preset") == "CVAT"


def test_keys_go_into_a_file_and_come_back(editor, table, tmp_path, monkeypatch):
    path = tmp_path / "mine.json"
    dialogs = "PySide6.QtWidgets.QFileDialog."
    monkeypatch.setattr(dialogs + "getSaveFileName", lambda *a, **k: (str(path), ""))
    monkeypatch.setattr(dialogs + "getOpenFileName", lambda *a, **k: (str(path), ""))
    editor.preset.textActivated.emit("Blender")
    typed(editor, NEXT, "F12")
    editor.add_button.click()
    wanted = {a.id: table.keys(a.id) for a in table}
    editor.export_button.click()
    editor.preset.textActivated.emit("Studio")
    editor.choose(NEXT)
    editor.reset_button.click()
    assert {a.id: table.keys(a.id) for a in table} != wanted
    editor.import_button.click()
    assert {a.id: table.keys(a.id) for a in table} == wanted and table.preset == "Blender"
    assert Settings().own_keys() == table.own_keys() == {NEXT: ("Right", "F12")}


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda c: c.update(format="other"), "format"),
        (lambda c: c.update(version=9), "version"),
        (lambda c: c.update(preset="Emacs"), "format"),
        (lambda c: c["keys"].update({NEXT: ["Left"]}), "value"),
        (lambda c: c["keys"].update({NEXT: ["Tab"]}), "value"),
        (lambda c: c["keys"].update({NEXT: ["Nokey"]}), "value"),
        (lambda c: c["keys"].update({NEXT: "Right"}), "value"),
    ],
)
def test_a_file_of_keys_that_is_wrong_changes_nothing(qapp, table, tmp_path, change, code):
    path = tmp_path / "keys.json"
    key_rules.write_file(table, path)
    content = json.loads(path.read_text())
    change(content)
    path.write_text(json.dumps(content))
    with pytest.raises(GenmojoError) as caught:
        key_rules.read_file(table, path)
    assert caught.value.code == code and table.own_keys() == {}


def texts(sheet):
    return [[i.text(c) for c in range(3)] for i in sheet.list.leaves() if not i.isHidden()]


@pytest.fixture
def sheets(qapp, qtbot, table):
    for action in table:
        table.bind(action.id, lambda: None)

    def make(place):
        made = KeySheet(table, "annotate", None, place)
        qtbot.addWidget(made)
        made.show()
        return made

    return make


def test_the_sheet_tells_what_the_mouse_does_in_this_step(sheets, table):
    refine = " ".join(" ".join(row) for row in texts(sheets(2)))
    for words in ("Places the active point", "within 12 pixels", "eighth of the speed", "Zooms at the mouse", "middle",
                  "Occluded, or visible again", "Hold Z", "Hold H", "Hold Q and step",
                  "Paints the state that is chosen", "Drag a diamond", "arrow at the rim", "Puts it back",
                  "Right click", "Zooms in time about the mouse", "Drag the bar"):  # fmt: skip
        assert words in refine, words
    objects = " ".join(" ".join(row) for row in texts(sheets(0)))
    assert "Places the active point" not in objects and "rectangle round the object" in objects


def test_the_sheet_is_searched_shows_the_step_alone_and_the_keys_of_now(sheets, table, qtbot):
    sheet = sheets(2)
    sheet.line.setText("wheel")
    assert 0 < len(texts(sheet)) < 8
    sheet.line.setText("")
    everything = len(texts(sheet))
    sheet.only.setChecked(True)
    assert 20 < len(texts(sheet)) < everything
    table.set_keys("annotate.view.loupe", ("F12",))
    qtbot.waitUntil(lambda: any("Hold F12" in row[0] for row in texts(sheet)), timeout=60_000)


def test_all_actions_that_are_held_are_marked(table):
    assert {a.id for a in table if a.held} == {f"annotate.{name}" for name in (
        "point.occluded", "point.outside", "point.visible", "point.nothing", "view.loupe", "view.hide")}  # fmt: skip
