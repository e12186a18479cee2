"""Run a kernel over a range on several threads. The result never depends on how many."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import count as counter

import numpy as np

from genmojo_core.kernels.buffers import LINE, on_line

HELPERS = "genmojo-kernel"  # their names begin so

_state: dict[str, ThreadPoolExecutor | int | None] = {"pool": None, "threads": 0}
_local = threading.local()


def available_threads() -> int:
    """Processors this process may use, at least 1."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def set_threads(threads: int) -> None:
    """Use that many threads from now on (at least 1); 0 = one per available processor."""
    pool = _state["pool"]
    if isinstance(pool, ThreadPoolExecutor):
        pool.shutdown(wait=True)
    _state["threads"] = max(threads, 0)
    _state["pool"] = None


def get_threads() -> int:
    """Threads in use."""
    return int(_state["threads"] or 0) or available_threads()  # type: ignore[arg-type]


def run_jobs(job: Callable[[int], object], count: int) -> None:
    """Call job(0), ..., job(count - 1) in any order, on the calling thread and on helpers where there is work for them.

    Every thread takes the next number as soon as it is free, so one that wakes late costs nothing but its own share.
    Raises what a job raised, after all threads have stopped.
    """
    helpers = min(helpers_at_hand(), count - 1)
    numbers = counter()

    def work() -> None:
        while (index := next(numbers)) < count:
            job(index)

    asked = [submit(work) for _ in range(helpers)]
    try:
        work()
    finally:
        started = [one for one in asked if not one.cancel()]
        for one in started:
            one.exception()
    for one in started:
        one.result()


def run_whole(job: Callable[[int], object], count: int) -> None:
    """The same for large jobs that use threads themselves: as long as every thread has one, they keep to it.

    The last ones, fewer than the threads, share all threads.
    """
    if count == 1:
        job(0)
        return

    def alone(index: int) -> None:
        before, _local.alone = getattr(_local, "alone", False), True
        try:
            job(index)
        finally:
            _local.alone = before

    whole = count - count % get_threads()
    run_jobs(alone, whole)
    run_jobs(lambda index: job(whole + index), count - whole)


def helpers_at_hand() -> int:
    """Threads that the calling one may ask for help: 0 where there are none, or each has a large job of its own."""
    return 0 if getattr(_local, "alone", False) else get_threads() - 1


def submit(work: Callable[[], None]) -> Future[None]:
    """Have a helper do something as soon as one is free."""
    return _pool().submit(work)


def run_ranges(kernel: Callable[[int, int], object], size: int, chunk: int) -> None:
    """Call kernel(start, stop) over 0..size-1, in pieces of `chunk`, or at once where the calling thread is alone.

    So the result must not depend on the pieces. One call asks for the interpreter's lock once.
    """
    chunk = chunk if helpers_at_hand() else max(size, 1)
    run_jobs(lambda index: kernel(index * chunk, min((index + 1) * chunk, size)), -(-size // chunk))


def scratch(floats: int) -> np.ndarray:
    """(floats,) float32 of any content, the calling thread's own; valid until it asks again."""
    kept = getattr(_local, "floats", None)
    if kept is None or len(kept) < floats:
        _local.floats = kept = on_line(np.empty(4 * floats + LINE, np.uint8), 4 * floats).view(np.float32)
    return kept[:floats]


def _pool() -> ThreadPoolExecutor:
    """The helpers: all threads but the calling one."""
    pool = _state["pool"]
    if not isinstance(pool, ThreadPoolExecutor):
        pool = ThreadPoolExecutor(max(get_threads() - 1, 1), thread_name_prefix=HELPERS)
        _state["pool"] = pool
    return pool
