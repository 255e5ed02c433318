"""Writes PB16 with N intervals on each side: python3 reference/benchmarks/membrane.py FOLDER N. PB16 has 20.

The obstacle problem of PETSc's examples (snes/tutorials/ex9.c): a membrane hangs over the unit ball
on the square from -2 to 2:
    u >= sqrt(1 - r^2),   -laplace u = 0 where it does not touch,   u = exact on the boundary,
    exact: the ball up to r = R, beyond it u = -A log r + B,   A = R^2 / sqrt(1 - R^2),   B = A log 2,   R^2 log(2 / R) = 1 - R^2.
The matrix is that of the five-point formula, times h^2. It has no boundary nodes; their values are loads on their
neighbours. The unknowns are w = u - 1, so that the top of the ball is at 0 and the unloaded membrane is not inside it.
"""
import sys
from math import hypot, log, sqrt
from pathlib import Path

R = 0.697965148223374
A = R**2 / sqrt(1 - R**2)
STIFFNESS = 1e6  # of the ball at each node; the diagonal of the matrix is 4
HIGHEST = 0.9  # largest r of a pair; contact ends at r = R


def exact(x, y):
    """Returns the exact w = u - 1."""
    r = hypot(x, y)
    return (sqrt(1 - r**2) if r <= R else A * log(2 / r)) - 1


class Membrane:
    def __init__(self, intervals):
        self.last = range(1, intervals)
        self.places = {f"{i}_{j}": (4 * i / intervals - 2, 4 * j / intervals - 2) for j in self.last for i in self.last}
        self.names = list(self.places)
        width, self.entries, self.loads = len(self.last), [], {}
        for row, name in enumerate(self.names):
            self.entries += [(row + 1, row + 1, 4)] + [(row + 1, row + 1 - left, -1) for left, there in ((1, row % width), (width, row >= width)) if there]
            i, j = map(int, name.split("_"))
            beyond = [(a, b) for a, b in ((i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)) if {a, b} & {0, intervals}]
            if beyond:
                self.loads[name] = sum(exact(4 * a / intervals - 2, 4 * b / intervals - 2) for a, b in beyond)
        self.faces = {name: sqrt(1 - hypot(*place)**2) - 1 for name, place in self.places.items() if hypot(*place) <= HIGHEST}

    def write(self, folder, name):
        head = f"%%MatrixMarket matrix coordinate real symmetric\n% five-point formula on a square without its boundary\n{len(self.names)} {len(self.names)}"
        rows = "".join(f"{row} {column} {value}\n" for row, column, value in self.entries)
        (folder / f"{name}.mtx").write_text(f"{head} {len(self.entries)}\n{rows}")
        (folder / f"{name}.dof").write_text("".join(f"{label}.z\n" for label in self.names))
        (folder / f"{name}.xyz").write_text("# node x y z\n" + "".join(f"{label} {x:g} {y:g} 0\n" for label, (x, y) in self.places.items()))
        (folder / f"{name}.toml").write_text(self.problem(name))

    def problem(self, name):
        pairs = ",\n  ".join(f'"{label}.z"' for label in self.faces)
        faces = ",\n  ".join(f"{face:.12g}" for face in self.faces.values())
        loads = ",\n  ".join(f'{{ dof = "{label}.z", value = {load:.12g} }}' for label, load in self.loads.items())
        return f"""# PB16  A membrane over a ball: the obstacle problem of PETSc's examples (snes/tutorials/ex9.c), whose solution is known.
#
# Membrane of tension 1 on the square from -2 to 2, w = 0 at the top of the unit ball below it:
#     w = sqrt(1 - r^2) - 1 up to r = R = 0.697965, then A log(2 / r) - 1,   A = R^2 / sqrt(1 - R^2),   R^2 log(2 / R) = 1 - R^2,
# on the boundary too, which loads its neighbours in the five-point formula. Contact begins at the top and grows.
# reference/benchmarks/membrane.py writes these files.

title = "PB16  Membrane over a ball"

[matrix]
stiffness   = "{name}.mtx"
dofs        = "{name}.dof"
coordinates = "{name}.xyz"

[[contact]]
dofs = [
  {pairs} ]
surface   = "below"
face = [
  {faces} ]
stiffness = {STIFFNESS:.1e}

[[step]]
point = [
  {loads} ]
"""


if __name__ == "__main__":
    Membrane(int(sys.argv[2])).write(Path(sys.argv[1]), "pb16-membrane-over-ball")
