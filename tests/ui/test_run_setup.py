"""Before a run the form tells what to expect, and follows the budget and the effects as they are chosen."""

import re

from PySide6.QtCore import Qt

from genmojo_core.config import PRESETS
from genmojo_core.effects import decide
from genmojo_studio.state import AppState
from genmojo_studio.watch.run_setup import RunSetup
from tests.optimise.small_runs import small_clip

EXPECTED = {"factor": 1.0, "clip": {"texture": 30.0, "motion": 30.0, "change": 20.0, "area": 0.1, "moved": 1.0}}


def told(setup: RunSetup) -> tuple[float, float]:
    found = re.search(r"Expected: ([\d.]+) (s|min) .*?, ([\d.]+) dB", setup.said.text())
    assert found, setup.said.text()
    return float(found[1]) * (60 if found[2] == "min" else 1), float(found[3])


def test_what_to_expect_follows_budget_and_effects(qapp, tmp_path):
    state, clip = AppState(), small_clip()
    setup = RunSetup(state)
    setup.preset.setCurrentIndex(setup.preset.findData("draft"))
    state.open_clip(clip, tmp_path)
    setup.effects.show_rows(decide.plan(clip, PRESETS["draft"], {"non_rigid_motion": True}).to_json())
    setup.budget.setValue(0)
    assert "Expected" not in setup.said.text() and "GB" in setup.said.text()  # nothing is known yet
    setup.effects.expected = EXPECTED
    setup.effects.measured.emit()
    seconds, decibel = told(setup)
    setup.budget.setValue(max(1, round(seconds / 3)))
    cut, less = told(setup)
    assert cut <= seconds / 3 + 1 and less < decibel
    setup.budget.setValue(0)
    assert told(setup) == (seconds, decibel)
    row = next(i for i in range(setup.effects.topLevelItemCount())
               if setup.effects.rows[i]["name"] == "non_rigid_motion")  # fmt: skip
    setup.effects.topLevelItem(row).setCheckState(0, Qt.CheckState.Unchecked)
    assert told(setup)[0] < seconds
