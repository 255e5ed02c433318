"""peer.py CONTCT CCX REFERENCE FOLDER: CalculiX as a peer: another program, by other elements and another way of solving, comes to the same
states, on beams and plates that are written for it here, and on solids whose matrix it wrote for contct."""
import json
import math
import subprocess
import sys
from pathlib import Path

from calculix import Block, Deck, problem_in, run_ccx, values_at_end

CONTCT, CCX, REFERENCE, FOLDER = sys.argv[1], sys.argv[2], Path(sys.argv[3]), Path(sys.argv[4])
LEAST_CHECKS = 54
checks = failures = 0

# Everything that a beam may have and that the references lack here.
MOTLEY_BEAM = """
[beam]
x = [0.0, 0.7, 1.0, 2.0, 2.5, 4.0]
EI = [1e3, 2e3, 1e3, 5e2, 1e3]
[[support]]
node = 1
fix = ["w", "theta"]
[[support]]
node = 5
spring = { w = 2.0e3 }
[[contact]]
node = 3
surface = "above"
face = 0.001
stiffness = 3e4
[[contact]]
node = 6
surface = "below"
face = -0.02
stiffness = 3e3
[[contact]]
node = 2
surface = "below"
face = 0
stiffness = 3e3
[[step]]
uniform = [ { value = 30.0, elements = "4..5" }, { polynomial = [10.0, 2.0, -3.0, 4.0], elements = "1..3" } ]
point = [ { node = 2, theta = -111.5 }, { node = 6, theta = -7, w = -13 } ]
"""
# Supports that settle, with a stop that is reached on the way, and a load in one of the steps.
SETTLING_BEAM = """
[beam]
length = 8.0
elements = 8
EI = 1.0e4
[[support]]
x = 0.0
fix = ["w", "theta"]
[[support]]
x = 8.0
fix = "w"
[[contact]]
x = 4.0
surface = "below"
face = -0.004
stiffness = 5e3
[[step]]
settlement = [ { x = 8.0, w = -0.03 }, { x = 0.0, theta = 0.001 } ]
[[step]]
uniform = -5.0
settlement = [ { x = 8.0, w = -0.01 }, { x = 0.0, w = 0.002 } ]
"""


def check(good, words):
    global checks, failures
    checks, failures = checks + 1, failures + (not good)
    print(f"{'  ok    ' if good else '  FAILED'} {words}", flush=True)


def run_contct(problem):
    """The result, both kernels in lockstep: equal, and every final state certified."""
    file = FOLDER / "contct.json"
    subprocess.run([CONTCT, "run", problem, "--quiet", "--strict", "--kernels", "fortran,cpp", "--json", file], check=True)
    result = json.loads(file.read_text())
    if result["lockstep"]["calls"] == 0 or result["lockstep"]["mismatches"] != 0:
        raise ValueError(f"{problem}: the kernels were not compared, or differ")
    return result


class Difference:
    """How far CalculiX's displacements and forces are from ours, each over the largest; are the same pairs in contact?"""

    def __init__(self, ours, theirs, pairs, their_forces):
        largest, pressing = max(map(abs, ours)), max((abs(pair["force"]) for pair in pairs), default=0.0)
        self.displacement = max(abs(a - b) for a, b in zip(ours, theirs)) / (largest or 1.0)
        self.force = max((abs(pair["force"] - f) for pair, f in zip(pairs, their_forces)), default=0.0) / (pressing or 1.0)
        self.same_pairs = all((f > 0.0) == (pair["state"] == "contact") for pair, f in zip(pairs, their_forces, strict=True))
        self.values = len(ours) + len(pairs)

    def within(self, displacement, force):
        return self.same_pairs and self.values > 0 and self.displacement <= displacement and self.force <= force

    def __str__(self):
        return f"w within {self.displacement:.1e}, forces within {self.force:.1e}, {'the same' if self.same_pairs else 'OTHER'} pairs in contact, " \
               f"{self.values} values"


