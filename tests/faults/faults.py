"""python3 tests/faults/faults.py CONTCT LIBRARY PLUGIN [--more]: after any failing system call, signal or lack of
memory, the program ends by itself or by the signal, every file is complete or unchanged, and no other file remains.

LIBRARY is the preloaded tests/faults/fail.c; PLUGIN is a kernel that differs from CONTCT, so that `fuzz --out` writes a
file. A sample of the calls of every kind is tested; with --more, six times as many."""
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, LIBRARY, PLUGIN = (Path(a).resolve() for a in sys.argv[1:4])
TIMES = 6 if "--more" in sys.argv[4:] else 1  # factor of all sample sizes
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
# The error number of each system call. Eight calls of each kind fail, or the number of calls in SAMPLE.
ERRORS = {"write": 28, "read": 5, "openat": 13, "close": 5, "rename": 28, "fsync": 5, "pread": 5, "fcntl": 9,
          "lseek": 29, "fchmod": 1, "mkdir": 13}
SAMPLE = {"write": 24, "openat": 16}
SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGUSR1, signal.SIGALRM]
LEAST = {"runs": 300, "ended with exit status 2": 100, "died by a signal": 40, "solved in little memory": 2,
         "ended for memory": 2}
counts = dict.fromkeys(LEAST, 0)
complaints: list[str] = []


def check(good: bool, what: str) -> None:
    if not good:
        complaints.append(what)
        print(what, flush=True)


class Command:
    """A command line, the files in its folder before it runs, and the files that it writes."""

    def __init__(self, name: str, arguments: list[str], prepared: dict[str, bytes], before: bool) -> None:
        self.name, self.arguments, self.prepared = name, arguments, dict(prepared)
        self.status, self.made, self.said = self.run({})
        new = self.made.keys() - prepared.keys()
        if self.status not in (0, 1) or not new:
            raise SystemExit(f"faults: {name}: exit {self.status}, files {sorted(self.made)}: {self.said}")
        self.replaced = len(new) if before else 0
        if before:
            self.prepared |= dict.fromkeys(new, b"before\n")

    def run(self, fault: dict[str, str], limited=None) -> tuple[int, dict[str, bytes], str]:
        """Run the command. Return the exit status (negative: a signal), all files afterwards, and standard error."""
        with tempfile.TemporaryDirectory(prefix="contct-faults-") as scratch:
            folder = Path(scratch)
            for file, content in self.prepared.items():
                (folder / file).parent.mkdir(parents=True, exist_ok=True)
                (folder / file).write_bytes(content)
            environment = {"PATH": "/usr/bin:/bin", "SOURCE_DATE_EPOCH": "0", "OPENBLAS_NUM_THREADS": "1"}
            if fault:
                environment |= {"LD_PRELOAD": str(LIBRARY)} | fault
            done = subprocess.run([PROGRAM, *self.arguments], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                                  capture_output=True, timeout=600, preexec_fn=limited)
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

    def check_files(self, what: str, files: dict[str, bytes]) -> None:
        for file, content in files.items():
            check(content in (self.made.get(file), self.prepared.get(file)), f"{what}: {file} is neither whole nor as it was")
        check(self.prepared.keys() <= files.keys(), f"{what}: a file is lost")


def call_fails(command: Command, kind: str, number: int, more: bool) -> None:
    fault = {"FAULT_CALL": kind, "FAULT_AT": str(number), "FAULT_ERRNO": str(ERRORS[kind])} | ({"FAULT_MORE": "1"} if more else {})
    what = f"{command.name}: {kind} {number}{' and all behind it' if more else ''}"
    status, files, said = command.run(fault)
    new = [line for line in said.splitlines() if line not in command.said.splitlines()]
    check(status in (command.status, 2), f"{what}: exit {status}: {said}")
    # If all later writes fail too, no message can be written.
    check(status != 2 or (len(new) == 1 and new[0].startswith("contct: ")) or (more and kind == "write" and not new),
          f"{what}: {len(new)} messages for exit 2: {said}")
    check(status == 2 or files == command.made, f"{what}: exit {status}, but other files: {said}")
    command.check_files(what, files)
    counts["runs"] += 1
    counts["ended with exit status 2"] += status == 2


def calls_fail(command: Command) -> None:
    for kind in ERRORS:
        count = command.calls(kind)
        if kind == "fsync":
            check(count >= command.replaced, f"{command.name}: {count} calls of fsync; allowed: one for each of {command.replaced} "
                  "files that are replaced")
        most = TIMES * SAMPLE.get(kind, 8)
        for number in sorted({1 + i * (count - 1) // (most - 1) for i in range(most)}) if count else []:
            call_fails(command, kind, number, False)
            if kind == "write" or number % 3 == 0:
                call_fails(command, kind, number, True)


def signals_come(command: Command) -> None:
    """Send signals at some calls of each kind."""
    for kind in ("write", "openat", "rename", "close", "pread"):
        count = command.calls(kind)
        for number in sorted(random.sample(range(1, count + 1), min(count, 6 * TIMES))):
            which = SIGNALS[number % len(SIGNALS)]
            status, files, said = command.run({"FAULT_CALL": kind, "FAULT_AT": str(number), "FAULT_SIGNAL": str(int(which))})
            what = f"{command.name}: {which.name} at {kind} {number} of {count}"
            check(status in (command.status, -which), f"{what}: exit {status}: {said}")
            command.check_files(what, files)
            counts["died by a signal"] += status == -which


def memory_is_limited(command: Command) -> None:
    """Run with 16 MiB and more of memory: the loader or the program writes a message, or the result is complete."""
    has_begun = False
    for mib in range(16, 120, 2 if TIMES > 1 else 4):
        def limited(bytes_allowed=mib << 20):
            resource.setrlimit(resource.RLIMIT_AS, (bytes_allowed, bytes_allowed))
        status, files, said = command.run({}, limited)
        what = f"{command.name}: {mib} MiB: exit {status}"
        has_begun |= status in (0, 2)
        if has_begun or status == 127:  # 127: the loader wrote the message
            check(status in (0, 2, 127), f"{what}: {said}")
            check(said.count("\n") == (status != 0), f"{what}: {said}")
        else:  # before main(), where the loader does not check its memory and libgfortran has its own message
            check(status == -signal.SIGSEGV or (status == 1 and said.endswith("Memory allocation failed\n")), f"{what}: {said}")
        command.check_files(what, files)
        counts["solved in little memory" if status == 0 else "ended for memory"] += 1


def commands() -> list[Command]:
    beam, matrix = {"p.toml": PROBLEM.encode()}, {"K.mtx": STIFFNESS.encode()}
    calls = Command("trace", ["run", "p.toml", "--quiet", "--trace", "calls.trace"], beam, False).made["calls.trace"]
    for storage in ("band", "sparse"):
        matrix[f"m{storage}.toml"] = MATRIX.replace("STORAGE", storage).encode()
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


random.seed(21)
for command in commands():
    calls_fail(command)
    signals_come(command)
    if command.name in ("run", "exact"):
        memory_is_limited(command)
print(", ".join(f"{name}: {count}" for name, count in counts.items()) + f"; {len(complaints)} wrong")
if complaints or any(counts[name] < least for name, least in LEAST.items()):
    raise SystemExit(f"faults.py: allowed: none wrong, at least {LEAST}")
