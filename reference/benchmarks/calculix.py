"""Solves benchmark problems of this folder by CalculiX, and prints its numbers as a file of results.

    python3 reference/benchmarks/calculix.py [NAME..] > theirs.json       NAME: such as pb01-cantilever-tip-stop
    python3 reference/benchmarks/judge.py theirs.json

ccx must be in PATH. A beam consists of B32R elements, which are so slender that their shear is negligible. A pair is a
SPRINGA with a table, from the pair's node to a fixed node. Springs with tables need NLGEOM, so displacements are scaled
down until CalculiX finds no rotation.
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
TOLERANCE = 1e-4
# Factors of displacements and of forces in a deck.
SCALE, FORCE_SCALE = 1e-6, 1e6
# Ends of a spring's table in the problem's lengths, outside which the force is constant. The far end is rounded, so the
# near end defines the face.
FAR_AWAY, NEAR = 1e4, 1.0
DIRECTIONS = {"w": (3, 1), "theta": (5, -1)}  # (direction in CalculiX, sign): dw/dx is negative about axis y


def field(x):
    """Returns x in at most 20 characters, after which CalculiX cuts a field."""
    return f"{float(x):.12e}"


def is_known(problem):
    """Returns True if the problem can be translated. Moments at nodes of a shell, among others, cannot."""
    kind = problem["structure"]["kind"]
    plain = not any(step["settlements"] for step in problem["steps"]) and all(spring is None for *_, spring in problem["supports"])
    if kind == "plate":
        return plain and not problem["supports"] and all(dof == "w" for step in problem["steps"] for _, dof, _ in step["loads"])
    return plain and kind == "beam" and not problem["structure"]["hinges"] and "GA" not in problem["structure"]


def section(name, kind, modulus, nu, thickness):
    """Returns a section of this thickness, with the elastic modulus that gives the bending stiffness of the problem."""
    beam = f"*BEAM SECTION,ELSET={name},MATERIAL={name},SECTION=RECT\n{field(thickness)},{field(thickness)}\n0.,1.,0."
    plate = f"*SHELL SECTION,ELSET={name},MATERIAL={name}\n{field(thickness)}"
    return f"*MATERIAL,NAME={name}\n*ELASTIC\n{field(modulus * FORCE_SCALE / SCALE)},{nu}\n{beam if kind == 'beam' else plate}"


def beam(structure):
    """Returns (coordinates of nodes, lines, number of elements, supports that hold the beam in its plane).

    Nodes 1 to n are those of the problem; the nodes in the middle of elements follow.
    """
    x, stiffness = structure["x"], structure["EI"]
    depth = (x[-1] - x[0]) / 400
    places = [(at, 0.0) for at in x + [(a + b) / 2 for a, b in zip(x, x[1:])]]
    lines = []
    for number, EI in enumerate(sorted(set(stiffness))):
        lines.append(f"*ELEMENT,TYPE=B32R,ELSET=E{number}")
        lines += [f"{e},{e},{len(x) + e},{e + 1}" for e, of in enumerate(stiffness, 1) if of == EI]
        lines.append(section(f"E{number}", "beam", 12 * EI / depth**4, 0.0, depth))
    return places, lines, len(stiffness), {1: [1, 2, 4], len(x): [2]}


def plate(structure):
    """Returns the same as `beam` for a plate. Nodes in the middle of sides follow, along x and then along y."""
    x, y, nu = structure["x"], structure["y"], structure["nu"]
    columns, thickness = len(x), (x[-1] - x[0]) / 200
    along_x = [((a + b) / 2, at) for at in y for a, b in zip(x, x[1:])]
    along_y = [(at, (a + b) / 2) for a, b in zip(y, y[1:]) for at in x]
    places, lines = [(a, b) for b in y for a in x] + along_x + along_y, ["*ELEMENT,TYPE=S8R,ELSET=E0"]
    on_x, on_y = columns * len(y) + 1, columns * len(y) + len(along_x) + 1
    for j in range(len(y) - 1):
        for i in range(columns - 1):
            corner, side = j * columns + i + 1, on_x + j * (columns - 1) + i
            nodes = [corner, corner + 1, corner + columns + 1, corner + columns, side, on_y + j * columns + i + 1, side + columns - 1, on_y + j * columns + i]
            lines.append(",".join(map(str, [j * (columns - 1) + i + 1, *nodes])))
    lines.append(section("E0", "plate", 12 * (1 - nu**2) * structure["D"] / thickness**3, nu, thickness))
    return places, lines, (columns - 1) * (len(y) - 1), {1: [1, 2], columns: [2]}


def springs(problem, faces, places, first_element):
    """Returns a fixed node and a spring without tension for each pair. Fixed nodes are numbered after `places`."""
    away, lines = (places[-1][0] - places[0][0]) / 10, []
    for i, (pair, face) in enumerate(zip(problem["pairs"], faces)):
        ground, (x, y), side = len(places) + 1 + i, places[pair["node"] - 1], -1 if pair["surface"] == "below" else 1
        lines.append(f"*NODE,NSET=GROUND\n{ground},{field(x)},{field(y)},{field(side * away)}")
        lines.append(f"*ELEMENT,TYPE=SPRINGA,ELSET=S{i}\n{first_element + i},{pair['node']},{ground}\n*SPRING,ELSET=S{i},NONLINEAR")
        touch = -side * face * SCALE  # elongation of the spring when the pair is at its face
        for inside in (FAR_AWAY, NEAR):
            lines.append(f"{field(-pair['stiffness'] * inside * FORCE_SCALE)},{field(touch - inside * SCALE)}")
        lines.append(f"0.,{field(touch)}\n0.,{field(touch + FAR_AWAY * SCALE)}")
    return lines


def deck(problem, step):
    structure = problem["structure"]
    places, lines, elements, held = (beam if structure["kind"] == "beam" else plate)(structure)
    moved = {node: value for node, _, value in step["moves"]}
    lines = ["*NODE,NSET=ALL", *(f"{n},{field(x)},{field(y)},0." for n, (x, y) in enumerate(places, 1)), *lines]
    lines += springs(problem, [pair["face"] + moved.get(pair["node"], 0.0) for pair in problem["pairs"]], places, elements + 1)
    for node, dof, _ in problem["supports"]:
        held.setdefault(node, []).append(DIRECTIONS[dof][0])
    lines += ["*BOUNDARY", *(f"{node},{way},{way}" for node, ways in held.items() for way in sorted(ways))]
    lines += ["GROUND,1,3"] if problem["pairs"] else []
    lines += ["*STEP,NLGEOM,INC=100", "*STATIC", "1.,1.", "*CLOAD"]
    lines += [f"{node},{DIRECTIONS[dof][0]},{field(DIRECTIONS[dof][1] * value * FORCE_SCALE)}" for node, dof, value in step["loads"]
              if DIRECTIONS[dof][0] not in held.get(node, [])]
    lines += ["*NODE PRINT,NSET=ALL", "U,RF"] + (["*NODE PRINT,NSET=GROUND", "RF"] if problem["pairs"] else [])
    return "\n".join([*lines, "*END STEP"]) + "\n"


def values_at_end(dat, quantity, name):
    """Returns {node: (x, y, z)} of a quantity and a set of nodes at time 1, the end of the step."""
    tables = re.split(r"^ (\w+) \(\w+,\w+,\w+\) for set (\w+) and time +(\S+)$", dat, flags=re.M)
    found = [text for what, which, time, text in zip(tables[1::4], tables[2::4], tables[3::4], tables[4::4])
             if (what, which) == (quantity, name) and float(time) == 1.0]
    if not found:
        raise ValueError(f"found no {quantity} for set {name} at time 1: CalculiX did not reach the step's end")
    rows = [line.split() for line in found[-1].splitlines() if line.strip()]
    return {int(node): [float(re.sub(r"(\d)([+-]\d{3})$", r"\1E\2", x)) for x in values] for node, *values in rows}


def contact_forces(problem, dat):
    """Returns the contact force of each pair, at the end of the step."""
    up = [force[2] / FORCE_SCALE for _, force in sorted(values_at_end(dat, "forces", "GROUND").items())] if problem["pairs"] else []
    return [force if pair["surface"] == "below" else -force for pair, force in zip(problem["pairs"], up, strict=True)]


def answers_of_step(problem, number, dat):
    """Returns the step's numbers of the benchmark that the .dat file has, with their keys in verification.toml."""
    u, reactions, pressed = values_at_end(dat, "displacements", "ALL"), values_at_end(dat, "forces", "ALL"), contact_forces(problem, dat)
    loads = {(node, dof): value for node, dof, value in problem["steps"][number - 1]["loads"]}
    for asked in (n for n in problem["numbers"] if n["step"] == number):
        quantity, value = asked["quantity"], None
        if quantity == "w":
            value = u[asked["node"]][2] / SCALE
        elif quantity == "force":
            value = pressed[asked["pair"] - 1]
        elif quantity == "state":
            value = "contact" if pressed[asked["pair"] - 1] else "separated"
        elif quantity == "contacts":
            value = sum(force != 0 for force in pressed)
        elif quantity == "reaction" and asked["dof"] == "w":
            value = reactions[asked["node"]][2] / FORCE_SCALE - loads.get((asked["node"], "w"), 0.0)  # CalculiX's includes the load
        if value is not None:
            yield {key: asked[key] for key in asked if key not in ("exact", "compared_with")} | {"value": value}


