"""A problem file as fractions, for check_proof.py: from its decimals, without the program."""
from fractions import Fraction as F

from check_beam import beam, listed
from check_matrix import matrix
from check_plate import plate


class Problem:
    """K by rows, supports, pairs and loads, as fractions."""

    def __init__(self, t, folder):
        if "matrix" in t:
            self.K, t = matrix(t["matrix"], t, folder)
            self.names, self.at, share, self.elements = ["w"], {}, [F(1)] * len(self.K), []
        else:
            self.names, self.at, share, self.elements = plate(t["plate"]) if "plate" in t else beam(t["beam"], t)
            self.K = [{i: F(0)} for i in range(len(share) * len(self.names))]
        self.steps, self.n = t["step"], len(self.K)
        for element, dofs, _ in self.elements:
            for i, j, k in ((i, j, k) for i, row in zip(dofs, element.stiffness) for j, k in zip(dofs, row)):
                self.K[i][j] = self.K[i].get(j, 0) + k
        self.supports = []  # (dof, its spring; None: fixed)
        for s in t.get("support", []):
            springs = [(name, F(s["spring"][name])) for name in self.names if name in s.get("spring", {})]
            for name, spring in [(name, None) for name in listed(s.get("fix", []))] + springs:
                self.supports += [(self.dof(node, name), spring) for node in self.nodes(s, len(share))]
        for dof, spring in self.supports:
            self.K[dof][dof] += spring or 0
        self.fixed = {dof for dof, spring in self.supports if spring is None}
        self.pairs = []  # (dof, n, face, stiffness)
        for c in t.get("contact", []) + t.get("bed", []):
            for i, node in enumerate(self.nodes(c, len(share))):
                face, k = (v[i] if isinstance(v, list) else v for v in (c["face"], c.get("stiffness", c.get("modulus"))))
                face = face if not isinstance(face, dict) else sum(
                    F(a) * list(self.at)[node]**power for power, a in enumerate(face["polynomial"]))
                k = F(k) * (share[node] if "modulus" in c else 1)
                if "modulus" not in c or self.dof(node, "w") not in self.fixed:
                    self.pairs.append((self.dof(node, "w"), 1 if c.get("surface") == "above" else -1, F(face), k))

    def dof(self, node, name):
        return node * len(self.names) + self.names.index(name)

    def nodes(self, t, count):
        """Nodes from 0 of a table: node, nodes, x or at; a bed's are all that no support fixes, by default all."""
        if "x" in t or "at" in t:
            places = listed(t["x"]) if "x" in t else t["at"] if isinstance(t["at"][0], list) else [t["at"]]
            return [self.at[tuple(place) if "at" in t else place] for place in places]
        which = t.get("nodes", t.get("node", "all"))
        if isinstance(which, str):
            first, last = ("1", count) if which == "all" else which.split("..")
            return list(range(int(first) - 1, int(last)))
        return [node - 1 for node in listed(which)]

    def loads(self, step):
        """Loads [dofs], the settlement of each fixed dof, and each element's own loads."""
        f, settled, own = [F(0)] * self.n, dict.fromkeys(self.fixed, F(0)), [[F(0)] * len(dofs) for _, dofs, _ in self.elements]
        for part in listed(step.get("uniform", [])):
            part = part if isinstance(part, dict) else {"value": part}
            q = [F(c) for c in part.get("polynomial", [part.get("value")])]
            for e in self.nodes({"nodes": part.get("elements", "all")}, len(own)):
                own[e] = [a + b for a, b in zip(own[e], self.elements[e][0].load(q, self.elements[e][2]))]
        for dof, force in ((dof, force) for (_, dofs, _), work in zip(self.elements, own) for dof, force in zip(dofs, work)):
            f[dof] += force
        given = [(part, f) for part in step.get("point", [])] + [(part, settled) for part in step.get("settlement", [])]
        for part, into in given:
            for node in self.nodes(part, 0):
                for name in part.keys() & set(self.names):
                    into[self.dof(node, name)] += F(part[name])
        return f, settled, own
