"""Computes results between the nodes of beams and plates in fractions: deflections, moments, shears and their extremes.

Derived from the differential equations, independently of the C++ code with which it is compared. Polynomials are lists
with the constant first. An irrational number is replaced by a Fraction with a relative error below 1e-60.
"""
from fractions import Fraction
from itertools import zip_longest
from math import comb, isqrt, perm


def decimal(text):
    """Returns the exact value of a literal, as `contct exact` does: the shortest decimal of the same double."""
    return Fraction(repr(float(text)))


def grid(table, key, which=None):
    """Returns the coordinates of grid lines, given one by one or as equal parts of a length."""
    if key in table:
        return [Fraction(x) for x in table[key]]
    length, parts = (table["length"], table["elements"]) if which is None else (table["size"][which], table["elements"][which])
    return [Fraction(length) * i / parts for i in range(parts + 1)]


def at(p, x):
    value = Fraction(0)
    for c in reversed(p):
        value = value * x + c
    return value


def derivative(p):
    return [i * c for i, c in enumerate(p)][1:]


def integral(p, constant):
    return [constant] + [c / (i + 1) for i, c in enumerate(p)]


def shifted(p, left):
    """Returns p(left + t) as a polynomial in t."""
    return [sum(c * comb(i, k) * left ** (i - k) for i, c in enumerate(p) if i >= k) for k in range(len(p))]


def rounded(x, digits=150):
    """Returns x rounded to this number of digits if it has many more, so that later numbers stay short."""
    size = max(len(str(x.numerator)), len(str(x.denominator)))
    if size <= 2 * digits or x == 0:
        return x
    scale = 10 ** (digits + len(str(x.denominator)) - len(str(x.numerator)))
    return Fraction(round(x * scale), scale)


