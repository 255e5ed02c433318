"""forms_test.py CONTCT REFERENCE: each form of problem-file.md is read alike by the program and by the checker.

The checker accepts the proof of a problem with these forms, and refuses it for a problem in which any one of them has another value.
"""
import re
import tempfile
from pathlib import Path

from proofs import end, fail, reference, run, verdict

# (what the problem has: pairs and supports; the problem; others, of which each differs in one form)
BEAMS = [
    (10, 4, """
title = "forms"
units = { length = "m", force = "kN" }
step = [ { name = "in one line", uniform = [ { value = -3 }, { value = -5.0, elements = "1..4" } ], point = [ { nodes = "all", w = -10.5 } ] } ]
[beam]
length = 4
elements = 8
EI = [1e4, 1e4, 1e4, 1.5e4, 1e4, 1e4, 2e4, 1e4]
[[support]]
node = 1
fix = ["theta", "w"]
[[support]]
nodes = [3, 4]
spring = { w = 50.0 }
[[contact]]
nodes = "2..3"
surface = "below"
face = [-1e-4, -1e-3]
stiffness = [5e4, 4e4]
[[contact]]
x = 2
surface = "above"
face = 0
stiffness = 1e3
state = "separated"
[[bed]]
nodes = "3..9"
modulus = 2e3
face = { polynomial = [-0.001, 0.0, -2.0e-5] }
""", ["-5.0, elements = \"1..4\"|-5.0, elements = \"1..3\"", "value = -3|value = -3.1", "nodes = \"all\", w|nodes = \"1..8\", w", "1.5e4, 1e4|1e4, 1.5e4",
      "[3, 4]|[3, 5]", "w = 50|w = 51", "[-1e-4, -1e-3]|[-1.1e-4, -1e-3]", "[5e4, 4e4]|[5e4, 4.1e4]", "\"3..9\"|\"4..9\"", "modulus = 2e3|modulus = 2.1e3",
      "-2.0e-5|-2.1e-5", "nodes = \"2..3\"|nodes = [3, 2]"]),
    (4, 3, """
[beam]
length = 4
elements = 8
EI = 1e4
[[support]]
node = 1
fix = ["theta", "w"]
[[support]]
x = 4.0
fix = "theta"
[[contact]]
x = [1.0, 2.0, 3.0, 4.0]
surface = "below"
face = -0.001
stiffness = 5e4
[[step]]
name = "many"
uniform = [
  { polynomial = [0.0, -1.0, 2e-1], elements = [7, 8] },
  { value = -1_0.25e-1, elements = "all" },
]
point = [
  { nodes = "2..4", theta = 1 }, { nodes = [8, 9], w = -1, theta = 2.5 }, { node = 5, w = +3.0 },
  { x = [0.5, 3.0], w = -7.0 }, { x = 3.5, theta = -2 },
]
settlement = [ { nodes = "1..1", w = -1e-3 }, { x = [0.0, 4.0], theta = 2e-4 } ]
""", ["-1.0, 2e-1|-1.0, 3e-1", "[7, 8]|[6, 7]", "1_0.25e-1|1.0e-1", "\"2..4\", theta|\"2..3\", theta", "[8, 9]|[8, 7]", "node = 5|node = 6",
      "[0.5, 3.0]|[0.5, 2.5]", "x = 3.5|x = 3.0", "-1e-3 }|-1.1e-3 }", "theta = 2e-4|theta = 2.1e-4", "EI = 1e4|EI = 1.1e4"]),
    (5, 4, """
[beam]
x = [0.0, 2.9]
element_size = 0.7
EI = [ { to = 0.9, value = 2e4 }, { to = 2.9, value = 1.5e4 } ]
[[support]]
x = [0.0, 2.9]
fix = "w"
spring = { theta = 30 }
[[bed]]
modulus = 3e3
surface = "below"
face = [0, -2e-4, 0, -1e-3, 0, 0.0, 0]
[[step]]
point = [ { x = 1.1, w = -10 }, { x = [0.3, 1.7], w = -3 } ]
[[step]]
uniform = 0
[[step]]
uniform = -30
""", ["element_size = 0.7|element_size = 0.35", "to = 0.9|to = 1.1", "2e4 }, |2.1e4 }, ", "x = 1.1|x = 1.2", "[0.3, 1.7]|[0.3, 1.6]", "theta = 30|theta = 31",
      "-2e-4, 0|-1e-4, 0", "uniform = -30|uniform = -31"]),
    (1, 2, """
[beam]
x = [0, 0.1, 0.30000000000000004, 1]
EI = 1234.5000000000000000001
[[support]]
nodes = [1]
fix = ["w", "theta"]
[[contact]]
x = 0.3
surface = "below"
face = -1e-3
stiffness = 1e5
[[step]]
uniform = -100
""", ["0.1,|0.11,", "1234.5|1234.6"]),
    (0, 2, """
[beam]
length = 0.9
element_size = 0.3
EI = 100
[[support]]
x = 0.0
fix = ["w", "theta"]
[[step]]
uniform = [ { polynomial = [1, 2, 3], elements = [1] } ]
""", ["length = 0.9|length = 0.8", "[1, 2, 3]|[1, 2, 2]"]),
]
PLATES = [
    (24, 5, """
[plate]
size = [2.0, 1]
elements = [4, 4]
D = 1e3
nu = 0.3
[[support]]
at = [[0.0, 0.0], [2.0, 0]]
fix = "w"
[[support]]
at = [2.0, 1.0]
spring = { wx = 50.0, w = 1.0e3, wy = 2 }
[[contact]]
nodes = [11, 13]
surface = "below"
face = 0.0
stiffness = 2.0e4
state = "contact"
[[bed]]
nodes = "1..24"
modulus = 30
face = -1e-3
[[step]]
uniform = [ { value = -2 }, { value = -1.5, elements = "3..5" } ]
point = [ { at = [1.0, 0.5], w = -1.0, wx = 0.1, wy = 0.2 }, { nodes = "all", w = -0.1 }, { at = [[0.5, 0.5], [1.5, 0.75]], wx = 0.3 } ]
settlement = [ { at = [2.0, 0.0], w = -0.01 } ]
""", ["[2.0, 1]|[2.0, 1.1]", "[4, 4]|[4, 5]", "D = 1e3|D = 1.1e3", "nu = 0.3|nu = 0.29", "[2.0, 0]|[1.5, 0]", "wx = 50|wx = 51", "wy = 2 }|wy = 3 }", "[11, 13]|[11, 12]",
      "modulus = 30|modulus = 31", "\"3..5\"|\"3..6\"", "[1.0, 0.5]|[1.0, 0.25]", "\"all\", w|\"1..24\", w", "[1.5, 0.75]|[1.5, 0.5]", "-0.01 }|-0.011 }"]),
    (8, 9, """
[plate]
x = [0.0, 0.25, 1.0]
y = [0.0, 0.5, 1.5]
E = 1.1e10
nu = -0.25
thickness = 0.01
[[support]]
nodes = [1, 2, 3]
fix = ["w", "wx", "wy"]
[[contact]]
nodes = "4..9"
surface = "above"
face = 1e-4
stiffness = 10
[[contact]]
at = [[0.25, 1.5], [1.0, 1.5]]
surface = "below"
face = [0, -1e-5]
stiffness = [2000, 100]
[[step]]
uniform = 30
point = [ { node = 8, w = -25 } ]
""", ["0.25, 1.0]|0.3, 1.0]", "1.1e10|1.2e10", "-0.25|-0.2", "0.01|0.011", "\"4..9\"|[9, 8, 7, 6, 5, 4]", "[2000, 100]|[2001, 100]", "uniform = 30|uniform = 31", "1e-4|1.1e-4"]),
]
K = """%%MatrixMarket MATRIX coordinate Real symmetric
% a comment

   % another
3 3 5

1 1 2.000000000000000111e0
2 1 -1
  2 2 2.0

3 2\t-1e0
3 3 1.5

"""
MATRICES = [
    (2, 1, """
[matrix]
stiffness = "K.mtx"
dofs = "K.dof"
coordinates = "K.xyz"
free_motions = 0
storage = "band"
[[support]]
dof = "tip.y"
spring = 2
[[contact]]
dofs = ["mid.y", "tip.y"]
surface = "above"
face = [1, 2]
stiffness = 3
state = "separated"
[[step]]
load = "f.mtx"
point = [ { dofs = ["root.y", "mid.y"], value = 1 }, { dof = ["tip.y"], value = 5.0 } ]
[[step]]
load = "g.mtx"
""", ["K.mtx:3 3 1.5|3 3 1.6", "K.mtx:2 1 -1|2 1 -1.1", "K.mtx:000111e0|000777e0", "K.dof:root.y|tip.y", "K.dof:mid.y|root.y", "f.mtx:2.5|2.6", "g.mtx:3 1 30|3 1 31", "g.mtx:3 1 30|2 1 30",
      "spring = 2|spring = 2.1", "[1, 2]|[1, 2.1]", "stiffness = 3|stiffness = 4", "value = 1 |value = 1.1 ", "\"root.y\", \"mid.y\"|\"mid.y\""]),
    (1, 1, """
[matrix]
stiffness = "K.mtx"
[[support]]
dofs = "1"
fix = true
[[contact]]
dof = "3"
surface = "below"
face = -1
stiffness = 3
[[step]]
point = [ { dof = "2", value = -9 } ]
settlement = [ { dof = "1", value = -0.5 } ]
""", ["dof = \"2\"|dof = \"3\"", "value = -0.5|value = -0.6"]),
]
FILES = {"K.mtx": K, "K.dof": "root.y\n\nmid.y  \n tip.y\n", "K.xyz": "root 0 0\nmid 1 0\ntip 2 0\n",
         "f.mtx": "%%matrixmarket matrix array real general\n% loads\n\n3 1\n0\n\n2.5\n1e1\n",
         "g.mtx": "%%MatrixMarket matrix coordinate real general\n\n3 1 2\n1 1 4\n\n3 1 30\n"}
