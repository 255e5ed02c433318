"""mpi.py CASE CONTCT REFERENCE [MPIEXEC RANKS]: `contct run --engine petsc`, by one process and under mpirun.

CASE:
  equal      every plate and matrix problem of REFERENCE, a beam, and mat-50, by RANKS ranks: its events, shares of the step
             and statuses are those of one process on the default engine, and D is within the error bounds of both.
  bad-input  what is refused is refused with one message and exit status 2, and leaves no file.
  parts      a matrix of which each of RANKS ranks reads a part: bad ones are refused in the words of one process.
  torn       the file's parts that one rank of two cannot read: one message, exit status 2 and no file.
  multigrid  without room for a factor the events are the same, nothing is certified, and the residual is told.
  killed     a rank that is killed ends the job, with an exit status other than 0 and without a file.
  engines    the tests of every engine, where rank 0 of RANKS runs them and petsc is among the engines.
  factor     a matrix that RANKS ranks share: its factors and solutions, and what has no factor.
  pieces     --vtu F.pvtu by RANKS ranks: pieces that have every cell of F.vtu once and every point with its numbers; the JSON
             has the displacement of every dof where --displacement asks for it, and in results of other engines.
  naming     the files of --vtu F.pvtu where one of them cannot get its name: F.pvtu is the last to get its own.
  binary     what contct convert writes is read by PETSc itself, which writes the same bytes.
  scaling    the benchmark of the ranks: the events of one process, a time, and the memory of each rank.
  absent     without its module the engine is refused with one message that says what is missing.
  apart      the program itself links neither MPI nor PETSc.
"""
import json
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from xml.etree import ElementTree

LEAST = {"problems": 28, "increments": 300, "events": 900, "numbers": 12500}
PATIENCE = 1200  # seconds, after which something hangs


def mpi_environment():
    """As root Open MPI wants to be told twice; where processors are shared, a rank that waits had better let others run."""
    return os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                         "OMPI_MCA_mpi_yield_when_idle": "1", "ASAN_OPTIONS": "detect_leaks=0"}


def mpirun(mpiexec, ranks):
    said = subprocess.run([mpiexec, "--version"], capture_output=True, text=True, env=mpi_environment()).stdout
    more = ["--oversubscribe", "--bind-to", "none"] if "Open MPI" in said or "OpenRTE" in said else []
    return [mpiexec, *more, "-n", str(ranks)]


def run(line, folder, status=0, patience=PATIENCE):
    finished = subprocess.run(line, stdin=subprocess.DEVNULL, capture_output=True, text=True, env=mpi_environment(),
                              cwd=folder, timeout=patience)
    if status is not None and finished.returncode != status:
        sys.exit(f"{line}: found exit status {finished.returncode}, allowed: {status}\n{finished.stdout}{finished.stderr}")
    return finished


def messages(text):
    return [line for line in text.splitlines() if line.startswith("contct: ") and not line.startswith("contct: warning")]


def mat(n):
    """mat-N of the benchmark: a free plate on a one-sided bed, pressed down and then lifted at one point."""
    w = n * n / 256
    lifted = n * 58 // 100 * (n + 1) + n * 37 // 100 + 1
    return f"""[plate]
size = [{n}, {n}]
elements = [{n}, {n}]
D = 1.0
nu = 0.3
[[bed]]
modulus = 0.00390625
face = 0.0
[[step]]
uniform = -0.00390625
[[step]]
uniform = -0.00390625
point = [ {{ node = {lifted}, w = {0.25 * w}, wx = {0.137 * 0.25 * w}, wy = {0.311 * 0.25 * w} }} ]
"""


def solved(line, folder, name):
    """The result, and the exit status."""
    file = Path(folder) / name
    finished = run([*line, "--json", file, "--quiet"], folder, None)
    if not file.exists():
        sys.exit(f"{line}: found no result, and exit status {finished.returncode}\n{finished.stdout}{finished.stderr}")
    return json.loads(file.read_text()), finished.returncode


def error_bound(step, largest):
    """What D may be off, absolutely: as proved, or else as a certificate allows."""
    proved = (step.get("error") or {}).get("w")
    return proved if proved is not None else 1e-6 * largest


