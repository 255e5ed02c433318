"""Reals as bits. Comparisons are exact; +, -, *, / and conversions are functions of which nothing is known but that
the same bits in the same order give the same bits."""

import functools

import z3

z3.set_param("rewriter.elim_sign_ext", False)  # whole terms are quicker than single bits

INFINITY = {32: 0x7F800000, 64: 0x7FF0000000000000}


@functools.cache
def function(name: str, width: int, *inputs: int) -> z3.FuncDeclRef:
    """An unknown function of bits, for each name and width the same one."""
    return z3.Function(f"{name}{width}", *(z3.BitVecSort(w) for w in inputs), z3.BitVecSort(width))


def arithmetic(name: str, a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BitVecRef:
    """`a` + `b` and so on: add, sub, mul, div, in operand order."""
    return function(name, a.size(), a.size(), a.size())(a, b)


def from_integer(value: z3.BitVecRef, width: int) -> z3.BitVecRef:
    """A whole number as a real."""
    return function(f"from_int{value.size()}_", width, value.size())(value)


def product(a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BitVecRef:
    """A product of whole numbers: with a constant as it is, else a function like those of reals, but for the order."""
    a, b = z3.simplify(a), z3.simplify(b)
    if z3.is_bv_value(a) or z3.is_bv_value(b):
        return a * b
    return function("product", a.size(), a.size(), a.size())(*sorted((a, b), key=z3.AstRef.get_id))


def magnitude(x: z3.BitVecRef) -> z3.BitVecRef:
    """ABS: the sign bit cleared."""
    return x & z3.BitVecVal((1 << x.size() - 1) - 1, x.size())


def is_nan(x: z3.BitVecRef) -> z3.BoolRef:
    return z3.UGT(magnitude(x), INFINITY[x.size()])


def unordered(a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BoolRef:
    return z3.Or(is_nan(a), is_nan(b))


def equal(a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BoolRef:
    """IEEE's a = b: zeros of both signs are equal, NaN is not."""
    return z3.And(z3.Not(unordered(a, b)), z3.Or(a == b, magnitude(a | b) == 0))


def less(a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BoolRef:
    """IEEE's a < b. Of two negative numbers the one with the larger bits is the smaller."""
    below = z3.If(a < 0, z3.If(b < 0, z3.UGT(a, b), magnitude(a | b) != 0), z3.And(b >= 0, z3.ULT(a, b)))
    return z3.And(z3.Not(unordered(a, b)), below)


def comparisons_are_ieee(width: int) -> bool:
    """Z3's own theory of IEEE 754 says the same of every two bit patterns."""
    a, b = z3.BitVecs("a b", width)
    sort = {32: z3.Float32(), 64: z3.Float64()}[width]
    x, y = z3.fpBVToFP(a, sort), z3.fpBVToFP(b, sort)
    solver = z3.Solver()
    solver.add(z3.Not(z3.And(less(a, b) == z3.fpLT(x, y), equal(a, b) == z3.fpEQ(x, y), is_nan(a) == z3.fpIsNaN(x))))
    return solver.check() == z3.unsat
