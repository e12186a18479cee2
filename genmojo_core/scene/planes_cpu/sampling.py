"""Whole K-plane reads on numpy arrays, spread over threads."""

from __future__ import annotations

import numpy as np

from genmojo_core.kernels.buffers import take, zeros
from genmojo_core.kernels.threads import run_jobs, run_ranges
from genmojo_core.scene.planes_cpu.planes import (
    LANES,
    lines_of,
    sample_lines,
    sample_space,
    slope_lines,
    slope_sampled,
    slope_space,
)  # fmt: skip

POINTS_PER_JOB = 2048


def space_features(planes: np.ndarray, coords: np.ndarray) -> np.ndarray:
    """(3, R, R, C) float32 planes at (N, 3) float32 coordinates: (N, C) products; C a multiple of 8."""
    shape = (planes.shape[1], planes.shape[3])
    out = take((len(coords), shape[1]))
    flat, target = planes.reshape(-1), out.reshape(-1)
    run_ranges(lambda a, b: sample_space(a, b, flat, coords, shape, target), len(coords), POINTS_PER_JOB)
    return out


def space_gradient(planes: np.ndarray, coords: np.ndarray, upstream: np.ndarray) -> np.ndarray:
    """Gradient (3, R, R, C) of sum(upstream * space_features(planes, coords))."""
    shape = (planes.shape[1], planes.shape[3])
    out = zeros(planes.shape)
    flat, above, target = planes.reshape(-1), upstream.reshape(-1), out.reshape(-1)
    run_jobs(lambda job: slope_space(job * LANES, flat, coords, shape, above, target), shape[1] // LANES)
    return out


def time_features(planes: np.ndarray, coords: np.ndarray, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(3, R, T, C) float32 planes at (N, 3) coordinates and (B,) times: (B, N, C) products, and lines (B, 3, R, C)."""
    _, nodes, _, channels = planes.shape
    shape = planes.shape[1:]
    lines = take((len(times), 3, nodes, channels))
    out = take((len(times), len(coords), channels))
    flat = planes.reshape(-1)

    def job(b: int) -> None:
        lines_of(flat, float(times[b]), shape, lines[b].reshape(-1))
        sample_lines(lines[b].reshape(-1), coords, shape, out[b].reshape(-1))

    run_jobs(job, len(times))
    return out, lines


def time_gradient(
    planes_shape: tuple[int, ...], lines: np.ndarray, coords: np.ndarray, times: np.ndarray, upstream: np.ndarray
) -> np.ndarray:
    """Gradient (3, R, T, C) of sum(upstream * time_features(...)); `lines` as returned there."""
    shape = planes_shape[1:]
    groups = shape[2] // LANES
    line_gradients = zeros(lines.shape)

    def job(index: int) -> None:
        b, group = divmod(index, groups)
        slope_sampled(
            group * LANES, lines[b].reshape(-1), coords, shape, upstream[b].reshape(-1), line_gradients[b].reshape(-1)
        )

    run_jobs(job, len(times) * groups)
    out = zeros(planes_shape)
    for b, time in enumerate(times):
        slope_lines(float(time), shape, line_gradients[b].reshape(-1), out.reshape(-1))
    return out
