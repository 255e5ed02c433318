"""Verifies the bounds on the error of the mesh of a beam with beds, for check_proof.py, by the line w1 of mesh-error.md."""
from fractions import Fraction as F
from math import comb, inf, isqrt, lcm, nextafter
from types import SimpleNamespace

from check_definite import reach_of, up
from check_plate import dot, need

KINDS = ("w", "moment", "shear")


def root(x):
    """Returns the square root of x >= 0, rounded up."""
    if not x:
        return F(0)
    shift = max(0, 200 - x.numerator.bit_length() + x.denominator.bit_length()) // 2 * 2
    return F(isqrt((x.numerator << shift) // x.denominator) + 1, 1 << shift // 2)


def along(p, a, h):
    """Returns the coefficients in s of the polynomial p(a + s h)."""
    out = []
    for c in [] if (a, h) == (0, 1) else reversed(p):
        out = [c + a * out[0]] + [a * y + h * x for x, y in zip(out, out[1:] + [F(0)])] if out else [c]
    return out or p


def plus(p, q, share=1):
    n = max(len(p), len(q))
    return [a + share * b for a, b in zip([*p] + [F(0)] * (n - len(p)), [*q] + [F(0)] * (n - len(q)))]


def whole(p):
    """Returns p as integers over a denominator, with which Python computes several times faster than with fractions."""
    below = lcm(*(c.denominator for c in p))
    return [c.numerator * (below // c.denominator) for c in p], below


def product(p, q):
    """Returns the integral of p q from 0 to 1."""
    (p, below), (q, also), all = whole(p), whole(q), lcm(*range(1, len(p) + len(q)))
    return F(sum(a * b * (all // (i + j + 1)) for i, a in enumerate(p) for j, b in enumerate(q)), all * below * also)


def grown(p, start, h):
    """Returns start + h times the integral of p from 0 to s."""
    return [start] + [h * c / (i + 1) for i, c in enumerate(p)]


def bernstein(p):
    n = len(p) - 1
    (p, below), all = whole(p), lcm(*(comb(n, i) for i in range(n + 1)))
    shares = [all // comb(n, i) * c for i, c in enumerate(p)]
    return [F(sum(comb(j, i) * share for i, share in enumerate(shares[:j + 1])), all * below) for j in range(n + 1)]


def most(p, reached=-inf):
    """Returns a bound on the values of p from 0 to 1, and the largest of `reached` and of the values that were seen, nearly."""
    n = len(p) - 1
    first = [float(x) if F(float(x)) >= x else nextafter(float(x), inf) for x in bernstein(p)]
    size, bound, open = max(map(abs, first)), -inf, [(first, 0)]
    while open:
        b, halved = open.pop()
        reached = max(reached, b[0], b[-1])
        if max(b) - reached <= size / 2**34 or halved == 24:
            bound = max(bound, max(b) + halved * n * size / 2**51)  # each half is rounded n times
            continue
        left, right = [], b
        while right:  # P. de Casteljau
            left, ends, right = left + right[:1], (right[-1], *(ends if left else ())), [(x + y) / 2 for x, y in zip(right, right[1:])]
        open += [(left, halved + 1), ([*ends], halved + 1)]
    return F(bound), reached


def top(p):
    return most(p)[0]


def beyond(p, least, a=F(0), w=F(1)):
    """Returns a bound from below on the length along which p, from a to a + w, exceeds `least`."""
    b = bernstein(along(p, a, w))
    if min(b) > least:
        return w
    if w < F(1, 2**24) or max(b) <= least:
        return F(0)
    return beyond(p, least, a, w / 2) + beyond(p, least, a + w / 2, w / 2)


class Line:
    """The line w1 and its parts in exact numbers."""

    def __init__(self, p, s, f, settled, own):
        self.p, self.s = p, s
        N, x = 2**s["halvings"], p.lines[0]
        nodes = [a + (b - a) * i / N for a, b in zip(x, x[1:]) for i in range(N)] + [x[-1]]
        self.node = lambda node: node * N
        hinges = [e for e, (element, _, _) in enumerate(p.elements) if element.free]
        count = 2 * len(nodes) + len(hinges)
        self.fixed = {self.dof(dof) for dof in p.fixed}
        u = self.u = [F(hi) + F(lo) for hi, lo in s["u"]]
        for dof, at in settled.items():
            u[self.dof(dof)] = at
        self.held = [{i: F(0)} for i in range(count)]  # K_A
        self.rest, self.parts, self.ends = [F(0)] * count, [], []
        for dof, force in enumerate(f):
            self.rest[self.dof(dof)] += force
        for (_, dofs, _), work in zip(p.elements, own):  # f, but the loads inside elements
            for dof, force in zip(dofs, work):
                self.rest[self.dof(dof)] -= force
        cuts, given = sorted({at for _, at, _ in p.acting} | {x for bed in p.continuum for part in bed.parts for x in part[:2]} | {F(str(x)) for x in s["ends"]}), iter(s["parts"])
        for e, (element, _, _) in enumerate(p.elements):
            for i in range(N):
                node = N * e + i
                right = 2 * len(nodes) + hinges.index(e) if i == N - 1 and element.free else 2 * node + 3
                self.element(element, e, [2 * node, 2 * node + 1, 2 * node + 2, right], nodes[node], nodes[node + 1], cuts, given)
            if element.free:
                spring, pair = element.near * (1 - element.free) / element.free, (right, 2 * node + 3)
                for i, j in ((i, j) for i in pair for j in pair):
                    self.add(i, j, spring if i == j else -spring)
                    self.rest[i] -= (spring if i == j else -spring) * u[j]
        need(next(given, None) is None, "the line has more parts than the beam")
        for dof, spring in ((self.dof(dof), spring) for dof, spring in p.supports if spring):
            self.add(dof, dof, spring)
            self.rest[dof] -= spring * u[dof]
        self.deep = [n * (u[self.dof(dof)] - face) for dof, n, face, _ in p.pairs[:p.contacts]]
        for (dof, n, _, k), deep in zip(p.pairs, self.deep):
            self.rest[self.dof(dof)] -= n * k * max(deep, 0)

    def dof(self, dof):
        return 2 * self.node(dof // 2) + dof % 2

    def add(self, i, j, k):
        self.held[i][j] = self.held[i].get(j, 0) + k

    def element(self, of, e, dofs, x0, x1, cuts, given):
        """Adds an element of the line, from x0 to x1 inside element e of the problem, with its parts."""
        H, u, parts = x1 - x0, [self.u[dof] for dof in dofs], []
        K = type(of)(H, of.EI).stiffness
        places = [x0, *(x for x in cuts if x0 < x < x1), x1]
        force = [dot(row, u) for row in K]
        base = [[F(1), F(0), F(-3), F(2)], [F(0), H, -2 * H, H], [F(0), F(0), F(3), F(-2)], [F(0), F(0), -H, H]]
        for a, b in zip(places, places[1:]):
            told = next(given, None)
            need(told is not None, "the line has fewer parts than the beam")
            part = SimpleNamespace(e=len(self.ends), h=b - a, shapes=[along(shape, (a - x0) / H, (b - a) / H) for shape in base], beds=[], certain=[])
            at = lambda kind, power: sum(jump for (k, x, i), jump in self.p.acting.items() if k == kind and i == power and x <= a)
            powers = max([i for k, _, i in self.p.acting if k == "uniform"] + [0])
            part.q, part.curvature = along([at("uniform", i) for i in range(powers + 1)], a, b - a), F(at("curvature", 0))
            part.point = [self.p.acting.get(("point", a, i), F(0)) for i in range(2)]
            part.wI = [sum(v * shape[k] for v, shape in zip(u, part.shapes)) for k in range(4)]
            part.before, part.P, part.pressed = [F(x) for x in told["before"]] or [F(0)], [F(0)], told["pressed"]
            for number, bed in enumerate(self.p.continuum):
                for _, _, k in (x for x in bed.parts if x[0] <= a and b <= x[1]):
                    face = along(bed.face(e, self.p.moved), a, b - a)
                    part.beds.append((number, k, bed.n, face))
                    if number + 1 in part.pressed:
                        part.P = plus(part.P, plus(plus(part.wI, part.before), face, -1), -k)
            for number, first, last in told["certain"]:
                need(0 <= first < last <= 1, "a stretch that is none")
                part.certain.append((next(bed for bed in part.beds if bed[0] + 1 == number), F(first), F(last)))
            g = plus(part.q, part.P)
            turn = lambda shape, s: sum(i * c * s**(i - 1) for i, c in enumerate(shape) if i) / part.h
            work = [part.h * product(g, shape) + part.point[0] * shape[0] + part.point[1] * turn(shape, 0) + of.EI * part.curvature * (turn(shape, 1) - turn(shape, 0))
                    for shape in part.shapes]
            force = [x - y for x, y in zip(force, work)]
            for (_, k, _, _), first, last in part.certain:
                shapes = [along(shape, first, last - first) for shape in part.shapes]
                for i, j in ((i, j) for i in range(4) for j in range(4)):
                    self.add(dofs[i], dofs[j], k * part.h * (last - first) * product(shapes[i], shapes[j]))
            parts.append((part, g))
        V, M, slope, w = force[0], -force[1], u[1], u[0]
        self.ends.append(SimpleNamespace(dofs=dofs, h=H, EI=of.EI, left=(V, M), k=max(sum(bed[1] for bed in part.beds) for part, _ in parts)))
        for part, g in parts:
            V, M = V + part.point[0], M - part.point[1]
            part.shear = grown(g, V, part.h)
            part.moment = grown(part.shear, M, part.h)
            slopes = grown(plus([c / of.EI for c in part.moment], [part.curvature]), slope, part.h)
            part.w = grown(slopes, w, part.h)
            V, M, slope, w = (sum(p) for p in (part.shear, part.moment, slopes, part.w))
            self.parts.append(part)
        self.ends[-1].right = V, M
        for i in range(4):
            self.rest[dofs[i]] -= force[i]
            for j in range(4):
                self.add(dofs[i], dofs[j], K[i][j])

    def depth(self, part, bed):
        return [bed[2] * c for c in plus(part.w, bed[3], -1)]

    def prove(self):
        """Sets C of each dof, Ce of each element, rho and Xh. Raises ValueError unless A certainly presses."""
        s, n = self.s, len(self.u)
        springs, closed = [F(0)] * n, [i - 1 for i in s["closed"]]
        for i in closed:
            springs[self.dof(self.p.pairs[i][0])] += self.p.pairs[i][3]
        reach = reach_of(SimpleNamespace(n=n, fixed=self.fixed, K=self.held), s, springs)
        eta = max(e.k * e.h**4 / e.EI for e in self.ends) / F("500.56")
        self.C = C = [F(0) if dof in self.fixed else root(c * (1 + eta)) for dof, c in enumerate(reach)]
        self.Ce = [max(C[e.dofs[0]], C[e.dofs[2]]) + e.h / 4 * max(C[e.dofs[1]], C[e.dofs[3]]) + root(e.h**3 / 192 / e.EI) for e in self.ends]
        nodal = sum((C[dof] * x)**2 for dof, x in enumerate(self.rest) if dof not in self.fixed)
        inside, outside, all = F(0), F(0), F(0)
        for part in (part for part in self.parts if part.beds):
            late, depths = plus(plus(part.w, part.wI, -1), part.before, -1), {bed[0]: self.depth(part, bed) for bed in part.beds}
            size, off = max(top(late), top([-c for c in late])), F(0)
            for number, k, n, face in part.beds:
                pressed = number + 1 in part.pressed
                off += k * ((size if pressed else 0) + max(0, top([(-c if pressed else c) for c in depths[number]])))
            k, share = max(((bed[1], last - first) for bed, first, last in part.certain), key=lambda x: x[1], default=(F(1), F(0)))
            inside += up(share * part.h * off * off / k)
            outside += up((1 - share) * part.h * off * self.Ce[part.e])
            all += up(part.h * off * off / sum(bed[1] for bed in part.beds))
        self.rho = root(nodal) + root(inside) + outside
        self.Xh = self.rho + root(all)
        for part in self.parts:
            for bed, first, last in part.certain:
                need(-top([-c for c in along(self.depth(part, bed), first, last - first)]) > self.Ce[part.e] * self.rho, "a stretch of a bed is taken as certain that may not press")
        for i in closed:
            need(self.deep[i] > C[self.dof(self.p.pairs[i][0])] * self.rho, "a pair is taken as closed that may be open")

    def claims(self):
        """Returns (kind, number without mesh error, bound on its error) for all numbers of the proof file in order; those of beds' pairs are pressures."""
        p, C, rho, Xh = self.p, self.C, self.rho, self.Xh
        ends = {False: lambda e: 12 * e.EI / e.h**3 + F(13, 35) * e.k * e.h, True: lambda e: 4 * e.EI / e.h + e.k * e.h**3 / 105}
        at = [("slope" if dof % 2 else "w", self.u[self.dof(dof)], C[self.dof(dof)] * rho) for dof in range(p.n)]
        for i, (dof, n, face, k) in enumerate(p.pairs):
            deep = n * (self.u[self.dof(dof)] - face)
            bound = min(k * C[self.dof(dof)], root(k) if i < p.contacts else k * C[self.dof(dof)]) * rho
            at.append(("force", k * max(deep, 0), bound))
        held = {}
        for dof in p.fixed:
            node, beside = self.dof(dof) // 2, lambda e: 0 <= e < len(self.ends)
            held[dof] = -self.rest[self.dof(dof)], root(sum(ends[dof % 2 > 0](self.ends[e]) for e in (node - 1, node) if beside(e))) * Xh
        for dof, k in p.supports:
            x, bound = held.pop(dof, (F(0), F(0))) if k is None else (-k * self.u[self.dof(dof)], min(root(k), k * C[self.dof(dof)]) * rho)
            at.append(("moment" if dof % 2 else "reaction", x, bound))
        N = self.node(1)
        for e in range(len(p.elements)):
            left, right = self.ends[N * e], self.ends[N * e + N - 1]
            for kind, x, own in (("shear", left.left[0], left), ("shear", right.right[0], right), ("moment", left.left[1], left), ("moment", right.right[1], right)):
                at.append((kind, x, root(ends[kind == "moment"](own)) * Xh))
        return at


    def of_bed(self, number):
        """Returns bounds on the force of a bed and on its length in contact."""
        force, more, stiffness, least, most = (F(0) for _ in range(5))
        for part, bed in ((part, bed) for part in self.parts for bed in part.beds if bed[0] == number):
            d, k, moved, pressed = self.depth(part, bed), bed[1], self.Ce[part.e] * self.rho, number + 1 in part.pressed
            down = [-c for c in d]
            force += k * part.h * product(d, [F(1)]) if pressed else 0
            more += up(k * part.h * max(F(0), top(down if pressed else d)))
            stiffness += k * part.h
            least, most = least + part.h * beyond(d, moved), most + part.h * (1 - beyond(down, moved))
        off = root(stiffness) * self.rho
        return (force - off, force + more + off), (least, most)


def check_mesh(p, mesh, f, settled, own, told, state):
    """Raises ValueError if the bounds of `mesh` do not hold for the numbers `told`, in the order of the proof file, and pairs with these statuses. Returns a message."""
    line = Line(p, mesh, f, settled, own)
    line.prove()
    error, of = ({kind: F(x) for kind, x in mesh[key].items()} for key in ("error", "of"))
    for number, ((kind, true, bound), x) in enumerate(zip(line.claims(), told, strict=True)):
        need(abs(F(x) - true) + bound <= error[kind] and abs(F(x)) <= of[kind], f"the mesh's bound on {kind} does not hold for number {number + 1}")
    for kind in mesh["extremes"]:
        need(kind in KINDS, f"extremes of {kind}")
        for key, sign in (("min", -1), ("max", 1)):
            claimed, reached, bound = sign * F(mesh["extremes"][kind][key]), -inf, -inf
            for part in line.parts:
                here, reached = most([sign * c for c in getattr(part, kind)], reached)
                bound = max(bound, here)
            size = F(mesh["of"][kind]) / 10**6 + F(1, 2**1000)
            need(reached - size <= claimed <= bound + size, f"the {key} of {kind} without mesh error is another")
    at_nodes = {}  # pressures of all beds: printed, of w1, bound
    for bed, (pairs, fixed) in enumerate(zip(p.bed_pairs, p.bed_held)):
        for i, share in pairs:
            deep, k = p.pairs[i][1] * (line.u[line.dof(p.pairs[i][0])] - p.pairs[i][2]), p.pairs[i][3] / share
            here = F(told[p.n + i]) / share, k * max(deep, 0), k * line.C[line.dof(p.pairs[i][0])] * line.rho
            at_nodes[p.pairs[i][0]] = [x + y for x, y in zip(at_nodes.get(p.pairs[i][0], (0, 0, 0)), here)]
            need(abs(here[0] - here[1]) + here[2] <= error["pressure"], "the mesh's bound on pressure does not hold")
        deep = [(p.held[i][1] * (line.u[line.dof(p.held[i][0])] - p.held[i][2]), p.held[i][3], share) for i, share in fixed]
        rounding = sum(p.held[i][3] * (abs(line.u[line.dof(p.held[i][0])]) + abs(p.held[i][2])) for i, _ in fixed) / 2**50
        sums = (sum(F(told[p.n + i]) for i, _ in pairs) + sum(k * max(d, 0) for d, k, _ in deep),
                sum(share for i, share in pairs if state[i] == "contact") + sum(share for d, _, share in deep if d >= 0))
        for kind, x, bounds in zip(("bed_force", "bed_contact"), sums, line.of_bed(bed)):
            size, off = abs(x), max(abs(x - y) for y in bounds)
            room = size / 2**48 + (rounding if kind == "bed_force" else 0)
            need(off <= error[kind] + room and size <= of[kind] + room, f"the mesh's bound on {kind} does not hold for bed {bed + 1}")
    need(all(abs(x - y) + z <= error["pressure"] for x, y, z in at_nodes.values()), "the mesh's bound on pressure does not hold where beds overlap")
    return f"; the mesh's error is proved: {len(told)} numbers"
