"""check_results.py PROGRAM ROOT PLUGIN BENCH: tests that the pages document every key that contct fuzz, verify, exact,
explain and contct_bench (BENCH) write with --json. PLUGIN: a kernel that differs from FORTRAN in the last bit.

- fuzz, verify: reference/check-results.md documents reference/check-results.schema.json, and results follow the schema.
  Every key of the schema is in a result. The examples of the page are output of the program.
- exact, explain, contct_bench: reference/exact.md, explain-format.md and speed.md document exactly the keys of the
  results.
"""
import json
import re
import sys
import tempfile
from pathlib import Path

from documented import first_difference, objects, result_of, same, seen_keys, validator
from manual import blocks

JSON = ["--quiet", "--json", "result.json"]
LEAST_KEYS, LEAST_PLAIN = 78, 120
BEAM = """
[beam]
length = %s
elements = %s
EI = 1.0
[[contact]]
x = [0.0, %s]
surface = "below"
face = -0.001
stiffness = 1.0e4
[[step]]
uniform = -1.0
"""
# A beam without supports, whose exact path begins with a rigid-body motion and ends in a mechanism.
FREE = BEAM % (2.0, 2, 2.0) + "[[step]]\nuniform = 1.0\n"

# The keys that contct_bench writes for CHOLMOD; a build without CHOLMOD writes none of them.
OF_PEERS = {"method", "steps", "digits", "wrong_statuses", "values"}


def doctored_reference(root, folder):
    """Makes a reference folder in which one exact number is wrong, and returns its path."""
    (folder / "wrong").mkdir()
    (folder / "wrong/problems").symlink_to(root / "reference/problems")
    table = (root / "reference/verification.toml").read_text()
    (folder / "wrong/verification.toml").write_text(table.replace('exact     = "-1/375"', 'exact     = "-1/374"', 1))
    return folder / "wrong"


def of_schema(program, root, plugin, folder):
    """Yields (name in the schema, arguments, exit status) for each result."""
    yield "fuzz", ["fuzz", "--calls", 1000, "--problems", 0], 0
    yield "fuzz", ["fuzz", "--calls", 2000, "--shard", "2/3", "--kernels", f"fortran,cpp,plugin:{plugin}"], 1
    yield "verify", ["verify", "--reference", root / "reference"], 0
    yield "verify", ["verify", "--reference", doctored_reference(root, folder)], 1


def with_schema(program, root, plugin, folder):
    """Tests the results that have a schema. Returns a summary; raises ValueError for an error."""
    text = (root / "reference/check-results.md").read_text()
    schema, results = (json.loads((root / f"reference/{name}.schema.json").read_text()) for name in ("check-results", "result"))
    if difference := first_difference(text, schema):
        raise ValueError(f"check-results.md and check-results.schema.json: {difference}")
    check, seen, written = validator(schema, {"result.schema.json": results}), set(), []
    for name, arguments, status in of_schema(program, root, plugin, folder):
        result = result_of([program, *arguments, *JSON], folder, status)
        of = schema["$defs"][name]
        if fault := check.fault(result) or check.fault(result, of):
            raise ValueError(f"{arguments}: {fault}: {check.fault(result, of)}")
        seen_keys(schema, result, of, seen)
        written.append(result)
    keys = {(title, key) for title, of in objects(schema).items() for key in of["properties"]}
    if missing := keys - seen:
        raise ValueError(f"no result has this key: {min(missing)}")
    examples = [json.loads(b.text) for b in blocks(text) if b.language == "json"]
    fuzzed = {**written[0], "seconds": examples[0]["seconds"]}
    if not same(examples[0], fuzzed) or not any(same(examples[1], check) for check in written[2]["cases"][0]["checks"]):
        raise ValueError("an example of check-results.md is not what the program writes")
    if len(keys) < LEAST_KEYS:
        raise ValueError(f"found {len(keys)} keys; allowed: {LEAST_KEYS} or more")
    return f"{len(keys)} keys compared"


