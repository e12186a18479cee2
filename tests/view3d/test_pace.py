"""Frames while an optimiser works: their cost is found out from its steps, and there are fewer while they cost much."""

import pytest

from genmojo_studio.view3d.pace import FASTEST, FIRST, MOST, SLOWEST, Pace


def steps(pace, count, step, drawing, slower):
    """Steps of a run during which the view draws for a share of the time and makes them so much slower."""
    for _ in range(count):
        pace.drew(drawing * step)
        pace.stepped(step * slower, drawing * step)


@pytest.mark.parametrize("slower", [1.0, 1.05, 1.3])
def test_the_cost_is_that_of_the_steps_that_were_slowed(slower):
    pace = Pace()
    steps(pace, 20, 0.1, 0.0, 1.0)
    steps(pace, 20, 0.1, 0.5, slower)
    assert pace.share == pytest.approx(slower - 1.0, abs=1e-9)


def test_frames_lie_farther_apart_while_they_cost_much_and_come_back():
    pace = Pace()
    steps(pace, 20, 0.1, 0.0, 1.0)
    steps(pace, 100, 0.1, 0.5, 1.0 + 2 * MOST)
    assert pace.interval == SLOWEST > FIRST
    steps(pace, 200, 0.1, 0.5, 1.0)
    assert pace.interval == FASTEST


def test_a_view_that_stands_still_costs_nothing():
    pace = Pace()
    steps(pace, 20, 0.1, 0.0, 1.0)
    steps(pace, 20, 0.1, 0.5, 1.2)
    steps(pace, 10, 0.1, 0.0, 1.0)
    assert pace.share == pytest.approx(0.1)  # half of the last steps were slowed by a fifth
    steps(pace, 10, 0.1, 0.0, 1.0)
    assert pace.share == 0.0


def test_steps_of_another_stage_are_not_compared():
    pace = Pace()
    steps(pace, 20, 0.1, 0.0, 1.0)
    pace.another_stage()
    steps(pace, 20, 0.3, 0.5, 1.0)
    assert pace.share == 0.0


def test_drawing_costs_no_more_than_the_window_works():
    pace = Pace()
    steps(pace, 20, 0.1, 0.0, 1.0)
    for _ in range(20):  # another program slows the run down
        pace.drew(0.05)
        pace.stepped(0.2, 0.01)
    assert pace.share == pytest.approx(0.05)


def test_without_steps_to_compare_with_nothing_is_claimed():
    pace = Pace()
    steps(pace, 100, 0.1, 0.5, 1.3)
    assert pace.share == 0.0 and pace.interval == FIRST
