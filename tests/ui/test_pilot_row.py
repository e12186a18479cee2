"""A pilot in the form of a new run: it begins by itself where it pays, can be skipped, and changes what is expected."""

import pytest

from genmojo_core.config import PRESETS
from genmojo_core.effects import decide
from genmojo_studio.state import AppState
from genmojo_studio.watch.effects_process import EffectsProcess
from genmojo_studio.watch.run_setup import RunSetup
from tests.optimise.small_runs import small_clip

EXPECTED = {"factor": 1.0, "clip": {"texture": 30.0, "motion": 30.0, "change": 20.0, "area": 0.1, "moved": 1.0}}
PILOTED = {"factor": 1.0, "clip": {**EXPECTED["clip"], "reached": 22.0, "coarse": 30.0, "fine": 35.0}}


@pytest.fixture
def setup(qtbot, tmp_path, monkeypatch):
    """A form whose effects are known; `asked` collects the questions of its pilot."""
    asked = []
    monkeypatch.setattr(EffectsProcess, "ask", lambda process, *what: asked.append((process, what)))
    state, clip = AppState(), small_clip()
    form = RunSetup(state)
    qtbot.addWidget(form)
    form.preset.setCurrentIndex(form.preset.findData("standard"))
    state.open_clip(clip, tmp_path)
    form.effects.show_rows(decide.plan(clip, PRESETS["standard"]).to_json())
    form.asked = asked
    return form


def measured(form: RunSetup, seconds: float | None) -> None:
    form.effects.expected, form.effects.pilot_seconds = EXPECTED, seconds
    form.effects.measured.emit()


def test_it_begins_where_it_pays_and_changes_what_is_expected(setup):
    measured(setup, None)
    assert not setup.asked and setup.pilot.isHidden() and "pilot" not in setup.said.text()
    measured(setup, 9.0)
    process, what = setup.asked[0]
    assert "--pilot" in what and not setup.pilot.isHidden() and "about 9 s" in setup.pilot.said.text()
    before = setup.said.text()
    process.answered.emit({"forecast": PILOTED})
    assert setup.pilot.isHidden() and "from a pilot run" in setup.said.text() != before


def test_it_can_be_skipped_and_ends_with_the_start_of_the_run(setup, monkeypatch):
    stopped = []
    monkeypatch.setattr(EffectsProcess, "stop", lambda process: stopped.append(process))
    measured(setup, 9.0)
    setup.pilot.skip.click()
    assert stopped and setup.pilot.isHidden() and "from a pilot run" not in setup.said.text()
    measured(setup, 9.0)
    stopped.clear()
    setup.request()
    assert stopped and setup.pilot.isHidden()
    measured(setup, 9.0)
    setup.asked[-1][0].failed.emit("There is no such clip.")
    assert setup.pilot.isHidden()
