"""What CONTCT does with one pair, in the order of the listing. The numbers are lines of fortran/contct.f."""

from typing import NamedTuple

import z3

from .reals import arithmetic, equal, from_integer, less, magnitude, product

CONSTANTS = {  # DATA, line 22, in each precision
    32: {"one": 0x3F800000, "delta": 0x1E3CE508, "epsgap": 0x2EDBE6FF, "epsmul": 0x3B800000},
    64: {"one": 0x3FF0000000000000, "delta": 0x3BC79CA10C924223, "epsgap": 0x3DDB7CDFD9D7BDBB, "epsmul": 0x3F70000000000000},
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


class Position(NamedTuple):
    """How far the listing has come: in which loop (1: DO 10, 2: DO 30), at which pair (from 0), with which SMIN, and how
    many pairs it has toggled."""

    loop: int
    i: z3.BitVecRef
    smin: z3.BitVecRef
    toggled: z3.BitVecRef


class Toggle(NamedTuple):
    """The two WRITEs of a pair that DO 30 toggles, and the same as an event of C++: `happens` says whether, `makes` which
    of 40 and 50 comes first."""

    happens: z3.BoolRef
    makes: z3.BoolRef
    i: z3.BitVecRef
    node: z3.BitVecRef
    isurf: z3.BitVecRef
    smin: z3.BitVecRef


class Specification:
    """The listing in one precision, `width` bits, over the arrays of any call."""

    def __init__(self, width: int, left_out: str = ""):
        self.width, self.left_out = width, left_out
        self.one, self.delta, self.epsgap, self.epsmul = (z3.BitVecVal(v, width) for v in CONSTANTS[width].values())
        self.zero = z3.BitVecVal(0, width)
        self.nc, self.indof, self.ndofpn = z3.BitVecs("nc indof ndofpn", 32)
        self.dofs = z3.BitVec("dofs", 64)  # length of DD and DTEST
        self.here = Position(0, z3.BitVec("i", 64), z3.BitVec("smin", width), z3.BitVec("toggled", 32))
        self.widths = {"DD": width, "DTEST": width, "CC": width, "SS": width, "ID": 32, "ISEP": 32, "ISURF": 32}
        self._arrays = {a: z3.Function(a, z3.BitVecSort(64), z3.BitVecSort(w)) for a, w in self.widths.items()}

    def element(self, array: str, index: z3.BitVecRef) -> z3.BitVecRef:
        """An element, from 0."""
        return self.at_byte(array, index * (self.widths[array] // 8))

    def at_byte(self, array: str, offset: z3.BitVecRef) -> z3.BitVecRef:
        """The element that begins at a byte of the array. SS is as DO 10 leaves it, ISEP as it was on entry."""
        return self._arrays[array](z3.simplify(offset))

    def ndof(self, i: z3.BitVecRef) -> z3.BitVecRef:
        return product(self.element("ID", i) - 1, self.ndofpn) + self.indof  # 28, 29

    def subscript(self, i: z3.BitVecRef) -> z3.BitVecRef:
        """NDOF, from 0 and in 64 bits."""
        return z3.SignExt(32, self.ndof(i)) - 1

    def scale_factor(self, i: z3.BitVecRef) -> z3.BitVecRef:
        """SS(I): the body of DO 10."""
        at = self.subscript(i)
        dtest = self.element("DTEST", at)
        gap = arithmetic("sub", self.element("CC", i), self.element("DD", at))  # 30
        signs = product(self.element("ISEP", i), self.element("ISURF", i))
        sschk = arithmetic("div", from_integer(signs, self.width), dtest)  # 35
        stationary = z3.If(less(self.zero, sschk), arithmetic("mul", sschk, self.delta), self.one)  # 34, 36
        moving = arithmetic("div", gap, dtest)  # 38
        return z3.If(
            equal(dtest, self.zero), self.one, z3.If(less(magnitude(gap), self.epsgap), stationary, moving)  # 31 to 33
        )

    def smaller(self, s: z3.BitVecRef, smin: z3.BitVecRef) -> z3.BitVecRef:
        """SMIN after a pair."""
        return z3.If(z3.And(less(self.zero, s), less(s, smin)), s, smin)  # 40

    def toggle(self, at: Position) -> Toggle:
        """What DO 30 does with pair I."""
        diff = arithmetic("div", magnitude(arithmetic("sub", self.element("SS", at.i), at.smin)), at.smin)  # 51
        makes = self.element("ISEP", at.i) == 1  # 54
        node, isurf = self.element("ID", at.i), self.element("ISURF", at.i)  # 53, 61
        return Toggle(less(diff, self.epsmul), makes, at.i, node, isurf, at.smin)  # 52

    def isep_after(self, t: Toggle) -> z3.BitVecRef:
        toggled = z3.If(t.makes, z3.BitVecVal(-1, 32), z3.BitVecVal(1, 32))  # 55, 58
        return z3.If(t.happens, toggled, self.element("ISEP", t.i))

    def pairs(self) -> z3.BitVecRef:
        return z3.ZeroExt(32, self.nc)

    def of_call(self) -> list[z3.BoolRef]:
        """What holds in every call. DD and DTEST have no more elements than an INTEGER can number."""
        stated = [] if self.left_out == "pairs" else [self.nc >= 0, self.nc < 0x7FFFFFFF]
        return stated + [z3.ULT(self.dofs, 1 << 31)]

    def of_pair(self, i: z3.BitVecRef) -> list[z3.BoolRef]:
        """What the preconditions say of pair `i`."""
        wide = lambda x: z3.SignExt(32, x)
        node, isep, isurf = (self.element(array, i) for array in ("ID", "ISEP", "ISURF"))
        nodes_before = product(node - 1, self.ndofpn)
        ndof = wide(self.ndof(i))
        stated = {
            "subscripts": [1 <= ndof, ndof <= self.dofs],
            "dofs": [wide(node - 1) == wide(node) - 1, ndof == wide(nodes_before) + wide(self.indof),
                     wide(nodes_before) == product(wide(node - 1), wide(self.ndofpn))],
            "product": [wide(product(isep, isurf)) == product(wide(isep), wide(isurf))],
        }  # fmt: skip
        times_1 = [z3.Implies(self.ndofpn == 1, nodes_before == node - 1)]  # compilers make a loop for NDOFPN = 1
        return times_1 + [fact for name, facts in stated.items() if name != self.left_out for fact in facts]

    def of_position(self, at: Position) -> list[z3.BoolRef]:
        """What holds wherever a loop begins a pair: see is_kept."""
        within = z3.And(less(self.zero, at.smin), z3.Not(less(self.one, at.smin)))
        events = z3.ULE(z3.ZeroExt(32, at.toggled), at.i)
        return [within, events, at.smin != self.one if at.loop == 2 else at.toggled == 0]

    def is_kept(self) -> bool:
        """SMIN stays positive and at most 1, whatever DO 10 finds."""
        solver = z3.Solver()
        s = z3.BitVec("s", self.width)
        before, after = self.here, self.here._replace(smin=self.smaller(s, self.here.smin))
        solver.add(self.of_position(before)[0], z3.Not(self.of_position(after)[0]))
        return solver.check() == z3.unsat
