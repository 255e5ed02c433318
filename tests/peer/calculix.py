"""CalculiX by its own program: beams, plates and blocks of bricks as its input files, and what it prints of nodes.

Its quadratic elements stand for ours: B32R lines and S8R rectangles. Deflection is along z; a beam lies on the x axis. CalculiX starts
with every pair separated, so the supports must hold the structure by themselves, and its beams and plates have no springs for
rotations.
"""
import re
import subprocess
import sys
import tomllib
from collections import defaultdict
from fractions import Fraction as F
from math import comb
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "reference"))
from check_beam import listed, numbers  # noqa: E402
from check_plate import real  # noqa: E402
from check_problem import Problem  # noqa: E402

# Largest deflection over the structure's length: CalculiX's NLGEOM must not notice that anything turns.
SMALLNESS = 1e-7
# All forces together, in the unit of force that the deck counts in: CalculiX treats forces far below 0.01 as zero.
TOTAL_FORCE = 1e6
# How far a spring's table reaches, in largest deflections: Newton's first steps may go far, and outside it the force is constant. A second
# point is near the answer, since the far end, rounded to a field's digits, would misplace a stiff spring's face.
FAR_AWAY, NEAR = 1e6, 4
# Of each of our dofs w, wx (theta), wy: CalculiX's direction, 1 to 3 along the axes and 4 to 6 about them, and the sign.
TURNED = ((3, 1.0), (5, -1.0), (4, 1.0))


def field(x):
    """CalculiX cuts a field after 20 characters; this has 19 at most."""
    return f"{float(x):.12e}"


