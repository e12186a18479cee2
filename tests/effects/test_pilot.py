"""A pilot: when it pays, how it is kept, and what a forecast makes of it."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from genmojo_core.clip.cut import cut, picked
from genmojo_core.config import preset
from genmojo_core.effects import decide, forecast, pilot
from genmojo_core.effects.difficulty import Difficulty
from genmojo_core.effects.forecast import foretold, remainder, together, work_of
from genmojo_core.effects.pilot import Pilot
from genmojo_core.measure.pilot_run import blurred_psnr, keep, piloted, small
from genmojo_core.optimise.schedule import frames_in_play
from tests.benchmarks import forecast as benchmark
from tests.optimise.small_runs import small_clip

CLIP = Difficulty(30.0, 30.0, 20.0, 0.1, 2.0, reached=25.0, coarse=30.0, fine=36.0)


def told(clip=CLIP, **changes):
    config = preset("draft", budget_seconds=1e6, **changes)
    side = config.short_side
    return foretold(work_of((2 * side, side), 24, 2, ["background", "flow"], config), clip, config, 1.0)


@given(st.floats(10, 45), st.floats(0.5, 20))
def test_what_few_pixels_cost_is_taken_off_and_put_back(decibel, above):
    limit = decibel + above
    rest = remainder(decibel, limit)
    assert decibel < rest <= decibel - 10 * math.log10(forecast.LEAST_REST) + 1e-9
    if 1 - 10 ** (-above / 10) > forecast.LEAST_REST:  # else a least share is kept
        assert together(rest, limit) == pytest.approx(decibel)


def test_a_pilot_replaces_the_clip_s_motion_and_says_so():
    plain, seen = told(replace(CLIP, reached=None, coarse=None, fine=None)), told()
    assert seen.decibel != plain.decibel and seen.decibel_error == forecast.MODEL.piloted_error
    assert "from a pilot run" in forecast.said(seen) and "pilot" not in forecast.said(plain)
    assert told(replace(CLIP, reached=28.0)).decibel > seen.decibel
    assert told(joint_steps=2000).decibel > seen.decibel > told(joint_steps=20).decibel
    assert told(short_side=128).decibel < seen.decibel < together(60.0, CLIP.fine)
    cut = foretold(work_of((448, 224), 24, 2, ["background"], preset("draft")), CLIP,
                   preset("draft", budget_seconds=8.0), 1.0)  # fmt: skip
    assert cut.decibel < seen.decibel  # ended before all frames took part


def test_the_fit_finds_the_law_that_made_the_rows():
    law, rows, features = np.array([-3.0, 2.0, 0.8]), [], []
    for name, reached, motion in (("a", 20.0, 24.0), ("b", 26.0, 27.0), ("c", 30.0, 36.0), ("d", 24.0, 31.0)):
        for steps, gaussians in ((50, 3000), (200, 2000), (600, 5000), (200, 6000)):
            config = preset("draft", paced=True, budget_seconds=100.0, gaussians_per_object=gaussians)
            clip = replace(CLIP, reached=reached, motion=motion, coarse=50.0, fine=60.0)
            row = {"clip": name, "kind": "preset", "size": (448, 224), "frames": 24, "objects": 2, "on": ["background"],
                   "config": config.to_json(), "gaussians": 9000, "difficulty": clip.to_json(),
                   "stages": {"joint": {"steps": steps}}}  # fmt: skip
            made = benchmark.work(row)
            features.append(forecast.pilot_features(made, steps, steps, gaussians))
            gain = float(features[-1] @ law)
            limit = forecast.ceiling(clip, forecast.PILOT_SIDE)
            row["psnr"] = together(remainder(reached, limit) + gain, forecast.ceiling(clip, forecast.side_of(made)))
            rows.append(row)
    found = np.array(benchmark.pilot_law(rows))  # drawn to 0 a little: rows of so few clips say no more
    assert np.abs(np.array(features) @ (found - law)).max() < 0.3 and found == pytest.approx(law, rel=0.2)
    assert benchmark.pilot_law([{**row, "difficulty": {"reached": None}} for row in rows]) == ()


@pytest.mark.parametrize(("joint", "planned"), [(240, 240), (100, 240), (60, 700), (1, 700), (0, 700)])
def test_looks_are_counted_as_the_schedule_gives_them(joint, planned):
    """A schedule cut off early has shown many frames little or never, whatever it made of those it began with."""
    work = work_of((64, 64), 24, 1, [], preset("draft"))
    looks = np.zeros(24)
    for i in range(joint):
        there = frames_in_play(24, 12, i / planned)
        looks[there] += min(work.views / len(there), 1.0)
    told = forecast.pilot_features(work, joint, planned, 6000)
    assert (
        told[0] == 1.0
        and told[2] == pytest.approx(math.log(2))
        and told[1] == pytest.approx(np.log(looks + 4.0).mean(), abs=0.03)
    )


def test_a_pilot_looks_at_the_whole_clip():
    clip = small_clip(frames=5)
    assert list(small(clip).frame_index) == list(clip.frame_index)
    assert small(clip).flow.value.shape == clip.flow.value.shape
    few = picked(clip, [0, 2, 4])
    assert few.flow is None and list(few.frame_index) == list(clip.frame_index[[0, 2, 4]])
    assert few.background_frame == int(np.argmin(np.abs(np.array([0, 2, 4]) - clip.background_frame)))
    assert np.array_equal(few.cameras.value.K, clip.cameras.value.K[[0, 2, 4]])
    assert np.array_equal(few.masks.value, clip.masks.value[[0, 2, 4]]) and few.source_names[1] == clip.source_names[2]
    two = cut(clip, 1, 2)
    assert two.flow.valid[0].any() and not two.flow.valid[-1].any() and clip.flow.valid[2].any()


def test_a_pilot_of_a_long_clip_takes_frames_evenly(monkeypatch):
    monkeypatch.setattr(pilot, "FRAMES", 3)
    clip = small_clip(frames=5)
    few = small(clip)
    assert list(few.frame_index) == list(clip.frame_index[[0, 2, 4]]) and few.flow.value.shape[0] == 3


def test_a_pilot_pays_only_before_a_long_run():
    clip = small_clip()
    seconds = pilot.pilot_seconds(clip, ["background"], 1.0)
    assert 0 < seconds < pilot.pilot_seconds(clip, ["background"], 3.0) == pytest.approx(3 * seconds)
    assert pilot.pilot_seconds(clip, ["background", "non_rigid_motion"], 1.0) > seconds
    long = replace(told(), seconds=600.0)
    assert pilot.pays(long, 20.0) and not pilot.pays(long, 61.0)
    assert not pilot.pays(replace(long, seconds=50.0), 1.0)
    assert pilot.pilot_config(5).gaussians_per_object * 5 <= forecast.PILOT_TOGETHER


def test_pilots_are_kept_by_pixels_masks_and_effects(tmp_path, monkeypatch):
    monkeypatch.setattr(pilot, "user_cache", lambda: tmp_path)
    clip = small_clip()
    plan = decide.plan(clip, preset("draft"))
    found = Pilot(25.5, 30.0, 36.0)
    assert pilot.stored(clip, plan) is None and keep(clip, plan, found) and pilot.stored(clip, plan) == found
    other = clip.frames.copy()
    other[0, 0, 0, 0] ^= 1
    labels = clip.masks.value.copy()
    labels[0, 0, 0] ^= 1
    assert pilot.stored(replace(clip, frames=other), plan) is None
    assert pilot.stored(clip.with_channels(masks=replace(clip.masks, value=labels)), plan) is None
    assert pilot.stored(clip, plan.changed("flow", on=not plan.on("flow"))) is None
    for text in ("", "[]", "{}", '{"reached": NaN, "coarse": 1, "fine": 1}'):
        pilot.pilot_file(clip, plan).write_text(text)
        assert pilot.stored(clip, plan) is None


def test_a_pilot_runs_once_and_a_blur_costs_more_the_fewer_pixels(tmp_path, monkeypatch):
    monkeypatch.setattr(pilot, "user_cache", lambda: tmp_path)
    few = replace(pilot.pilot_config(2), gaussians_per_object=100, background_gaussians=300, lift_steps=2,
                  joint_steps=3, short_side=45, plane_resolution=8)  # fmt: skip
    monkeypatch.setattr(pilot, "pilot_config", lambda objects: few)
    clip, shares = small_clip(), []
    plan = decide.plan(clip, preset("draft"))
    found = piloted(clip, plan, clip, shares.append)
    assert 5 < found.reached < 40 and shares and max(shares) <= 1.0
    monkeypatch.setattr("genmojo_core.measure.pilot_run.Run", None)
    assert piloted(clip, plan, clip, shares.append) == found
    blurred = [blurred_psnr(clip, side) for side in (10, 20, 45, 90)]
    assert blurred == sorted(blurred) and blurred[3] > blurred[2]
    empty = clip.with_channels(masks=replace(clip.masks, value=np.zeros_like(clip.masks.value)))
    assert math.isnan(blurred_psnr(empty, 20))
