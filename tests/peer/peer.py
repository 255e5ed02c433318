"""peer.py CONTCT CCX REFERENCE FOLDER: compares contct with CalculiX and Siconos.

contct and CalculiX must find the same states of solids, for which contct reads the matrix that CalculiX writes. They
must also agree on benchmark problems and on combinations of a base plate, for which CalculiX uses its beams or shells.
Siconos solves all benchmark problems as linear complementarity problems.
"""
import json
import os
import sys
from pathlib import Path

CONTCT, CCX, REFERENCE, FOLDER = (Path(a).resolve() for a in sys.argv[1:])
sys.path[:0] = [str(REFERENCE / "benchmarks"), str(Path(__file__).parents[1] / "support")]
from testing import Checks, result_of, run  # noqa: E402
import calculix  # noqa: E402
from block import Block  # noqa: E402
from make import problem_of  # noqa: E402

check = Checks()


def run_contct(problem):
    """Returns the result of contct; fails unless every final state is certified, and FORTRAN and C++ are equal in lockstep."""
    result = result_of(CONTCT, "run", problem, "--quiet", "--strict", "--kernels", "fortran,cpp", cwd=FOLDER)
    if result["lockstep"]["calls"] == 0 or result["lockstep"]["mismatches"] != 0:
        raise ValueError(f"{problem}: the kernels were not compared, or differ")
    return result


def run_ccx(job, deck):
    for old in (".dat", ".sti", ".dof"):  # files of an earlier run
        Path(FOLDER, job + old).unlink(missing_ok=True)
    Path(FOLDER, f"{job}.inp").write_text(deck)
    run(CCX, job, cwd=FOLDER, status=0)


def values_at_end(job, quantity, name, first, count):
    """Returns the values along x, y, z of `count` nodes from `first` on, at the end of the step."""
    at = calculix.values_at_end(Path(FOLDER, f"{job}.dat").read_text(), quantity, name)
    return [at[node] for node in range(first, first + count)]


def check_example():
    """Checks that CalculiX still writes the matrix of the example in reference/structures."""
    kept = REFERENCE / "structures/calculix/console"
    run_ccx("console", kept.with_suffix(".inp").read_text())
    check(kept.with_suffix(".dof").read_text() == (FOLDER / "console.dof").read_text(), "console: the kept labels are CalculiX's")
    ours, theirs = ([line.split() for line in path.read_text().splitlines()] for path in (kept.with_suffix(".sti"), FOLDER / "console.sti"))
    largest = max(abs(float(row[2])) for row in ours)
    off = max(abs(float(a[2]) - float(b[2])) for a, b in zip(ours, theirs)) / largest
    same_places = [row[:2] for row in ours] == [row[:2] for row in theirs]
    check(same_places and len(ours) > 5000 and off <= 1e-12, f"console: the kept matrix is CalculiX's, {len(ours)} entries within {off:.1e}")
    increments = sum(len(step["increments"]) for step in run_contct(kept.with_suffix(".toml"))["steps"])
    check(increments == 10, f"console: both kernels equal and certified in {increments} increments")


def check_block(block, events):
    """Compares the ends of steps by contct, with CalculiX's matrix and both kernels, with those of CalculiX."""
    path, nodes = FOLDER / f"{block.name}.toml", len(block.places)
    path.write_text(block.problem())
    run_ccx(block.name, block.matrix_deck())
    result = run_contct(path)
    found = sum(len(i["events"]) for step in result["steps"] for i in step["increments"])
    check(found >= events, f"{block.name}: both kernels equal and certified on {found} events, {result['lockstep']['calls']} calls")
    labels = [tuple(map(int, label.split("."))) for label in (FOLDER / f"{block.name}.dof").read_text().split()]
    in_contact = 0
    for number, (load, step) in enumerate(zip(block.loads, result["steps"], strict=True), 1):
        job = f"{block.name}-peer"
        run_ccx(job, block.peer_deck(load))
        u = values_at_end(job, "displacements", "ALL", 1, nodes)
        held = values_at_end(job, "forces", "GROUND", nodes + 1, len(block.supports))
        # CalculiX's element C3D8I has internal modes, which are numbered as nodes after the others.
        both = [(ours, u[node - 1][way - 1] / block.SCALE) for ours, (node, way) in zip(step["displacement"], labels, strict=True) if node <= nodes]
        forces = [(pair["force"], f[2] / block.FORCE_SCALE) for pair, f in zip(step["pairs"], held, strict=True)]
        off, off_force = (max(abs(a - b) for a, b in of) / (max(abs(a) for a, _ in of) or 1.0) for of in (both, forces))
        same = all((f[2] > 0.0) == (pair["state"] == "contact") for pair, f in zip(step["pairs"], held))
        here = sum(pair["state"] == "contact" for pair in step["pairs"])
        in_contact += here
        check(same and off <= 1e-6 and off_force <= 1e-6 and len(both) >= 100, f"{block.name} step {number}: {here} in contact; w within {off:.1e}, "
              f"forces within {off_force:.1e}, {'the same' if same else 'OTHER'} pairs in contact, {len(both)} displacements")
    check(in_contact >= 3, f"{block.name}: {in_contact} pairs in contact were compared")