def run_ccx(ccx, folder, job, deck):
    for old in (".dat", ".sti", ".dof"):  # not those from before
        Path(folder, job + old).unlink(missing_ok=True)
    Path(folder, f"{job}.inp").write_text(deck)
    done = subprocess.run([ccx, job], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ValueError(f"CalculiX on {job}: exit {done.returncode}\n{done.stdout[-1000:]}")


def values_at_end(folder, job, quantity, name, first, count):
    """Values along x, y, z of nodes `first`, `first` + 1 and so on at the end of the step, which lasts from time 0 to 1."""
    tables = re.split(r"^ (\w+) \(\w+,\w+,\w+\) for set (\w+) and time +(\S+)$", Path(folder, f"{job}.dat").read_text(), flags=re.M)
    of_set = [text for what, which, time, text in zip(tables[1::4], tables[2::4], tables[3::4], tables[4::4])
              if (what, which) == (quantity, name) and float(time) == 1.0]
    if not of_set:
        raise ValueError(f"{job}: found no {quantity} for set {name} at time 1: CalculiX did not reach the step's end")
    rows = [line.split() for line in of_set[-1].splitlines() if line.strip()]
    at = {int(node): [float(re.sub(r"(\d)([+-]\d{3})$", r"\1E\2", x)) for x in values] for node, *values in rows}
    return [at[node] for node in range(first, first + count)]


def load_on_line(q, left, h):
    """Work of the polynomial q in x on the three shape functions of a quadratic line from x = left, h long."""
    own = [sum(c * comb(k, i) * left**(k - i) for k, c in enumerate(q) if k >= i) * h**(i + 1) for i in range(len(q))]
    return [sum(c * a / F(i + j + 1) for i, c in enumerate(own) for j, a in enumerate(shape)) for shape in ((1, -3, 2), (0, 4, -4), (0, -1, 2))]


class Mesh:
    """Nodes and elements from 0, the problem's own nodes first and in their order; forces and displacements by (node, direction)."""

    def __init__(self, problem, step, refine):
        self.problem, self.nodes, self.elements, self.origins = problem, [], [], []
        self.forces, self.settled, per = defaultdict(float), {}, len(problem.names)
        self.fixed = [(dof // per, TURNED[dof % per][0]) for dof in sorted(problem.fixed)]
        for part in step.get("point", []):
            for dof, value in problem.at_dofs(part):
                self.forces[dof // per, TURNED[dof % per][0]] += TURNED[dof % per][1] * float(value)
        for part in step.get("settlement", []):
            for dof, value in problem.at_dofs(part):
                self.settled[dof // per, TURNED[dof % per][0]] = TURNED[dof % per][1] * float(value)
        loads = []  # (element, polynomial)
        for part in listed(step.get("uniform", [])):
            part = part if isinstance(part, dict) else {"value": part}
            q = [real(a) for a in part.get("polynomial", [part.get("value")])]
            loads += [(e, q) for e in numbers(part.get("elements", "all"), len(problem.elements))]
        (self.make_beam if len(problem.lines) == 1 else self.make_plate)(refine, loads)

    def make_beam(self, refine, loads):
        x = self.problem.lines[0]
        self.nodes = [(at, F(0)) for at in x]
        for e, (left, right) in enumerate(zip(x, x[1:])):
            inside = range(len(self.nodes), len(self.nodes) + 2 * refine - 1)
            self.nodes += [(left + (right - left) * i / (2 * refine), F(0)) for i in range(1, 2 * refine)]
            line = [e, *inside, e + 1]
            self.elements += [line[i:i + 3] for i in range(0, 2 * refine, 2)]
            self.origins += [e] * refine
        # Nothing pulls it sideways or turns it about its axis; these only keep it from floating there.
        self.fixed += [(0, 1), (0, 2), (0, 4), (len(x) - 1, 2)]
        for e, q in loads:
            h = (x[e + 1] - x[e]) / refine
            for i in range(refine):
                for node, force in zip(self.elements[e * refine + i], load_on_line(q, x[e] + i * h, h)):
                    self.forces[node, 3] += float(force)

    def make_plate(self, refine, loads):
        """A refined grid, every other line of which runs through the middles of elements; the problem's own lines are every `step`-th."""
        (x, y), step, grid = self.problem.lines, 2 * refine, {}
        self.nodes = [(a, b) for b in y for a in x]

        def along(line, i):
            return line[i // step] if i % step == 0 else line[i // step] + (line[i // step + 1] - line[i // step]) * (i % step) / step

        columns, rows = (len(x) - 1) * step + 1, (len(y) - 1) * step + 1
        for b in range(rows):
            for a in range(columns):
                if a % 2 == 1 and b % 2 == 1:
                    continue  # the middle of an element: S8R has no node there
                own, here = (a % step == 0, b % step == 0), b // step * len(x) + a // step
                grid[a, b] = here if all(own) else len(self.nodes)
                if not all(own):
                    self.nodes.append((along(x, a), along(y, b)))
                if own == (False, True):
                    self.fix_between(here, here + 1, 1, grid[a, b])
                if own == (True, False):
                    self.fix_between(here, here + len(x), 2, grid[a, b])
        # Nothing pulls it in its plane; these only keep it from floating there.
        self.fixed += [(0, 1), (0, 2), (len(x) - 1, 2)]
        pressure = defaultdict(float)
        for e, q in loads:
            pressure[e] += float(q[0])
        for b in range(0, rows - 2, 2):
            for a in range(0, columns - 2, 2):
                around = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
                self.elements.append([grid[a + i, b + j] for i, j in around])
                column, row = a // step, b // step
                self.origins.append(row * (len(x) - 1) + column)
                force = pressure[self.origins[-1]] * float((x[column + 1] - x[column]) * (y[row + 1] - y[row])) / refine**2
                # Work of a uniform pressure on S8R's shape functions: its corners take less than nothing.
                for k, node in enumerate(self.elements[-1]):
                    self.forces[node, 3] += -force / 12 if k < 4 else force / 3

    def fix_between(self, one, other, along, node):
        """A node between two of the problem's is fixed as an edge of our rectangle is there: its w and its slope along the line where both
        have these fixed, the slope across it where both have that."""
        def both(dof):
            return {3 * one + dof, 3 * other + dof} <= self.problem.fixed
        self.fixed += [(node, TURNED[dof][0]) for dof in range(3) if (both(dof) if dof == 3 - along else both(0) and both(along))]


class Deck:
    """One step of a problem as an input file: `text`; displacements and faces are `scale` times the problem's, forces `force_scale` times.
    The problem's node i (from 0) is node i + 1; pair i presses on node `first_ground` + i."""

    def __init__(self, problem, step, deflection, refine, slenderness):
        self.mesh = Mesh(problem, step, refine)
        self.length = float(max(max(a - self.mesh.nodes[0][0], b - self.mesh.nodes[0][1]) for a, b in self.mesh.nodes))
        self.thickness, self.scale = self.length / slenderness, SMALLNESS * self.length / deflection
        self.deflection = deflection * self.scale
        forces = sum(map(abs, self.mesh.forces.values()))
        self.unit = TOTAL_FORCE / (forces * self.scale) if forces > 0 else 1.0  # everything elastic is so much stiffer than the problem's
        self.force_scale, self.first_ground, self.springs = self.scale * self.unit, len(self.mesh.nodes) + 1, 0
        self.lines = ["*NODE,NSET=STRUCTURE", *(f"{i},{field(a)},{field(b)},0" for i, (a, b) in enumerate(self.mesh.nodes, 1))]
        self.write(problem)
        self.text = "\n".join(self.lines) + "\n"

    def write(self, problem):
        self.write_elements([element for element, _, _ in problem.elements], len(problem.lines) == 1)
        per = len(problem.names)
        for dof, side, face, stiffness in problem.pairs:
            self.write_spring(dof // per, side, float(stiffness), float(side * face), False)
        for dof, spring in problem.supports:
            if spring is not None:
                self.write_spring(dof // per, -1, float(spring), 0.0, True)
        self.lines += ["*BOUNDARY", *(f"{node + 1},{direction}" for node, direction in self.mesh.fixed)]
        self.lines += ["GROUND,1,3"] if self.springs else []
        # Without NLGEOM CalculiX treats one-sided springs as linear.
        self.lines += ["*STEP,NLGEOM", "*STATIC", "1.,1."] + (["*BOUNDARY"] if self.mesh.settled else [])
        self.lines += [f"{node + 1},{way},{way},{field(value * self.scale)}" for (node, way), value in self.mesh.settled.items()]
        self.lines += ["*CLOAD", *(f"{node + 1},{way},{field(value * self.force_scale)}" for (node, way), value in self.mesh.forces.items() if value)]
        self.lines += [f"*NSET,NSET=GIVEN,GENERATE\n1,{problem.count},1", "*NODE PRINT,NSET=GIVEN\nU"]
        self.lines += (["*NODE PRINT,NSET=GROUND\nRF"] if self.springs else []) + ["*END STEP"]

    def write_elements(self, elements, is_beam):
        """A beam's section is a square, and its nu is 0, since a beam of given EI has none. E is chosen to give EI or D."""
        parts, t = defaultdict(list), self.thickness
        for e, origin in enumerate(self.mesh.origins):
            parts[float(elements[origin].EI) if is_beam else 0.0].append(e)
        for part, (EI, which) in enumerate(sorted(parts.items()), 1):
            self.lines.append(f"*ELEMENT,TYPE={'B32R' if is_beam else 'S8R'},ELSET=PART{part}")
            self.lines += [",".join(map(str, [e + 1, *(n + 1 for n in self.mesh.elements[e])])) for e in which]
            self.lines.append(f"*MATERIAL,NAME=M{part}\n*ELASTIC")
            if is_beam:
                self.lines.append(f"{field(self.unit * 12 * EI / t**4)},0.\n*BEAM SECTION,ELSET=PART{part},MATERIAL=M{part},SECTION=RECT\n"
                                  f"{field(t)},{field(t)}\n0.,0.,1.")
            else:
                D, nu = float(elements[0].D), float(elements[0].nu)
                self.lines.append(f"{field(self.unit * 12 * D * (1 - nu * nu) / t**3)},{field(nu)}\n"
                                  f"*SHELL SECTION,ELSET=PART{part},MATERIAL=M{part}\n{field(t)}")

    def write_spring(self, node, side, stiffness, start, both_ways):
        """SPRINGA to a node on the ground above (+1) or below, since SPRING1 cannot be nonlinear in CalculiX 2.20: a table of force against
        lengthening, from a shortening of `start` on."""
        (a, b), ground = self.mesh.nodes[node], self.first_ground + self.springs
        self.springs += 1
        k, face = self.unit * stiffness, -start * self.scale
        table = [(k * end, face + end) for end in (-FAR_AWAY * self.deflection, -NEAR * self.deflection)]
        table += ([] if both_ways else [(0.0, face)]) + [(k * FAR_AWAY * self.deflection if both_ways else 0.0, face + FAR_AWAY * self.deflection)]
        self.lines += [f"*NODE,NSET=GROUND\n{ground},{field(a)},{field(b)},{field(side * self.length / 100)}",
                       f"*ELEMENT,TYPE=SPRINGA,ELSET=SPRING{self.springs}\n{len(self.mesh.elements) + self.springs},{node + 1},{ground}",
                       f"*SPRING,ELSET=SPRING{self.springs},NONLINEAR", *(f"{field(force)},{field(at)}" for force, at in table)]


class Block:
    """A block of C3D8I bricks, clamped at x = 0, over springs with gaps: (node, face, stiffness). A step for each load at a node, along z."""

    YOUNGS = 1e4
    # In a deck of peer_deck displacements and forces are so many times the problem's: see SMALLNESS and TOTAL_FORCE.
    SCALE, FORCE_SCALE = 1e-8, 1e6

    def __init__(self, name, bricks, size, supports, loaded, loads):
        self.name, self.bricks, self.size, self.loads = name, bricks, size, loads
        self.supports = [(self.at(*place), face, stiffness) for place, face, stiffness in supports]
        self.loaded = self.at(*loaded)
        self.places = [(i, j, k) for i in range(bricks[0] + 1) for j in range(bricks[1] + 1) for k in range(bricks[2] + 1)]

    def at(self, i, j, k):
        return (i * (self.bricks[1] + 1) + j) * (self.bricks[2] + 1) + k + 1

    def where(self, node):
        return [length * i / n for length, i, n in zip(self.size, self.places[node - 1], self.bricks)]

    def mesh(self, modulus):
        lines = ["*NODE,NSET=ALL", *(f"{n},{','.join(map(field, self.where(n)))}" for n in range(1, len(self.places) + 1))]
        lines.append("*ELEMENT,TYPE=C3D8I,ELSET=BLOCK")
        cells = [place for place in self.places if all(i < n for i, n in zip(place, self.bricks))]
        for element, (i, j, k) in enumerate(cells, 1):
            corners = [self.at(i + di, j + dj, k + up) for up in (0, 1) for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))]
            lines.append(",".join(map(str, [element, *corners])))
        lines.append(f"*MATERIAL,NAME=M\n*ELASTIC\n{field(modulus)},0.3\n*DENSITY\n1.\n*SOLID SECTION,ELSET=BLOCK,MATERIAL=M\n*BOUNDARY")
        lines += [f"{self.at(*place)},1,3" for place in self.places if place[0] == 0]
        return "\n".join(lines) + "\n", len(cells)

    def matrix_deck(self):
        """CalculiX writes the stiffness matrix under the name of the job."""
        return self.mesh(self.YOUNGS)[0] + "*STEP\n*FREQUENCY,SOLVER=MATRIXSTORAGE\n1\n*END STEP\n"

    def peer_deck(self, load):
        """CalculiX's own nonlinear run under one step's load. The springs' grounds are the nodes after the block's."""
        text, element = self.mesh(self.YOUNGS * self.FORCE_SCALE / self.SCALE)
        for ground, (node, face, stiffness) in enumerate(self.supports, len(self.places) + 1):
            x, y, z = self.where(node)
            element += 1
            text += f"*NODE,NSET=GROUND\n{ground},{field(x)},{field(y)},{field(z - self.size[2] / 10)}\n" \
                    f"*ELEMENT,TYPE=SPRINGA,ELSET=S{ground}\n{element},{node},{ground}\n*SPRING,ELSET=S{ground},NONLINEAR\n"
            for end in (-FAR_AWAY, -NEAR):
                text += f"{field(stiffness * end * self.FORCE_SCALE)},{field((face + end) * self.SCALE)}\n"
            text += f"0.,{field(face * self.SCALE)}\n0.,{field((face + FAR_AWAY) * self.SCALE)}\n"
        text += f"*BOUNDARY\nGROUND,1,3\n*STEP,NLGEOM\n*STATIC\n1.,1.\n*CLOAD\n{self.loaded},3,{field(load * self.FORCE_SCALE)}\n"
        return text + "*NODE PRINT,NSET=ALL\nU\n*NODE PRINT,NSET=GROUND\nRF\n*END STEP\n"

    def problem(self):
        """The problem file that reads that matrix."""
        text = f'title = "{self.name}"\n\n[calculix]\njob = "{self.name}"\n'
        for node, face, stiffness in self.supports:
            text += f'\n[[contact]]\ndof = "{node}.3"\nsurface = "below"\nface = {face}\nstiffness = {stiffness}\n'
        return text + "".join(f'\n[[step]]\npoint = [ {{ dof = "{self.loaded}.3", value = {load} }} ]\n' for load in self.loads)


def problem_in(path):
    """A beam or a plate, read by the checker of proofs, which shares nothing with the program."""
    return Problem(tomllib.loads(Path(path).read_text(), parse_float=F), str(Path(path).parent))
