"""Threads that go through the stages of one picture together."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from types import TracebackType

import numpy as np

from genmojo_core.kernels.stage import ENDED, INSIDE, WORDS, Stage
from genmojo_core.kernels.threads import helpers_at_hand, submit

NAP = 1e-4  # seconds


class Team:
    """The calling thread and as many helpers as it may have, from stage to stage of one picture.

        with Team() as team:
            team.run(lambda stage: some_kernel(stage, ...), size, chunk)

    Helpers are woken at once, so that they are there when the first stage begins, and stay at hand between the stages
    for a fraction of a millisecond each; by the end of the block they are on their way back to sleep. A thread that has
    no helpers wakes and waits for nobody.
    """

    def __init__(self) -> None:
        self.threads = 1 + helpers_at_hand()
        self._newest = np.zeros(WORDS, np.int64)
        self._last = 0  # number of the newest stage that is shared
        self._posted: tuple[Callable[[tuple[Stage, ...], int], int], tuple[Stage, ...]] | None = None
        self._asked: list[Future[None]] = []

    def __enter__(self) -> Team:
        self._ask()
        return self

    def __exit__(self, kind: type | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._newest[0] = ENDED
        asked, self._asked = self._asked, []
        for one in asked:
            if not one.cancel() and error is None and one.done():
                one.result()

    def run(self, kernel: Callable[[Stage], object], size: int, chunk: int = 1) -> None:
        """Call kernel(stage) on every thread at hand, and return when all pieces of 0..size-1 are done.

        The kernel takes its pieces by the rules of kernels/stage.py. Pieces are the same for any number of threads.
        """

        def only(stages: tuple[Stage, ...], done: int) -> int:
            kernel(stages[0])
            return 1

        self.run_all(only, [(size, chunk)])

    def run_all(self, kernel: Callable[[tuple[Stage, ...], int], int], ranges: Sequence[tuple[int, int]]) -> None:
        """Call kernel(stages, 0) on every thread at hand, a stage for each (size, chunk), and return when all is done.

        The kernel goes through the stages one after the other and returns how many are behind it: all, or fewer where
        `meet` told it to stop. Then it is called again, with that number, when the next stage may begin.
        """
        shared = self.threads > 1 and any(size > chunk for size, chunk in ranges)
        stages = []
        for size, chunk in ranges:
            self._last += shared
            stages.append(Stage(self._newest, np.zeros(WORDS, np.int64), self._last, size, chunk, 1))
        if shared:
            self._posted = kernel, tuple(one._replace(leads=0) for one in stages)
            self._ask()
        done = 0
        while done < len(stages):
            done = kernel(tuple(stages), done)
            while stages[done - 1].counts[INSIDE] != 0:  # somebody was stopped in the middle of a piece
                time.sleep(NAP)

    def _ask(self) -> None:
        """Wake helpers in place of those that have none yet or ran out of patience."""
        self._asked = [one for one in self._asked if not one.done()]
        self._asked += [submit(self._attend) for _ in range(self.threads - 1 - len(self._asked))]

    def _attend(self) -> None:
        """A helper's part: every stage it comes in time for, until no kernel has followed while it waited."""
        last = 0
        while self._posted is not None and self._posted[1][-1].number > last and self._newest[0] != ENDED:
            kernel, stages = self._posted
            done, last = kernel(stages, 0), stages[-1].number
            while done < len(stages) and (newest := int(self._newest[0])) != ENDED:
                if newest > stages[done - 1].number:
                    done = kernel(stages, done)
                else:
                    time.sleep(NAP)  # the leader takes long over a piece
