"""One seeding at a time, which can be cancelled until its result is there, and what is said of the result."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from genmojo_core.clip.clip import Clip
from genmojo_core.trackers.solver import SolveRequest
from genmojo_core.tracks.annotation import Annotation
from genmojo_core.tracks.keys import name_of
from genmojo_studio.background import Tasks
from genmojo_studio.translate import told, tr

_NAMED = 4  # tracks named in a sentence at most


class SeedTask:
    """The seeding that runs. Args: tasks: does it; gave_up: called on the UI thread once a cancelled one has ended."""

    def __init__(self, tasks: Tasks, gave_up: Callable[[], None]) -> None:
        self._tasks, self._gave_up = tasks, gave_up
        self._cancelled = threading.Event()

    def cancel(self) -> None:
        """End what runs; it changes nothing."""
        self._cancelled.set()

    def run(
        self, work: Callable[[Callable[[], bool]], Any], done: Callable[[Any], None],
        failed: Callable[[BaseException], None],
    ) -> None:  # fmt: skip
        """Do `work(cancelled)` on the thread, then `done(result)` or `failed(error)`; one that still runs is cancelled.

        Once it was cancelled neither is called, however far it was.
        """
        self._cancelled.set()
        cancelled = self._cancelled = threading.Event()

        def ended(then: Callable[[], None]) -> None:
            if cancelled.is_set():
                self._gave_up()
            else:
                then()

        self._tasks.run(lambda: work(cancelled.is_set), lambda found: ended(lambda: done(found)),
                        lambda error: ended(lambda: failed(error)))  # fmt: skip


def seeded_words(annotation: Annotation, count: int, lost: list[int]) -> str:
    """How many tracks were filled, and for which nothing was found; "" where there were none at all."""
    if not lost:
        return tr("{n} tracks are seeded.").format(n=count) if count else ""
    names = ", ".join(told(name_of(annotation, track)) for track in lost[:_NAMED])
    names += ", …" if len(lost) > _NAMED else ""
    if not count:
        return tr("Nothing was found for {names}.").format(names=names)
    words = tr("{n} of {m} tracks are seeded. Nothing was found for {names}.")
    return words.format(n=count, m=count + len(lost), names=names)


def seedable(annotation: Annotation, objects: list[int], clip: Clip) -> tuple[list[SolveRequest], str]:
    """What is to be solved for the objects that have points and a mask, and a sentence that names those without one."""
    placed = [r for r in (SolveRequest.of(annotation, o) for o in objects) if r.tracks]
    masked = clip.object_ids.tolist()
    left = ", ".join(annotation.objects[r.object_id].name for r in placed if r.object_id not in masked)
    words = tr("Without a mask, so left out: {names}.").format(names=left) if left else ""
    return [r for r in placed if r.object_id in masked], words