# Forms that the program refuses, so that no proof is of them.
REFUSED = [("uniform = -100", "uniform = -100\nmove = [ { x = 1.0, w = 0.1 } ]"), ("nodes = [1]", "nodes = [0, 1]"), ("nodes = [1]", "nodes = [1, 1]"),
           ("nodes = [1]", "nodes = [1]\nx = 1.0"), ("x = 0.3\n", "x = 0.31\n"), ("EI = 1234.5000000000000000001", "EI = -1"), ("[[step]]", "[[hinge]]\nx = 0.3\n[[step]]")]


def check(problem, text, others, pairs, supports, folder):
    """A problem, and those that differ from it in one form; how many these are."""
    problem.write_text(text)
    proof, result = run(problem, folder, "--kernels", "corrected")
    if proof is None:
        return fail(f"not solved: {result}{text}") or 0
    code, said = verdict(problem, proof, folder)
    counts = len(result["steps"][0]["pairs"]), len(result["steps"][0]["reactions"]), said.count("; certified")
    if code != 0 or counts != (pairs, supports, text.count("[[step]]") or 1) or any(p["force"] for s in result["steps"] for p in s["pairs"]) != (pairs > 0):
        fail(f"{code}, {counts}: {said}{text}")
    for other in others:
        file, _, change = other.rpartition(".mtx:") if ".mtx:" in other else other.rpartition(".dof:")
        at, (old, new) = folder / (file + other[len(file):other.index(":")] if file else problem.name), change.split("|")
        before = at.read_text()
        at.write_text(before.replace(old, new, 1))
        code, said = verdict(problem, proof, folder)
        if code != 1 or before.count(old) != 1 or "REFUSED: ValueError" not in said:
            fail(f"{other}: {code}, {before.count(old)} times: {said}")
        at.write_text(before)
    return len(others)


