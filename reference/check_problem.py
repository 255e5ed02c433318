"""Reads the decimals of a problem file into fractions, without the program, for check_proof.py."""
from fractions import Fraction as F
from itertools import product
from types import SimpleNamespace

from check_beam import beam, find, listed, need, numbers, only, positive, real
from check_matrix import matrix
from check_plate import plate

TOP = {"title", "project", "author", "revision", "units", "beam", "plate", "matrix", "hinge", "support", "contact", "bed", "step", "case", "combination", "train", "watch"}


def one_each(values, nodes):
    return [real(x) for x in (values if isinstance(values, list) else [values] * len(nodes))]


def combinations(t, lines):
    """Returns a list of (table of loads, factor) for each combination and each place of a train."""
    for tables in (t.get("case", []), t.get("combination", []) + t.get("train", [])):
        names = [c["name"] for c in tables]
        need(all(type(name) is str and name.strip() for name in names) and len(set(names)) == len(names), f"names that are no text, or not unique: {names}")
    cases = {c["name"]: {key: value for key, value in c.items() if key != "name"} for c in t.get("case", [])}
    need("step" not in t, "steps beside combinations")

    def terms(c):
        need(c["terms"] and c["terms"].keys() <= cases.keys(), f"terms of {c['name']}: not factors of one case or more")
        return [(cases[name], real(factor)) for name, factor in c["terms"].items()]
    steps = [terms(only(c, {"name", "terms"})) for c in t.get("combination", [])]
    for train in t.get("train", []):
        need(len(lines) == 1 and only(train, {"name", "axles", "from", "to", "by", "terms", "factor"})["axles"], "a train without axles or a beam")
        line, first, last, by, factor = lines[0], *(real(x) for x in (train["from"], train["to"], train["by"], train.get("factor", 1)))
        need(first <= last and (last - first) / positive(by) < 10000, "a train whose `to` is before `from`, or with more than 10000 places")
        for k in range(int((last - first) / by) + 1):
            at = [(first + k * by + real(axle["at"]), axle["w"]) for axle in train["axles"] if only(axle, {"at", "w"})]
            steps.append((terms(train) if "terms" in train else []) + [({"point": [{"x": x, "w": w}]}, factor) for x, w in at if line[0] <= x <= line[-1]])
    return steps


