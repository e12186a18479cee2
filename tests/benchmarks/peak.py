"""The processor's peak of fused multiply-adds, measured with the rasteriser's own vectors."""

from __future__ import annotations

import time

import numba
import numpy as np

from genmojo_core.kernels.simd import fma, load8, splat8, store8
from genmojo_core.kernels.threads import run_jobs


@numba.njit(nogil=True)
def _chains(rounds: int, seeds: np.ndarray, out: np.ndarray) -> None:
    """Twelve independent chains of fused multiply-adds."""
    a, b = load8(seeds, 0), load8(seeds, 8)
    c0, c1, c2, c3, c4, c5 = a, a, a, a, a, a
    c6, c7, c8, c9, c10, c11 = b, b, b, b, b, b
    for _ in range(rounds):
        c0, c1, c2, c3 = fma(c0, a, b), fma(c1, a, b), fma(c2, a, b), fma(c3, a, b)
        c4, c5, c6, c7 = fma(c4, a, b), fma(c5, a, b), fma(c6, a, b), fma(c7, a, b)
        c8, c9, c10, c11 = fma(c8, a, b), fma(c9, a, b), fma(c10, a, b), fma(c11, a, b)
    total = splat8(np.float32(0))
    for c in (c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11):
        total = total + c
    store8(out, 0, total)


def peak_flops(seconds: float = 0.5) -> float:
    """Floating-point operations per second of one core in float32; the best of several short runs."""
    seeds, out = np.full(16, 0.5, np.float32), np.empty(8, np.float32)
    rounds = 200_000
    _chains(rounds, seeds, out)
    best, end = 0.0, time.monotonic() + seconds
    while time.monotonic() < end:
        start = time.process_time()
        _chains(rounds, seeds, out)
        best = max(best, rounds * 12 * 8 * 2 / max(time.process_time() - start, 1e-9))
    return best


def multiply_seconds(jobs: int) -> float:
    """Wall seconds for `jobs` equal loops of fused multiply-adds on the kernels' threads: nothing shared, no memory."""
    seeds, outs = np.full(16, 0.5, np.float32), np.empty((jobs, 8), np.float32)
    start = time.perf_counter()
    run_jobs(lambda index: _chains(3_000_000, seeds, outs[index]), jobs)
    return time.perf_counter() - start
