"""Teams of threads: every piece once, helpers that go to sleep and come back, faults that leave nobody waiting."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator

import numpy as np
import pytest

from genmojo_core.kernels import threads
from genmojo_core.kernels.cache import inlined, kernel
from genmojo_core.kernels.stage import Stage, begin, claim, end_of, meet
from genmojo_core.kernels.team import Team

LONG = 120  # seconds


@inlined
def _count(stage: Stage, done: np.ndarray, before: np.ndarray, late: np.ndarray) -> int:
    """Add 1 to the stage's numbers; note where the stage before had not done its own yet."""
    begin(stage)
    first = claim(stage)
    while first < stage.size:
        for i in range(first, end_of(stage, first)):
            done[i] += 1
            for k in range(before.size):
                late[i] += before[k] != 1
        first = claim(stage)
    return meet(stage)


@kernel
def _count_up(stage: Stage, done: np.ndarray, before: np.ndarray, late: np.ndarray) -> None:
    _count(stage, done, before, late)


@kernel
def _count_up_thrice(stages: tuple[Stage, Stage, Stage], passed: int, done: tuple, late: tuple) -> int:
    """Three stages in one call; done: four arrays, the first of which nobody counts up."""
    if passed < 1 and _count(stages[0], done[1], done[0], late[0]) == 0:
        return 1
    if passed < 2 and _count(stages[1], done[2], done[1], late[1]) == 0:
        return 2
    _count(stages[2], done[3], done[2], late[2])
    return 3


def _marks(*arrays: np.ndarray) -> Callable[[Stage], object]:
    return lambda stage: _count_up(stage, *arrays)


@pytest.fixture(autouse=True)
def _usual_threads() -> Iterator[None]:
    yield
    threads.set_threads(0)


def _until(reached: Callable[[], bool]) -> None:
    """Wait for something that must happen."""
    end = time.monotonic() + LONG
    while not reached():
        assert time.monotonic() < end
        time.sleep(0.001)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_every_piece_is_done_once_and_before_the_next_stage(count: int) -> None:
    """Sizes that no chunk divides, none at all, and far more stages than a picture has."""
    threads.set_threads(count)
    nothing = np.ones(0, np.int64)
    for _ in range(20):
        before = nothing
        with Team() as team:
            for size, chunk in ((1, 1), (0, 4), (257, 3), (2, 1), (1000, 64), (7, 100), (129, 1)):
                done, late = np.zeros(size, np.int64), np.zeros(size, np.int64)
                team.run(_marks(done, before, late), size, chunk)
                assert (done == 1).all() and not late.any()
                before = done


@pytest.mark.parametrize("count", [1, 2, 3])
@pytest.mark.parametrize("work", [1, 1_000_000])
def test_stages_of_one_kernel_follow_each_other(count: int, work: int) -> None:
    """Also where a piece takes so long that those who wait for it run out of patience and come back later."""
    threads.set_threads(count)
    asked: list[int] = []
    for _ in range(20 if work == 1 else 3):
        sizes = (2 * count + 1, 5, 257)
        done = (np.ones(work, np.int64), *(np.zeros(size, np.int64) for size in sizes))
        late = tuple(np.zeros(size, np.int64) for size in sizes)

        def kernel(stages: tuple[Stage, ...], passed: int, done: tuple = done, late: tuple = late) -> int:
            asked.append(passed)
            return _count_up_thrice(stages, passed, done, late)

        with Team() as team:
            team.run_all(kernel, [(sizes[0], 1), (sizes[1], 1), (sizes[2], 3)])
        assert all((one == 1).all() for one in done) and not any(one.any() for one in late)
    assert count > 1 or not any(asked)  # who is alone never has to come back


def test_helpers_go_to_sleep_when_nothing_follows_and_come_back() -> None:
    threads.set_threads(2)
    met = threading.Barrier(2)

    def together(stage: Stage) -> None:
        met.wait(LONG)  # breaks where one thread is alone
        _count_up(stage, *(np.zeros(4, np.int64),) * 3)

    with Team() as team:
        for _ in range(3):
            team.run(together, 4)
            _until(lambda: all(one.done() for one in team._asked))  # nobody tells it to go: its patience ends
            met.reset()


def test_who_has_a_job_of_its_own_or_no_helpers_asks_nobody() -> None:
    asked: list[int] = []

    def job(_: int) -> None:
        with Team() as team:
            team.run(_marks(*(np.zeros(9, np.int64),) * 3), 9)
            asked.append(len(team._asked))

    threads.set_threads(2)
    threads.run_whole(job, 2)
    threads.set_threads(1)
    job(0)
    assert asked == [0, 0, 0]


def test_a_fault_between_stages_frees_the_helpers() -> None:
    threads.set_threads(2)
    with pytest.raises(ValueError, match="between"), Team() as team:
        team.run(_marks(*(np.zeros(50, np.int64),) * 3), 50)
        raise ValueError("between")
    met = threading.Barrier(2)
    threads.run_jobs(lambda _: met.wait(LONG), 2)


def test_a_fault_of_a_helper_reaches_the_caller_and_costs_no_piece() -> None:
    threads.set_threads(2)
    main, done = threading.current_thread(), np.zeros(50, np.int64)

    def fails(stage: Stage) -> None:
        if threading.current_thread() is not main:
            raise MemoryError("no scratch")
        _until(lambda: all(one.done() for one in team._asked))
        _count_up(stage, done, done[:0], np.zeros(50, np.int64))

    with pytest.raises(MemoryError, match="no scratch"), Team() as team:
        team.run(fails, 50)
    assert (done == 1).all()