def check_keys():
    """Every key of the manual's tables, but for CalculiX's, stands in a problem here."""
    page = (reference / "problem-file.md").read_text()
    page = page[:page.index("## `[calculix]`")] + page[page.index("## `[[support]]`"):]
    keys = set(re.findall(r"(?m)^\| `(\w+)` \|", page)) - {"calculix"}
    texts = "".join(text for _, _, text, _ in BEAMS + PLATES + MATRICES)
    missing = [key for key in sorted(keys) if not re.search(rf"\b{key}\b", texts)]
    if missing or len(keys) < 40:
        fail(f"of {len(keys)} keys of the manual {missing} are in no problem here")
    return len(keys)


with tempfile.TemporaryDirectory() as scratch:
    folder, others = Path(scratch), 0
    for name, text in FILES.items():
        (folder / name).write_text(text)
    for pairs, supports, text, changes in BEAMS + PLATES + MATRICES:
        others += check(folder / "forms.toml", text, changes, pairs, supports, folder)
    problem = folder / "forms.toml"
    problem.write_text(BEAMS[3][2])
    proof, _ = run(problem, folder, "--kernels", "corrected")
    for old, new in REFUSED:
        problem.write_text(BEAMS[3][2].replace(old, new))
        if BEAMS[3][2].count(old) != 1 or verdict(problem, proof, folder)[0] != 1 or run(problem, folder)[0] is not None:
            fail(f"read by the program or by the checker: {new}")
    print(f"{len(BEAMS + PLATES + MATRICES)} problems with {check_keys()} keys are read alike, {others} others and {len(REFUSED)} refused forms were tried")
end()
