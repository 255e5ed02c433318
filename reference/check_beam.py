"""The beam's element and its nodes, in fractions, for check_proof.py."""
from fractions import Fraction as F
from math import ceil, comb

from check_plate import dot


def listed(x):
    return x if isinstance(x, list) else [x]


def meant(literal):
    """The number that a literal of a file means: the shortest decimal that reads as its double."""
    return F(repr(float(literal)))


def numbers(t):
    """A table, list or value of a file, where whole numbers from 2^53 on are what they mean."""
    if isinstance(t, (dict, list)):
        return {key: numbers(x) for key, x in t.items()} if isinstance(t, dict) else [numbers(x) for x in t]
    return meant(t) if isinstance(t, int) and abs(t) >= 2**53 else t


class Beam:
    """An element of length h: dofs w and w' at its left end, w and w' at its right."""

    def __init__(self, h, EI):
        self.h, self.EI, c = h, EI, EI / h**3
        self.stiffness = [[12 * c, 6 * h * c, -12 * c, 6 * h * c], [6 * h * c, 4 * h * h * c, -6 * h * c, 2 * h * h * c],
                          [-12 * c, -6 * h * c, 12 * c, -6 * h * c], [6 * h * c, 2 * h * h * c, -6 * h * c, 4 * h * h * c]]

    def load(self, q, left):
        """Consistent forces of the polynomial q in x; q and the shapes become polynomials in t = (x - left) / h."""
        shapes = [(1, 0, -3, 2), (0, self.h, -2 * self.h, self.h), (0, 0, 3, -2), (0, 0, -self.h, self.h)]
        own = [sum(c * comb(k, i) * left**(k - i) for k, c in enumerate(q) if k >= i) * self.h**(i + 1) for i in range(len(q))]
        return [sum(c * a / F(i + j + 1) for i, c in enumerate(own) for j, a in enumerate(shape)) for shape in shapes]

    def values(self, u, work):
        """(kind, value, square of its error per rho) of what is handed out, for its displacements and its own loads."""
        v, m, w, n = [dot(row, u) - f for row, f in zip(self.stiffness, work)]
        shear, moment = 12 * self.EI / self.h**3, 4 * self.EI / self.h
        return [("shear", v, shear), ("shear", -w, shear), ("moment", -m, moment), ("moment", n, moment)]


def named(of, t):
    """Every x that the problem names outside the beam's own x."""
    tables = [part for key in ("support", "contact", "bed") for part in t.get(key, [])]
    tables += [part for step in t["step"] for key in ("point", "settlement") for part in step.get(key, [])]
    return [x for part in tables for x in listed(part.get("x", []))] + [piece["to"] for piece in pieces(of)]


def pieces(of):
    return [piece for piece in listed(of["EI"]) if isinstance(piece, dict)]


def places(of, t):
    """Coordinates of the nodes. With element_size the file names some; elements between two of these are of equal length."""
    if "element_size" not in of:
        return [F(x) for x in of["x"]] if "x" in of else [F(of["length"]) * i / of["elements"] for i in range(of["elements"] + 1)]
    corners = sorted({F(x) for x in of.get("x", [0, of.get("length", 0)])} | {F(x) for x in named(of, t)})
    counts = [max(1, ceil((b - a) / F(of["element_size"]) - F(1, 10**9))) for a, b in zip(corners, corners[1:])]
    return corners[:1] + [a + (b - a) * i / n for a, b, n in zip(corners, corners[1:], counts) for i in range(1, n + 1)]


def beam(of, t):
    """Names of dofs, nodes by place, how much of the length each has, and the elements with their dofs and left ends."""
    x, EI = places(of, t), listed(of["EI"])
    if pieces(of):
        EI = [next(piece["value"] for piece in EI if F(piece["to"]) >= right) for right in x[1:]]
    EI = EI * (len(x) - 1) if len(EI) == 1 else EI
    elements = [(Beam(x[e + 1] - x[e], F(k)), range(2 * e, 2 * e + 4), x[e]) for e, k in enumerate(EI)]
    return ["w", "theta"], {v: i for i, v in enumerate(x)}, [(b - a) / 2 for a, b in zip(x[:1] + x, x[1:] + x[-1:])], elements
