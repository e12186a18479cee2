"""Eight float32 lanes as a numba type, so that kernels stay plain Python and still compile to vector instructions.

`Float8` is the LLVM type <8 x float>, `Mask8` is <8 x i1>. LLVM lowers both to AVX, to two NEON registers on ARM or to
SSE by itself: nothing here names a processor. Arithmetic between `Float8` and scalars broadcasts the scalar. There is
no fast-math flag anywhere; `fma` is `llvm.fmuladd`, fused where the processor does that well (RASTER.md sections 5, 6).

Loads and stores take a flat float32 array and an element index; nothing is bounds-checked and no alignment is needed.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.core.cgutils import get_or_insert_function
from numba.core.datamodel import models
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, register_model

from genmojo_core.kernels.cache import inlined

LANES = 8
_NUMBERS = (types.Integer, types.Float)
F32 = ir.FloatType()
I32 = ir.IntType(32)
F8 = ir.VectorType(F32, LANES)
I8 = ir.VectorType(I32, LANES)
_M8 = ir.VectorType(ir.IntType(1), LANES)


def instruction(function: Callable) -> Any:
    """Make `function(typing context, argument types)` -> (signature, code generator) callable from kernels."""
    return intrinsic(function)


class Float8Type(types.Type):
    """Numba type of eight float32 lanes."""

    def __init__(self) -> None:
        super().__init__(name="Float8")


class Mask8Type(types.Type):
    """Numba type of eight truth values, one per lane."""

    def __init__(self) -> None:
        super().__init__(name="Mask8")


Float8 = Float8Type()
Mask8 = Mask8Type()


@register_model(Float8Type)
class _Float8Model(models.PrimitiveModel):
    """Held as <8 x float>."""

    def __init__(self, dmm: Any, fe_type: Any) -> None:
        super().__init__(dmm, fe_type, F8)


@register_model(Mask8Type)
class _Mask8Model(models.PrimitiveModel):
    """Held as <8 x i1>."""

    def __init__(self, dmm: Any, fe_type: Any) -> None:
        super().__init__(dmm, fe_type, _M8)


def _broadcast(builder: ir.IRBuilder, scalar: ir.Value) -> ir.Value:
    """One float32 in all lanes."""
    single = builder.insert_element(ir.Constant(F8, ir.Undefined), scalar, ir.Constant(I32, 0))
    return builder.shuffle_vector(single, ir.Constant(F8, ir.Undefined), ir.Constant(I8, [0] * LANES))


def _as_vector(context: Any, builder: ir.IRBuilder, kind: types.Type, value: ir.Value) -> ir.Value:
    """A Float8 as it is; any number cast to float32 and broadcast."""
    if isinstance(kind, Float8Type):
        return value
    return _broadcast(builder, context.cast(builder, value, kind, types.float32))


def pointer(
    context: Any, builder: ir.IRBuilder, kind: Any, array: ir.Value, index: ir.Value, lanes: int = LANES
) -> ir.Value:
    """Address of element `index` of a flat float32 array, as a pointer to that many lanes."""
    data = context.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [index]), ir.VectorType(F32, lanes).as_pointer())


def call(builder: ir.IRBuilder, name: str, arguments: list[ir.Value]) -> ir.Value:
    """Call a generic LLVM intrinsic on <8 x float>."""
    signature = ir.FunctionType(F8, [F8] * len(arguments))
    return builder.call(get_or_insert_function(builder.module, signature, f"llvm.{name}.v{LANES}f32"), arguments)


def _is_vector_operation(a: types.Type, b: types.Type) -> bool:
    """At least one Float8, the other a Float8 or a number."""
    kinds = [isinstance(t, Float8Type) for t in (a, b)]
    return any(kinds) and all(k or isinstance(t, types.Number) for k, t in zip(kinds, (a, b), strict=True))


def _are_masks(a: types.Type, b: types.Type) -> bool:
    """Two Mask8."""
    return isinstance(a, Mask8Type) and isinstance(b, Mask8Type)


def _vectors(context: Any, builder: ir.IRBuilder, kinds: Any, values: Any) -> list[ir.Value]:
    """Operands as vectors of eight lanes: numbers are cast to float32 and broadcast."""
    return [v if isinstance(t, Mask8Type) else _as_vector(context, builder, t, v)
            for t, v in zip(kinds, values, strict=True)]  # fmt: skip


def _register(operation: Callable, fits: Callable, result: types.Type, build: Callable) -> None:
    """Give a Python operator a meaning on vectors where `fits(type, type)`: build(builder, a, b)."""

    class Operator(AbstractTemplate):
        """The type of the result; being made for this target it is asked before numba's own dozens of rules."""

        key = operation

        known: ClassVar[dict] = {}

        def generic(self, arguments: tuple, keywords: dict) -> Any:
            """The signature; on two numbers numba's own answer, asked for once; None on anything else."""
            if fits(*arguments):
                return signature(result, *arguments)
            if arguments in self.known or not all(isinstance(t, _NUMBERS) for t in arguments):
                return self.known.get(arguments)
            self.known[arguments] = None  # numba asks here again, and then its own rules
            self.known[arguments] = self.context.resolve_function_type(operation, arguments, {})
            return self.known[arguments]

    Operator.metadata = {"target": "cpu"}

    def lower(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        return build(builder, *_vectors(context, builder, signature.args, arguments))

    infer_global(operation)(Operator)
    pairs = [(Mask8Type, Mask8Type)] if fits is _are_masks else [
        (Float8Type, Float8Type), (Float8Type, types.Number), (types.Number, Float8Type)]  # fmt: skip
    for pair in pairs:
        lower_builtin(operation, *pair)(lower)


_ARITHMETIC = {operator.add: "fadd", operator.sub: "fsub", operator.mul: "fmul", operator.truediv: "fdiv"}
_ORDER = {operator.ge: ">=", operator.gt: ">", operator.le: "<=", operator.lt: "<", operator.eq: "=="}
for _operation, _name in _ARITHMETIC.items():
    _register(_operation, _is_vector_operation, Float8, lambda builder, a, b, name=_name: getattr(builder, name)(a, b))
for _operation, _name in _ORDER.items():
    _register(_operation, _is_vector_operation, Mask8,
              lambda builder, a, b, name=_name: builder.fcmp_ordered(name, a, b))  # fmt: skip
_register(operator.and_, _are_masks, Mask8, lambda builder, a, b: builder.and_(a, b))


@instruction
def splat8(typingctx: Any, value: types.Type) -> Any:
    """The same number in all lanes."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        return _as_vector(context, builder, signature.args[0], arguments[0])

    return Float8(value), codegen


@instruction
def broadcast8(typingctx: Any, array: types.Type, index: types.Type) -> Any:
    """One element of a flat float32 array in all lanes; the index is not negative."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        data = context.make_array(signature.args[0])(context, builder, arguments[0]).data
        return _broadcast(builder, builder.load(builder.gep(data, [arguments[1]])))

    return Float8(array, types.intp), codegen


@instruction
def load8(typingctx: Any, array: types.Type, index: types.Type) -> Any:
    """Eight consecutive elements of a flat float32 array from `index` on."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        return builder.load(pointer(context, builder, signature.args[0], arguments[0], arguments[1]), align=4)

    return Float8(array, types.intp), codegen


@instruction
def store8(typingctx: Any, array: types.Type, index: types.Type, value: types.Type) -> Any:
    """Write eight consecutive elements of a flat float32 array."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        array, index, value = arguments
        builder.store(value, pointer(context, builder, signature.args[0], array, index, LANES), align=4)
        return context.get_dummy_value()

    return types.void(array, types.intp, Float8), codegen


@instruction
def store_rows(typingctx: Any, array: types.Type, index: types.Type, vectors: types.Type) -> Any:
    """Write the vectors of a tuple one after the other, the first at element `index`."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        array, index, vectors = arguments
        for row in range(len(signature.args[2])):
            at = builder.add(index, ir.Constant(index.type, LANES * row))
            place = pointer(context, builder, signature.args[0], array, at)
            builder.store(builder.extract_value(vectors, row), place, align=4)
        return context.get_dummy_value()

    return types.void(array, types.intp, vectors), codegen


@instruction
def load4x2(typingctx: Any, array: types.Type, upper: types.Type, lower: types.Type) -> Any:
    """A block of 4 x 2 pixels: four elements from `upper` on, then four from `lower` on."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        halves = [
            builder.load(pointer(context, builder, signature.args[0], arguments[0], index, 4), align=4)
            for index in arguments[1:]
        ]
        return builder.shuffle_vector(*halves, ir.Constant(I8, list(range(LANES))))

    return Float8(array, types.intp, types.intp), codegen


