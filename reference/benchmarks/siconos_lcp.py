"""Solves benchmark problems of this folder as linear complementarity problems, by Lemke's method in Siconos.

    python3 reference/benchmarks/siconos_lcp.py [NAME..] > theirs.json    NAME: such as pb01-cantilever-tip-stop
    python3 reference/benchmarks/judge.py theirs.json

Needs python3-siconos and numpy. reference/check_problem.py reads K from the problem file, without contct. Every pair is
a spring k that can pull, and z >= 0 is the force that cancels its tension. With the compliance A of the structure on
all springs, the displacements u0 at z = 0, the faces c, and n = +1 for a face above and -1 for a face below:
    force(z) = k n (u0 - c) + (1 - k n A n) z >= 0,   z >= 0,   force(z) z = 0.
"""
import json
import sys
import tomllib
from decimal import Decimal
from pathlib import Path

import numpy
import siconos.numerics as numerics

HERE = Path(__file__).resolve().parent
TOLERANCE = 1e-4
sys.dont_write_bytecode = True
sys.path[:0] = [str(HERE), str(HERE.parent)]
from calculix import words  # noqa: E402
from check_problem import Problem  # noqa: E402


class Structure:
    """A problem's K, and the compliance of its free dofs with the springs of all pairs."""

    def __init__(self, file):
        toml = tomllib.loads(file.read_text(), parse_float=Decimal)
        self.problem = problem = Problem(toml, file.parent)
        self.K = numpy.zeros((problem.n, problem.n))
        for i, row in enumerate(problem.K):
            for j, k in row.items():
                self.K[i, j] = float(k)
        self.sees = numpy.zeros((len(problem.pairs), problem.n))  # sees @ u: n times the displacement of each pair
        for row, (dof, n, *_), other in zip(self.sees, problem.pairs, problem.others):
            row[dof] = n
            if other is not None:
                row[other] = -n
        self.stiffness = numpy.array([float(k) for *_, k in problem.pairs])
        self.free = numpy.array(sorted(set(range(problem.n)) - problem.fixed))
        held = (self.K + self.sees.T @ (self.stiffness[:, None] * self.sees))[numpy.ix_(self.free, self.free)]
        self.compliance = numpy.linalg.inv(held)

    def end_of(self, step):
        """Returns displacements, contact forces, gaps, and the reactions of fixed dofs [dofs], at the end of a step."""
        loads, settled, _ = self.problem.loads(step)
        loads, u = numpy.array([float(f) for f in loads]), numpy.zeros(self.problem.n)
        for dof, value in settled.items():
            u[dof] = float(value)
        faces = numpy.array([n * float(face) for _, n, face, _ in self.problem.pairs])
        free, sees, k = self.free, self.sees[:, self.free], self.stiffness
        right = loads - self.K @ u + self.sees.T @ (k * (faces - self.sees @ u))
        u[free] = self.compliance @ right[free]
        z = self.take_tension(k * (self.sees @ u - faces), numpy.eye(len(k)) - (k[:, None] * sees) @ self.compliance @ sees.T)
        u[free] += self.compliance @ (sees.T @ -z) if len(k) else 0.0
        gaps = faces - self.sees @ u
        forces = numpy.where(z > 0, 0.0, -k * gaps)
        return u, forces, numpy.where(z > 0, gaps, 0.0), self.K @ u + self.sees.T @ forces - loads

    @staticmethod
    def take_tension(pull, M):
        if not len(pull):
            return pull
        z, force = numpy.zeros(len(pull)), numpy.zeros(len(pull))
        size = max(abs(pull).max(), 1e-300)
        status = numerics.lcp_lexicolemke(numerics.LCP(M, pull / size), z, force, numerics.SolverOptions(numerics.SICONOS_LCP_LEMKE))
        if status != 0:
            raise ValueError(f"Lemke's method ends with status {status}")
        return z * size


def answers(name):
    structure = Structure(HERE.parent / "problems" / f"{name}.toml")
    problem, data = structure.problem, json.loads((HERE / f"{name}.json").read_text())
    labels, springs = data["structure"].get("dofs", []), {dof: float(k) for dof, k in problem.supports if k is not None}
    found = []
    for number, step in enumerate(problem.steps, 1):
        u, forces, gaps, held = structure.end_of(step)
        for asked in (n for n in data["numbers"] if n["step"] == number):
            quantity, value = asked["quantity"], None
            if quantity in (*problem.names, "value") and ("node" in asked or "dof" in asked):
                place = labels.index(asked["dof"]) if labels and "dof" in asked else asked.get("node", 0) - 1
                value = u[place if labels or not problem.lines else problem.dof(place, quantity)]
            elif quantity in ("force", "gap"):
                value = (forces if quantity == "force" else gaps)[asked["pair"] - 1]
            elif quantity == "state":
                value = "contact" if forces[asked["pair"] - 1] > 0 else "separated"
            elif quantity == "contacts":
                value = int((forces > 0).sum())
            elif quantity == "reaction":
                dof = problem.dof(asked["node"] - 1, asked["dof"])
                value = -springs[dof] * u[dof] if dof in springs else held[dof]
            if value is not None:
                found.append({key: asked[key] for key in asked if key not in ("exact", "compared_with")}
                             | {"value": value if isinstance(value, (str, int)) else float(value)})
    return found


def results(names):
    return {"format": "contct-answers-1", "program": "Siconos", "version": "4.4", "tolerance": TOLERANCE, "problems": {name: answers(name) for name in names}}


if __name__ == "__main__":
    sys.stdout.write(words(results(sys.argv[1:] or sorted(file.stem for file in (HERE.parent / "problems").glob("*.toml")))))
