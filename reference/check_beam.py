"""Makes the nodes and elements of a beam in fractions, for check_proof.py; also reads lists of a problem file."""
import re
from bisect import bisect_left
from fractions import Fraction as F
from math import ceil, comb

from check_plate import dot, need, positive, real


def listed(x):
    return x if isinstance(x, list) else [x]


def only(table, keys):
    """Returns the table. Raises ValueError if it has a key that is not in `keys`."""
    need(isinstance(table, dict) and table.keys() <= set(keys), f"a table has keys other than {sorted(keys)}")
    return table


def numbers(which, count):
    """Returns indices from 0 for different numbers from 1 to `count`, given as a list, "a..b" or "all"."""
    if isinstance(which, str):
        first, last = (1, count) if which == "all" else map(int, re.fullmatch(r"(\d+)\.\.(\d+)", which).groups())
        which = list(range(first, last + 1))
    need(which and all(type(x) is int and 1 <= x <= count for x in which) and len(set(which)) == len(which), f"{which}: not from 1 to {count}")
    return [x - 1 for x in which]


def same(line):
    """Returns the distance within which coordinates are equal: 2^-50 of the end with the larger magnitude."""
    return F(1, 2**50) * max(abs(line[0]), abs(line[-1]))


def find(line, x):
    """Returns the index of the coordinate that equals x, or None. The coordinates increase."""
    i = bisect_left(line, x)
    near = min((k for k in (i - 1, i) if 0 <= k < len(line)), key=lambda k: abs(line[k] - x))
    return near if abs(line[near] - x) <= same(line) else None


class Beam:
    """An element of length h: dofs w and w' at its left end, w and w' at its right end.

    If `released`, a hinge makes the moment at the right end 0. The element's w' at this end is condensed: it is
    -turn . u plus the rotation from the element's loads.
    """

    def __init__(self, h, EI, weight=None, released=False):
        self.weight, self.released = weight, released
        self.h, self.EI, c = positive(h), positive(EI), EI / h**3
        self.stiffness = [[12 * c, 6 * h * c, -12 * c, 6 * h * c], [6 * h * c, 4 * h * h * c, -6 * h * c, 2 * h * h * c],
                          [-12 * c, -6 * h * c, 12 * c, -6 * h * c], [6 * h * c, 2 * h * h * c, -6 * h * c, 4 * h * h * c]]
        self.turn = [k * h / (4 * EI) for k in self.stiffness[3]]
        if released:
            self.stiffness = [[k - a * b * 4 * EI / h for k, b in zip(row, self.turn)] for row, a in zip(self.stiffness, self.turn)]

    def work(self, of):
        """Returns a load's work on the four shape functions, and the deflection of the middle that it causes at u = 0.

        of(shape, a, b) is the load's work on a polynomial in t = (x - left) / h from t = a to t = b. The deflection of
        the middle is the load's work on the deflection under a unit load in the middle, between clamped ends
        h^3 t^2 (3 - 4 t) / 48 EI for t up to 1/2.
        """
        shapes = [(1, 0, -3, 2), (0, self.h, -2 * self.h, self.h), (0, 0, 3, -2), (0, 0, -self.h, self.h)]
        forces = [of(shape, F(0), F(1)) for shape in shapes]
        middle = self.h**3 / (48 * self.EI) * (of((0, 0, 3, -4), F(0), F(1, 2)) + of((-1, 6, -9, 4), F(1, 2), F(1)))
        if self.released:
            middle -= self.h * self.h * forces[3] / (32 * self.EI)
            forces = [f - a * forces[3] for f, a in zip(forces, self.turn)]
        return forces + [middle]

    def load(self, q, left, first=F(0), last=F(1)):
        """Returns `work` of a load that is the polynomial q in x from t = first to t = last."""
        own = [sum(c * comb(k, i) * left**(k - i) for k, c in enumerate(q) if k >= i) * self.h**(i + 1) for i in range(len(q))]

        def of(shape, a, b):
            a, b = max(a, first), max(a, first, min(b, last))
            return sum(c * s * (b**(i + j + 1) - a**(i + j + 1)) / F(i + j + 1) for i, c in enumerate(own) for j, s in enumerate(shape))
        return self.work(of)

    def point(self, force, moment, t):
        """Returns `work` of a force and a moment at t, inside the element."""
        return self.work(lambda shape, a, b: sum(force * s * t**j + moment * j * s * t**(j - 1) / self.h for j, s in enumerate(shape)) if a < t <= b else F(0))

    def bent(self, curvature, first, last):
        """Returns `work` of an imposed curvature from t = first to t = last."""
        def of(shape, a, b):
            a, b = max(a, first), max(a, first, min(b, last))
            return self.EI * curvature / self.h * sum(j * s * (b**(j - 1) - a**(j - 1)) for j, s in enumerate(shape) if j > 1)
        return self.work(of)

    def middle(self, u, work):
        """Returns w in the middle, from the element's displacements u and the `work` of its loads."""
        right = -dot(self.turn[:3], u[:3]) if self.released else u[3]
        return (u[0] + u[2]) / 2 + self.h * (u[1] - right) / 8 + work[4]

    def values(self, u, work):
        """Returns shears and moments at the ends as (kind, value, c), with error^2 <= c rho^2, from u and `work`."""
        v, m, w, n = [dot(row, u) - f for row, f in zip(self.stiffness, work)]
        shear, moment = 12 * self.EI / self.h**3, 4 * self.EI / self.h
        return [("shear", v, shear), ("shear", -w, shear), ("moment", -m, moment), ("moment", n, moment)]


