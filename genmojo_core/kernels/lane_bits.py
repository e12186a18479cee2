"""Lanes and bits: masks as integers, 32-bit words kept in lanes, and the logarithm, which takes numbers apart."""

from __future__ import annotations

import math
from typing import Any

from llvmlite import ir
from numba.core import types

from genmojo_core.kernels.simd import F8, F32, I8, I32, LANES, Float8, Mask8, call, instruction, pointer


@instruction
def bits(typingctx: Any, mask: types.Type) -> Any:
    """The mask as an integer: bit i is lane i; 0 where no lane holds."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        return builder.zext(builder.bitcast(arguments[0], ir.IntType(8)), ir.IntType(64))

    return types.int64(Mask8), codegen


@instruction
def gather8(typingctx: Any, array: types.Type, index: types.Type, step: types.Type) -> Any:
    """Eight elements of a flat float32 array, from `index` on, `step` apart."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        array, index, step = arguments
        data = context.make_array(signature.args[0])(context, builder, array).data
        lanes = ir.Constant(F8, ir.Undefined)
        for lane in range(LANES):
            lanes = builder.insert_element(lanes, builder.load(builder.gep(data, [index])), ir.Constant(I32, lane))
            index = builder.add(index, step)
        return lanes

    return Float8(array, types.intp, types.intp), codegen


@instruction
def any_lane(typingctx: Any, mask: types.Type) -> Any:
    """1 where some lane holds, else 0, as an int64."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        lanes = builder.bitcast(arguments[0], ir.IntType(8))
        return builder.zext(builder.icmp_unsigned("!=", lanes, ir.Constant(lanes.type, 0)), ir.IntType(64))

    return types.int64(Mask8), codegen


@instruction
def trailing_zeros(typingctx: Any, value: types.Type) -> Any:
    """Index of the lowest set bit of a non-zero int64."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        return builder.cttz(arguments[0], ir.Constant(ir.IntType(1), 1))

    return types.int64(types.int64), codegen


@instruction
def store_bits(typingctx: Any, array: types.Type, index: types.Type, value: types.Type) -> Any:
    """Write the lowest 32 bits of an int64 in place of one element of a flat float32 array."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        array, index, value = arguments
        data = context.make_array(signature.args[0])(context, builder, array).data
        builder.store(builder.bitcast(builder.trunc(value, I32), F32), builder.gep(data, [index]))
        return context.get_dummy_value()

    return types.void(array, types.intp, types.int64), codegen


@instruction
def lanes_with_bit(typingctx: Any, array: types.Type, index: types.Type, bit: types.Type) -> Any:
    """Which of eight elements written by `store_bits` have that bit (0..31) set: bit i of the result is lane i."""

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        array, index, bit = arguments
        words = builder.load(pointer(context, builder, signature.args[0], array, index), align=4)
        wanted = builder.shl(ir.Constant(I32, 1), builder.trunc(bit, I32))
        single = builder.insert_element(ir.Constant(I8, ir.Undefined), wanted, ir.Constant(I32, 0))
        wanted = builder.shuffle_vector(single, ir.Constant(I8, ir.Undefined), ir.Constant(I8, [0] * LANES))
        found = builder.and_(builder.bitcast(words, I8), wanted)
        lanes = builder.icmp_unsigned("!=", found, ir.Constant(I8, [0] * LANES))
        return builder.zext(builder.bitcast(lanes, ir.IntType(8)), ir.IntType(64))

    return types.int64(array, types.intp, types.int64), codegen


@instruction
def log_8(typingctx: Any, value: types.Type) -> Any:
    """Natural logarithm per lane of positive numbers that are not denormal, relative error 2e-7.

    x = 2**n m with m in sqrt(1/2)..sqrt(2); log m = 2 artanh s, s = (m - 1) / (m + 1), by its series to s**9.
    """

    def codegen(context: Any, builder: ir.IRBuilder, signature: Any, arguments: Any) -> ir.Value:
        def number(x: float) -> ir.Value:
            return ir.Constant(F8, [x] * LANES)

        def words(x: int) -> ir.Value:
            return ir.Constant(I8, [x] * LANES)

        x = builder.bitcast(arguments[0], I8)
        n = builder.ashr(builder.sub(x, words(0x3F3504F3)), words(23))
        m = builder.bitcast(builder.sub(x, builder.shl(n, words(23))), F8)
        s = builder.fdiv(builder.fsub(m, number(1.0)), builder.fadd(m, number(1.0)))
        z = builder.fmul(s, s)
        series = number(1.0 / 9)
        for power in (7, 5, 3, 1):
            series = call(builder, "fmuladd", [series, z, number(1.0 / power)])
        part = builder.fmul(builder.fadd(s, s), series)
        return call(builder, "fmuladd", [builder.sitofp(n, F8), number(math.log(2.0)), part])

    return Float8(Float8), codegen
