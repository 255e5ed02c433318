"""Makes the nodes and elements of a plate in fractions, for check_proof.py.

The element (Adini, Clough, Melosh) follows from monomials, without the program's formulas.
"""
from decimal import Decimal
from fractions import Fraction as F
from math import perm

MONOMIALS = [(i, 0) for i in range(4)] + [(0, 1), (1, 1), (2, 1), (3, 1), (0, 2), (1, 2), (0, 3), (1, 3)]  # of x^i y^j
SLOPES = [(0, 0), (1, 0), (0, 1)]  # the dofs w, wx and wy as orders of derivatives


def need(holds, words):
    if not holds:
        raise ValueError(words)


def real(x):
    """Returns the exact value of a number in a file: the shortest decimal that is read as the same double; F as it is."""
    need(type(x) is not bool and isinstance(x, (int, Decimal, bytes, F)), f"{x!r}: not a number")
    return x if isinstance(x, F) else F(repr(float(x)))


def positive(x):
    need(x > 0, f"{x}: not greater than 0")
    return x


def dot(x, y):
    return sum((a * b for a, b in zip(x, y) if a and b), F(0))


def at(p, d, x, y):
    """Returns the derivative of orders d of the monomial with powers p, at (x, y)."""
    if d[0] > p[0] or d[1] > p[1]:
        return 0
    return perm(p[0], d[0]) * perm(p[1], d[1]) * x**(p[0] - d[0]) * y**(p[1] - d[1])


def inverse(a):
    rows = [list(map(F, row)) + [F(i == j) for j in range(len(a))] for i, row in enumerate(a)]
    for i in range(len(a)):
        k = next(k for k in range(i, len(a)) if rows[k][i])
        rows[i], rows[k] = rows[k], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        rows = [row if r == i or not row[i] else [x - row[i] * y for x, y in zip(row, rows[i])] for r, row in enumerate(rows)]
    return [row[len(a):] for row in rows]


class Plate:
    """An element with sides a and b; dofs w, wx and wy at its corners, counter-clockwise from the lower left corner."""

    def __init__(self, a, b, D, nu, weight=None):
        self.a, self.b, self.D, self.nu, self.weight = positive(a), positive(b), positive(D), nu, weight  # weight: per area
        self.corners = [(F(0), F(0)), (a, F(0)), (a, b), (F(0), b)]
        self.shapes = inverse([[at(p, d, x, y) for p in MONOMIALS] for x, y in self.corners for d in SLOPES])  # [monomial][dof]
        energy = [[self.bending(p, q) for q in MONOMIALS] for p in MONOMIALS]
        columns = list(zip(*self.shapes))
        half = [[dot(row, column) for column in columns] for row in energy]
        self.stiffness = [[dot(column, other) for other in zip(*half)] for column in columns]

    def integral(self, i, j):
        return self.a**(i + 1) / (i + 1) * self.b**(j + 1) / (j + 1)

    def bending(self, p, q):
        def of(d, e):  # the integral of derivative d of p times derivative e of q
            factor = at(p, d, 1, 1) * at(q, e, 1, 1)
            return factor and factor * self.integral(p[0] + q[0] - d[0] - e[0], p[1] + q[1] - d[1] - e[1])
        xx, yy, xy = (2, 0), (0, 2), (1, 1)
        return self.D * (of(xx, xx) + of(yy, yy) + self.nu * (of(xx, yy) + of(yy, xx)) + 2 * (1 - self.nu) * of(xy, xy))

    def load(self, q, _, x=(F(0), F(1)), y=(F(0), F(1)), slope=(0, 0)):
        """Returns the consistent forces of q[0] per area on the part x by y, given in shares of the sides: a pressure, or a moment on a slope."""
        part = [[(b**(i + 1) - a**(i + 1)) for i in range(4)] for a, b in (x, y)]
        of = [(at(p, slope, 1, 1), p[0] - slope[0], p[1] - slope[1]) for p in MONOMIALS]
        work = [q[0] * c * part[0][i] * part[1][j] * self.integral(i, j) if c else F(0) for c, i, j in of]
        return [dot(work, column) for column in zip(*self.shapes)]

    def values(self, u, _):
        """Returns mx, my and mxy at the corners as (kind, value, c), with error^2 <= c rho^2."""
        c, D, nu = [dot(row, u) for row in self.shapes], self.D, self.nu
        xx, yy, xy = ([dot(c, [at(p, d, x, y) for p in MONOMIALS]) for x, y in self.corners] for d in [(2, 0), (0, 2), (1, 1)])
        bends, twists = 16 * D / (self.a * self.b), 17 * D * (1 - nu) / (2 * self.a * self.b)
        return ([("moment", D * (s + nu * t), bends) for s, t in [*zip(xx, yy), *zip(yy, xx)]]
                + [("moment", D * (1 - nu) * t, twists) for t in xy])


class Even(list):
    """Coordinates of equal parts, whose places may have no end as a decimal."""


def parts(length, elements):
    """Returns the coordinates of equal elements from 0 to `length`."""
    need(type(elements) is int and 0 < elements <= 2_000_000, f"{elements!r} elements: not from 1 to 2000000")
    return Even(positive(real(length)) * i / elements for i in range(elements + 1))


def line(of, key, i):
    """Returns the coordinates of grid lines, given one by one or in equal parts, and their tributary lengths."""
    need(key in of or len(of["size"]) == len(of["elements"]) == 2, "size or elements: not two numbers")
    x = [real(v) for v in of[key]] if key in of else parts(of["size"][i], of["elements"][i])
    need(len(x) > 1, f"{key}: fewer than two coordinates")
    return x, [(b - a) / 2 for a, b in zip(x[:1] + x, x[1:] + x[-1:])]


def plate(of, count=None):
    """Raises ValueError unless there are `count` element results, if it is given. Returns a node's dof names, [x, y], the nodes' tributary areas, and (element, dofs, left end) of each element."""
    grid, material = of.keys() & {"x", "y", "size", "elements"}, of.keys() - {"x", "y", "size", "elements"}
    need(grid in ({"x", "y"}, {"size", "elements"}) and material - {"weight"} in ({"D", "nu"}, {"E", "nu", "thickness"})
         and ("D" not in of or "weight" not in of), "a plate of two forms")
    (x, width), (y, height), nu = line(of, "x", 0), line(of, "y", 1), real(of["nu"])
    need(-1 < nu <= F(1, 2), f"nu is {nu}")
    need(count in (None, 12 * (len(x) - 1) * (len(y) - 1)), "a plate with another number of elements than in the proof file")
    D = real(of["D"]) if "D" in of else positive(real(of["E"])) * real(of["thickness"])**3 / (12 * (1 - nu * nu))
    weight = positive(real(of["weight"])) * real(of["thickness"]) if "weight" in of else None
    elements, made = [], {}
    for j in range(len(y) - 1):
        for i in range(len(x) - 1):
            sides, first = (x[i + 1] - x[i], y[j + 1] - y[j]), j * len(x) + i
            made[sides] = made.get(sides) or Plate(*sides, D, nu, weight)
            corners = [first, first + 1, first + len(x) + 1, first + len(x)]
            elements.append((made[sides], [3 * corner + d for corner in corners for d in range(3)], x[i]))
    return ["w", "wx", "wy"], [x, y], [a * b for b in height for a in width], elements
