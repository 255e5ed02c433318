"""python3 tests/faults/faults.py CONTCT LIBRARY PLUGIN [--more]: after any failing system call, signal or lack of
memory, the program ends by itself or by the signal, every file is complete or unchanged, and no other file remains.

LIBRARY is the preloaded tests/faults/fail.c; PLUGIN is a kernel that differs from CONTCT, so that `fuzz --out` writes a
file. A sample of the calls of every kind is tested; with --more, six times as many."""
import random
import re
import resource
import signal
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import Checks, run  # noqa: E402

PROGRAM, LIBRARY, PLUGIN = (Path(a).resolve() for a in sys.argv[1:4])
TIMES = 6 if "--more" in sys.argv[4:] else 1  # factor of all sample sizes
PROBLEM = (b'title = "Faults"\n[beam]\nx = [0.0, 1.0, 2.0]\nEI = 1.0e4\n[[support]]\nnode = 1\nfix = ["w", "theta"]\n[[contact]]\nnode = 3\n'
           b'surface = "below"\nface = -0.004\nstiffness = 5.0e4\n[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n')
MATRIX = (b'[matrix]\nstiffness = "K.mtx"\nstorage = "band"\n[[contact]]\ndof = "3"\nsurface = "above"\nface = 0.5\nstiffness = 10.0\n'
          b'[[step]]\npoint = [ { dof = "2", value = 2.0 } ]\n')
STIFFNESS = b"%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 2\n2 1 -1\n2 2 2\n3 2 -1\n3 3 2\n"
OUTPUTS = ["--json", "o.json", "--html", "o.html", "--csv", "o.csv", "--vtu", "o.vtu", "--log", "o.log",
           "--trace", "o.trace", "--proof", "o.proof", "--junit", "o.xml", "--markdown", "o.md"]
# The error number of each system call. Eight calls of each kind fail, or the number of calls in SAMPLE.
ERRORS = {"write": 28, "read": 5, "openat": 13, "close": 5, "rename": 28, "fsync": 5, "pread": 5, "fcntl": 9,
          "lseek": 29, "fchmod": 1, "mkdir": 13}
SAMPLE = {"write": 24, "openat": 16}
SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGUSR1, signal.SIGALRM]
LEAST = {"runs": 300, "ended with exit status 2": 100, "died by a signal": 40, "solved in little memory": 2,
         "ended for memory": 2}
check = Checks()
counts = check.counted


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
            done = run(PROGRAM, *self.arguments, cwd=folder, env=environment, preexec_fn=limited)
            files = {str(f.relative_to(folder)): self.timeless(f) for f in sorted(folder.rglob("*")) if f.is_file()}
        return done.returncode, files, done.stderr

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
    status, files, said = command.run(fault)
    what = f"{command.name}: {kind} {number}{' and all behind it' if more else ''}: exit {status}: {said}"
    new = [line for line in said.splitlines() if line not in command.said.splitlines()]
    silent = more and kind == "write" and not new  # if all later writes fail too, no message can be written
    check(files == command.made if status == command.status and status != 2 else status == 2 and (silent or [line[:8] for line in new] == ["contct: "]), what)
    command.check_files(what, files)
    counts.update({"runs": 1, "ended with exit status 2": status == 2})


def calls_fail(command: Command) -> None:
    for kind in ERRORS:
        count = command.calls(kind)
        check(kind != "fsync" or count >= command.replaced, f"{command.name}: {count} calls of fsync; allowed: one for each of {command.replaced} files that are replaced")
        most = TIMES * SAMPLE.get(kind, 8)
        for number in sorted({1 + i * (count - 1) // (most - 1) for i in range(most)}) if count else []:
            for more in (False, True) if kind == "write" or number % 3 == 0 else (False,):
                call_fails(command, kind, number, more)


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
        status, files, said = command.run({}, lambda most=mib << 20: resource.setrlimit(resource.RLIMIT_AS, (most, most)))
        what = f"{command.name}: {mib} MiB: exit {status}: {said}"
        has_begun |= status in (0, 2)
        if has_begun or status == 127:  # 127: the loader wrote the message
            check(status in (0, 2, 127) and said.count("\n") == (status != 0), what)
        else:  # before main(), where the loader does not check its memory and libgfortran has its own message
            check(status == -signal.SIGSEGV or (status == 1 and said.endswith("Memory allocation failed\n")), what)
        command.check_files(what, files)
        counts["solved in little memory" if status == 0 else "ended for memory"] += 1


def commands() -> list[Command]:
    beam, matrix = {"p.toml": PROBLEM}, {"K.mtx": STIFFNESS, "mband.toml": MATRIX, "msparse.toml": MATRIX.replace(b"band", b"sparse")}
    calls = Command("trace", ["run", "p.toml", "--quiet", "--trace", "calls.trace"], beam, False).made["calls.trace"]
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
check.end(**LEAST)