def compare(one, many, counts):
    """The first difference between two results, in words; None where there is none."""
    if (one["status"], len(one["steps"])) != (many["status"], len(many["steps"])):
        return f"status {one['status']} after {len(one['steps'])} steps, and {many['status']} after {len(many['steps'])}"
    for a, b in zip(one["steps"], many["steps"]):
        where = f"step {a['step']}"
        if len(a["increments"]) != len(b["increments"]):
            return f"{where}: {len(a['increments'])} increments and {len(b['increments'])}"
        for i, j in zip(a["increments"], b["increments"]):
            events = [[(e["pair"], e["change"]) for e in x["events"]] for x in (i, j)]
            if events[0] != events[1]:
                return f"{where}, increment {i['increment']}: events {events[0]} and {events[1]}"
            if abs(i["fraction"] - j["fraction"]) > 1e-9:
                return f"{where}, increment {i['increment']}: shares {i['fraction']} and {j['fraction']}"
            counts["increments"] += 1
            counts["events"] += len(events[0])
        for p, q in zip(a["pairs"], b["pairs"], strict=True):
            if p["state"] != q["state"]:
                return f"{where}, pair {p['pair']}: {p['state']} and {q['state']}"
        largest = max(map(abs, a["w"]), default=0.0)
        allowed = error_bound(a, largest) + error_bound(b, largest)
        for node, (u, v) in enumerate(zip(a["w"], b["w"], strict=True), 1):
            if not abs(u - v) <= allowed:
                return f"{where}, node {node}: w {u} and {v}, allowed: {allowed:.2g} apart"
            counts["numbers"] += 1
        if (a["certificate"] is None) != (b["certificate"] is None) or \
                a["certificate"] and a["certificate"]["exact"] != b["certificate"]["exact"]:
            return f"{where}: certificates {a['certificate']} and {b['certificate']}"
    return None


def equal(contct, reference, mpiexec, ranks):
    counts = dict.fromkeys(LEAST, 0)
    with tempfile.TemporaryDirectory() as folder:
        large = Path(folder) / "mat-50.toml"
        large.write_text(mat(50))
        files = sorted([*reference.glob("problems/pp*.toml"), reference / "problems/pb07-three-gap-supports.toml",
                        *reference.glob("structures/*.toml"), *reference.glob("structures/calculix/*.toml")])
        wrong = []
        for file in [*files, large]:
            kernels = ["--kernels", "corrected"] if file == large else []
            line = [contct, "run", file, *kernels]
            one = solved(line, folder, "one.json")
            many = solved([*mpirun(mpiexec, ranks), *line, "--engine", "petsc"], folder, "many.json")
            difference = f"exit status {one[1]} and {many[1]}" if one[1] != many[1] else compare(one[0], many[0], counts)
            if many[0]["engine"] != "petsc":
                difference = f"engine {many[0]['engine']}"
            if difference:
                wrong.append(f"{file.name}: {difference}")
            counts["problems"] += 1
        if wrong:
            sys.exit("\n".join(wrong))
        doctored = json.loads(json.dumps(many[0]))
        doctored["steps"][-1]["w"][0] += 1e-3
        if not compare(one[0], doctored, dict.fromkeys(LEAST, 0)):
            sys.exit("a deflection that is off by 0.001 is not noticed")
    too_few = [f"{what}: found {n}, allowed: {LEAST[what]} or more" for what, n in counts.items() if n < LEAST[what]]
    if too_few:
        sys.exit("\n".join(too_few))
    print(f"{ranks} ranks:", ", ".join(f"{n} {what}" for what, n in counts.items()), "are those of one process")


def bad_input(contct, reference, mpiexec, ranks):
    pb07 = reference / "problems/pb07-three-gap-supports.toml"
    refused = 0
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "wrong.toml").write_text("[beam]\nlength = -1.0\n")
        for arguments in (["no-such-file.toml"], ["wrong.toml"], [pb07, "--no-such-option"], [pb07, "--kernels", "warp"],
                          [pb07, "--csv", "no-such-folder/out.csv"]):
            line = [*mpirun(mpiexec, ranks), contct, "run", *arguments, "--engine", "petsc", "--json", "out.json"]
            found = run(line, folder, 2)
            if len(messages(found.stderr)) != 1 or found.stdout:
                sys.exit(f"{line}: found {messages(found.stderr)} and {found.stdout!r}, allowed: one message")
            if sorted(f.name for f in Path(folder).iterdir()) != ["wrong.toml"]:
                sys.exit(f"{line}: found {list(Path(folder).iterdir())}, allowed: no file of a run")
            refused += 1
    print(f"{refused} command lines refused, with one message each")


