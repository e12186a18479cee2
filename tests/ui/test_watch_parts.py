"""Parts of the workspace Watch that need no window: time, run log, forecasts, track sets, undo, differences."""

import math

import numpy as np
import pytest

from genmojo_core.optimise import gain
from genmojo_core.tracks.model import OCCLUDED, VISIBLE, PointTracks
from genmojo_studio.undo import UndoStack
from genmojo_studio.watch import differences, track_sets
from genmojo_studio.watch.player import following
from genmojo_studio.watch.run_log import RunLog


def test_there_and_back_shows_every_frame_and_the_ends_once():
    shown, frame, direction = [], 0, 1
    for _ in range(7):
        frame, direction, ended = following(frame, 1, 4, "ping-pong", direction)
        shown.append(frame)
        assert not ended
    assert shown == [1, 2, 3, 2, 1, 0, 1]


def test_once_ends_at_the_last_frame_and_loop_goes_round():
    assert following(2, 5, 4, "once", 1) == (3, 1, True)
    assert following(3, 1, 4, "loop", 1) == (0, 1, False)


def _step(seconds, step, psnr=None, **losses):
    return {"event": "Step", "seconds": seconds, "cpu_seconds": seconds, "stage": "joint", "step": step, "steps": 9,
            "loss": sum(losses.values()), "losses": losses, "gaussians": 5, "psnr_held_out": psnr, "progress": 0.1,
            "eta_seconds": 3.0}  # fmt: skip


def test_a_loss_that_comes_later_keeps_its_place_in_time():
    log = RunLog()
    log.add({"event": "StageStarted", "seconds": 0.0, "stage": "joint", "steps": 9})
    log.add(_step(1.0, 1, 20.0, rgb=0.5))
    log.add(_step(1.5, 2, None, rgb=0.4, flow=0.1))
    assert log.column("flow").tolist()[1] == 0.1 and math.isnan(log.column("flow")[0])
    assert log.step_ms[1] == pytest.approx(500.0)
    assert log.accuracy == [(1.0, 1, 20.0)]
    assert log.stages[0].done == 2
    rows = log.to_csv().splitlines()
    assert rows[0] == "seconds,step,gaussians,step_ms,psnr_held_out_db,total,rgb,flow" and len(rows) == 3


def test_the_gain_of_the_next_minute_is_that_of_the_true_curve():
    curve = [(float(t), 20.0 + 2.0 * math.log(t)) for t in range(5, 65, 5)]
    found = gain.expected(curve, 60.0)
    assert found is not None
    assert found.decibel == pytest.approx(2.0 * math.log(2.0), abs=1e-6) and found.spread < 1e-6
    assert gain.expected(curve[:5]) is None
    assert gain.expected([(t / 10, value) for t, value in curve]) is None  # five seconds say nothing about a minute


def test_a_run_is_stopped_only_when_it_stays_flat():
    rule = gain.StopRule(patience=3)
    rising = [(float(t), 20.0 + 3.0 * math.log(t)) for t in range(5, 60, 5)]
    assert not any(rule.reached(rising[:n], 0.5) for n in range(1, len(rising)))
    flat = [(float(t), 25.0) for t in range(5, 100, 5)]
    rule = gain.StopRule(patience=3)
    said = [rule.reached(flat[:n], 0.5) for n in range(1, len(flat))]
    assert said.index(True) == gain.FEWEST + 1  # the third point with a forecast


def _tracks(xy, state=None):
    xy = np.asarray(xy, np.float32)
    states = np.full(xy.shape[:2], VISIBLE, np.uint8) if state is None else np.asarray(state, np.uint8)
    return PointTracks(xy, states, np.ones(len(xy), np.int64), (512, 512))


def test_tracks_of_another_order_find_their_partners():
    truth = _tracks([[[10, 10], [12, 10]], [[300, 300], [302, 300]]])
    found = track_sets.apart(_tracks([[[301, 300], [310, 300]], [[10, 12], [12, 12]]]), truth)
    assert found.partner.tolist() == [1, 0]
    assert found.error[1].tolist() == pytest.approx([1.0, 1.0])  # two pixels of 512 are one at 256
    assert found.worst(5)[0][:2] == (0, 1)


def test_states_that_differ_are_counted():
    a = _tracks([[[10, 10], [12, 10]]], [[VISIBLE, OCCLUDED]])
    b = _tracks([[[10, 10], [12, 10]]])
    assert track_sets.apart(a, b).state_differs.tolist() == [[False, True]]


def test_quick_changes_of_one_thing_are_undone_together():
    now, value = [0.0], [0]
    stack = UndoStack(lambda: now[0])

    def change(to, key):
        stack.record("change", lambda v: value.__setitem__(0, v), value[0], to, key)
        value[0] = to

    change(1, "slider")
    now[0] = 0.5
    change(2, "slider")
    now[0] = 5.0
    change(3, "slider")
    assert stack.undo() and value == [2]
    assert stack.undo() and value == [0]
    assert not stack.undo()
    assert stack.redo() and stack.redo() and value == [3]


def test_differences_of_equal_and_unequal_pictures():
    a = np.full((4, 6, 3), 100, np.uint8)
    b = a.copy()
    b[:, 3:] += 10
    assert differences.absolute(a, b, 4.0)[0].tolist() == [[0, 0, 0]] * 3 + [[40, 40, 40]] * 3
    assert differences.wipe(b, a, 0.5).tolist() == a.tolist()  # only their right halves differ
    assert differences.onion(a, b, 1.0).tolist() == b.tolist()
    by_object = differences.psnr_by_object(a, b, np.tile([0, 0, 0, 1, 1, 1], (4, 1)), {7: 1})
    assert by_object[7] == pytest.approx(-20 * math.log10(10 / 255), abs=1e-3)


def test_a_resumed_run_tells_each_step_once():
    """Killed at step 4 after a checkpoint at step 2: steps 3 and 4 come again, and the newer ones count."""
    log = RunLog()
    for name in ("first scene", "joint"):
        log.add({"event": "StageStarted", "seconds": 0.0, "stage": name, "steps": 9})
    for step in range(1, 5):
        log.add(_step(float(step), step, 20.0 + step, rgb=0.5))
    for name in ("first scene", "joint"):
        log.add({"event": "StageStarted", "seconds": 2.0, "stage": name, "steps": 9})
    for step in range(3, 6):
        log.add(_step(2.5 + step, step, 30.0 + step, rgb=0.1, flow=0.2))
    assert log.step == [1, 2, 3, 4, 5] and log.losses["rgb"] == [0.5, 0.5, 0.1, 0.1, 0.1]
    assert [row[1:] for row in log.accuracy] == [(1, 21.0), (2, 22.0), (3, 33.0), (4, 34.0), (5, 35.0)]
    assert [(stage.name, stage.done) for stage in log.stages] == [("first scene", 0), ("joint", 5)]
    assert {len(column) for column in (log.seconds, log.gaussians, log.step_ms, *log.losses.values())} == {5}