@instruction
def store4x2(typingctx: Any, array: types.Type, upper: types.Type, lower: types.Type, value: types.Type) -> Any:
    """Write a block of 4 x 2 pixels: lanes 0..3 from `upper` on, lanes 4..7 from `lower` on."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        value = arguments[3]
        for half, index in enumerate(arguments[1:3]):
            lanes = ir.Constant(ir.VectorType(I32, 4), [4 * half + i for i in range(4)])
            part = builder.shuffle_vector(value, ir.Constant(F8, ir.Undefined), lanes)
            builder.store(part, pointer(context, builder, signature.args[0], arguments[0], index, 4), align=4)
        return context.get_dummy_value()

    return types.void(array, types.intp, types.intp, Float8), codegen


@instruction
def fma(typingctx: Any, a: types.Type, b: types.Type, c: types.Type) -> Any:
    """a b + c, with one rounding where the processor has a fused instruction."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        vectors = [_as_vector(context, builder, t, v) for t, v in zip(signature.args, arguments, strict=True)]
        return call(builder, "fmuladd", vectors)

    return Float8(a, b, c), codegen


@instruction
def min8(typingctx: Any, a: types.Type, b: types.Type) -> Any:
    """The smaller value per lane (b where a is NaN)."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        a, b = (_as_vector(context, builder, t, v) for t, v in zip(signature.args, arguments, strict=True))
        return builder.select(builder.fcmp_ordered("<", a, b), a, b)

    return Float8(a, b), codegen


@instruction
def max8(typingctx: Any, a: types.Type, b: types.Type) -> Any:
    """The larger value per lane (b where a is NaN)."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        a, b = (_as_vector(context, builder, t, v) for t, v in zip(signature.args, arguments, strict=True))
        return builder.select(builder.fcmp_ordered(">", a, b), a, b)

    return Float8(a, b), codegen