CHAIN = [[i, i, 2.50000003] for i in range(1, 41)] + [[i + 1, i, -1.25000001] for i in range(1, 40)]
MATRIX = """[matrix]
stiffness = "K.mtx"
[[contact]]
dof = "17"
surface = "below"
face = -0.5
stiffness = 10.0
[[step]]
point = [ { dof = "20", value = -1.0 }, { dof = "3", value = -0.125 } ]
"""


def market(entries, head="%%MatrixMarket matrix coordinate real symmetric", size=None, end="\n"):
    size = size or f"40 40 {len(entries)}"
    return "\n".join([head, size, *(" ".join(map(str, e)) for e in entries)]) + end


def changed(at, entry):
    return [*CHAIN[:at], entry, *CHAIN[at + 1:]]


BAD = {
    "another header": market(CHAIN, "%%MatrixMarket matrix coordinate complex symmetric"),
    "no square": market(CHAIN, size="40 41 79"),
    "an entry more than it says": market(CHAIN, size="40 40 78"),
    "an entry fewer": market(CHAIN, size="40 40 80"),
    "more rows than entries": market(CHAIN, size="400 400 79"),
    "above the diagonal": market(changed(50, [3, 17, 1.0])),
    "a place twice": market(changed(70, [8, 7, -1.25])),
    "a negative diagonal": market(changed(33, [34, 34, -2.5])),
    "a row with 0 on its diagonal": market(changed(20, [21, 21, 0])),
    "not a number": market(changed(60, [22, 21, "nan"])),
    "infinite": market(changed(61, [23, 22, "1e999"])),
    "a word": market(changed(62, [24, 23, "x"])),
    "a fourth field": market(changed(10, [11, 11, 2.5, 0])),
    "a row too far": market(changed(77, [41, 39, -1.25])),
    "two wrong lines": market([*changed(15, [16, 16, "y"])[:72], [35, 34, "z"], *CHAIN[73:]]),
    "no end of the last line": market(CHAIN, end=""),
    "nothing": "",
}


def binaries(good):
    """PETSc's binary of CHAIN, 40 rows and 118 entries, with one thing wrong each."""
    columns, values = 16 + 4 * 40, 16 + 4 * 40 + 4 * 118
    put = lambda at, form, value: good[:at] + struct.pack(form, value) + good[at + struct.calcsize(form):]
    return {
        "cut short": good[:-8], "longer": good + b"\0" * 8, "no rows": put(4, ">i", 0), "no square": put(8, ">i", 41),
        "a row without entries": put(16 + 4 * 30, ">i", 0), "a long row": put(16 + 4 * 30, ">i", 4),
        "a column too far": put(columns + 4 * 90, ">i", 40), "a negative column": put(columns + 4 * 5, ">i", -1),
        "a place twice": put(columns + 4 * 60, ">i", struct.unpack_from(">i", good, columns + 4 * 59)[0]),
        "not a number": put(values + 8 * 100, ">d", float("nan")), "no symmetry": put(values + 8 * 80, ">d", -1.5),
        "a negative diagonal": put(values, ">d", -2.5), "0 on a diagonal": put(values, ">d", 0.0),
    }


def petsc_binary(contct, folder):
    """CHAIN in PETSc's binary."""
    (Path(folder) / "good.mtx").write_text(market(CHAIN))
    run([contct, "convert", "good.mtx", "good.petsc"], folder)
    return (Path(folder) / "good.petsc").read_bytes()


def torn(contct, reference, mpiexec, fail):
    refused = 0
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "chain.toml").write_text(MATRIX)
        line = [contct, "run", "chain.toml", "--kernels", "corrected", "--engine", "petsc", "--json", "out.json", "--quiet"]
        for content in (market(CHAIN).encode(), petsc_binary(contct, folder)):
            (Path(folder) / "K.mtx").write_bytes(content)
            for number in range(1, 5):
                fault = ["env", f"LD_PRELOAD={fail}", "FAULT_CALL=pread", f"FAULT_AT={number}", "FAULT_ERRNO=5"]
                job = [*mpirun(mpiexec, 1), *line, ":", "-n", "1", *fault, *line]
                found = run(job, folder, None, 120)
                said = messages(found.stderr)
                if found.returncode == 0 and not said:
                    (Path(folder) / "out.json").unlink()
                    continue
                if found.returncode != 2 or said != ["contct: K.mtx: cannot be read to its end"] or (Path(folder) / "out.json").exists():
                    sys.exit(f"{job}: found exit status {found.returncode} and {said}; allowed: 2 and one message")
                refused += 1
    if refused < 5:
        sys.exit(f"found {refused} runs of which a rank cannot read a part, allowed: 5 or more")
    print(f"{refused} runs of which a rank cannot read a part end with one message")