class Solved:
    """A beam or a plate, and what contct says of its steps."""

    def __init__(self, name, path):
        self.name, self.given, self.steps = name, problem_in(path), run_contct(path)["steps"]

    def difference(self, number, refine, slenderness):
        """CalculiX's answer to a step, from 1, by so many elements for each of the problem's along each side."""
        step = self.steps[number - 1]
        deck = Deck(self.given, self.given.steps[number - 1], max(map(abs, step["w"])), refine, slenderness)
        run_ccx(CCX, FOLDER, "structure", deck.text)
        w = [u[2] / deck.scale for u in values_at_end(FOLDER, "structure", "displacements", "GIVEN", 1, len(step["w"]))]
        held = values_at_end(FOLDER, "structure", "forces", "GROUND", deck.first_ground, len(self.given.pairs)) if self.given.pairs else []
        forces = [-side * f[2] / deck.force_scale for (_, side, _, _), f in zip(self.given.pairs, held)]
        return Difference(step["w"], w, step["pairs"], forces)


def reference(name):
    return Solved(name.partition("-")[0], REFERENCE / f"problems/{name}.toml")


def written(name, text):
    path = FOLDER / f"{name}.toml"
    path.write_text(text)
    return Solved(f"{name} beam", path)


def order(before, after):
    """How fast differences fall where what causes them is halved."""
    return math.log2(before / after)


def check_every_step(solved, least):
    """Every step of a beam that carries load."""
    in_contact = 0
    for number, step in enumerate(solved.steps, 1):
        if max(map(abs, step["w"])) < 1e-12:
            continue
        d = solved.difference(number, 2, 500)
        in_contact += sum(pair["state"] == "contact" for pair in step["pairs"])
        check(d.within(1e-5, 3e-4), f"{solved.name} step {number}: {d}")
    check(in_contact >= least, f"{solved.name}: {in_contact} pairs in contact were compared")


def check_shear(solved, number):
    """A beam's difference is shear, which Euler and Bernoulli leave out: (thickness over length)^2."""
    found = [solved.difference(number, 2, slenderness) for slenderness in (25, 50, 100)]
    for i, (a, b) in enumerate(zip(found, found[1:]), 1):
        w, n = order(a.displacement, b.displacement), order(a.force, b.force)
        check(b.same_pairs and w > 1.7 and n > 1.7, f"{solved.name} step {number}, section {2**i} times thinner: {b}; order {w:.2f} and {n:.2f}")


def check_mesh():
    """Where loads are no constants, the mesh counts too; down to what solving for so thin a section leaves of double precision, some 1e-5."""
    solved = written("motley", MOTLEY_BEAM)
    one, two, four = (solved.difference(1, refine, 500) for refine in (1, 2, 4))
    by = order(one.displacement, two.displacement)
    check(two.within(1e-4, 5e-4) and by > 3, f"{solved.name}, 2 elements for each: {two}; order {by:.2f}")
    check(four.within(2e-5, 2e-4) and four.displacement < two.displacement, f"{solved.name}, 4 elements for each: {four}")


def check_settlements():
    check_every_step(written("settling", SETTLING_BEAM), 2)
    line = reference("pp06-plate-over-settling-line")
    for number in (1, 2):
        d = line.difference(number, 4, 500)
        check(d.within(4e-3, 2e-2), f"{line.name} step {number}: {d}")


def check_plates():
    """contct's mesh and CalculiX's are refined together."""
    meshes = [reference(name) for name in ("pp02a-settled-column-n4", "pp02b-settled-column-n8", "pp02c-settled-column-n16")]
    for number in (1, 2, 3, 4):
        found = [solved.difference(number, 1, 500) for solved in meshes]
        for solved, a, b in zip(meshes[1:], found, found[1:]):
            by = order(a.displacement, b.displacement)
            check(b.same_pairs and by > 1.7, f"{solved.name} step {number}: {b}; order {by:.2f}")
        check(found[-1].within(4e-3, 2e-2), f"{meshes[-1].name} step {number}: {found[-1]}")


def check_structures():
    stop, settled, gaps = map(reference, ("pb01-cantilever-tip-stop", "pb06-settled-middle-support", "pb07-three-gap-supports"))
    for solved, least in ((stop, 2), (settled, 3), (gaps, 5)):
        check_every_step(solved, least)
    for solved, number in ((stop, 2), (settled, 3), (gaps, 3)):
        check_shear(solved, number)
    check_mesh()
    check_plates()
    check_settlements()