def keys_in(value, found):
    """Adds every key of a result to `found`, except the keys of loads, which contct run --json has too, and names."""
    for key, inner in value.items() if isinstance(value, dict) else ():
        if re.fullmatch(r"\w+", key):
            found.add(key)
        if key != "load":
            keys_in(inner, found)
    for entry in value if isinstance(value, list) else ():
        keys_in(entry, found)


def documented_keys(text):
    """Returns the keys in a page's JSON, in the first column of its tables, and in braces in cells of its tables."""
    shown = set(re.findall(r'"(\w+)":', "".join(b.text for b in blocks(text) if b.language == "json")))
    rows = [line for line in text.splitlines() if line.startswith("| `")]
    first = {key for row in rows for key in re.findall(r"`(\w+)`", row.split("|")[1])}
    braces = "".join(re.findall(r"`\{[^`]*\}`", "".join(rows)))
    return shown | first | set(re.findall(r'"(\w+)"', braces))


def plain_difference(documented, named, found):
    """Returns the first difference in words, or None. `named`: names in backticks, which may document a key."""
    if missing := found - documented - named:
        return f"written, not documented: {min(missing)}"
    if missing := documented - found:
        return f"documented, not written: {min(missing)}"
    return None


def plainly(program, root, plugin, bench, folder):
    """Tests the results of exact, explain and contct_bench. Returns a summary; raises ValueError for an error."""
    pb07 = root / "reference/problems/pb07-three-gap-supports.toml"
    (folder / "free.toml").write_text(FREE)
    of_case = (BEAM % (2.0, 2, 2.0)).replace("[[step]]", '[[case]]\nname = "G"')
    (folder / "combined.toml").write_text(of_case + '[[combination]]\nname = "a"\nterms = { G = 1.0 }\n')
    near_tie = root / "reference/problems/divergences/near-tie.toml"
    results = {
        "exact.md": [["exact", pb07, "--kernels", "fortran,corrected"], ["exact", "free.toml", "--kernels", "fortran"],
                     ["exact", root / "reference/structures/frame.toml"], ["exact", "combined.toml"]],
        "explain-format.md": [["explain", pb07], ["explain", near_tie],
                              ["explain", root / "reference/structures/frame.toml"],
                              ["explain", pb07, "--kernels", f"fortran,plugin:{plugin}"]],
        "speed.md": [["--problem", "rail-3", "--engine", "refactor,updated", "--rounds", "1"]]}
    count = 0
    for page, lines in results.items():
        text, found = (root / "reference" / page).read_text(), set()
        for arguments in lines:
            status = 4 if "free.toml" in arguments else 1 if str(arguments[-1]).startswith("fortran,plugin") else 0
            line = [bench, *arguments, *JSON[1:]] if page == "speed.md" else [program, *arguments, *JSON]
            result = result_of(line, folder, status)
            keys_in(result, found)
        documented = documented_keys(text)
        if page == "speed.md" and not result["peers"]:
            documented -= OF_PEERS
        named = set(re.findall(r"`(\w+)`", text))
        if difference := plain_difference(documented, named, found):
            raise ValueError(f"{page}: {difference}")
        count += len(found)
    if count < LEAST_PLAIN:
        raise ValueError(f"found {count} keys of exact, explain and contct_bench; allowed: {LEAST_PLAIN} or more")
    return f"{count} keys of exact, explain and contct_bench"


def main(program, root, plugin, bench):
    program, root, plugin = str(Path(program).resolve()), Path(root).resolve(), Path(plugin).resolve()
    with tempfile.TemporaryDirectory() as folder:
        try:
            print(with_schema(program, root, plugin, Path(folder)))
            print(plainly(program, root, plugin, str(Path(bench).resolve()), Path(folder)))
        except ValueError as wrong:
            return str(wrong)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