@instruction
def sqrt8(typingctx: Any, value: types.Type) -> Any:
    """Square root per lane."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        return call(builder, "sqrt", list(arguments))

    return Float8(Float8), codegen


@instruction
def select8(typingctx: Any, mask: types.Type, a: types.Type, b: types.Type) -> Any:
    """a where the mask holds, else b."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        kinds = signature.args[1:]
        a, b = (_as_vector(context, builder, t, v) for t, v in zip(kinds, arguments[1:], strict=True))
        return builder.select(arguments[0], a, b)

    return Float8(Mask8, a, b), codegen


# 1.5 * 2**23, then minimax coefficients of 2**r on [-1/2, 1/2], highest power first, the constant fixed: error 9e-8.
_EXP2 = np.array(
    [12582912.0, 1.326472606e-3, 9.671513044e-3, 5.55073375e-2, 0.2402224208, 0.6931469776, 1.0], np.float32
)  # fmt: skip
EXP2_FLOATS = 8 * len(_EXP2)  # size of the table that exp2_table reads


@inlined
def prepare_exp2(table: np.ndarray) -> None:
    """Write the constants of 2**x to the first EXP2_FLOATS elements of a flat float32 array.

    From memory they stay in registers or enter the arithmetic as operands; as literals LLVM would fetch the address of
    each one anew.
    """
    for i in range(EXP2_FLOATS):
        table[i] = _EXP2[i >> 3]


@inlined
def exp2_table(table: np.ndarray) -> tuple:
    """The constants that exp2_8 wants, from an array filled by `prepare_exp2`."""
    return (
        load8(table, 0), load8(table, 8), load8(table, 16), load8(table, 24),
        load8(table, 32), load8(table, 40), load8(table, 48),
    )  # fmt: skip


@instruction
def exp2_8(typingctx: Any, value: types.Type, table: types.Type) -> Any:
    """2**x per lane for -125 <= x <= 125, relative error 2e-7; `table` from `exp2_table`.

    Adding 1.5 * 2**23 rounds x to the integer n; a polynomial gives 2**(x - n) and n is added to the exponent bits.
    """

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        x, table = arguments
        constants = [builder.extract_value(table, row) for row in range(len(_EXP2))]
        shifted = builder.fadd(x, constants[0])
        rest = builder.fsub(x, builder.fsub(shifted, constants[0]))
        power = constants[1]
        for constant in constants[2:]:
            power = call(builder, "fmuladd", [power, rest, constant])
        exponent = builder.shl(builder.bitcast(shifted, I8), ir.Constant(I8, [23] * LANES))
        return builder.bitcast(builder.add(builder.bitcast(power, I8), exponent), F8)

    return Float8(Float8, table), codegen


@instruction
def sum_rows(typingctx: Any, array: types.Type, index: types.Type) -> Any:
    """Sums over lanes of eight vectors stored one after the other: lane i of the result is the sum of vector i."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        array, index = arguments
        rows = []
        for i in range(LANES):
            at = builder.add(index, ir.Constant(index.type, LANES * i))
            rows.append(builder.load(pointer(context, builder, signature.args[0], array, at, LANES), align=4))
        # Each round pairs vectors: 8 rows -> 4 -> 2 -> 1. Twice the even and odd lanes of each half are added, which no
        # processor needs to carry across halves, and at last the halves.
        across = [0, 2, 8, 10, 4, 6, 12, 14], [1, 3, 9, 11, 5, 7, 13, 15]
        for first, second in (across, across, ([0, 1, 2, 3, 8, 9, 10, 11], [4, 5, 6, 7, 12, 13, 14, 15])):
            lanes = ir.Constant(I8, first), ir.Constant(I8, second)
            pairs = zip(rows[::2], rows[1::2], strict=True)
            rows = [builder.fadd(*(builder.shuffle_vector(a, b, one) for one in lanes)) for a, b in pairs]
        return rows[0]

    return Float8(array, types.intp), codegen


@instruction
def prefetch(typingctx: Any, array: types.Type, index: types.Type) -> Any:
    """Ask for the cache line of element `index` of an array, counted through all its axes."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        data = context.make_array(signature.args[0])(context, builder, arguments[0]).data
        address = builder.bitcast(builder.gep(data, [arguments[1]]), ir.IntType(8).as_pointer())
        kind = ir.FunctionType(ir.VoidType(), [address.type, I32, I32, I32])
        hint = [ir.Constant(I32, v) for v in (0, 3, 1)]
        builder.call(builder.module.declare_intrinsic("llvm.prefetch", [address.type], kind), [address, *hint])
        return context.get_dummy_value()

    return types.void(array, types.intp), codegen
