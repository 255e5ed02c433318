"""CONTCT for one pair, in the order of the listing. Numbers in comments are lines of fortran/contct.f."""

from typing import Callable, NamedTuple

import z3

from .reals import arithmetic, equal, follows, from_integer, less, magnitude, of_quotient, product

CONSTANTS = {  # DATA, line 22, in each precision
    32: {"one": 0x3F800000, "delta": 0x1E3CE508, "epsgap": 0x2EDBE6FF, "epsmul": 0x3B800000},
    64: {"one": 1023 << 52, "delta": 0x3BC79CA10C924223, "epsgap": 0x3DDB7CDFD9D7BDBB, "epsmul": 0x3F70000000000000},
}
FORMATS = {  # lines 44, 64, 65 and 66
    20: "(2X,'NO EVENTS. RETURNING. SCALE FACTOR = ',E10.3)",
    40: "(2X,'******* MAKING CONTACT ********')",
    50: "(2X,'****** BREAKING CONTACT *******')",
    60: "(3X,'CONTACT PAIR: ',I3,' NODE: ',I3,' SURFACE: ',I3,' SCALE FACTOR = ',E11.4)",
}
PRECONDITIONS = {
    "pairs": "0 <= NC < 2^31 - 1",
    "subscripts": "NDOF of each pair is inside DD and DTEST, which have fewer than 2^31 elements",
    "dofs": "no overflow in (NODE-1) * NDOFPN + INDOF",
    "product": "no overflow in ISEP * ISURF",
}


Holds = Callable[..., bool]


class Position(NamedTuple):
    """A position of the listing: the loop (1: DO 10, 2: DO 30, 0: returned), the pair (from 0), SMIN, and the number of
    toggled pairs."""

    loop: int
    i: z3.BitVecRef
    smin: z3.BitVecRef
    toggled: z3.BitVecRef


class Toggle(NamedTuple):
    """DO 30 for a pair that is toggled: whether the pair makes contact, and the numbers of the WRITEs."""

    makes: bool
    i: z3.BitVecRef
    node: z3.BitVecRef
    isurf: z3.BitVecRef
    smin: z3.BitVecRef