class Problem:
    """K by rows, supports, pairs and loads in fractions."""

    def __init__(self, t, folder, count=None):
        only(t, TOP)
        need(len(t.keys() & {"beam", "plate", "matrix"}) == 1, "not one structure")
        need("hinge" not in t or "beam" in t, "a hinge without a beam")
        self.whole = "matrix" not in t  # K is semidefinite, fixed dofs included
        self.definite, self.of_elements = "matrix" not in t, 0  # K is proved semidefinite; number of element results
        self.rounded = t.get("matrix", {}).get("free_motions", 0) > 0  # K may be indefinite, because its entries are rounded
        if "matrix" in t:
            self.K, t = matrix(t["matrix"], t, folder)
            self.names, self.lines, share, self.elements, self.span = ["w"], [], [F(1)] * len(self.K), [], F(0)
        else:
            self.names, self.lines, share, self.elements = plate(t["plate"], count) if "plate" in t else beam(t["beam"], t, count)
            self.K = [{i: F(0)} for i in range(len(share) * len(self.names))]
            self.span = max(line[-1] - line[0] for line in self.lines)
            self.of_elements = (4 if "beam" in t else 12) * len(self.elements)
        combined = t.keys() & {"combination", "train"}
        self.steps, self.n, self.count = combinations(t, self.lines) if combined else t["step"], len(self.K), len(share)
        need(type(self.steps) is list and self.steps and (combined or "case" not in t), "no step, or cases without combinations")
        self.told_faces = []
        for element, dofs, _ in self.elements:
            for i, j, k in ((i, j, k) for i, row in zip(dofs, element.stiffness) for j, k in zip(dofs, row)):
                self.K[i][j] = self.K[i].get(j, 0) + k
        self.supports = []  # (dof, spring stiffness, or None if fixed)
        for s in t.get("support", []):
            self.support(s, self.nodes(s, {"name", "fix", "spring"}))
        self.fixed = {dof for dof, spring in self.supports if spring is None}
        self.continuum, self.bed_pairs, self.bed_held = [], [], []  # of each bed its intervals, n and face; its pairs, and those at fixed nodes, with their tributary lengths
        self.pairs, self.others, self.held = [], [], []  # (dof, n, face, stiffness); the dof that carries the face, or None; pairs of beds at fixed nodes
        for c in t.get("contact", []):
            nodes = self.nodes(c, {"name", "surface", "face", "stiffness", "state"} | (set() if self.lines else {"other"}))
            self.contact(c, nodes, c["surface"], one_each(c["stiffness"], nodes))
        self.contacts = len(self.pairs)
        for c in t.get("bed", []):
            springs = self.bed(c, share)
            first = len(self.pairs), len(self.held)
            self.contact(c, [*springs], c.get("surface", "below"), [*springs.values()], self.fixed)
            if len(self.lines) == 1:
                self.along(c, *first)
        self.unmoved, self.unmoved_held = self.pairs, self.held
        self.kinds = {"w": self.n} | ({"slope": self.n, "moment": self.n} if self.elements else {}) | ({"shear": self.n} if len(self.lines) == 1 else {})
        self.kinds |= {"force": len(self.pairs), "gap": len(self.pairs)} if self.pairs else {}
        self.kinds |= {"reaction": sum(dof % len(self.names) == 0 for dof, _ in self.supports)} if self.supports else {}  # kind: number of results

    def support(self, s, nodes):
        need("fix" in s or "spring" in s, "a support with neither fix nor spring")
        fixed, springs = listed(s.get("fix", [])), only(s.get("spring", {}), self.names)
        need(len(set(fixed)) == len(fixed), "a dof is fixed twice")
        held = [(name, None) for name in fixed] + [(name, positive(real(springs[name]))) for name in self.names if name in springs]
        self.supports += [(self.dof(node, name), spring) for name, spring in held for node in nodes]
        for dof, spring in ((self.dof(node, name), spring) for name, spring in held for node in nodes):
            self.K[dof][dof] += spring or 0

    def bed(self, c, share):
        """Returns the stiffness of a bed at each of its nodes: the modulus times what of the half elements there lies inside."""
        pieces = [piece for piece in listed(c["modulus"]) if isinstance(piece, dict) and len(self.lines) == 1]
        if not pieces and not c.keys() & {"from", "to"}:
            return {node: real(c["modulus"]) * share[node] for node in self.nodes(c, {"name", "surface", "face", "modulus", "state"}, "all")}
        only(c, {"name", "from", "to", "surface", "face", "modulus", "state"})
        need(type(c["face"]) is not list, "a list of faces without nodes")
        ends, springs, half = {key: c[key] for key in ("from", "to") if key in c}, {}, F(1, 2)
        for piece in pieces or [{"value": c["modulus"]}]:
            part = ends | only(piece, {"to", "value"})
            for e, sides in self.parts(part):
                at = [e] if len(self.lines) == 1 else [e % (len(self.lines[0]) - 1), e // (len(self.lines[0]) - 1)]
                halves = [[(k, (line[k + 1] - line[k]) * (min(b, half) - min(a, half))), (k + 1, (line[k + 1] - line[k]) * (max(b, half) - max(a, half)))]
                          for k, (a, b), line in zip(at, sides, self.lines)]
                for (i, x), (j, y) in product(halves[0], halves[1] if len(halves) == 2 else [(0, 1)]):
                    springs[i + j * len(self.lines[0])] = springs.get(i + j * len(self.lines[0]), 0) + positive(real(piece["value"])) * x * y
            ends = ends | ({"from": piece["to"]} if pieces else {})
        place = lambda x: self.lines[0][-1] if x is None else real(x) if (k := find(self.lines[0], x)) is None else self.lines[0][k]
        need(not pieces or place(pieces[-1]["to"]) == place(c.get("to")), "a bed with pieces that end elsewhere")
        return {node: k for node, k in sorted(springs.items()) if k}

    def along(self, c, first, first_held):
        """Adds a bed along a beam to `continuum`: where it acts, with which modulus, and its face as a polynomial in x in each element."""
        x, place = self.lines[0], lambda at: self.lines[0][find(self.lines[0], at)] if find(self.lines[0], at) is not None else real(at)
        middle = [x[0]] + [(a + b) / 2 for a, b in zip(x, x[1:])] + [x[-1]]
        begin, end = place(c["from"]) if "from" in c else x[0], place(c["to"]) if "to" in c else x[-1]
        parts = [[begin, end, None]]
        if isinstance(c["modulus"], list):
            ends = [begin] + [place(piece["to"]) for piece in c["modulus"]]
            parts = [[a, b, real(piece["value"])] for a, b, piece in zip(ends, ends[1:], c["modulus"])]
        elif not c.keys() & {"from", "to"}:
            nodes = sorted(self.nodes(c, {"name", "surface", "face", "modulus", "state"}, "all"))
            ends = sorted({middle[node] for node in nodes} ^ {middle[node + 1] for node in nodes})  # of nodes in a row
            parts = [[a, b, None] for a, b in zip(ends[::2], ends[1::2])]
        parts = [(a, b, real(c["modulus"]) if k is None else k) for a, b, k in parts]
        powers = [real(a) for a in c["face"]["polynomial"]] if isinstance(c["face"], dict) else []
        faces = {pair[0] // 2: F(0) if powers else pair[2] for pair in self.pairs[first:] + self.held[first_held:]}

        def face(e, moved):
            at = [faces[node] + moved.get(2 * node, 0) if node in faces else None for node in (e, e + 1)]
            a = next((y for y in at if y is not None), F(0))
            rise = (a if at[1] is None else at[1]) - a
            line = [a - rise * x[e] / (x[e + 1] - x[e]), rise / (x[e + 1] - x[e])]
            return [y + (line[i] if i < 2 else 0) for i, y in enumerate(powers + [F(0)] * (2 - len(powers)))]
        self.continuum.append(SimpleNamespace(parts=parts, n=self.pairs[first][1], face=face))
        share = lambda node: sum(max(F(0), min(b, middle[node + 1]) - max(a, middle[node])) for a, b, _ in parts)
        for of, all, begin in ((self.bed_pairs, self.pairs, first), (self.bed_held, self.held, first_held)):
            of.append([(i, share(all[i][0] // 2)) for i in range(begin, len(all))])

    def contact(self, c, nodes, surface, stiffness, without=()):
        """Adds a pair at each node; at those whose w is in `without` one that only adds to the reaction."""
        if isinstance(c["face"], dict):
            powers = self.polynomial(only(c["face"], {"polynomial"})["polynomial"])
            faces = [sum(a * self.lines[0][node]**power for power, a in enumerate(powers)) for node in nodes]
        else:
            faces = one_each(c["face"], nodes)
        others = (c["other"] if len(c["other"]) > 1 else c["other"] * len(nodes)) if "other" in c else [None] * len(nodes)
        for node, x, k, other in zip(nodes, faces, stiffness, others, strict=True):
            n, state = {"above": 1, "below": -1}[surface], c.get("state", "separated")
            need(n * x >= 0 and (state == "separated" or (state == "contact" and x == 0)), f"a face at {x} {surface}, {state}, of the undeformed structure")
            need(other is None or (other != node and not {node, other} & self.fixed), "a pair of a dof with itself, or with a fixed one")
            pair = self.dof(node, "w"), n, x, positive(k)
            if pair[0] in without:
                self.held.append(pair)
                continue
            self.pairs.append(pair)
            self.others.append(other)

    def seen(self, i, u):
        """Returns the displacement of pair i: that of its dof, relative to the dof that carries the face."""
        return u[self.pairs[i][0]] - (0 if self.others[i] is None else u[self.others[i]])

    def polynomial(self, coefficients):
        need(len(self.lines) == 1 and 0 < len(coefficients) < 22, "a polynomial that is not along a beam, or without 1 to 21 coefficients")
        return [real(a) for a in coefficients]

    def dof(self, node, name):
        return node * len(self.names) + self.names.index(name)

    def nodes(self, t, keys, otherwise=None):
        """Returns the nodes, from 0, that a table names by node, nodes, x or at.

        Raises ValueError for other keys that are not in `keys`. `otherwise`: the nodes of a table that names none.
        """
        place = {0: ["node", "nodes"], 1: ["node", "nodes", "x"], 2: ["node", "nodes", "at"]}[len(self.lines)]
        only(t, {*place, *keys})
        named = [key for key in place if key in t]
        need(len(named) == 1 or (not named and otherwise), f"not one of {place}")
        if not named or named[0] in ("node", "nodes"):
            return numbers([t["node"]] if "node" in t else t.get("nodes", otherwise), self.count)
        points = [[x] for x in listed(t["x"])] if "x" in t else t["at"] if isinstance(t["at"][0], list) else [t["at"]]
        found = [[find(line, x) for line, x in zip(self.lines, point, strict=True)] for point in points]
        need(found and all(None not in at for at in found), "a place where there is no node")
        return numbers([1 + sum(i * stride for i, stride in zip(at, (1, len(self.lines[0])))) for at in found], self.count)

    def combined(self, terms):
        """Returns what `loads` returns, for a sum of tables with factors."""
        moved, acting = {}, {}
        f, settled, own = [F(0)] * self.n, dict.fromkeys(self.fixed, F(0)), [[F(0)] * (len(dofs) + 3) for _, dofs, _ in self.elements]
        for table, factor in terms:
            force, place, work = self.loads(table)
            moved = {dof: moved.get(dof, 0) + factor * self.moved.get(dof, 0) for dof in moved | self.moved}
            acting = {at: acting.get(at, 0) + factor * self.acting.get(at, 0) for at in acting | self.acting}
            f = [a + factor * b for a, b in zip(f, force)]
            settled = {dof: a + factor * place[dof] for dof, a in settled.items()}
            own = [[a + factor * b for a, b in zip(*at)] for at in zip(own, work)]
        self.move_faces(moved)
        self.acting = acting
        return f, settled, own

    def loads(self, step):
        """Moves the faces; returns loads [dofs], settlements of fixed dofs, and `work` of each element's loads.

        Sets `acting`, which is 0 everywhere if the loads inside a beam cancel: the jump of each coefficient of a load
        where this load begins and ends, and each load at a point.
        """
        if isinstance(step, list):
            return self.combined(step)
        f, settled, own = [F(0)] * self.n, {}, [[F(0)] * (len(dofs) + 3) for _, dofs, _ in self.elements]
        self.acting = {}
        only(step, {"name", "point", "settlement", "move"} | ({"uniform", "self_weight"} if self.elements else set()) | ({"curvature"} if len(self.lines) == 1 else {"moment"} if self.elements else set()))

        def add(e, work, kind="uniform", values=(), shares=(F(0), F(1))):
            own[e] = [a + b for a, b in zip(own[e], work)]
            for (power, a), (t, sign) in product(enumerate(values if len(self.lines) == 1 else ()), zip(shares, (1, -1))):
                at = kind, self.elements[e][2] + t * self.elements[e][0].h, power
                self.acting[at] = self.acting.get(at, 0) + sign * a
        if step.get("self_weight", False):
            need(self.elements and all(e.weight is not None for e, _, _ in self.elements), "self-weight without a weight")
            for e, (element, _, left) in enumerate(self.elements):
                add(e, element.load([-element.weight], left), values=[-element.weight])
        for part in listed(step.get("uniform", [])):
            part = only(part, {"value", "polynomial", "elements", "from", "to"}) if isinstance(part, dict) else {"value": part}
            need(("value" in part) + ("polynomial" in part) == 1, "not one of value and polynomial")
            q = [real(part["value"])] if "value" in part else self.polynomial(part["polynomial"])
            if part.keys() & {"from", "to"}:
                need("elements" not in part, "a load on elements and from a place")
                for e, shares in self.parts(part):
                    add(e, self.elements[e][0].load(q, self.elements[e][2], *(shares[0] if len(shares) == 1 else shares)), "uniform", q, shares[0])
                continue
            for e in numbers(part.get("elements", "all"), len(own)):
                add(e, self.elements[e][0].load(q, self.elements[e][2]), values=q)
        for part in step.get("curvature", []):
            for e, shares in self.parts(only(part, {"value", "from", "to"})):
                add(e, self.elements[e][0].bent(real(part["value"]), *shares[0]), "curvature", [real(part["value"])], shares[0])
        for part in step.get("moment", []):
            need(only(part, {"wx", "wy", "from", "to"}).keys() & {"wx", "wy"}, "a moment on no slope")
            on = [(self.elements[e][0], e, shares) for e, shares in self.parts(part)]
            area = sum(element.a * (x[1] - x[0]) * element.b * (y[1] - y[0]) for element, _, (x, y) in on)
            for (element, e, shares), (key, slope) in product(on, (("wx", (1, 0)), ("wy", (0, 1)))):
                add(e, element.load([real(part.get(key, 0)) / area], None, *shares, slope))
        points = step.get("point", [])
        for part, x in ((part, x) for part in points if len(self.lines) == 1 for x in listed(part.get("x", []))):
            if find(self.lines[0], x) is None:
                e, t = self.inside(0, real(x))
                need(only(part, {"x", *self.names}).keys() & set(self.names), "a load of no dof")
                add(e, self.elements[e][0].point(real(part.get("w", 0)), real(part.get("theta", 0)), t), "point",
                    [real(part.get("w", 0)), real(part.get("theta", 0))], [t])
        for dof, force in ((dof, force) for (_, dofs, _), work in zip(self.elements, own) for dof, force in zip(dofs, work)):
            f[dof] += force
        for part in points:
            if len(self.lines) == 1 and "x" in part:  # loads between nodes are already in f
                part = part | {"x": [x for x in listed(part["x"]) if find(self.lines[0], x) is not None]}
            for dof, value in self.at_dofs(part) if part.get("x", True) != [] else []:
                f[dof] += value
        for part in step.get("settlement", []):
            for dof, value in self.at_dofs(part):
                need(dof in self.fixed and dof not in settled, "a settlement of a dof that is free, or a second one")
                settled[dof] = value
        moved = {}
        for dof, value in (at for part in step.get("move", []) for at in self.at_dofs(part)):
            need(dof in {pair[0] for pair in self.unmoved + self.unmoved_held} - set(self.others) and dof not in moved, "a move where there is no pair, or a second one")
            moved[dof] = value
        self.move_faces(moved)
        return f, dict.fromkeys(self.fixed, F(0)) | settled, own

    def inside(self, i, x):
        """Returns the interval of line i that contains x, and the share of the interval before x."""
        line = self.lines[i]
        need(line[0] <= x <= line[-1], f"a load at {x}, which is outside the structure")
        e = next(k for k in range(len(line) - 1) if line[k] <= x <= line[k + 1])
        return e, (x - line[e]) / (line[e + 1] - line[e])

    def parts(self, part):
        """Returns the elements between "from" and "to", with the shares of their sides where the part begins and ends."""
        sides = []
        for i, line in enumerate(self.lines):
            named = [(part[key] if len(self.lines) == 1 else part[key][i]) if key in part else line[k] for key, k in (("from", 0), ("to", -1))]
            ends = [line[find(line, x)] if find(line, x) is not None else real(x) for x in named]
            need(line[0] <= ends[0] < ends[1] <= line[-1], "a load from a place that is not before its end")
            sides.append([(e, [min(max((x - a) / (b - a), F(0)), F(1)) for x in ends]) for e, (a, b) in enumerate(zip(line, line[1:])) if ends[0] < b and a < ends[1]])
        if len(sides) == 1:
            return [(e, [at]) for e, at in sides[0]]
        return [(j * (len(self.lines[0]) - 1) + i, [x, y]) for j, y in sides[1] for i, x in sides[0]]

    def move_faces(self, moved):
        """Adds the moves to the faces: exactly in `pairs`, and rounded as in the program in `told_faces`."""
        self.moved = moved
        self.pairs, self.held = ([(dof, n, face + moved.get(dof, 0), k) for dof, n, face, k in of] for of in (self.unmoved, self.unmoved_held))
        self.told_faces = [float(face) + float(moved.get(dof, 0)) for dof, _, face, _ in self.unmoved]

    def at_dofs(self, part):
        """Returns (dof, value) for each dof that a table names."""
        nodes, names = self.nodes(part, self.names), [name for name in self.names if name in part]
        need(names, "a load or a settlement of no dof")
        return [(self.dof(node, name), real(part[name])) for node in nodes for name in names]
