"""result_file.py PROGRAM ROOT PLUGIN [EVERY]: tests that results of contct run --json follow reference/result.schema.json,
and that reference/result-file.md documents this schema. PLUGIN: a kernel that differs from FORTRAN in the last bit.
EVERY: only every so many runs.

- The results of every reference problem under the 1989 and the corrected rule, and of small problems of each kind with
  every option of contct run, are valid. So are the results in pages.
- Each key of the schema has a row in the manual or a description in the schema; a row states whether the key may be
  absent or null.
- On each list of a step, the numbers of the schema are those that "quantities" of the result has for this list.
- The key "status" of a result and the exit status are a pair that the manual lists.
- Every key of the schema is in a result. The example of the manual is output of the program.
"""
import json
import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import blocks, parsed, run  # noqa: E402
from documented import documented, same  # noqa: E402
from kinds import FILES, KINDS, LINES, runs_of_kinds  # noqa: E402

# For each list of quantities, the title of its object in the schema, and the entries of a step. Reactions have no keys.
LISTS = {"nodes": ("A step", lambda step: [step]), "pairs": ("A pair", lambda step: step["pairs"]), "beds": ("A bed", lambda step: step["beds"]),
         "element_ends": ("An element", lambda step: step["elements"]), "structure": ("`balance`", lambda step: [step.get("balance", {})])}
PLACES = {"displacement", "fraction", "rcond", "x", "y"}  # numbers that are no quantities


def quantities(page, result):
    """Returns {(list, key)} of a result's quantities. Raises ValueError if the entries of a list have other numbers."""
    for on, (title, entries) in LISTS.items():
        schema = page.objects[title]["properties"]
        numbers = {key for key, of in schema.items() if of.get("items", of).get("type") == "number" or of.get("$ref") == "#/$defs/range"} - PLACES
        rows = {row["key"].removeprefix("bed_").removeprefix("sum_of_") for row in result["quantities"] if row["on"] == on}
        for entry in (entry for step in result["steps"] for entry in entries(step)):
            if different := rows ^ (numbers & set(entry)):
                raise ValueError(f"a quantity on {on} that only one of the table and the list has: {min(different)}")
    return {(row["on"], row["key"]) for row in result["quantities"]}


def runs(root, plugin):
    """Yields (problem file or text, options, exit status) for each result."""
    for problem in sorted(p for folder in ("problems", "structures") for p in (root / "reference" / folder).rglob("*.toml")):
        yield problem, ["--kernels", "fortran,cpp"], 5 if problem.stem in ("locked-in-forces", "standstill") else 0
        yield problem, [], 0
    pb07, plate = "problems/pb07-three-gap-supports", "problems/pp05a-free-plate-on-bed-n8"
    corrected = ["--kernels", "corrected"]
    for parts, options, status in (
            ((pb07, "problems/pp04a-unilateral-edges-settled-column-n6", "structures/frame"), [*corrected, "--envelope", "--proof", "proof.json"], 0),
            ((pb07, "problems/pp04a-unilateral-edges-settled-column-n6", "structures/frame"), ["--final-only"], 0),
            ((pb07, plate), [*corrected, "--refine"], 0), ((pb07,), ["--free-run", "--kernels", "fortran,cpp"], 0),
            ((pb07,), ["--free-run", "--kernels", "corrected,fortran"], 1), ((pb07,), ["--kernels", f"fortran,plugin:{plugin}"], 1),
            ((pb07,), ["--kernels", "fortran", "--max-increments", "1"], 5), (("problems/divergences/near-tie",), ["--kernels", "fortran,cpp", "--strict"], 3),
            ((pb07, plate, "problems/pb14-gerber-beam", "problems/pb15-two-beams", "structures/frame", "structures/calculix/console"), ["--html", "page.html"], 0)):
        for part in parts:
            yield root / f"reference/{part}.toml", options, status
    for text, options in runs_of_kinds():
        yield text, options, (0, 1, 3, 4, 5)


def result_of_run(program, folder, problem, options, status):
    """Returns (exit status, result) of a run; with --html, the result that is embedded in the page."""
    if isinstance(problem, str):
        (folder / "own.toml").write_text(problem)
        problem = "own.toml"
    found = run(program, "run", problem, "--quiet", "--json", "result.json", *options, cwd=folder, status=status)
    text = (folder / "page.html").read_text().split('id="data">')[1].split("</script>")[0] if "--html" in options else (folder / "result.json").read_text()
    return found.returncode, parsed(text)


program, root, plugin = (Path(a).resolve() for a in sys.argv[1:4])
every = int(next(iter(sys.argv[4:]), 1))
page, count, ended, known = documented(root, "result-file.md", "result"), 0, set(), set()
options = set(re.findall(r"^ +(--[\w-]+)", run(program, "run", "--help").stdout, re.M)) - {"--quiet", "--json", "--help"}
if missing := options - {word for line in LINES for word in line}:
    sys.exit(f"no run of kinds.py has the option {min(missing)}")
with tempfile.TemporaryDirectory() as scratch:
    folder = Path(scratch)
    for name, content in FILES.items():
        (folder / name).write_text(content)
    for problem, options, status in list(runs(root, plugin))[::every]:
        status, result = result_of_run(program, folder, problem, options, status)
        page.add((problem, options), result)
        if without := [step["step"] for step in result["steps"] if "displacement" not in step]:
            sys.exit(f"{problem} {options}: found steps {without} without displacement")
        known |= quantities(page, result)
        count += 1
        ended.add((status, result["status"]))
    shown = blocks(page.text)
    _, example = result_of_run(program, folder, shown[0].text, [], 0)
    if not same(json.loads(shown[1].text), example):
        sys.exit(f"line {shown[1].line}: the example is not what the program writes:\n{json.dumps(example)}")
if every == 1:
    page.need_every_key()
    rows = re.findall(r'^\| `"([\w-]+)"` \| (.*) \|$', page.text.split("\n## Exit status")[1].split("\n## ")[0], re.M)
    if different := ended ^ {(int(number), status) for status, cell in rows for number in re.findall(r"\d", cell)}:
        sys.exit(f"result-file.md and the runs: exit status {min(different)}")
found = count, len(KINDS), len(page.keys), len(known)
if any(number < least for number, least in zip(found, (320 // every, 31, 356, 28))):
    sys.exit(f"found {found} results, kinds, keys and quantities; allowed: {320 // every}, 31, 356 and 28 or more")
print(f"{len(page.objects)} objects, {len(page.keys)} keys compared; {count} results are valid and have {len(page.seen)} of the keys and {len(known)} quantities")
