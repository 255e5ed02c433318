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
    """An element of length h: dofs w and the rotation of the section at its left end, then at its right end.

    GA is its shear stiffness, None without shear flexibility. `hinge` is the stiffness of a hinge at the right end, None
    without one. The element's rotation at this end is condensed: it is u[3] - free turn . u, plus the rotation from the
    element's loads.
    A shape is two polynomials in t = (x - left) / h: its w, and h times the rotation of its section.
    """

    def __init__(self, h, EI, GA=None, weight=None, hinge=None):
        self.weight, self.GA = weight, GA
        self.h, self.EI = positive(h), positive(EI)
        self.phi = phi = 12 * EI / positive(GA) / h**2 if GA is not None else F(0)
        c = EI / h**3 / (1 + phi)
        near, far = (4 + phi) * h * h * c, (2 - phi) * h * h * c
        self.stiffness = [[12 * c, 6 * h * c, -12 * c, 6 * h * c], [6 * h * c, near, -6 * h * c, far],
                          [-12 * c, -6 * h * c, 12 * c, -6 * h * c], [6 * h * c, far, -6 * h * c, near]]
        self.near, self.turn = near, [k / near for k in self.stiffness[3]]
        self.free = F(0) if hinge is None else near / (near + hinge)
        if self.free:
            self.stiffness = [[k - a * b * near * self.free for k, b in zip(row, self.turn)] for row, a in zip(self.stiffness, self.turn)]

    def work(self, of):
        """Returns a load's work on the four shape functions, and what it adds inside at u = 0: to w and moment in the middle, to shear at 1/4.

        of(shape, a, b) is the load's work on a shape from t = a to t = b. The deflection of the middle is the load's work
        on the deflection under a unit load in the middle, between clamped ends h^3 (t^2 (3 - 4 t) + 2 phi t) / 48 EI for
        t up to 1/2.
        """
        h, phi, share = self.h, self.phi, 1 / (1 + self.phi)
        shapes = [((1 + phi, -phi, -3, 2), (0, -6, 6)), ((0, h * (1 + phi / 2), -h * (2 + phi / 2), h), (h * (1 + phi), -h * (4 + phi), 3 * h)),
                  ((0, phi, 3, -2), (0, 6, -6)), ((0, -h * phi / 2, h * (phi / 2 - 1), h), (0, h * (phi - 2), 3 * h))]
        forces = [share * of(shape, F(0), F(1)) for shape in shapes]
        middle = h**3 / (48 * self.EI) * (of(((0, 2 * phi, 3, -4), (0, 6, -12)), F(0), F(1, 2))
                                          + of(((2 * phi - 1, 6 - 2 * phi, -9, 4), (6, -18, 12)), F(1, 2), F(1)))
        if self.free:
            middle -= h * self.free * forces[3] / (8 * self.near)
            forces = [f - self.free * a * forces[3] for f, a in zip(forces, self.turn)]
        return forces + [middle, of(((F(1),), ()), F(0), F(1, 4)), h * of(((F(1, 2), F(-1)), (F(-1),)), F(0), F(1, 2))]

    def load(self, q, left, first=F(0), last=F(1)):
        """Returns `work` of a load that is the polynomial q in x from t = first to t = last."""
        own = [sum(c * comb(k, i) * left**(k - i) for k, c in enumerate(q) if k >= i) * self.h**(i + 1) for i in range(len(q))]

        def of(shape, a, b):
            a, b = max(a, first), max(a, first, min(b, last))
            return sum(c * s * (b**(i + j + 1) - a**(i + j + 1)) / F(i + j + 1) for i, c in enumerate(own) for j, s in enumerate(shape[0]))
        return self.work(of)

    def point(self, force, moment, t):
        """Returns `work` of a force and a moment at t, inside the element."""
        at = lambda p: sum(s * t**j for j, s in enumerate(p))
        return self.work(lambda shape, a, b: force * at(shape[0]) + moment * at(shape[1]) / self.h if a < t <= b else F(0))

    def bent(self, curvature, first, last):
        """Returns `work` of an imposed curvature from t = first to t = last."""
        def of(shape, a, b):
            a, b = max(a, first), max(a, first, min(b, last))
            return self.EI * curvature / self.h * sum(s * (b**j - a**j) for j, s in enumerate(shape[1]))
        return self.work(of)

    def middle(self, u, work):
        """Returns (kind, size) for w and moment in the middle, shear at a quarter, and without GA the larger mean slope of a half."""
        right = u[3] - self.free * dot(self.turn, u) if self.free else u[3]
        w = (u[0] + u[2]) / 2 + self.h * (u[1] - right) / 8 + work[4]
        shear, moment = (dot(row, u) - f for row, f in zip(self.stiffness[:2], work))
        inside = [w, shear + work[5], shear * self.h / 2 - moment + work[6], max(abs(w - u[0]), abs(u[2] - w)) * 2 / self.h if self.GA is None else F(0)]
        return zip(("w", "shear", "moment", "slope"), map(abs, inside))

    def values(self, u, work):
        """Returns shears and moments at the ends as (kind, value, c), with error^2 <= c rho^2, from u and `work`."""
        v, m, w, n = [dot(row, u) - f for row, f in zip(self.stiffness, work)]
        shear, moment = 12 * self.EI / self.h**3, 4 * self.EI / self.h
        return [("shear", v, shear), ("shear", -w, shear), ("moment", -m, moment), ("moment", n, moment)]