def answers(problem, folder, ccx="ccx"):
    found = []
    for number, step in enumerate(problem["steps"], 1):
        job = Path(folder, f"{problem['name']}-{number}")
        job.with_suffix(".inp").write_text(deck(problem, step))
        done = subprocess.run([ccx, job.name], cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            print(f"{job.name}: CalculiX does not converge, exit {done.returncode}", file=sys.stderr)
            continue
        found += answers_of_step(problem, number, job.with_suffix(".dat").read_text())
    return found


def results(names, folder, ccx="ccx"):
    version = subprocess.run([ccx, "-v"], capture_output=True, text=True, check=False).stdout
    given = {}
    for name in names:
        problem = json.loads((HERE / f"{name}.json").read_text())
        if not is_known(problem):
            raise ValueError(f"{name}: allowed: beams without hinges, GA, settlements and elastic supports; plates that pairs hold")
        given[name] = answers(problem, folder, ccx)
    return {"format": "contct-answers-1", "program": "CalculiX", "version": re.search(r"[\d.]+", version)[0], "tolerance": TOLERANCE,
            "problems": given}


# Problems in which CalculiX's Newton steps converge, except in the last step of PB5.
CONVERGE = ["pb01-cantilever-tip-stop", "pb02-beam-over-cantilever", "pb03a-point-load-on-bed-l4", "pb03b-point-load-on-bed-l6-coarse",
            "pb04a-end-loads-on-bed-short", "pb04c-end-loads-on-bed-long", "pb05-cantilever-over-flat-obstacle", "pb06-settled-middle-support",
            "pb07-three-gap-supports", "pb10-cantilever-gapped-spring", "pb12-two-spans-moving-load"]


def words(found):
    """Returns the results as JSON with one line for each number."""
    rows = ",\n".join(f"  {json.dumps(name)}: [\n   " + ",\n   ".join(map(json.dumps, entries)) + " ]" for name, entries in found["problems"].items())
    head = json.dumps({key: value for key, value in found.items() if key != "problems"})
    return f"{head[:-1]},\n \"problems\": {{\n{rows} }} }}\n"


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as work:
        sys.stdout.write(words(results(sys.argv[1:] or CONVERGE, work)))
