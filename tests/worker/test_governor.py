"""The governor keeps previews under their share of the run, finds out what drawing costs, and says it."""

from __future__ import annotations

import pytest

from genmojo_studio.worker.governor import PROBE_EVERY, PROBE_STEPS, SHARE, Governor


def run_for(governor, seconds, step, publish, drawing=1.0):
    """A simulated run; returns how many previews there were and the share of time they took."""
    clock, spent, count = 100.0, 0.0, 0
    while clock < 100 + seconds:
        took = step * (1.0 if governor.probing else drawing)
        clock += took
        governor.stepped(took)
        if governor.due(clock):
            clock += publish
            spent += publish
            count += 1
            governor.published(clock, publish)
    return count, spent / seconds, clock


@pytest.mark.parametrize(("step", "publish"), [(0.1, 0.004), (0.02, 0.05), (1.0, 0.001), (0.05, 0.3)])
def test_previews_keep_to_their_share(step, publish):
    governor = Governor("live")
    count, share, clock = run_for(governor, 200, step, publish)
    assert share <= SHARE * 1.1 and count > 5
    assert governor.cost(clock).publish_share == pytest.approx(share, abs=0.012)


def test_cheap_previews_come_as_often_as_one_can_see():
    count, _, _ = run_for(Governor("live"), 10, 0.005, 0.0001)
    assert 200 < count < 340


def test_slow_and_off():
    count, _, _ = run_for(Governor("slow"), 20, 0.02, 0.0001)
    assert 18 <= count <= 21
    off = Governor("off")
    assert run_for(off, 20, 0.02, 0.1)[0] == 0 and off.cost(0.0).interval == 0.0
    with pytest.raises(KeyError):
        off.set_cadence("often")


def test_drawing_that_costs_more_is_found_and_spaced_out():
    governor = Governor("live")
    run_for(governor, 0.05 * (PROBE_EVERY + PROBE_STEPS + 2) * 1.3, 0.05, 0.002, drawing=1.25)
    assert governor.cost(0.0).draw_share == pytest.approx(0.25, abs=0.02)
    before = governor.interval()
    run_for(governor, 0.05 * (PROBE_EVERY + PROBE_STEPS + 2) * 1.3, 0.05, 0.002, drawing=1.25)
    assert governor.interval() == pytest.approx(2 * before)
    for _ in range(6):
        run_for(governor, 0.05 * (PROBE_EVERY + PROBE_STEPS + 2) * 1.1, 0.05, 0.002)
    assert governor.interval() < before and governor.cost(0.0).draw_share < 0.01


def test_nothing_is_due_while_probing():
    governor = Governor("live")
    for _ in range(PROBE_EVERY):
        governor.stepped(0.1)
    assert governor.probing and not governor.due(1e9)
    for _ in range(PROBE_STEPS):
        governor.stepped(0.1)
    assert not governor.probing and governor.due(1e9)
