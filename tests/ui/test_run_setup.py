"""Before a run the form tells what to expect, and follows the budget and the effects as they are chosen."""

import json
import re
from dataclasses import replace

from PySide6.QtCore import Qt

from genmojo_core.clip import synthetic, synthetic_files
from genmojo_core.clip.synthetic_specs import spec
from genmojo_core.config import PRESETS, preset
from genmojo_core.effects import auto, decide
from genmojo_core.store.project import Project, info_of
from genmojo_core.tracks import edit_tracks, keys
from genmojo_core.tracks.annotation import ObjectInfo
from genmojo_core.tracks.model import NONE, VISIBLE
from genmojo_studio.state import AppState
from genmojo_studio.watch.forecast import spoken
from genmojo_studio.watch.run_log import RunLog
from genmojo_studio.watch.run_setup import RunSetup
from genmojo_studio.worker import preparing
from genmojo_studio.worker.protocol import RunRequest
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


def test_best_for_the_budget_asks_for_what_the_command_line_would(qapp, tmp_path):
    state, clip = AppState(), small_clip()
    setup = RunSetup(state)
    state.open_clip(clip, tmp_path)
    setup.preset.setCurrentIndex(setup.preset.findData("auto"))
    setup.preset.activated.emit(setup.preset.currentIndex())
    assert setup.budget.value() == auto.AUTO_SECONDS and setup.budget.minimum() > 0  # "no limit" makes no sense here
    setup.budget.setValue(60)
    request = setup.request()
    asked = RunRequest.from_json(json.loads(json.dumps(request.to_json())))
    assert preset(asked.preset, **asked.changes) == auto.for_budget(60.0, clip)
    setup.preset.setCurrentIndex(setup.preset.findData("draft"))
    setup.preset.activated.emit(setup.preset.currentIndex())
    assert setup.budget.minimum() == 0 and setup.request().changes["budget_seconds"] == 70.0


def test_after_a_run_what_was_expected_stands_beside_what_came(qapp, tmp_path):
    state, clip = AppState(), small_clip()
    setup = RunSetup(state)
    state.open_clip(clip, tmp_path)
    setup.preset.setCurrentIndex(setup.preset.findData("draft"))
    setup.effects.show_rows(decide.plan(clip, PRESETS["draft"]).to_json())
    log = RunLog.of_scene([{"seconds": 41.0, "step": 300, "psnr_held_out": 27.25}])
    setup.came(log)
    assert "last run" not in setup.said.text()  # nobody asked for one
    setup.effects.expected = EXPECTED
    setup.effects.measured.emit()
    seconds, decibel = told(setup)
    setup.request()
    setup.came(log)
    assert f"expected {spoken(seconds)} and {decibel:.1f} dB, took {spoken(41.0)}, 27.2 dB" in setup.said.text()
    setup.request()
    assert told(setup) == (seconds, decibel)


def test_a_run_follows_the_annotated_points_of_the_clip_unless_told_otherwise(qapp, tmp_path):
    clip, folder = made_clip(tmp_path)
    state, file = AppState(), tmp_path / "p.genmojo"
    setup = RunSetup(state)
    state.open_clip(clip, folder)
    assert setup.annotated.isHidden() and setup.request().tracks == ""
    project = Project.create(file, info_of(len(clip), clip.source_size, str(folder)), person="Ada")
    state.set(project_path=file)
    assert not setup.annotated.isHidden()
    prepared, _, _ = preparing.prepare(setup.request(), lambda *_: None, lambda: False)
    assert prepared.tracks is None, "nobody has placed a point: the run goes without"
    owner = int(clip.object_ids[0])
    project.do(edit_tracks.put_objects(project.annotation, [ObjectInfo(owner, "one", 1, "chosen")]))
    project.do(edit_tracks.add_track(project.annotation, owner, 1, "Ada"))
    project.do(keys.set_key(project.annotation, 1, 0, (5.0, 6.0)))
    project.close()
    prepared, _, _ = preparing.prepare(setup.request(), lambda *_: None, lambda: False)
    assert prepared.tracks.given and prepared.tracks.value.state.tolist() == [[VISIBLE] + [NONE] * (len(clip) - 1)]
    setup.annotated.setChecked(False)
    assert setup.request().tracks == ""


def made_clip(tmp_path):
    """A small clip in a folder of its own."""
    clip, truth = synthetic.generate(replace(spec("crossing-shapes"), frames=4, novel_every=0, size=(96, 54)))
    synthetic_files.write(clip, truth, tmp_path / "clip")
    (tmp_path / "clip" / "tracks.npz").unlink(missing_ok=True)
    return clip, tmp_path / "clip"
