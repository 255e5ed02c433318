"""Makes the nodes and elements of a beam in fractions, for check_proof.py; also reads lists of a problem file."""
import re
from bisect import bisect_left
from decimal import ROUND_HALF_UP, Context, Decimal
from fractions import Fraction as F
from math import ceil, comb

from check_plate import Even, dot, need, parts, positive, real


def listed(x):
    return x if isinstance(x, list) else [x]


def only(table, keys):
    """Returns the table. Raises ValueError if it has a key that is not in `keys`."""
    need(isinstance(table, dict) and table.keys() <= set(keys), f"a table has keys other than {sorted(keys)}")
    return table


def numbers(which, count):
    """Returns indices from 0 for different numbers from 1 to `count`, given as a list, "a..b" or "all"."""
    if isinstance(which, str):
        ends = re.fullmatch(r"(\d{1,9})\.\.(\d{1,9})", "1..%d" % count if which == "all" else which)
        which = list(range(int(ends[1]), min(int(ends[2]), count + 1) + 1)) if ends else []
    need(which and all(type(x) is int and 1 <= x <= count for x in which) and len(set(which)) == len(which), f"{which}: not different numbers from 1 to {count}")
    return [x - 1 for x in which]


def digits(x):
    """Returns the number of significant digits of x as written, at most 17."""
    return min(17, len(Decimal(x).as_tuple().digits))


def rounds_to(place, x):
    """Returns True if x has 12 digits or more, and `place`, rounded to as many digits or to a double, is x as a double."""
    if not place or digits(x) < 12:
        return False
    shown = Context(prec=digits(x), rounding=ROUND_HALF_UP).divide(Decimal(place.numerator), Decimal(place.denominator))
    return float(x) in (float(shown), float(place))


def find(line, x):
    """Returns the index of the coordinate that x names, a number of the file or a sum of them (F), or None. They increase."""
    at = real(x)
    i = bisect_left(line, at)
    near = min((k for k in (i - 1, i) if 0 <= k < len(line)), key=lambda k: abs(line[k] - at))
    return near if line[near] == at or (at is not x and isinstance(line, Even) and rounds_to(line[near], x)) else None


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
        """Returns a load's work on the four shape functions, and what it adds inside at u = 0: to w and moment in the middle, to shear at 1/4.

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
        return forces + [middle, of((F(1),), F(0), F(1, 4)), self.h * of((F(1, 2), F(-1)), F(0), F(1, 2))]

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
        """Returns (kind, size) for w and moment in the middle, shear at a quarter, and the larger mean slope of a half."""
        right = -dot(self.turn[:3], u[:3]) if self.released else u[3]
        w = (u[0] + u[2]) / 2 + self.h * (u[1] - right) / 8 + work[4]
        shear, moment = (dot(row, u) - f for row, f in zip(self.stiffness[:2], work))
        inside = [w, shear + work[5], shear * self.h / 2 - moment + work[6], max(abs(w - u[0]), abs(u[2] - w)) * 2 / self.h]
        return zip(("w", "shear", "moment", "slope"), map(abs, inside))

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
        found += [find(x, at) for at in listed(part["x"])] if "x" in part else numbers(listed(part["node"]) if "node" in part else part["nodes"], len(x))
    need(all(node is not None and 0 < node < len(x) - 1 for node in found) and len(set(found)) == len(found), "a hinge that is at no inner node")
    return set(found)


def named(of, t):
    """Returns every x of supports, pairs, hinges, loads and ends of pieces."""
    tables = [part for key in ("support", "contact", "bed", "hinge") for part in t.get(key, [])]
    tables += [part for step in t.get("step", []) + t.get("case", []) for key in ("point", "settlement", "move") for part in step.get(key, [])]
    return [x for part in tables for x in listed(part.get("x", []))] + [piece["to"] for piece in pieces(of)]


def sized(of, t, ends):
    """Returns nodes at `ends`, at every x of `named` between the ends, and in equal parts between these points."""
    corners = list(ends)
    for x in sorted(named(of, t), key=lambda x: (-digits(x), real(x))):  # the longest first: a shorter one may round to it
        i = bisect_left(corners, real(x))
        if 0 < i < len(corners) and corners[i] != real(x) and not any(rounds_to(corner, x) for corner in corners[i - 1:i + 1]):
            corners.insert(i, real(x))
    counts = [max(1, ceil((float(b) - float(a)) / float(of["element_size"]) - 1e-9)) for a, b in zip(corners, corners[1:])]
    need(sum(counts) <= 2_000_000, "element_size makes more than 2000000 elements")
    return Even(corners[:1] + [a + (b - a) * i / n for a, b, n in zip(corners, corners[1:], counts) for i in range(1, n + 1)])


def places(of, t):
    """Returns the coordinates of the nodes."""
    need(len(of.keys() & {"EI", "section"}) == 1, "not one of EI and section")
    need(of.keys() - {"EI", "section"} in ({"x"}, {"length", "elements"}, {"x", "element_size"}, {"length", "element_size"}), "a beam of another form")
    if "element_size" in of:
        return sized(of, t, [real(x) for x in of.get("x", [0, of.get("length")])])
    return [real(x) for x in of["x"]] if "x" in of else parts(of["length"], of["elements"])


def beam(of, t, count=None):
    """Raises ValueError unless there are `count` element results, if it is given. Returns a node's dof names, [x], the nodes' tributary lengths, and (element, dofs, left end) of each element."""
    x = places(of, t)
    need(len(x) > 1 and count in (None, 4 * (len(x) - 1)), "a beam with another number of elements than in the proof file")
    if pieces(of):
        ends = [0] + [find(x, piece["to"]) for piece in pieces(of)]
        need(None not in ends and ends == sorted(set(ends)) and ends[-1] == len(x) - 1, "pieces that are not from node to node, or do not end where the beam ends")
        EI = [stiffness(piece) for piece, a, b in zip(pieces(of), ends, ends[1:]) for _ in range(a, b)]
    elif "section" in of:
        EI = [stiffness(only(of["section"], {"E", "I", "W", "A", "weight"}))] * (len(x) - 1)
    else:
        EI = [(real(k), None) for k in listed(of["EI"])] * (1 if isinstance(of["EI"], list) else len(x) - 1)
    need(len(EI) == len(x) - 1, "EI: not one for each element")
    at = hinges(t, x)
    elements = [(Beam(b - a, *k, e + 1 in at), range(2 * e, 2 * e + 4), a) for e, (a, b, k) in enumerate(zip(x, x[1:], EI))]
    return ["w", "theta"], [x], [(b - a) / 2 for a, b in zip(x[:1] + x, x[1:] + x[-1:])], elements
