"""The smaller and the larger of two numbers: Python's `min` and `max` are functions of numba's own, compiled anew."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core import types

from genmojo_core.kernels.simd import instruction


@instruction
def smaller(typingctx: Any, a: types.Type, b: types.Type) -> Any:
    """The smaller of two numbers as int64 or float64 (b where either is NaN); Python's `min` compiles longer."""
    return _choice("<", a, b)


@instruction
def larger(typingctx: Any, a: types.Type, b: types.Type) -> Any:
    """The larger of two numbers as int64 or float64 (b where either is NaN)."""
    return _choice(">", a, b)


def _choice(symbol: str, a: types.Type, b: types.Type) -> Any:
    """Signature and code of `a if a symbol b else b` on two scalars, int64 or float64."""
    kind = types.int64 if isinstance(a, types.Integer) and isinstance(b, types.Integer) else types.float64

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        a, b = arguments
        compare = builder.icmp_signed if kind is types.int64 else builder.fcmp_ordered
        return builder.select(compare(symbol, a, b), a, b)

    return kind(kind, kind), codegen