def check_example():
    """The matrix that the example in reference/ keeps, against what CalculiX makes of its input now."""
    kept = REFERENCE / "structures/calculix/console"
    run_ccx(CCX, FOLDER, "console", kept.with_suffix(".inp").read_text())
    check(kept.with_suffix(".dof").read_text() == (FOLDER / "console.dof").read_text(), "console: the kept labels are CalculiX's")
    ours, theirs = ([line.split() for line in path.read_text().splitlines()] for path in (kept.with_suffix(".sti"), FOLDER / "console.sti"))
    largest = max(abs(float(row[2])) for row in ours)
    off = max(abs(float(a[2]) - float(b[2])) for a, b in zip(ours, theirs)) / largest
    same_places = [row[:2] for row in ours] == [row[:2] for row in theirs]
    check(same_places and len(ours) > 5000 and off <= 1e-12, f"console: the kept matrix is CalculiX's, {len(ours)} entries within {off:.1e}")
    increments = sum(len(step["increments"]) for step in run_contct(kept.with_suffix(".toml"))["steps"])
    check(increments == 10, f"console: both kernels equal and certified in {increments} increments")


def check_block(block, events):
    """Its matrix, the path by both kernels, and CalculiX's own end of every step: nothing but the contact is left to differ."""
    path, nodes = FOLDER / f"{block.name}.toml", len(block.places)
    path.write_text(block.problem())
    run_ccx(CCX, FOLDER, block.name, block.matrix_deck())
    result = run_contct(path)
    found = sum(len(i["events"]) for step in result["steps"] for i in step["increments"])
    check(found >= events, f"{block.name}: both kernels equal and certified on {found} events, {result['lockstep']['calls']} calls")
    labels = [tuple(map(int, label.split("."))) for label in (FOLDER / f"{block.name}.dof").read_text().split()]
    in_contact = 0
    for number, (load, step) in enumerate(zip(block.loads, result["steps"], strict=True), 1):
        job = f"{block.name}-peer"
        run_ccx(CCX, FOLDER, job, block.peer_deck(load))
        u = values_at_end(FOLDER, job, "displacements", "ALL", 1, nodes)
        held = values_at_end(FOLDER, job, "forces", "GROUND", nodes + 1, len(block.supports))
        # C3D8I's own modes are numbered as nodes behind the others.
        both = [(ours, u[node - 1][way - 1] / block.SCALE) for ours, (node, way) in zip(step["displacement"], labels, strict=True) if node <= nodes]
        d = Difference([a for a, _ in both], [b for _, b in both], step["pairs"], [f[2] / block.FORCE_SCALE for f in held])
        here = sum(pair["state"] == "contact" for pair in step["pairs"])
        in_contact += here
        check(d.within(1e-6, 1e-6) and d.values >= 100, f"{block.name} step {number}: {here} in contact; {d}")
    check(in_contact >= 3, f"{block.name}: {in_contact} pairs in contact were compared")


def check_solids():
    check_example()
    check_block(Block("cantilever", (10, 2, 2), (10, 1, 1), [((4, 1, 0), -0.02, 100), ((7, 1, 0), -0.1, 100), ((10, 1, 0), -0.2, 50)], (10, 1, 2),
                      [-2, -10, -1, 3]), 4)
    check_block(Block("slab", (8, 6, 1), (8, 6, 0.5), [((8, 0, 0), -0.2, 40), ((8, 6, 0), -0.3, 40), ((4, 3, 0), -0.15, 40),
                                                       ((8, 3, 0), -0.4, 40)], (8, 2, 1), [-5, -20, -4]), 4)


for part in (check_structures, check_solids):
    try:
        part()
    except (ValueError, KeyError, OSError, subprocess.CalledProcessError) as wrong:
        check(False, f"{part.__name__}: {wrong!r}")
if checks < LEAST_CHECKS:
    check(False, f"found {checks} checks; allowed: {LEAST_CHECKS} or more")
print(f"CalculiX as a peer: {checks} checks, {failures} failed")
sys.exit(1 if failures else 0)