class Specification:
    """The listing with REAL of `width` bits, for the arrays of any call. `holds` tells whether a condition of the
    listing holds on a path, as Machine.decide does."""

    def __init__(self, width: int, left_out: str = ""):
        self.width, self.left_out = width, left_out
        self.one, self.delta, self.epsgap, self.epsmul = (z3.BitVecVal(v, width) for v in CONSTANTS[width].values())
        self.zero = z3.BitVecVal(0, width)
        self.nc, self.indof, self.ndofpn = z3.BitVecs("nc indof ndofpn", 32)
        self.pairs = z3.ZeroExt(32, self.nc)
        self.dofs = z3.BitVec("dofs", 64)  # length of DD and DTEST
        self.first = Position(1, z3.BitVecVal(0, 64), self.one, z3.BitVecVal(0, 32))
        self.here = Position(0, z3.BitVec("i", 64), z3.BitVec("smin", width), z3.BitVec("toggled", 32))
        self.widths = dict.fromkeys(("DD", "DTEST", "CC", "SS"), width) | dict.fromkeys(("ID", "ISEP", "ISURF"), 32)

    def element(self, array: str, i: z3.BitVecRef) -> z3.BitVecRef:
        """The element of pair `i`, from 0: of SS after DO 10, of other arrays on entry."""
        return z3.Function(array, z3.BitVecSort(64), z3.BitVecSort(self.widths[array]))(self.index(array, i))

    def index(self, array: str, i: z3.BitVecRef) -> z3.BitVecRef:
        """The index of pair `i`'s element, from 0, in 64 bits: NDOF - 1 in DD and DTEST."""
        return z3.simplify(z3.SignExt(32, self.ndof(i)) - 1 if array in ("DD", "DTEST") else i)

    def length(self, array: str) -> z3.BitVecRef:
        return self.dofs if array in ("DD", "DTEST") else self.pairs

    def ndof(self, i: z3.BitVecRef) -> z3.BitVecRef:
        return product(self.element("ID", i) - 1, self.ndofpn) + self.indof  # 28, 29

    def scale_factor(self, i: z3.BitVecRef, holds: Holds) -> z3.BitVecRef:
        """SS(I): the body of DO 10."""
        dtest = self.element("DTEST", i)
        if holds(equal(dtest, self.zero)):  # 31
            return self.one  # 32
        gap = arithmetic("sub", self.element("CC", i), self.element("DD", i))  # 30
        if not holds(less(magnitude(gap), self.epsgap)):  # 33
            return arithmetic("div", gap, dtest)  # 38
        signs = product(self.element("ISEP", i), self.element("ISURF", i))
        sschk = arithmetic("div", from_integer(signs, self.width), dtest)  # 35
        return arithmetic("mul", sschk, self.delta) if holds(less(self.zero, sschk)) else self.one  # 36, 34

    def smaller(self, s: z3.BitVecRef, smin: z3.BitVecRef, holds: Holds) -> z3.BitVecRef:
        """SMIN after a pair with the scale factor `s`."""
        return s if holds(less(self.zero, s)) and holds(less(s, smin)) else smin  # 40

    def toggle(self, at: Position, holds: Holds) -> Toggle | None:
        """DO 30 for the pair at this position; None if the pair is not toggled."""
        signed = arithmetic("sub", self.element("SS", at.i), at.smin)
        is_close = lambda size: less(arithmetic("div", size, at.smin), self.epsmul)  # 51, 52
        size, minus = magnitude(signed), signed ^ (1 << self.width - 1)
        others = [(value == size, is_close(value)) for value in (signed, minus)]  # for ABS by a comparison
        if not holds(is_close(size), others, [fact for value in (signed, minus, size) for fact in of_quotient(value, at.smin)]):
            return None
        node, isurf = self.element("ID", at.i), self.element("ISURF", at.i)  # 53, 61
        return Toggle(holds(self.element("ISEP", at.i) == 1), at.i, node, isurf, at.smin)  # 54

    def of_call(self) -> list[z3.BoolRef]:
        """The preconditions for a call."""
        stated = [] if self.left_out == "pairs" else [self.nc >= 0, self.nc < 0x7FFFFFFF]
        return stated + [z3.ULT(self.dofs, 1 << 31)]  # an INTEGER can number no more dofs

    def of_pair(self, i: z3.BitVecRef) -> list[z3.BoolRef]:
        """The preconditions for pair `i`, if the pair exists."""
        wide = lambda x: z3.SignExt(32, x)
        node, isep, isurf = (self.element(array, i) for array in ("ID", "ISEP", "ISURF"))
        before, ndof = product(node - 1, self.ndofpn), wide(self.ndof(i))
        stated = {
            "subscripts": [1 <= ndof, ndof <= self.dofs],
            "dofs": [wide(node - 1) == wide(node) - 1, ndof == wide(before) + wide(self.indof),
                     wide(before) == product(wide(node - 1), wide(self.ndofpn))],
            "product": [wide(product(isep, isurf)) == product(wide(isep), wide(isurf))],
        }  # fmt: skip
        facts = [z3.Implies(self.ndofpn == 1, before == node - 1)]  # for the loop that compilers make for NDOFPN = 1
        facts += [fact for name, found in stated.items() if name != self.left_out for fact in found]
        return [z3.Implies(z3.ULT(i, self.pairs), fact) for fact in facts]

    def of_position(self, at: Position) -> list[z3.BoolRef]:
        """The invariant when a loop begins a pair. See is_kept."""
        within = z3.And(less(self.zero, at.smin), z3.Not(less(self.one, at.smin)))
        events = z3.And(z3.ULE(z3.ZeroExt(32, at.toggled), at.i), z3.ULE(at.i, self.pairs))
        return [within, events, at.smin != self.one if at.loop == 2 else at.toggled == 0]

    def is_kept(self) -> bool:
        """True if DO 10 keeps SMIN positive and at most 1 for any SS."""
        smin, s = self.here.smin, z3.BitVec("s", self.width)
        after = self.here._replace(smin=z3.If(z3.And(less(self.zero, s), less(s, smin)), s, smin))
        return follows(self.of_position(after)[0], self.of_position(self.here)[0])
