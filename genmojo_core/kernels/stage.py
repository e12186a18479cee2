"""One stage of a picture as kernels see it: pieces of a range that several threads take one by one.

A kernel that works in a stage reads

    begin(stage)
    first = claim(stage)
    while first < stage.size:
        ... first .. end_of(stage, first) - 1 ...
        first = claim(stage)
    return meet(stage)

and touches nothing shared outside the loop. Who takes which piece must not show in the result. A kernel may go through
several stages like that, as long as `meet` tells it to go on: all threads lose what Python takes between two kernels.

The thread that leads leaves a stage when all its pieces are done; a helper stays until the next one begins. So a helper
wants the interpreter's lock only while the leader does not hold it, and neither ever waits for the other to be woken by
the system, which takes longer than a stage of a small picture. Waiting ends after `PATIENCE` rounds whatever happens.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from llvmlite import ir
from numba.core import types

from genmojo_core.kernels.cache import inlined
from genmojo_core.kernels.scalars import smaller
from genmojo_core.kernels.simd import instruction

TAKEN, LOW, HIGH, INSIDE = 0, 1, 2, 3  # places in `Stage.counts`
ENDED = 2**62  # number of no stage
WORDS = 8  # int64 in a cache line
PATIENCE = 160_000  # rounds of waiting, some 1.2 ns each: 0.2 ms
_FACTOR = 6364136223846793005


class Stage(NamedTuple):
    """A range shared out among threads."""

    newest: np.ndarray  # (WORDS,) int64: number of the stage that the leader is in, first; shared by a team's stages
    counts: np.ndarray  # (WORDS,) int64, zero at first: pieces taken, from the lower and the upper end; threads inside
    number: int
    size: int
    chunk: int  # of a piece; the last may be smaller
    leads: int  # 1 for the thread that waits for the others, 0 for a helper


def alone(size: int, chunk: int = 0) -> Stage:
    """A stage for the calling thread by itself, in pieces of `chunk`, or in one."""
    return Stage(np.zeros(WORDS, np.int64), np.zeros(WORDS, np.int64), 0, size, chunk or max(size, 1), 1)


def _place(context: Any, builder: ir.IRBuilder, kind: Any, array: ir.Value, index: ir.Value) -> ir.Value:
    """Address of an element of a flat int64 array."""
    return builder.gep(context.make_array(kind)(context, builder, array).data, [index])


@instruction
def fetch_add(typingctx: Any, array: types.Type, index: types.Type, value: types.Type) -> Any:
    """Add to an element of a flat int64 array, as if no other thread were there; what it was before."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        place = _place(context, builder, signature.args[0], *arguments[:2])
        return builder.atomic_rmw("add", place, arguments[2], "seq_cst")

    return types.int64(array, types.intp, types.int64), codegen


@instruction
def look(typingctx: Any, array: types.Type, index: types.Type) -> Any:
    """An element of a flat int64 array as the other threads have left it by now."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        return builder.load_atomic(_place(context, builder, signature.args[0], *arguments), "seq_cst", 8)

    return types.int64(array, types.intp), codegen


@instruction
def tell(typingctx: Any, array: types.Type, index: types.Type, value: types.Type) -> Any:
    """Write an element of a flat int64 array for the other threads to see, after all that was written before."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        place = _place(context, builder, signature.args[0], *arguments[:2])
        builder.store_atomic(arguments[2], place, "seq_cst", 8)
        return context.get_dummy_value()

    return types.void(array, types.intp, types.int64), codegen


@inlined
def begin(stage: Stage) -> None:
    """Enter; the leader calls the helpers that wait for this stage."""
    fetch_add(stage.counts, INSIDE, 1)
    if stage.leads == 1:
        tell(stage.newest, 0, stage.number)


@inlined
def claim(stage: Stage) -> int:
    """The first number of a piece that nobody else gets; `size` where none is left.

    The leader takes them from the lower end, helpers from the upper one. So what a thread needs is mostly what it wrote
    in the stage or picture before, and lies in its own cache.
    """
    pieces = (stage.size + stage.chunk - 1) // stage.chunk
    if fetch_add(stage.counts, TAKEN, 1) >= pieces:
        return stage.size
    if stage.leads == 1:
        return fetch_add(stage.counts, LOW, 1) * stage.chunk
    return (pieces - 1 - fetch_add(stage.counts, HIGH, 1)) * stage.chunk


@inlined
def end_of(stage: Stage, first: int) -> int:
    """Where the piece from `first` on ends."""
    return smaller(first + stage.chunk, stage.size)


@inlined
def meet(stage: Stage) -> int:
    """Leave: the leader when all others have, a helper when a later stage has begun, both when patience ends.

    1 where the next stage may follow at once, 0 where patience or the team's work has ended. Between two looks a
    multiplication that waits for the last one passes the time.
    """
    fetch_add(stage.counts, INSIDE, -1)
    rounds, number = PATIENCE, stage.number
    while rounds > 0:
        if stage.leads == 1 and look(stage.counts, INSIDE) == 0:
            return 1
        if stage.leads == 0 and look(stage.newest, 0) > stage.number:
            return 1 if look(stage.newest, 0) < ENDED else 0
        number = number * _FACTOR + 1
        rounds -= 1 + (number == 0)
    return 0
