"""The commands that are disturbed, and what must come of them."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, LIBRARY, PLUGIN = (Path(a).resolve() for a in sys.argv[1:4])
TIMES = 6 if "--more" in sys.argv[4:] else 1  # how often a sample is taken
PROBLEM = """title = "Faults"
[beam]
x = [0.0, 1.0, 2.0]
EI = 1.0e4
[[support]]
node = 1
fix = ["w", "theta"]
[[contact]]
node = 3
surface = "below"
face = -0.004
stiffness = 5.0e4
[[step]]
point = [ { node = 3, w = -60.0 } ]
"""
MATRIX = """[matrix]
stiffness = "K.mtx"
storage = "STORAGE"
[[contact]]
dof = "3"
surface = "above"
face = 0.5
stiffness = 10.0
[[step]]
point = [ { dof = "2", value = 2.0 } ]
"""
STIFFNESS = "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 2\n2 1 -1\n2 2 2\n3 2 -1\n3 3 2\n"
OUTPUTS = ["--json", "o.json", "--html", "o.html", "--csv", "o.csv", "--vtu", "o.vtu", "--log", "o.log",
           "--trace", "o.trace", "--proof", "o.proof", "--junit", "o.xml", "--markdown", "o.md"]


# METIS, which orders sparse matrices, says itself that memory has ended, before the program does.
OF_METIS = re.compile(r" *(Current|Maximum) memory used: |\*\*\*Memory allocation failed for ")
# OpenMP, by which CHOLMOD factors, ends the process by itself.
OF_OPENMP = re.compile(r"libgomp: Out of memory allocating ")


class Command:
    """A command line, with what stands in its folder before, and what it makes."""

    def __init__(self, name: str, arguments: list[str], prepared: dict[str, bytes], before: bool) -> None:
        self.name, self.arguments, self.prepared = name, arguments, dict(prepared)
        self.status, self.made, self.said = self.run({})
        new = self.made.keys() - prepared.keys()
        if self.status not in (0, 1) or not new:
            raise SystemExit(f"faults: {name}: exit {self.status}, files {sorted(self.made)}: {self.said}")
        self.replaced = len(new) if before else 0
        if before:
            self.prepared |= dict.fromkeys(new, b"before\n")

    def run(self, fault: dict[str, str]) -> tuple[int, dict[str, bytes], str]:
        """Exit status (negative: a signal), all files behind it, and standard error."""
        with tempfile.TemporaryDirectory(prefix="contct-faults-") as scratch:
            folder = Path(scratch)
            for file, content in self.prepared.items():
                (folder / file).parent.mkdir(parents=True, exist_ok=True)
                (folder / file).write_bytes(content)
            environment = {"PATH": "/usr/bin:/bin", "SOURCE_DATE_EPOCH": "0", "OPENBLAS_NUM_THREADS": "1"}
            if fault:
                environment |= {"LD_PRELOAD": str(LIBRARY)} | fault
            done = subprocess.run([PROGRAM, *self.arguments], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                  capture_output=True, timeout=600)
            files = {str(f.relative_to(folder)): self.timeless(f) for f in sorted(folder.rglob("*")) if f.is_file()}
        return done.returncode, files, done.stderr.decode(errors="replace")

    @staticmethod
    def timeless(file: Path) -> bytes:
        content = re.sub(rb'(time=|"seconds": )"?[0-9.e-]+"?', b"", file.read_bytes())
        return re.sub(rb"after [0-9.]+ s", b"", content)

    def calls(self, kind: str) -> int:
        with tempfile.NamedTemporaryFile() as counted:
            status, _, said = self.run({"FAULT_CALL": kind, "FAULT_COUNT": counted.name})
            if status != self.status:
                raise SystemExit(f"faults.py: {self.name}: {kind}: exit {status} where nothing fails: {said}")
            return int(Path(counted.name).read_text())

    def wrong(self, fault: dict[str, str]) -> tuple[str, bool]:
        """What is wrong with a run in which this fails; empty where nothing is. And whether it ended with exit status 2."""
        try:
            status, files, said = self.run(fault)
        except subprocess.TimeoutExpired:
            return "it hangs", False
        more = [line for line in said.splitlines() if line not in self.said.splitlines() and not OF_METIS.match(line)]
        ended_by_openmp = status == 1 and any(OF_OPENMP.match(line) for line in more)
        if status not in (self.status, 2) and not ended_by_openmp:
            return f"exit {status}: {said}", False
        if status == 2 and (len(more) != 1 or not more[0].startswith("contct: ")):
            return f"{len(more)} messages for exit 2: {said}", True
        if status != 2 and not ended_by_openmp and files != self.made:
            changed = [f for f in files.keys() | self.made.keys() if files.get(f) != self.made.get(f)]
            return f"exit {status}, but other files: {changed}: {said}", False
        for file, content in files.items():
            if content not in (self.made.get(file), self.prepared.get(file)):
                return f"{file} is neither whole nor as it was ({len(content)} bytes): {said}", True
        for file in self.prepared:
            if file not in files:
                return f"{file} is lost: {said}", True
        return "", status == 2


def commands() -> list[Command]:
    trace = Command("trace", ["run", "p.toml", "--quiet", "--trace", "calls.trace"], {"p.toml": PROBLEM.encode()}, False)
    calls = trace.made["calls.trace"]
    beam, matrix = {"p.toml": PROBLEM.encode()}, {"K.mtx": STIFFNESS.encode()}
    files = [f"m{storage}.toml" for storage in ("band", "sparse")]
    for file, storage in zip(files, ("band", "sparse")):
        matrix[file] = MATRIX.replace("STORAGE", storage).encode()
    found = [Command("run", ["run", "p.toml", *OUTPUTS], beam, False),
             Command("run over files", ["run", "p.toml", "--quiet", *OUTPUTS], beam, True),
             Command("replay", ["replay", "calls.trace", "--kernel", "cpp,fortran", "--junit", "r.xml", "--markdown", "r.md"],
                     {"calls.trace": calls}, True),
             Command("fuzz", ["fuzz", "--calls", "30", "--problems", "1", "--seed", "7", "--kernels", f"cpp,plugin:{PLUGIN}",
                              "--out", "found", "--json", "f.json", "--junit", "f.xml"], {"found/mine": b"mine"}, False),
             Command("exact", ["exact", "p.toml", "--kernels", "fortran", "--json", "x.json"], beam, True),
             Command("band", ["run", "mband.toml", "--quiet", "--json", "o.json"], matrix, True)]
    try:
        found.append(Command("sparse", ["run", "msparse.toml", "--quiet", "--json", "o.json"], matrix, True))
    except SystemExit:
        print("without CHOLMOD")
    return found