def parts(contct, reference, mpiexec, ranks):
    refused = 0
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "chain.toml").write_text(MATRIX)
        matrix = Path(folder) / "K.mtx"
        line = [contct, "run", "chain.toml", "--kernels", "corrected", "--json", "out.json", "--quiet"]
        good = petsc_binary(contct, folder)
        bad = {what: text.encode() for what, text in BAD.items()} | binaries(good)
        for what, content in bad.items():
            matrix.write_bytes(content)
            one = messages(run(line, folder, 2).stderr)
            many = messages(run([*mpirun(mpiexec, ranks), *line, "--engine", "petsc"], folder, 2).stderr)
            if one != many or len(one) != 1 or (Path(folder) / "out.json").exists():
                sys.exit(f"{what}: found {many}, and a file: {(Path(folder) / 'out.json').exists()}; allowed: {one} and no file")
            refused += 1
        comments = "%%MatrixMarket matrix coordinate real symmetric\n" + "% a long comment\n" * 20000
        for text in (market(CHAIN), market([list(reversed(CHAIN))[i * 37 % 79] for i in range(79)]), market(CHAIN, comments[:-1]),
                     market([*CHAIN, [9, 3, 0.0]]).replace("\n", " \n\n \n", 30), good):
            matrix.write_bytes(text if text is good else text.encode())
            one = solved(line[:-3], folder, "one.json")
            many = solved([*mpirun(mpiexec, ranks), *line[:-3], "--engine", "petsc"], folder, "many.json")
            counts = dict.fromkeys(LEAST, 0)
            if (difference := compare(one[0], many[0], counts)) or counts["events"] < 1 or not many[0]["steps"][0]["certificate"]["exact"]:
                sys.exit(f"{text[:60]!r}: {difference}, {counts}, {many[0]['steps'][0]['certificate']}")
    print(f"{refused} files are refused by {ranks} ranks in the words of one process")


def stops(n):
    """A plate on all of its edges, over stops of which no two are reached at one time."""
    edges = [j * (n + 1) + i + 1 for j in range(n + 1) for i in range(n + 1) if i in (0, n) or j in (0, n)]
    nodes = [j * (n + 1) + i + 1 for j in range(1, n, 2) for i in range(1, n, 2)]
    pairs = [f'[[contact]]\nnode = {node}\nsurface = "below"\nface = {-0.1 - 0.37 * k % 1:.6f}\nstiffness = 5.0\n'
             for k, node in enumerate(nodes)]
    return f"""[plate]
size = [{n}, {n}]
elements = [{n}, {n}]
D = 1.0
nu = 0.3
[[support]]
nodes = {edges}
fix = "w"
{"".join(pairs)}[[step]]
uniform = -0.2
"""


def multigrid(contct, reference, mpiexec, ranks):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "stops.toml").write_text(stops(10))
        events = 0
        for file in (Path(folder) / "stops.toml", reference / "problems/pp01d-simply-supported-plate-n24.toml"):
            line = [contct, "run", file, "--kernels", "corrected"]
            one = solved(line, folder, "one.json")[0]
            os.environ["CONTCT_MEMORY_MIB"] = "1"
            line = [*mpirun(mpiexec, ranks), *line, "--engine", "petsc", "--json", "many.json", "--quiet"]
            said = run(line, folder).stderr
            del os.environ["CONTCT_MEMORY_MIB"]
            many = json.loads((Path(folder) / "many.json").read_text())
            if "multigrid" not in said:
                sys.exit(f"{file}: found {said!r}, allowed: a warning that multigrid solves")
            for a, b in zip(one["steps"], many["steps"], strict=True):
                for i, j in zip(a["increments"], b["increments"], strict=True):
                    if [(e["pair"], e["change"]) for e in i["events"]] != [(e["pair"], e["change"]) for e in j["events"]]:
                        sys.exit(f"{file}, step {a['step']}, increment {i['increment']}: {i['events']} and {j['events']}")
                    events += len(i["events"])
                c = b["certificate"]
                if c["exact"] or "multigrid" not in c["problem"] or any(e is not None for e in (b["error"] or {}).values()):
                    sys.exit(f"{file}, step {a['step']}: found {b['error']} and {c}, allowed: nothing certified")
                if not 0 < c["equilibrium"] < 1e-9:
                    sys.exit(f"{file}, step {a['step']}: found a residual of {c['equilibrium']}")
                largest = max(map(abs, a["w"]))
                if not max(abs(u - v) for u, v in zip(a["w"], b["w"], strict=True)) < 1e-6 * largest:
                    sys.exit(f"{file}, step {a['step']}: w differs")
        if events < 12:
            sys.exit(f"found {events} events, allowed: 12 or more")
    print(f"{events} events without a factor, by {ranks} ranks")


