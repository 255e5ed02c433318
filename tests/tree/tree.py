"""tree.py ROOT WHAT ARGUMENT..: fails unless the tree of the sources, or the build, is as a function below says."""
import hashlib
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(sys.argv[1])
FORBIDDEN = {"-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-fassociative-math", "-freciprocal-math", "-ffinite-math-only",
             "-fno-signed-zeros", "-ffp-contract=fast", "-ffp-contract=on"}
# The floors of cpp/contct, the lowest first. A folder may include headers of lower floors only. The replay of a trace
# must need no structure and no LAPACK.
FLOORS = ["text number", "kernel linear", "harness structure", "path read", "exact", "proof", "results", "write", "serve"]
REPLAY = {"kernel": {"text", "number"}, "harness": {"text", "number", "kernel"}}
MOST_SOURCES = 45
TOP = {"CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "cpp", "fortran", "reference", "tests"}
SLACK = 0.01  # a limit in lines.txt may be this share above what is found


def must(holds, what):
    if not holds:
        sys.exit(what)


git_files = lambda *paths: subprocess.run(["git", "-C", ROOT, "ls-files", *paths], check=True, capture_output=True, text=True).stdout.splitlines()


def folder(name, do):
    """Makes the working folder of the test programs, or checks that it is empty after them, since every test must write
    to a scratch folder."""
    if do == "make":
        shutil.rmtree(name, ignore_errors=True)
        Path(name).mkdir(parents=True)
    left = [file.name for file in Path(name).iterdir()]
    must(not left, f"{name}: found {left}; allowed: nothing, a test writes to a scratch folder (tests/support)")


def flags(commands):
    """Every command of compile_commands.json is strict about floating point."""
    rows = json.loads(Path(commands).read_text())
    for row in rows:
        words = set(row["command"].split())
        must("-ffp-contract=off" in words and not words & FORBIDDEN, f"{row['file']} is compiled without strict floating point:\n{row['command']}")
    listings = sum(row["file"].endswith("fortran/contct.f") for row in rows)
    must(len(rows) >= 20 and listings >= 2, f"only {len(rows)} commands and {listings} of the listing were looked at")


def floors():
    """No folder of cpp/contct includes a header of its own floor or of a higher floor, or has too many sources."""
    sources, below, looked_at = ROOT / "cpp/contct", {}, 0
    for floor in FLOORS:
        below |= dict.fromkeys(floor.split(), set(below))
    for room in (room for room in sources.iterdir() if room.is_dir()):
        must(room.name in below, f"{room}: it has no floor in tests/tree/tree.py")
        files = [*room.glob("*.hpp"), *room.glob("*.cpp")]
        must(len(files) <= MOST_SOURCES, f"{room}: found {len(files)} sources; allowed: {MOST_SOURCES} or fewer")
        allowed = {room.name} | REPLAY.get(room.name, below[room.name])
        for file in files:
            for line in re.findall(r'^#include "(.*)"', file.read_text(), re.M):
                other = re.match(r"contct/([a-z]+)/", line)
                must(other, f"{file}: {line}: name the room, as in \"contct/{room.name}/...\"")
                must(other[1] in allowed, f"{file}: {line}: {room.name}/ must not know {other[1]}/")
                looked_at += 1
    must(looked_at >= 40, f"only {looked_at} includes were looked at: something is missing")


def quantities():
    """Beside the reader, the names of dofs, those of elements, the kinds of bounds and the table, no source names a quantity."""
    name = re.compile(r"""["'](moment|shear|pressure|von_mises|mxy|slope|theta|bed_force)["']""")
    known = {"cpp/contct/structure/problem.hpp", "cpp/contct/structure/elements.hpp", "cpp/contct/proof/solved_path.hpp"}
    sources = [file for file in git_files("cpp") if not re.match(r"cpp/contct/(read/|results/quantities\.)", file)]
    found = {file for file in sources if name.search((ROOT / file).read_text(errors="replace"))}
    must(len(sources) > 200 and found == known, f"found names of quantities in {sorted(found)}; allowed: {sorted(known)}")


def top():
    """The top folder has exactly the allowed files and folders, apart from names with a dot first; presets name folders of tests."""
    names = {name.split("/")[0] for name in git_files()} if (ROOT / ".git").exists() else {file.name for file in ROOT.iterdir()} - {"build"}
    found = {name for name in names if name[0] != "."}
    must(found == TOP, f"{ROOT}: found {sorted(found - TOP)}, and missed {sorted(TOP - found)} at the top level")
    filters = re.findall(r"\^\(([a-z|]+)\)/", (ROOT / "CMakePresets.json").read_text())
    missing = [name for name in "|".join(filters).split("|") if not (ROOT / "tests" / name).is_dir()]
    must(len(filters) == 3 and not missing, f"CMakePresets.json: found {len(filters)} filters of tests, with {missing}; allowed: 3, of folders in tests")


def listing(file):
    """The listing has the SHA-256 in reference/contct.f.sha256."""
    found, allowed = hashlib.sha256(Path(file).read_bytes()).hexdigest(), (ROOT / "reference/contct.f.sha256").read_text().split()[0]
    must(found == allowed, f"The listing has been edited: {file}: found SHA-256 {found}; allowed: {allowed}\n"
         "contct.f is the 1989 listing, statement for statement. If it was edited by accident, restore it. If an erratum was read anew, write it into "
         "reference/errata.toml and reference/ERRATA.md, then run sha256sum fortran/contct.f > reference/contct.f.sha256")


def changelog(version, *pages):
    """The changelog begins with the project's version and goes on with older versions; the pages show this version only."""
    for page in pages:
        shown = set(re.findall(r"(?:version = \{|_)(\d+\.\d+\.\d+)", (ROOT / page).read_text()))
        must(shown == {version}, f"{page}: found versions {sorted(shown)}; allowed: {version}, the project's version")
    entries = re.findall(r"^## .*$", (ROOT / "reference/CHANGELOG.md").read_text(), re.M)
    found = [re.fullmatch(r"## (\d+)\.(\d+)\.(\d+), \d{4}-\d\d-\d\d", entry) for entry in entries]
    must(all(found), f"CHANGELOG.md: found {entries}; allowed: \"## VERSION, YEAR-MONTH-DAY\"")
    numbers = [tuple(map(int, entry.groups())) for entry in found]
    must(numbers == sorted(set(numbers), reverse=True) and len(numbers) >= 2, f"CHANGELOG.md: found {numbers}; allowed: the newest version first")
    must(".".join(map(str, numbers[0])) == version, f"CHANGELOG.md: found {numbers[0]} at the top; allowed: {version}, the project's version")


def lines():
    """cpp and tests have no more lines, and the pages no more words, than lines.txt allows, and not so many fewer that the
    limit no longer holds what was reached."""
    rows = [row.split(" ", 1) for row in Path(__file__).with_name("lines.txt").read_text().splitlines() if row and row[0] != "#"]
    found = dict.fromkeys(("lines of cpp", "lines of tests", "words of pages"), 0)
    for name in git_files("cpp", "tests", "reference", "README.md"):
        content = (ROOT / name).read_bytes()
        if name.startswith(("cpp/", "tests/")):
            found[f"lines of {name.split('/')[0]}"] += content.count(b"\n")
        elif name.endswith(".md"):
            found["words of pages"] += len(content.split())
    must([what for _, what in rows] == list(found), f"lines.txt: found {rows}; allowed: {list(found)}")
    print(found)
    for most, what in rows:
        must(found[what] <= int(most), f"{what}: found {found[what]}; allowed: {most}. Remove or share something, or use an issue's allowance")
        must(found[what] >= int(most) * (1 - SLACK), f"{what}: found {found[what]}; lower the limit of {most} in tests/tree/lines.txt to what was reached")


{of.__name__: of for of in (folder, flags, floors, quantities, top, listing, changelog, lines)}[sys.argv[2]](*sys.argv[3:])
