"""The table of actions: no key means two things, in any preset, and every action can be done."""

import pytest

from genmojo_studio import app
from genmojo_studio.actions import PRESETS, Action, ActionTable, normal_key
from genmojo_studio.palette import matches


@pytest.mark.parametrize("preset", PRESETS)
def test_no_key_has_two_meanings(preset):
    table = ActionTable(app.all_actions())
    table.set_preset(preset)
    assert table.conflicts() == []


def test_a_conflict_is_found_across_spellings_but_not_across_workspaces():
    table = ActionTable(
        [
            Action("a", "A", keys=("Ctrl+K",)),
            Action("b", "B", keys=("ctrl+k",), workspace="watch"),
            Action("c", "C", keys=("X",), workspace="watch"),
            Action("d", "D", keys=("X",), workspace="annotate"),
        ]
    )
    assert [(c.key, c.first, c.second) for c in table.conflicts()] == [("Ctrl+K", "a", "b")]


def test_own_keys_win_over_a_preset_and_can_be_given_back():
    table = ActionTable([Action("a", "A", keys=("X",), presets={"Blender": ("Y",)})])
    table.set_preset("Blender")
    assert table.keys("a") == ("Y",)
    table.set_keys("a", ("Z",))
    assert table.keys("a") == ("Z",) and table.own_keys() == {"a": ("Z",)}
    table.set_keys("a", None)
    assert table.keys("a") == ("Y",) and table.own_keys() == {}


def test_an_action_that_is_not_possible_is_not_done():
    done = []
    table = ActionTable([Action("a", "A")])
    assert not table.trigger("a")
    table.bind("a", lambda: done.append(1), lambda: False)
    assert not table.trigger("a") and done == []


@pytest.mark.parametrize(
    ("key", "normal"), [("shift+ctrl+k", "Ctrl+Shift+K"), ("Ctrl++", "Ctrl++"), ("space", "Space")]
)
def test_keys_have_one_spelling(key, normal):
    assert normal_key(key) == normal


def test_the_palette_finds_by_letters_in_order_and_prefers_words():
    actions = [Action("1", "Point tracks"), Action("2", "Play or pause"), Action("3", "Picture of this view")]
    assert [a.id for _, a in matches("pause", actions)] == ["2"]
    assert [a.id for _, a in matches("pnt", actions)] == ["1"]
    assert matches("zzz", actions) == []