def pieces(of):
    """Returns the pieces of the beam's EI or section that have an end, "to"."""
    section = {"E", "I", "W", "A", "weight"}
    return [only(piece, {"to", "value"} if "EI" in of else {"to", *section}) for piece in listed(of.get("EI", of.get("section")))
            if isinstance(piece, dict) and "to" in piece]


def stiffness(piece):
    """Returns EI and the weight per length of a piece; the weight is None if it is unknown."""
    if "value" in piece:
        return real(piece["value"]), None
    EI = positive(real(piece["E"])) * positive(real(piece["I"]))
    return EI, positive(real(piece["weight"])) * positive(real(piece["A"])) if "weight" in piece and "A" in piece else None


def hinges(t, x):
    """Returns the nodes of hinges, from 0. Raises ValueError unless they are different inner nodes."""
    found = []
    for part in t.get("hinge", []):
        need(len(only(part, {"node", "nodes", "x"})) == 1, "not one of node, nodes and x")
        found += [find(x, real(at)) for at in listed(part["x"])] if "x" in part else numbers(listed(part["node"]) if "node" in part else part["nodes"], len(x))
    need(all(node is not None and 0 < node < len(x) - 1 for node in found) and len(set(found)) == len(found), "a hinge that is at no inner node")
    return set(found)


def named(of, t):
    """Returns every x of supports, pairs, hinges, loads and ends of pieces."""
    tables = [part for key in ("support", "contact", "bed", "hinge") for part in t.get(key, [])]
    tables += [part for step in t.get("step", []) + t.get("case", []) for key in ("point", "settlement", "move") for part in step.get(key, [])]
    return [real(x) for part in tables for x in listed(part.get("x", []))] + [real(piece["to"]) for piece in pieces(of)]


def sized(of, t, ends):
    """Returns nodes at `ends`, at every x of `named` between the ends, and in equal parts between these points."""
    inside = sorted(x for x in set(named(of, t)) if ends[0] < x < ends[-1] and find(ends, x) is None)
    corners = sorted(ends + [x for i, x in enumerate(inside) if i == 0 or x - inside[i - 1] > same(ends)])
    counts = [max(1, ceil((float(b) - float(a)) / float(of["element_size"]) - 1e-9)) for a, b in zip(corners, corners[1:])]
    return corners[:1] + [a + (b - a) * i / n for a, b, n in zip(corners, corners[1:], counts) for i in range(1, n + 1)]


def places(of, t):
    """Returns the coordinates of the nodes."""
    need(len(of.keys() & {"EI", "section"}) == 1, "not one of EI and section")
    need(of.keys() - {"EI", "section"} in ({"x"}, {"length", "elements"}, {"x", "element_size"}, {"length", "element_size"}), "a beam of another form")
    if "element_size" in of:
        return sized(of, t, [real(x) for x in of.get("x", [0, of.get("length")])])
    return [real(x) for x in of["x"]] if "x" in of else [real(of["length"]) * i / of["elements"] for i in range(of["elements"] + 1)]


def beam(of, t):
    """Returns a node's dof names, [x], the nodes' tributary lengths, and (element, dofs, left end) of each element."""
    x = places(of, t)
    if pieces(of):
        ends = [0] + [find(x, real(piece["to"])) for piece in pieces(of)]
        need(ends[-1] == len(x) - 1, "pieces that do not end where the beam ends")
        EI = [stiffness(piece) for piece, a, b in zip(pieces(of), ends, ends[1:]) for _ in range(a, b)]
    elif "section" in of:
        EI = [stiffness(only(of["section"], {"E", "I", "W", "A", "weight"}))] * (len(x) - 1)
    else:
        EI = [(real(k), None) for k in listed(of["EI"])] * (1 if isinstance(of["EI"], list) else len(x) - 1)
    need(len(EI) == len(x) - 1, "EI: not one for each element")
    at = hinges(t, x)
    elements = [(Beam(b - a, *k, e + 1 in at), range(2 * e, 2 * e + 4), a) for e, (a, b, k) in enumerate(zip(x, x[1:], EI))]
    return ["w", "theta"], [x], [(b - a) / 2 for a, b in zip(x[:1] + x, x[1:] + x[-1:])], elements
