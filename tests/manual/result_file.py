"""result_file.py PROGRAM ROOT PLUGIN: tests that results of contct run --json follow reference/result.schema.json, and
that reference/result-file.md documents this schema. PLUGIN: a kernel that differs from FORTRAN in the last bit.

- The results of every reference problem under the 1989 and the corrected rule, and results of each other kind, are
  valid.
- Each key of the schema has a row in the manual or a description in the schema; a row states whether the key may be
  absent or null.
- The result in a page is valid too.
- The key "status" of a result and the exit status are a pair that the manual lists.
- Every key of the schema except those in UNSEEN is in a result. The example of the manual is output of the program.
"""
import json
import re
import sys
import tempfile
from pathlib import Path

from documented import first_difference, objects, parsed, result_of, same, seen_keys, validator, written_by
from manual import blocks


# No result has "ended_by", because every path of a reference problem reaches the ends of its steps.
UNSEEN = {("A step", "ended_by")}
LEAST_RUNS, LEAST_KEYS = 135, 267

MECHANISM = """
[units]
length = "m"
force = "kN"
[beam]
length = 4.0
elements = 4
EI = 1.0e4
[[contact]]
x = [1.0, 3.0]
surface = "below"
face = 0.0
stiffness = 1.0e4
[[step]]
uniform = -1.0
[[step]]
uniform = [ { value = -1.0 }, { polynomial = [0.0, 1.0e-3], elements = "2..3" } ]
point = [ { x = 2.0, w = 12.0, theta = 0.5 } ]
"""
PARTS = """
[beam]
length = 4.0
elements = 2
EI = 1.0e4
[[support]]
x = [0.0, 4.0]
fix = "w"
[[step]]
uniform = [ { value = -1.0, from = 0.5, to = 2.5 } ]
point = [ { x = 1.3, w = 12.0, theta = 0.5 } ]
curvature = [ { value = 1.0e-3, to = 3.0 } ]
"""
PLATE = """
[plate]
size = [1.0, 1.0]
elements = [2, 2]
E = 10.92
nu = 0.3
thickness = 1.0
[[support]]
nodes = "1..3"
fix = ["w", "wx", "wy"]
[[contact]]
node = 5
surface = "below"
face = -1.0e-3
stiffness = 1.0
[[step]]
uniform = [ { value = 1.0, from = [0.1, 0.2], to = [0.9, 0.3] } ]
point = [ { node = 5, w = 1.0, wx = 1.0, wy = 1.0 } ]
settlement = [ { node = 1, wx = 1.0e-3, wy = 1.0e-3 }, { node = 2, w = 1.0e-3 } ]
move = [ { node = 5, w = 1.0e-2 } ]
"""
MANY_PARTS = PLATE + f"[[step]]\npoint = [ {', '.join(['{ node = 5, w = 1 }'] * 40)} ]\n"
COMBINATIONS = """
[beam]
length = 2.0
elements = 2
EI = 1.0
[[contact]]
x = [0, 2]
surface = "below"
face = 0
stiffness = 10
[[case]]
name = "down"
uniform = -1.0
[[combination]]
name = "lifts"
terms = { down = -1.0 }
[[combination]]
name = "rests"
terms = { down = 1.5 }
[[combination]]
name = "lifts more"
terms = { down = -2.0 }
[[train]]
name = "cart"
axles = [ { at = 0, w = -1 } ]
from = 0.5
to = 1.5
by = 1
terms = { down = 1.5 }
factor = 1.4
"""
SETTLED_BEAM = """
[beam]
length = 2.0
elements = 2
section = { E = 1.0, I = 1.0, W = 0.5 }
[[support]]
nodes = [1, 3]
fix = ["w", "theta"]
[[step]]
settlement = [ { node = 1, theta = 1.0e-3 } ]
"""


def exit_statuses(text):
    """Returns the pairs (exit status, value of the key "status") in the manual."""
    rows = re.findall(r'^\| `"([\w-]+)"` \| (.*) \|$', text.split("\n## Exit status")[1].split("\n## ")[0], re.M)
    return {(int(number), status) for status, cell in rows for number in re.findall(r"\d", cell)}


