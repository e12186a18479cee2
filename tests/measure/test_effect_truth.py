"""The judge of effect plans: its truth is the scene's own, and easy clips are planned as they are.

Not here: how often plans are right over all combinations (tests/acceptance/7.py).
"""

from __future__ import annotations

import numpy as np
import pytest

from genmojo_core.clip.synthetic import generate
from genmojo_core.clip.synthetic_effects import COMBINATIONS, FRAMES, WISHES, MadeClip, made_clip
from genmojo_core.clip.synthetic_specs import BALL, CUBE, SyntheticSpec
from genmojo_core.measure.effect_truth import CALLS_FOR, Judged, table, true_amounts


def amounts(*shapes: object, parts: tuple[int, ...] = (), view_range: float = 180.0, **changes: object) -> dict:
    spec = SyntheticSpec("made", shapes, frames=6, size=(96, 72), novel_every=0, parts=parts, **changes)
    return true_amounts(MadeClip(spec, {}, view_range), generate(spec)[1])


def still(shape: object, *path: tuple[float, float, float], **changes: object) -> object:
    from dataclasses import replace

    return replace(shape, path=path, spin=0.0, **changes)


def test_a_rigid_ball_that_moves_calls_for_its_unseen_side_only() -> None:
    found = amounts(still(BALL, (-0.5, 0.0, 0.5), (0.5, 0.0, 0.5)))
    assert {name for name, amount in found.items() if amount >= CALLS_FOR[name]} == {"unseen_views"}
    assert found["camera_motion"] == pytest.approx(0, abs=1e-9) and found["non_rigid_motion"] < 1e-6


def test_covered_pixels_are_counted_in_frames() -> None:
    front, back = still(BALL, (-1.2, -1.0, 0.5), (1.2, -1.0, 0.5)), still(CUBE, (0.0, 0.6, 0.5))
    assert 1 <= amounts(front, back)["joint_occlusion"] <= 5
    assert amounts(front, still(CUBE, (3.0, 0.6, 0.5)))["joint_occlusion"] == 0


def test_two_solids_of_one_object_are_one_object_that_bends() -> None:
    body = still(CUBE, (0.0, 0.0, 0.5))
    arm = still(BALL, (0.0, 0.0, 1.2), (0.9, 0.0, 1.2), radii=(0.2, 0.2, 0.2))
    found = amounts(body, arm, parts=(0, 0))
    assert found["instance_labels"] == 1 and found["non_rigid_motion"] > 20 and found["joint_occlusion"] == 0


def test_camera_light_and_return_are_measured() -> None:
    gone = still(BALL, (0.0, -1.0, 0.5), (4.0, -1.0, 0.5), (4.0, -1.0, 0.5), (0.0, -1.0, 0.5))
    found = amounts(gone, eye=((0.0, -6.0, 1.9), (0.5, -6.0, 1.9)), light=(1.0, 0.2), view_range=0.0)
    assert found["camera_motion"] > 5 and found["appearance_change"] > 20 and found["reappearance"] >= 1
    assert found["unseen_views"] < CALLS_FOR["unseen_views"]


def test_seeds_run_through_all_combinations_and_repeat_exactly() -> None:
    wished = {tuple(made_clip(seed).wished.values()) for seed in range(len(COMBINATIONS))}
    assert wished == set(COMBINATIONS) and len(wished) == 2 ** len(WISHES)
    once, again = (generate(made_clip(31).spec)[0].frames for _ in range(2))
    assert len(once) == FRAMES and np.array_equal(once, again)


def test_the_table_counts_needless_and_missed() -> None:
    rows = [Judged(0, "flow", 1, 1, 1, right, decided) for right in (True, False) for decided in (True, False)]
    named = [Judged(r.seed, "camera_motion", 1, 1, 1, r.right, r.decided) for r in rows]
    row = next(r for r in table(named) if r["effect"] == "camera_motion")
    assert (row["decisions"], row["correct"], row["needless"], row["missed"]) == (4, 0.5, 1, 1)
