"""Reals as bits. Comparisons are exact. +, -, *, / and conversions are unknown functions: the same bits in the same
order give the same bits."""

import functools

import z3

z3.set_param("rewriter.elim_sign_ext", False)  # Z3 is faster with whole terms than with single bits

EFFORT = 10_000_000  # limit for a question in Z3's own units, so that verdicts do not depend on the machine's load
INFINITY = {32: 0x7F800000, 64: 0x7FF0000000000000}


def function(name: str, width: int, *arguments: z3.BitVecRef) -> z3.BitVecRef:
    """An unknown function of bits, which is the same for the same name and width."""
    return z3.Function(f"{name}{width}", *(a.sort() for a in arguments), z3.BitVecSort(width))(*arguments)


def arithmetic(name: str, a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BitVecRef:
    """`a` + `b` for add; likewise sub, mul and div. The order of operands matters in add and mul only if both are NaN,
    so a known operand that is a number is put second."""
    if name in ("add", "mul") and z3.is_bv_value(a) and z3.is_false(z3.simplify(is_nan(a))):
        a, b = b, a
    return function(name, a.size(), a, b)


def from_integer(value: z3.BitVecRef, width: int) -> z3.BitVecRef:
    """An integer as a real. An integer has the same result in 32 and in 64 bits."""
    return function("from_int", width, z3.SignExt(64 - value.size(), value))


def product(a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BitVecRef:
    """A product of integers: exact if one is constant, otherwise an unknown function that ignores the order."""
    a, b = sorted((z3.simplify(a), z3.simplify(b)), key=z3.AstRef.sexpr)
    if z3.is_bv_value(a) or z3.is_bv_value(b):
        return a * b
    return function("product", a.size(), z3.If(z3.ULE(a, b), a, b), z3.If(z3.ULE(a, b), b, a))


def magnitude(x: z3.BitVecRef) -> z3.BitVecRef:
    """ABS(x): x with the sign bit cleared."""
    return x & z3.BitVecVal((1 << x.size() - 1) - 1, x.size())


def of_quotient(a: z3.BitVecRef, b: z3.BitVecRef) -> list[z3.BoolRef]:
    """What is known of a / b for a number b > 0: NaN / b is NaN, and 0 / b is 0, with some sign."""
    q = arithmetic("div", a, b)
    above_0 = less(z3.BitVecVal(0, b.size()), b)
    return [z3.Implies(is_nan(a), is_nan(q)), z3.Implies(z3.And(magnitude(a) == 0, above_0), magnitude(q) == 0)]


def is_nan(x: z3.BitVecRef) -> z3.BoolRef:
    return z3.UGT(magnitude(x), INFINITY[x.size()])


def unordered(a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BoolRef:
    return z3.Or(is_nan(a), is_nan(b))


def equal(a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BoolRef:
    """a = b by IEEE 754: +0 equals -0, and NaN equals nothing."""
    return z3.And(z3.Not(unordered(a, b)), z3.Or(a == b, magnitude(a | b) == 0))


def less(a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BoolRef:
    """a < b by IEEE 754. For negative numbers, larger bits mean a smaller number."""
    below = z3.If(a < 0, z3.If(b < 0, z3.UGT(a, b), magnitude(a | b) != 0), z3.And(b >= 0, z3.ULT(a, b)))
    return z3.And(z3.Not(unordered(a, b)), below)


@functools.cache
def follows(claim: z3.BoolRef, *facts: z3.BoolRef) -> bool:
    """True if Z3 proves that `claim` follows from `facts`."""
    solver = z3.Solver()
    solver.set("rlimit", EFFORT)
    solver.add(*facts, z3.Not(claim))
    return solver.check() == z3.unsat


def are_ieee(width: int) -> bool:
    """True if these comparisons, and of_quotient in any rounding mode, agree with Z3's theory of IEEE 754 for all bit
    patterns. Quotients are proved for the values that NaN and 0 have there, which is much faster than for bits."""
    sort = {32: z3.Float32(), 64: z3.Float64()}[width]
    a, b = z3.BitVecs("a b", width)
    x, y = z3.fpBVToFP(a, sort), z3.fpBVToFP(b, sort)
    nan, zeros = z3.fpNaN(sort), (z3.fpPlusZero(sort), z3.fpMinusZero(sort))
    over_y = lambda numerator: z3.fpDiv(z3.Const("mode", z3.RNE().sort()), numerator, y)
    above_0 = less(z3.BitVecVal(0, width), b)
    claims = [less(a, b) == z3.fpLT(x, y), equal(a, b) == z3.fpEQ(x, y), is_nan(a) == (x == nan), z3.fpIsNaN(over_y(nan)),
              (magnitude(a) == 0) == z3.Or(*(x == zero for zero in zeros))]  # fmt: skip
    return all(map(follows, claims + [z3.Implies(above_0, z3.fpIsZero(over_y(zero))) for zero in zeros]))