def runs(root, plugin):
    """Yields (problem file or text, options, exit status) for each result."""
    problems = sorted(p for folder in ("problems", "structures") for p in (root / "reference" / folder).rglob("*.toml"))
    for problem in problems:
        ended = 5 if problem.stem in ("locked-in-forces", "standstill") else 0
        yield problem, ["--kernels", "fortran,cpp"], ended
        yield problem, [], 0
    for part in ("problems/pb07-three-gap-supports", "problems/pp04a-unilateral-edges-settled-column-n6", "structures/frame"):
        problem = root / f"reference/{part}.toml"
        yield problem, ["--kernels", "corrected", "--envelope", "--proof", "proof.json"], 0
        yield problem, ["--final-only"], 0
    for part in ("pb07-three-gap-supports", "pp05a-free-plate-on-bed-n8"):
        yield root / f"reference/problems/{part}.toml", ["--kernels", "corrected", "--refine"], 0
    pb07 = root / "reference/problems/pb07-three-gap-supports.toml"
    yield pb07, ["--free-run", "--kernels", "fortran,cpp"], 0
    yield pb07, ["--free-run", "--kernels", "corrected,fortran"], 1
    yield pb07, ["--kernels", f"fortran,plugin:{plugin}"], 1
    yield pb07, ["--kernels", "fortran", "--max-increments", "1"], 5
    yield root / "reference/problems/divergences/near-tie.toml", ["--kernels", "fortran,cpp", "--strict"], 3
    yield MECHANISM, ["--envelope"], 4
    yield COMBINATIONS, ["--envelope"], 4
    yield COMBINATIONS, ["--html", "page.html"], 4
    yield MECHANISM, ["--final-only"], 4
    for text in (PLATE, MANY_PARTS, SETTLED_BEAM, PARTS):
        yield text, ["--envelope"], 0
    yield PLATE, ["--html", "page.html"], 0
    for part in ("problems/pb07-three-gap-supports", "problems/pp05a-free-plate-on-bed-n8", "problems/pb14-gerber-beam", "problems/pb15-two-beams", "structures/frame", "structures/calculix/console"):
        yield root / f"reference/{part}.toml", ["--html", "page.html"], 0


def result_of_run(program, folder, problem, options, status):
    """Returns the result of a run with this exit status; with --html, the result that is embedded in the page."""
    if isinstance(problem, str):
        (folder / "own.toml").write_text(problem)
        problem = "own.toml"
    line = [program, "run", problem, "--quiet", "--json", "result.json", *options]
    if "--html" in options:
        return parsed(written_by(line, folder, status, "page.html").split('id="data">')[1].split("</script>")[0])
    return result_of(line, folder, status)


def main(program, root, plugin):
    program, root = str(Path(program).resolve()), Path(root).resolve()
    page = root / "reference/result-file.md"
    text, schema = page.read_text(), json.loads((root / "reference/result.schema.json").read_text())
    if difference := first_difference(text, schema):
        return f"result-file.md and result.schema.json: {difference}"
    check, seen, count, ended = validator(schema), set(), 0, set()
    with tempfile.TemporaryDirectory() as folder:
        for problem, options, status in runs(root, Path(plugin).resolve()):
            result = result_of_run(program, Path(folder), problem, options, status)
            if fault := check.fault(result):
                return f"{problem} {options}: {fault}"
            if without := [step["step"] for step in result["steps"] if "displacement" not in step]:
                return f"{problem} {options}: found steps {without} without displacement"
            count += 1
            ended.add((status, result["status"]))
            seen_keys(schema, result, schema, seen)
        shown = blocks(text)
        example = result_of_run(program, Path(folder), shown[0].text, [], 0)
        if not same(json.loads(shown[1].text), example):
            return f"line {shown[1].line}: the example is not what the program writes:\n{json.dumps(example)}"
    keys = {(title, key) for title, of in objects(schema).items() for key in of["properties"]}
    if missing := keys - seen - UNSEEN:
        return f"no result has this key: {min(missing)}"
    if different := ended ^ exit_statuses(text):
        return f"result-file.md and the runs: exit status {min(different)}"
    if count < LEAST_RUNS or len(keys) < LEAST_KEYS:
        return f"found {count} results and {len(keys)} keys; allowed: {LEAST_RUNS} and {LEAST_KEYS} or more"
    print(f"{len(objects(schema))} objects, {len(keys)} keys compared; {count} results are valid and have {len(seen)} of the keys")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
