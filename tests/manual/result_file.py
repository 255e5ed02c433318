"""result_file.py PROGRAM ROOT PLUGIN: tests that results of contct run --json follow reference/result.schema.json, and
that reference/result-file.md documents this schema. PLUGIN: a kernel that differs from FORTRAN in the last bit.

- The results of every reference problem under the 1989 and the corrected rule, and of small problems of each kind with
  every option of contct run, are valid.
- Each key of the schema has a row in the manual or a description in the schema; a row states whether the key may be
  absent or null.
- The result in a page is valid too.
- The key "status" of a result and the exit status are a pair that the manual lists.
- Every key of the schema is in a result. The example of the manual is output of the program.
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from documented import first_difference, objects, parsed, same, seen_keys, validator
from kinds import FILES, KINDS, missing_options, runs_of_kinds
from manual import blocks


LEAST_RUNS, LEAST_KINDS, LEAST_KEYS = 320, 31, 337


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
    for part in ("problems/pb07-three-gap-supports", "problems/pp05a-free-plate-on-bed-n8", "problems/pb14-gerber-beam", "problems/pb15-two-beams", "structures/frame", "structures/calculix/console"):
        yield root / f"reference/{part}.toml", ["--html", "page.html"], 0
    for text, options in runs_of_kinds():
        yield text, options, None


def result_of_run(program, folder, problem, options, status):
    """Returns (exit status, result) of a run with this exit status, or with any that has a result if `status` is None;
    with --html, the result that is embedded in the page."""
    if isinstance(problem, str):
        (folder / "own.toml").write_text(problem)
        problem = "own.toml"
    line = [program, "run", problem, "--quiet", "--json", "result.json", *options]
    found = subprocess.run(line, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if found.returncode not in ((0, 1, 3, 4, 5) if status is None else (status,)):
        raise ValueError(f"{line}: found exit status {found.returncode}, allowed: {status}\n{found.stderr}")
    if "--html" in options:
        return found.returncode, parsed((folder / "page.html").read_text().split('id="data">')[1].split("</script>")[0])
    return found.returncode, parsed((folder / "result.json").read_text())


def main(program, root, plugin, every=1):
    program, root = str(Path(program).resolve()), Path(root).resolve()
    page = root / "reference/result-file.md"
    text, schema = page.read_text(), json.loads((root / "reference/result.schema.json").read_text())
    if difference := first_difference(text, schema):
        return f"result-file.md and result.schema.json: {difference}"
    check, seen, count, ended = validator(schema), set(), 0, set()
    help_text = subprocess.run([program, "run", "--help"], capture_output=True, text=True).stdout
    if missing := missing_options(help_text):
        return f"no run of kinds.py has the option {min(missing)}"
    with tempfile.TemporaryDirectory() as folder:
        for name, content in FILES.items():
            (Path(folder) / name).write_text(content)
        for problem, options, status in list(runs(root, Path(plugin).resolve()))[::int(every)]:
            status, result = result_of_run(program, Path(folder), problem, options, status)
            if fault := check.fault(result):
                return f"{problem} {options}: {fault}"
            if without := [step["step"] for step in result["steps"] if "displacement" not in step]:
                return f"{problem} {options}: found steps {without} without displacement"
            count += 1
            ended.add((status, result["status"]))
            seen_keys(schema, result, schema, seen)
        shown = blocks(text)
        _, example = result_of_run(program, Path(folder), shown[0].text, [], 0)
        if not same(json.loads(shown[1].text), example):
            return f"line {shown[1].line}: the example is not what the program writes:\n{json.dumps(example)}"
    keys = {(title, key) for title, of in objects(schema).items() for key in of["properties"]}
    if every == 1 and (missing := keys - seen):
        return f"no result has this key: {min(missing)}"
    if every == 1 and (different := ended ^ exit_statuses(text)):
        return f"result-file.md and the runs: exit status {min(different)}"
    if count < LEAST_RUNS // int(every) or len(KINDS) < LEAST_KINDS or len(keys) < LEAST_KEYS:
        return f"found {count} results, {len(KINDS)} kinds and {len(keys)} keys; allowed: {LEAST_RUNS}, {LEAST_KINDS} and {LEAST_KEYS} or more"
    print(f"{len(objects(schema))} objects, {len(keys)} keys compared; {count} results are valid and have {len(seen)} of the keys")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