def engines(contct, reference, mpiexec, ranks, tests):
    # Thousands of toggles take several ranks minutes of waiting for each other: these follow whole paths alone.
    chosen, least_cases = ([], 8) if int(ranks) == 1 else (["*corrected kernel's paths*,free structures*"], 2)
    said = run([*mpirun(mpiexec, ranks), tests, *chosen], reference).stdout
    passed = re.search(r"\((\d+) assertions in (\d+) test cases\)", said)
    if not passed or int(passed[1]) < 1000 or int(passed[2]) < least_cases:
        sys.exit(f"{tests}: found {said!r}, allowed: 1000 assertions or more, passed, in {least_cases} test cases or more")
    print(said.strip().splitlines()[-1])


def factor(contct, reference, mpiexec, ranks, tests):
    said = run([*mpirun(mpiexec, ranks), tests, "*ranks*,*no factor*,*matrices*,*one process*"], reference).stdout
    passed = re.search(r"\((\d+) assertions in (\d+) test cases\)", said)
    if not passed or int(passed[1]) < 3000 or int(passed[2]) != 7:
        sys.exit(f"{tests}: found {said!r}, allowed: 3000 assertions or more, passed, in 7 test cases")
    print(said.strip().splitlines()[-1])


def grid_of(file):
    """A .vtu: {place: {name: numbers}}, {(places, pair): {name: numbers}} of its cells, and how many of each it has."""
    piece = ElementTree.parse(file).getroot().find("UnstructuredGrid/Piece")
    counts = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfCells"))

    def rows(part, count):
        table = [{} for _ in range(count)]
        for array in piece.find(part):
            k, numbers = int(array.get("NumberOfComponents")), [float(x) for x in (array.text or "").split()]
            if len(numbers) != k * count:
                sys.exit(f"{file}: {array.get('Name')}: found {len(numbers)} numbers, allowed: {k} for each of {count}")
            for row, at in zip(table, range(0, len(numbers), k)):
                row[array.get("Name")] = tuple(numbers[at:at + k])
        return table

    at = [row["points"] for row in rows("Points", counts[0])]
    connectivity, ends, types = ([int(x) for x in (a.text or "").split()] for a in piece.find("Cells"))
    if len(ends) != counts[1] or len(types) != counts[1] or (ends[-1] if ends else 0) != len(connectivity):
        sys.exit(f"{file}: found {len(ends)} cells that end at {ends[-1:]}, allowed: {counts[1]} and {len(connectivity)}")
    cells = {}
    for begin, end, kind, row in zip([0, *ends], ends, types, rows("CellData", counts[1])):
        cells[(*(at[n] for n in connectivity[begin:end]), row["pair"])] = row | {"type": (kind,)}
    return dict(zip(at, rows("PointData", counts[0]))), cells, counts


def is_close(found, wanted, largest):
    """Are rows equal, as far as the digits go that differ from run to run?"""
    return found.keys() == wanted.keys() and all(
        len(found[name]) == len(wanted[name]) and all(abs(x - y) <= 1e-7 * abs(y) + 1e-9 * largest[name] for x, y in zip(found[name], wanted[name]))
        for name in wanted)