def check_benchmarks(results, kept, least):
    """Checks another program's numbers for benchmark problems against the exact ones and against the kept file."""
    done = run(sys.executable, REFERENCE / "benchmarks/judge.py", "-", "--least", least, input=results)
    check(done.returncode == 0, f"{kept}: {done.stdout.strip()}{done.stderr}")
    kept = json.loads((REFERENCE / "benchmarks" / kept).read_text())["problems"]
    asked = [{name: [{**entry, "value": 0} for entry in entries] for name, entries in of.items()}
             for of in (kept, json.loads(results)["problems"])]
    check(asked[0] == asked[1], "the kept results are of the same numbers")


def combination_errors(elements):
    """Returns for each combination of the base plate, with this number of elements along a side: its name, the largest
    difference of contact forces relative to the largest force, the number of compared pairs, and the number of
    different statuses of pairs with a noticeable force."""
    text = (REFERENCE / "cookbook/base-plate.toml").read_text()
    if "elements  = [10, 10]" not in text:
        raise ValueError("base-plate.toml: found another mesh; allowed: [10, 10]")
    path = FOLDER / "base-plate.toml"
    path.write_text(text.replace("[10, 10]", f"[{elements}, {elements}]"))
    problem = problem_of(path)
    for step, ours in zip(problem["steps"], run_contct(path)["steps"], strict=True):
        run_ccx("base-plate", calculix.deck(problem, step))
        pressed = calculix.contact_forces(problem, Path(FOLDER, "base-plate.dat").read_text())
        largest = max(pair["force"] for pair in ours["pairs"])
        both = list(zip(ours["pairs"], pressed, strict=True))
        other = [pair for pair, force in both if (pair["state"] == "contact") != (force > 0) and max(pair["force"], force) > 1e-3 * largest]
        yield ours["name"], max(abs(pair["force"] - force) for pair, force in both) / largest, len(both), len(other)


def check_combinations():
    """Compares the base plate in CalculiX's S8R elements with ACM elements; differences must decrease with the size."""
    coarse = {name: error for name, error, *_ in combination_errors(10)}
    for name, error, count, other in combination_errors(20):
        check(error <= 5e-3 and error < coarse[name] / 2 and other == 0 and count > 400,
              f"base plate, {name}: {count} contact forces within {error:.1e} of the largest, {coarse[name]:.1e} on elements of twice the size; "
              f"{other} other statuses where forces are above 1e-3 of it")
    check(len(coarse) == 3, f"base plate: {len(coarse)} combinations were compared")


check_example()
check_benchmarks(calculix.words(calculix.results(calculix.CONVERGE, FOLDER, CCX)), "calculix.json", 100)
unpacked = FOLDER / "siconos/usr/lib"
libraries = unpacked / "x86_64-linux-gnu"
paths = {"PYTHONPATH": f"{unpacked}/python3/dist-packages", "LD_LIBRARY_PATH": f"{libraries}:{libraries}/openblas-pthread"}
siconos = run("/usr/bin/python3", REFERENCE / "benchmarks/siconos_lcp.py", env=os.environ | paths, status=0)
check_benchmarks(siconos.stdout, "siconos.json", 340)
check_combinations()
check_block(Block("cantilever", (10, 2, 2), (10, 1, 1), [((4, 1, 0), -0.02, 100), ((7, 1, 0), -0.1, 100), ((10, 1, 0), -0.2, 50)], (10, 1, 2),
                  [-2, -10, -1, 3]), 4)
check_block(Block("slab", (8, 6, 1), (8, 6, 0.5), [((8, 0, 0), -0.2, 40), ((8, 6, 0), -0.3, 40), ((4, 3, 0), -0.15, 40),
                                                   ((8, 3, 0), -0.4, 40)], (8, 2, 1), [-5, -20, -4]), 4)
check.end(22)