SECTION = {"E", "I", "W", "A", "G", "As", "weight"}


def pieces(of, *keys):
    """Returns the pieces that have an end, "to", in the beam's EI, GA and section, or in `keys` alone."""
    return [only(piece, {"to", *SECTION} if key == "section" else {"to", "value"}) for key in keys or ("EI", "GA", "section") for piece in listed(of.get(key))
            if isinstance(piece, dict) and "to" in piece]


def section(piece):
    """Returns EI, GA and the weight per length of a piece; GA and the weight are None if they are unknown."""
    product = lambda *keys: positive(real(piece[keys[0]])) * positive(real(piece[keys[1]]))
    need(("G" in piece) == ("As" in piece), "G without As")
    return product("E", "I"), product("G", "As") if "G" in piece else None, product("weight", "A") if "weight" in piece and "A" in piece else None


def along(of, key, x):
    """Returns the number, or the section, of each element."""
    parts = pieces(of, key)
    read = (lambda piece: section(only(piece, {"to", *SECTION}))) if key == "section" else lambda piece: real(piece["value"] if isinstance(piece, dict) else piece)
    if parts:
        ends = [0] + [find(x, piece["to"]) for piece in parts]
        need(None not in ends and ends == sorted(set(ends)) and ends[-1] == len(x) - 1, "pieces that are not from node to node, or do not end where the beam ends")
        return [read(piece) for piece, a, b in zip(parts, ends, ends[1:]) for _ in range(a, b)]
    all = [read(k) for k in listed(of[key])] * (1 if isinstance(of[key], list) else len(x) - 1)
    need(len(all) == len(x) - 1, f"{key}: not one for each element")
    return all


def hinges(t, x):
    """Returns the stiffness of the hinge at each node, from 0, that has one. Raises ValueError unless they are different inner nodes."""
    found = []
    for part in t.get("hinge", []):
        need(len(only(part, {"node", "nodes", "x", "stiffness"}).keys() - {"stiffness"}) == 1, "not one of node, nodes and x")
        at = [find(x, at) for at in listed(part["x"])] if "x" in part else numbers(listed(part["node"]) if "node" in part else part["nodes"], len(x))
        found += [(node, real(part.get("stiffness", 0))) for node in at]
    need(all(node is not None and 0 < node < len(x) - 1 and stiffness >= 0 for node, stiffness in found) and len(dict(found)) == len(found), "a hinge that is at no inner node, or of negative stiffness")
    return dict(found)


def named(of, t):
    """Returns every x of supports, pairs, hinges, loads, ends of pieces and ends of beds."""
    tables = [part for key in ("support", "contact", "bed", "hinge") for part in t.get(key, [])]
    tables += [part for step in t.get("step", []) + t.get("case", []) for key in ("point", "settlement", "move") for part in step.get(key, [])]
    beds = t.get("bed", [])
    ends = [bed[key] for bed in beds for key in ("from", "to") if key in bed] + [piece["to"] for bed in beds for piece in listed(bed["modulus"]) if isinstance(piece, dict)]
    return [x for part in tables for x in listed(part.get("x", []))] + [piece["to"] for piece in pieces(of)] + ends


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
    need("GA" not in of or "EI" in of, "GA without EI")
    need(of.keys() - {"EI", "GA", "section"} in ({"x"}, {"length", "elements"}, {"x", "element_size"}, {"length", "element_size"}), "a beam of another form")
    if "element_size" in of:
        return sized(of, t, [real(x) for x in of.get("x", [0, of.get("length")])])
    return [real(x) for x in of["x"]] if "x" in of else parts(of["length"], of["elements"])


def beam(of, t, count=None):
    """Raises ValueError unless there are `count` element results, if it is given. Returns a node's dof names, [x], the nodes' tributary lengths, and (element, dofs, left end) of each element."""
    x = places(of, t)
    need(len(x) > 1 and count in (None, 4 * (len(x) - 1)), "a beam with another number of elements than in the proof file")
    if "section" in of:
        sections = along(of, "section", x)
        need(len({GA is None for _, GA, _ in sections}) == 1, "G in some pieces and not in others")
    else:
        sections = list(zip(along(of, "EI", x), along(of, "GA", x) if "GA" in of else [None] * (len(x) - 1), [None] * (len(x) - 1)))
    at = hinges(t, x)
    elements = [(Beam(b - a, *k, at.get(e + 1)), range(2 * e, 2 * e + 4), a) for e, (a, b, k) in enumerate(zip(x, x[1:], sections))]
    return ["w", "theta"], [x], [(b - a) / 2 for a, b in zip(x[:1] + x, x[1:] + x[-1:])], elements
