"""check_results.py PROGRAM ROOT PLUGIN MINE BENCH: tests that the pages document every key that contct fuzz, verify, exact,
explain and contct_bench (BENCH) write with --json. PLUGIN: a kernel that differs from FORTRAN in the last bit; MINE: a kernel with <= EPSMUL.

- fuzz, replay, verify: reference/check-results.md documents reference/check-results.schema.json, and results follow the schema.
  Every key of the schema is in a result. The examples of the page are output of the program.
- exact, explain, contct_bench: reference/exact.md, explain-format.md and speed.md document exactly the keys of the
  results.
"""
import json
import re
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import blocks, result_of  # noqa: E402
from documented import documented, same  # noqa: E402

LEAST_KEYS, LEAST_PLAIN = 78, 120
# A beam without supports, whose exact path begins with a rigid-body motion and ends in a mechanism.
BEAM = ('[beam]\nlength = 2.0\nelements = 2\nEI = 1.0\n[[contact]]\nx = [0.0, 2.0]\nsurface = "below"\nface = -0.001\nstiffness = 1.0e4\n'
        "[[step]]\nuniform = -1.0\n")
FREE = BEAM + "[[step]]\nuniform = 1.0\n"
COMBINED = BEAM.replace("[[step]]", '[[case]]\nname = "G"') + '[[combination]]\nname = "a"\nterms = { G = 1.0 }\n'
# The keys that contct_bench writes for CHOLMOD; a build without CHOLMOD writes none of them.
OF_PEERS = {"method", "steps", "digits", "wrong_statuses", "values"}


def with_schema(program, root, plugin, mine, folder):
    """Tests the results that have a schema. Returns a summary; raises ValueError for an error."""
    page, wrong = documented(root, "check-results.md", "check-results", "result"), folder / "wrong"
    wrong.mkdir()  # a reference folder in which one exact number is wrong
    (wrong / "problems").symlink_to(root / "reference/problems")
    table = (root / "reference/verification.toml").read_text()
    (wrong / "verification.toml").write_text(table.replace('exact     = "-1/375"', 'exact     = "-1/374"', 1))
    written = []
    (folder / "mine.so").symlink_to(mine)
    (folder / "ties.trace").symlink_to(root / "reference/traces/ties.trace")
    for name, status, *options in (("fuzz", 0, "--calls", 1000, "--problems", 0),
                                   ("fuzz", 1, "--calls", 2000, "--shard", "2/3", "--kernels", f"fortran,cpp,plugin:{plugin}"),
                                   ("verify", 0, "--reference", root / "reference"), ("verify", 1, "--reference", wrong),
                                   ("replay", 1, "--kernel", "plugin:mine.so", "ties.trace")):
        written.append(result_of(program, name, *options, "--quiet", status=status, cwd=folder))
        page.add(options, written[-1], page.schema["$defs"][name])
    page.need_every_key()
    examples = [json.loads(b.text) for b in blocks(page.text) if b.language == "json"]
    fuzzed = {**written[0], "seconds": examples[0]["seconds"]}
    if not same(examples[0], fuzzed) or not any(same(examples[2], check) for check in written[2]["cases"][0]["checks"]) or not same(examples[1], written[4]):
        raise ValueError("an example of check-results.md is not what the program writes")
    if len(page.keys) < LEAST_KEYS:
        raise ValueError(f"found {len(page.keys)} keys; allowed: {LEAST_KEYS} or more")
    return f"{len(page.keys)} keys compared"


def keys_in(value):
    """Yields every key of a result, except the keys of loads, which contct run --json has too, and names."""
    for key, inner in value.items() if isinstance(value, dict) else ():
        if re.fullmatch(r"\w+", key):
            yield key
        if key != "load":
            yield from keys_in(inner)
    for entry in value if isinstance(value, list) else ():
        yield from keys_in(entry)


def documented_keys(text):
    """Returns the keys in a page's JSON, in the first column of its tables, and in braces in cells of its tables."""
    shown = set(re.findall(r'"(\w+)":', "".join(b.text for b in blocks(text) if b.language == "json")))
    rows = [line for line in text.splitlines() if line.startswith("| `")]
    first = {key for row in rows for key in re.findall(r"`(\w+)`", row.split("|")[1])}
    braces = "".join(re.findall(r"`\{[^`]*\}`", "".join(rows)))
    return shown | first | set(re.findall(r'"(\w+)"', braces))


def plainly(program, root, plugin, bench, folder):
    """Tests the results of exact, explain and contct_bench. Returns a summary; raises ValueError for an error."""
    pb07, frame = root / "reference/problems/pb07-three-gap-supports.toml", root / "reference/structures/frame.toml"
    (folder / "free.toml").write_text(FREE)
    (folder / "combined.toml").write_text(COMBINED)
    contct = lambda command, *words, status=0: result_of(program, command, *words, "--quiet", status=status, cwd=folder)
    results = {
        "exact.md": [contct("exact", pb07, "--kernels", "fortran,corrected"), contct("exact", "free.toml", "--kernels", "fortran", status=4),
                     contct("exact", frame), contct("exact", "combined.toml")],
        "explain-format.md": [contct("explain", pb07), contct("explain", root / "reference/problems/divergences/near-tie.toml"), contct("explain", frame),
                              contct("explain", pb07, "--kernels", f"fortran,plugin:{plugin}", status=1)],
        "speed.md": [result_of(bench, "--problem", "rail-3", "--engine", "refactor,updated", "--rounds", 1, cwd=folder)]}
    count = 0
    for page, written in results.items():
        text, found = (root / "reference" / page).read_text(), {key for result in written for key in keys_in(result)}
        keys = documented_keys(text) - (OF_PEERS if page == "speed.md" and not written[0]["peers"] else set())
        if missing := found - keys - set(re.findall(r"`(\w+)`", text)):  # a name in backticks may document a key
            raise ValueError(f"{page}: written, not documented: {min(missing)}")
        if missing := keys - found:
            raise ValueError(f"{page}: documented, not written: {min(missing)}")
        count += len(found)
    if count < LEAST_PLAIN:
        raise ValueError(f"found {count} keys of exact, explain and contct_bench; allowed: {LEAST_PLAIN} or more")
    return f"{count} keys of exact, explain and contct_bench"


program, root, plugin, mine, bench = (Path(a).resolve() for a in sys.argv[1:])
with tempfile.TemporaryDirectory() as scratch:
    print(with_schema(program, root, plugin, mine, Path(scratch)))
    print(plainly(program, root, plugin, bench, Path(scratch)))