def root_of_square(x):
    """Returns the square root of x >= 0, exact if it is rational."""
    n, d = isqrt(x.numerator), isqrt(x.denominator)
    if n * n == x.numerator and d * d == x.denominator:
        return Fraction(n, d)
    scale = 10**80
    return Fraction(isqrt(x.numerator * scale**2 // x.denominator), scale)


def zeros_inside(p, h):
    """Returns where p changes its sign between 0 and h: at most once between neighbouring zeros of its derivative."""
    while p and p[-1] == 0:
        p = p[:-1]
    if len(p) < 2:
        return []
    if len(p) == 2:
        zero = -p[0] / p[1]
        return [zero] if 0 < zero < h else []
    p = [rounded(c) for c in p]
    borders = [Fraction(0), *zeros_inside(derivative(p), h), h]
    zeros = []
    for low, high in zip(borders, borders[1:]):
        sign = at(p, low) < 0
        if sign == (at(p, high) < 0):
            continue
        for _ in range(210):
            middle = (low + high) / 2
            value = at(p, middle)
            low, high = (middle, middle) if value == 0 else (middle, high) if (value < 0) == sign else (low, middle)
        zeros.append((low + high) / 2)
    return zeros


def upper_bound(p, h):
    """Returns an upper bound of p from 0 to h: the largest coefficient of its Bernstein form."""
    n = max(len(p) - 1, 1)
    return max(sum(Fraction(comb(j, i), comb(n, i)) * c * h**i for i, c in enumerate(p[: j + 1])) for j in range(n + 1))


class Beam:
    """The structure of a beam problem: x [nodes], EI, 1 / GA [elements], and the loads of each step as in loads_of."""

    dofs = ("w", "theta")

    def __init__(self, problem):
        table = problem["beam"]
        self.x = grid(table, "x")
        elements = len(self.x) - 1
        section = table.get("section", {})
        EI = table["EI"] if "EI" in table else section["E"] * section["I"]
        self.EI = [Fraction(v) for v in EI] if isinstance(EI, list) else [Fraction(EI)] * elements
        GA = table.get("GA", section.get("G", 0) * section.get("As", 0))
        self.flexibility = [Fraction(1) / Fraction(v) if v else Fraction(0) for v in (GA if isinstance(GA, list) else [GA] * elements)]
        self.W = section.get("W")
        self.hinges = {self.x.index(Fraction(hinge["x"])): Fraction(hinge.get("stiffness", 0)) for hinge in problem.get("hinge", [])}
        own = lambda step: {"uniform": -section["weight"] * section["A"]} if step.get("self_weight") else {}
        self.loads = [loads_of({**own(step), **step}, self.x) for step in problem["step"]]

    def nodes(self):
        return len(self.x)

    def way(self, along):
        """Returns (place, node) along the beam."""
        return [(x, node) for node, x in enumerate(self.x)]

    def chain(self, step, e, w, slope, moment, shear):
        """Returns the pieces of element e between the places of loads, and w and the slope at the right end.

        They follow from w, slope, moment and shear at the left end. A piece is (left, length, polynomials in x - left).
        The moment is EI (slope' - curvature), the shear is its derivative, and the load is the derivative of the shear.
        The slope is the rotation of the section, w' + shear / GA.
        """
        lines, points, curvatures = self.loads[step]
        left, right = self.x[e], self.x[e + 1]
        ends = [x for a, b, _ in lines + curvatures for x in (a, b)] + [x for x, _, _ in points]
        cuts = [left, *sorted({x for x in ends if left < x < right}), right]
        pieces = []
        for a, b in zip(cuts, cuts[1:]):
            shear += sum(force for x, force, _ in points if x == a)
            moment -= sum(turn for x, _, turn in points if x == a)
            loads = [shifted(p, a) for c, d, p in lines if c <= a and b <= d]
            v = integral([sum(c) for c in zip_longest(*loads, fillvalue=0)] or [Fraction(0)], shear)
            m = integral(v, moment)
            bend = [c / self.EI[e] for c in m]
            bend[0] += sum(value for c, d, value in curvatures if c <= a and b <= d)
            turn = integral(bend, slope)
            line = integral([a - self.flexibility[e] * b for a, b in zip_longest(turn, v, fillvalue=0)], w)
            pieces.append((a, b - a, {"w": line, "moment": m, "shear": v, "stress": [c / (self.W or 1) for c in m]}))
            w, slope, moment, shear = at(line, b - a), at(turn, b - a), at(m, b - a), at(v, b - a)
        return pieces, w, slope

    def pieces(self, u, step, e):
        """Returns the pieces of element e between the places of loads, from the displacements of both ends."""
        h, (w0, slope0, w1, slope1) = self.x[e + 1] - self.x[e], u[2 * e : 2 * e + 4]
        pieces, w, slope = self.chain(step, e, w0, slope0, Fraction(0), Fraction(0))
        missing, turn = w1 - w, slope1 - slope
        if e + 1 in self.hinges:  # the moment at the right end is s times the rotation in the hinge, turn - M h / EI - V h^2 / 2 EI
            _, length, line = pieces[-1]
            s, bend = self.hinges[e + 1], h / self.EI[e]
            still = (s * turn - at(line["moment"], length)) / (1 + s * bend)  # M at V = 0
            by_shear = (h + s * h * bend / 2) / (1 + s * bend)  # M = still - by_shear V
            shear = (missing - still * h * bend / 2) / (h**2 * bend / 6 - by_shear * h * bend / 2 - h * self.flexibility[e])
            return self.chain(step, e, w0, slope0, still - by_shear * shear, shear)[0]
        # missing = M h^2 / 2 EI + V h^3 / 6 EI - V h / GA, turn = M h / EI + V h^2 / 2 EI
        shear = (turn * h / 2 - missing) / (h**3 / (12 * self.EI[e]) + h * self.flexibility[e])
        moment = self.EI[e] * turn / h - shear * h / 2
        return self.chain(step, e, w0, slope0, moment, shear)[0]

    def place(self, u, step, quantity, element, end):
        _, h, line = self.pieces(u, step, element - 1)[-1 if end == "right" else 0]
        return at(line[quantity], h if end == "right" else Fraction(0))

    def hinge_rotation(self, u, step, node):
        """Returns theta on the right of the hinge at this node, from 1, minus that on its left."""
        _, h, line = self.pieces(u, step, node - 2)[-1]
        return u[2 * node - 1] - at(derivative(line["w"]), h) - self.flexibility[node - 2] * at(line["shear"], h)

    def extreme(self, u, step, quantity, most):
        """Returns the largest (or least) value, and the x of all places with this value."""
        sign = 1 if most else -1
        best, places = None, []
        for left, h, line in (piece for e in range(len(self.x) - 1) for piece in self.pieces(u, step, e)):
            p = [sign * c for c in line[quantity]]
            inside = best is None or upper_bound(p, h) >= max(best, at(p, Fraction(0)), at(p, h))
            for t in [Fraction(0), h, *(zeros_inside(derivative(p), h) if inside else [])]:
                value = at(p, t)
                tied = best is not None and abs(value - best) <= abs(best) * Fraction(1, 10**60)
                if best is None or (value > best and not tied):
                    best, places = value, []
                if tied or value == best:
                    places.append(left + t)
        return sign * best, places


def loads_of(step, x):
    """Returns a step's loads along a beam: (from, to, polynomial in x), (x, force, moment) and (from, to, curvature).

    Raises ValueError for forms of loads that the reference problems do not use.
    """
    ends = lambda part: (Fraction(part.get("from", x[0])), Fraction(part.get("to", x[-1])))
    uniform = step.get("uniform", 0)
    parts = uniform if isinstance(uniform, list) else [{"value": uniform}]
    if any(part.keys() - {"value", "polynomial", "from", "to"} for part in parts):
        raise ValueError(f"uniform: found {uniform}, allowed: a number, or parts with value or polynomial, from and to")
    lines = [(*ends(part), [Fraction(c) for c in part.get("polynomial", [part.get("value")])]) for part in parts]
    points = [(Fraction(part["x"]), Fraction(part.get("w", 0)), Fraction(part.get("theta", 0)))
              for part in step.get("point", []) if "x" in part and Fraction(part["x"]) not in x]
    return lines, points, [(*ends(part), Fraction(part["value"])) for part in step.get("curvature", [])]


class Plate:
    """The structure of a plate problem: x, y [grid lines], D, nu."""

    dofs = ("w", "wx", "wy")
    # The exponents (i, j) of the terms x^i y^j of an element's w.
    monomials = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3), (3, 1), (1, 3))

    def __init__(self, problem):
        table = problem["plate"]
        self.x, self.y = grid(table, "x", 0), grid(table, "y", 1)
        self.D, self.nu = Fraction(table["D"]), Fraction(table["nu"])

    def nodes(self):
        return len(self.x) * len(self.y)

    def way(self, along):
        if along != "diagonal":
            return [(x - self.x[0], node) for node, x in enumerate(self.x)]
        return [(root_of_square((x - self.x[0]) ** 2 + (y - self.y[0]) ** 2), i * len(self.x) + i)
                for i, (x, y) in enumerate(zip(self.x, self.y))]

    @staticmethod
    def term(monomial, x, y, dx, dy):
        """Returns the derivative of x^i y^j, dx times by x and dy times by y."""
        i, j = monomial
        return perm(i, dx) * perm(j, dy) * x ** max(i - dx, 0) * y ** max(j - dy, 0)

    def corners(self, e):
        """Returns the grid points (column, row) of element e, counter-clockwise from the lower left corner."""
        j, i = divmod(e, len(self.x) - 1)
        return [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]

    def element(self, u, e):
        """Returns the coefficients of element e's monomials, with its lower left corner as origin, and its sides."""
        corners = self.corners(e)
        a = self.x[corners[1][0]] - self.x[corners[0][0]]
        b = self.y[corners[3][1]] - self.y[corners[0][1]]
        known = [u[3 * (j * len(self.x) + i) + d] for i, j in corners for d in range(3)]
        rows = [[self.term(m, x, y, *d) for m in self.monomials]
                for x, y in ((0, 0), (a, 0), (a, b), (0, b)) for d in ((0, 0), (1, 0), (0, 1))]
        return solved(rows, known), a, b

    def moments(self, u, e, corner):
        coefficients, a, b = self.element(u, e)
        x, y = ((0, 0), (a, 0), (a, b), (0, b))[corner - 1]
        xx, yy, xy = (sum(c * self.term(m, Fraction(x), Fraction(y), *d) for m, c in zip(self.monomials, coefficients))
                      for d in ((2, 0), (0, 2), (1, 1)))
        return {"mx": self.D * (xx + self.nu * yy), "my": self.D * (yy + self.nu * xx), "mxy": self.D * (1 - self.nu) * xy}

    def place(self, u, step, quantity, element, corner):
        return self.moments(u, element - 1, corner)[quantity]

    def extreme(self, u, step, quantity, most):
        """Returns the largest (or least) w at nodes or moment at corners of elements, and the x of all its places."""
        if quantity == "w":
            found = [(w, self.x[node % len(self.x)]) for node, w in enumerate(u[::3])]
        else:
            elements = range((len(self.x) - 1) * (len(self.y) - 1))
            found = [(self.moments(u, e, corner)[quantity], self.x[self.corners(e)[corner - 1][0]])
                     for e in elements for corner in range(1, 5)]
        best = (max if most else min)(value for value, _ in found)
        return best, [x for value, x in found if value == best]


def solved(rows, right):
    """Returns the solution of a square system, by elimination."""
    rows = [[Fraction(v) for v in row] + [r] for row, r in zip(rows, right)]
    for k in range(len(rows)):
        pivot = next(i for i in range(k, len(rows)) if rows[i][k] != 0)
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [v / rows[k][k] for v in rows[k]]
        for i, row in enumerate(rows):
            if i != k and row[k] != 0:
                rows[i] = [v - row[k] * p for v, p in zip(row, rows[k])]
    return [row[-1] for row in rows]