def wrong_in_pieces(folder, whole_file):
    """What differs between the pieces of F.pvtu and the grid as one file, in words, or None; and the counts of each piece."""
    whole = grid_of(folder / whole_file)
    largest = [{name: max(abs(x) for row in part.values() for x in row[name]) for name in next(iter(part.values()))} for part in whole[:2]]
    listed = ElementTree.parse(folder / "F.pvtu").getroot().find("PUnstructuredGrid")
    sources = [piece.get("Source") for piece in listed.findall("Piece")]
    names = [[a.get("Name") for a in listed.find(part)] for part in ("PPointData", "PCellData", "PPoints")]
    if names != [list(largest[0]), [n for n in largest[1] if n != "type"], ["points"]]:
        return f"F.pvtu declares {names}", []
    points, cells, sizes = {}, {}, []
    for source in sources:
        own = grid_of(folder / source)
        sizes.append(own[2])
        for place, row in own[0].items():
            if points.setdefault(place, row) != row:
                return f"{source}, point {place}: {row}, and {points[place]} in another piece", sizes
        if again := own[1].keys() & cells.keys():
            return f"{source}: a cell of another piece: {again}", sizes
        cells |= own[1]
    for what, found, wanted, size in (("point", points, whole[0], largest[0]), ("cell", cells, whole[1], largest[1])):
        if found.keys() != wanted.keys():
            return f"{len(found)} {what}s, {len(wanted)} in the whole", sizes
        for place, row in wanted.items():
            if not is_close(found[place], row, size):
                return f"{what} {place}: {found[place]}, {row} in the whole", sizes
    if sources != [f"F_{i}.vtu" for i in range(len(sources))] or sum(size[1] for size in sizes) != whole[2][1]:
        return f"{sources} of {sizes} points and cells, {whole[2]} in the whole", sizes
    return None, sizes


def displacements_in(folder, file, w):
    """Does every step of a result have the displacement of every dof? Ends the test where only some have it, or w is another."""
    steps = json.loads((folder / file).read_text())["steps"]
    has = {"displacement" in step for step in steps}
    if len(has) != 1 or [len(step["w"]) for step in steps] != [w] * len(steps):
        sys.exit(f"{file}: found {has} for displacement, and {[len(s['w']) for s in steps]} deflections")
    return has.pop()


def pieces(contct, reference, mpiexec, ranks):
    ranks, compared = int(ranks), 0
    plate = mat(10).replace("elements = [10, 10]", "elements = [6, 10]")
    frame = reference / "structures/frame.toml"
    with tempfile.TemporaryDirectory() as scratch:
        for text, name in ((plate, "plate.toml"), (None, frame)):
            folder = Path(tempfile.mkdtemp(dir=scratch))
            if text:
                (folder / name).write_text(text)
            line = [contct, "run", name, "--kernels", "corrected", "--engine", "petsc", "--quiet"]
            page = [] if text else ["--html", "F.html"]  # which needs every increment: the pieces alone do not
            # One run writes both: with several ranks the last digits differ from run to run.
            run([*mpirun(mpiexec, ranks), *line, "--vtu", "F.pvtu", "--json", "w.json", *page], folder)
            expected = sorted(["F.pvtu", "w.json", *page[1:], *[f"F_{i}.vtu" for i in range(ranks)], *([name] if text else [])])
            if sorted(f.name for f in folder.iterdir()) != expected:
                sys.exit(f"{line}: found {sorted(f.name for f in folder.iterdir())}, allowed: {expected}")
            compared += compare_pieces(contct, line, folder, mpiexec, ranks, bool(text))
        refused = run([contct, "run", frame, "--vtu", "G.pvtu"], scratch, 2)
        if "allowed: a file that ends in .vtu, or with --engine petsc in .pvtu" not in refused.stderr:
            sys.exit(f"--vtu G.pvtu without --engine petsc: found {refused.stderr!r}")
        shared = run([*mpirun(mpiexec, ranks), contct, "run", frame, "--engine", "petsc", "--vtu", "F.pvtu", "--html", "F_0.vtu"], scratch, 2)
        if "found the file of --" not in shared.stderr or (Path(scratch) / "F_0.vtu").exists():
            sys.exit(f"--html F_0.vtu beside --vtu F.pvtu: found {shared.stderr!r}")
        (Path(scratch) / "F_0.vtu").mkdir()
        (Path(scratch) / "plate.toml").write_text(plate)
        run([*mpirun(mpiexec, ranks), contct, "run", "plate.toml", "--kernels", "corrected", "--engine", "petsc", "--vtu", "F.pvtu"],
            scratch, 2)
        if any((Path(scratch) / f).exists() for f in ("F.pvtu", "F_1.vtu", "F_2.vtu")):
            sys.exit(f"found {list(Path(scratch).iterdir())} though F_0.vtu cannot be written; allowed: no file of the grid")
    print(f"{ranks} ranks: {compared} points and cells of pieces are those of the whole grid")
    if compared < 200:
        sys.exit(f"found {compared} points and cells, allowed: 200 or more")


