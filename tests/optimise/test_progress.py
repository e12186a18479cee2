"""What a run says about the time it still needs."""

import torch

from genmojo_core.optimise.objective import Outcome
from genmojo_core.optimise.progress import Clock, Progress
from genmojo_core.optimise.schedule import Stage
from tests.optimise.small_runs import small_config

OUTCOME = Outcome(torch.tensor(1.0), {}, [], [], [])


class SetClock(Clock):
    """A clock that the test moves."""

    seconds = 0.0

    def now(self) -> tuple[float, float]:
        return self.seconds, self.seconds

    def this_run(self) -> float:
        return self.seconds


def left_after(progress: Progress, clock: SetClock, steps: int, each: float) -> float:
    for _ in range(steps):
        clock.seconds += each
        progress.advance(OUTCOME)
        left = progress.event(clock, 10).eta_seconds
    return left


def test_time_left_is_told_by_the_pace_of_the_steps_and_not_by_what_went_before_them() -> None:
    stages = [Stage("lift", 10, False), Stage("joint", 100, True)]
    progress, clock = Progress(small_config(), stages, 4), SetClock()
    clock.seconds = 60.0  # reading motion, say
    progress.begin(stages[0])
    assert abs(left_after(progress, clock, 5, 0.1) - 105 * 0.1) < 1e-6
    progress.begin(stages[1])
    assert abs(left_after(progress, clock, 20, 0.5) - 85 * 0.5) < 1e-6


def test_time_left_is_never_more_than_the_budget_leaves() -> None:
    stages = [Stage("lift", 1000, False)]
    progress, clock = Progress(small_config(budget_seconds=30.0), stages, 4), SetClock()
    progress.begin(stages[0])
    assert abs(left_after(progress, clock, 10, 1.0) - 20.0) < 1e-6
    assert left_after(progress, clock, 30, 1.0) == 0.0
