"""The small kernel that `probe` compiles and runs."""

from __future__ import annotations

import numpy as np
from numba.core.errors import NumbaError

from genmojo_core.kernels.cache import kernel
from genmojo_core.kernels.lane_bits import bits, trailing_zeros
from genmojo_core.kernels.simd import (
    EXP2_FLOATS,
    exp2_8,
    exp2_table,
    fma,
    load8,
    prepare_exp2,
    select8,
    store8,
    sum_rows,
)  # fmt: skip


@kernel
def _trial(values: np.ndarray, out: np.ndarray, table: np.ndarray) -> int:
    """Sums of eight powers of two, and the lowest lane above zero."""
    prepare_exp2(table)
    x = load8(values, 0)
    positive = x > np.float32(0)
    for row in range(8):
        store8(out, 8 * row, select8(positive, exp2_8(x, exp2_table(table)), fma(x, np.float32(0), np.float32(1))))
    store8(out, 0, sum_rows(out, 0))
    return trailing_zeros(bits(positive))


def run() -> str:
    """An empty string where the kernel compiles and computes right, else what is wrong."""
    values, out = np.arange(-4, 4, dtype=np.float32) + np.float32(0.25), np.zeros(64, np.float32)
    try:
        lane = _trial(values, out, np.empty(EXP2_FLOATS, np.float32))
    except NumbaError as error:
        return f"{type(error).__name__}: {error}".splitlines()[0]
    right = lane == 4 and np.allclose(out[:8], 4 + 15 * 2**0.25, rtol=1e-5)
    return "" if right else f"wrong result {lane}, {out[0]:.6g}"