def w_in_pieces(folder, ranks):
    """The deflection of each node of a plate, from its pieces, in the order of nodes."""
    points = {}
    for i in range(ranks):
        points |= grid_of(folder / f"F_{i}.vtu")[0]
    return [points[place]["w"][0] for place in sorted(points, key=lambda at: (at[1], at[0]))]


def compare_pieces(contct, line, folder, mpiexec, ranks, is_plate):
    """How many points and cells are those of the whole grid."""
    w = 77 if is_plate else 33
    if displacements_in(folder, "w.json", w):
        sys.exit(f"{line}: found displacement in the result, which --displacement did not ask for")
    run([*mpirun(mpiexec, ranks), *line, "--vtu", "whole.vtu", "--json", "all.json", "--displacement"], folder)
    run([contct, "run", line[2], "--quiet", "--json", "other.json"], folder)
    if not displacements_in(folder, "all.json", w) or not displacements_in(folder, "other.json", w):
        sys.exit(f"{line}: found no displacement in all.json or other.json")
    wrong, sizes = wrong_in_pieces(folder, "whole.vtu")
    if wrong or len(sizes) != ranks:
        sys.exit(f"{line}: pieces of {sizes} points and cells: {wrong}")
    if is_plate:
        if w_in_pieces(folder, ranks) != json.loads((folder / "w.json").read_text())["steps"][-1]["w"]:
            sys.exit(f"{line}: w of the pieces is not that of the same run's result")
        rows = [10 * (i + 1) // ranks - 10 * i // ranks for i in range(ranks)]
        if sorted(7 * (r + 1) for r in rows) != sorted(size[0] for size in sizes):
            sys.exit(f"{line}: found pieces of {sizes} points and cells, allowed: {rows} rows of elements")
    doctored = folder / f"F_{ranks - 1}.vtu"
    right = doctored.read_text()
    for name in ("displacement", "force"):
        fault = re.sub(rf'(Name="{name}"[^>]*>\n)\S+', r"\g<1>7", right, count=1)
        doctored.write_text(fault)
        if fault == right or not wrong_in_pieces(folder, "whole.vtu")[0]:
            sys.exit(f"{doctored}: a changed number in {name} is not noticed")
    return sum(map(sum, sizes))


def naming(contct, reference, fail):
    """`fail` is tests/faults/fail.c, preloaded: the first, or the second, file cannot get its name."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "plate.toml").write_text(mat(3))
        for number, status, left in ((0, 0, ["F.pvtu", "F_0.vtu"]), (1, 2, []), (2, 2, ["F_0.vtu"])):
            line = ["env", f"LD_PRELOAD={fail}", "FAULT_NO_LINK=1", "FAULT_CALL=rename", f"FAULT_AT={number}", "FAULT_ERRNO=28",
                    contct, "run", "plate.toml", "--engine", "petsc", "--kernels", "corrected", "--quiet", "--vtu", "F.pvtu"]
            run(line, folder, status)
            if (found := sorted(f.name for f in Path(folder).iterdir())) != [*left, "plate.toml"]:
                sys.exit(f"{line}: found {found}, allowed: {left} and the problem")
            for name in left:
                (Path(folder) / name).unlink()
    print("F.pvtu gets its name when every piece has one")


def binary(contct, reference, load):
    with tempfile.TemporaryDirectory() as folder:
        for matrix in [reference / "structures/frame.mtx"]:
            run([contct, "convert", matrix, "K.petsc"], folder)
            run([load, "K.petsc", "again.petsc"], folder)
            written, again = ((Path(folder) / name).read_bytes() for name in ("K.petsc", "again.petsc"))
            if written != again or len(written) < 1000:
                sys.exit(f"{matrix}: found {len(written)} bytes, of which PETSc makes {len(again)} others")
            run([contct, "convert", "again.petsc", "K.mtx"], folder)
    print(f"{len(written)} bytes are PETSc's own")


def scaling(contct, reference, mpiexec, ranks, program):
    rows = {}
    for engine, start in (("updated", []), ("petsc", []), ("petsc ranks", mpirun(mpiexec, ranks))):
        row = json.loads(run([*start, program, "stops-12", engine.split()[0]], reference).stdout)
        rows[engine] = row
        if row["events"] != rows["updated"]["events"] or row["events"] < 60 or row["dofs"] != 3 * 13 * 13:
            sys.exit(f"{engine}: found {row}, allowed: the 60 events or more of updated, {rows['updated']['events']}")
        if not row["ms_per_event"] > 0 or len(row["peak_mib"]) != (int(ranks) if start else 1) or min(row["peak_mib"]) < 5:
            sys.exit(f"{engine}: found {row}, allowed: a time, and the memory of each rank")
    print(f"{rows['updated']['events']} events by each of {len(rows)} engines")


def descendants(of):
    """Processes and their parents, of those below `of`."""
    parents = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            parents[int(stat.parent.name)] = int(stat.read_text().rsplit(")", 1)[1].split()[1])
        except (OSError, ValueError):
            continue
    found, next_ones = [], [of]
    while next_ones:
        next_ones = [p for p, parent in parents.items() if parent in next_ones]
        found += next_ones
    return found


def process_of_rank(job, rank):
    """Its number, once it has loaded the module; None before."""
    for process in descendants(job):
        try:
            if f"OMPI_COMM_WORLD_RANK={rank}\0".encode() in Path(f"/proc/{process}/environ").read_bytes() \
                    and "contct_petsc.so" in Path(f"/proc/{process}/maps").read_text():
                return process
        except OSError:
            continue
    return None


def killed(contct, reference, mpiexec, ranks):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "mat.toml").write_text(mat(100))
        line = [*mpirun(mpiexec, ranks), contct, "run", "mat.toml", "--engine", "petsc", "--json", "out.json"]
        job = subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env=mpi_environment(), cwd=folder)
        begun = time.monotonic()
        while not (victim := process_of_rank(job.pid, 1)):
            if job.poll() is not None or time.monotonic() > begun + PATIENCE:
                sys.exit(f"{line}: found no rank 1 to kill\n{job.communicate()}")
            time.sleep(0.05)
        os.kill(victim, signal.SIGKILL)
        out, err = job.communicate(timeout=PATIENCE)
        if job.returncode == 0:
            sys.exit(f"{line}: found exit status 0 after rank 1 was killed\n{out}{err}")
        if (Path(folder) / "out.json").exists():
            sys.exit(f"{line}: found out.json after rank 1 was killed")
    print(f"rank 1 of {ranks} killed: the job ended with exit status {job.returncode} and left no file")


def absent(contct, reference, mpiexec=None, ranks=1):
    pb07 = reference / "problems/pb07-three-gap-supports.toml"
    with tempfile.TemporaryDirectory() as folder:
        alone = shutil.copy(contct, folder)
        for start in [[]] + ([mpirun(mpiexec, ranks)] if mpiexec else []):
            for engine in (["--engine", "petsc"], ["--engine=petsc"]):
                line = [*start, alone, "run", pb07, *engine, "--json", "out.json"]
                found = run(line, folder, 2)
                said = messages(found.stderr)
                if len(said) != 1 or "contct_petsc.so" not in said[0] or "libpetsc-real-dev" not in said[0] or found.stdout:
                    sys.exit(f"{line}: found {found.stderr!r} and {found.stdout!r}, allowed: one message that names the module")
                if (Path(folder) / "out.json").exists():
                    sys.exit(f"{line}: found out.json")
        run([alone, "run", pb07], folder)
    print("without its module the engine is refused, and the program runs")


def apart(contct, reference):
    linked = run(["ldd", contct], reference).stdout
    if "liblapack" not in linked or any(name in linked for name in ("libmpi", "petsc", "mumps")):
        sys.exit(f"ldd {contct}: found\n{linked}allowed: LAPACK, and neither MPI nor PETSc")
    print(f"{len(linked.splitlines())} libraries are linked, and none is of MPI or PETSc")


def main():
    case, contct, reference = sys.argv[1], Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()
    cases = {"equal": equal, "bad-input": bad_input, "killed": killed, "parts": parts, "torn": torn, "multigrid": multigrid, "absent": absent,
             "apart": apart, "engines": engines, "factor": factor, "scaling": scaling, "pieces": pieces, "binary": binary,
             "naming": naming}
    cases[case](contct, reference, *sys.argv[4:])


if __name__ == "__main__":
    main()
