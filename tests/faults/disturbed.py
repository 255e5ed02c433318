"""python3 tests/faults/disturbed.py CONTCT LIBRARY PLUGIN [--more]: signals, limits of memory, odd names of
files, and files that change while they are read.

Whatever comes at whatever moment: the program ends by itself or by the signal, a file is whole or what it was before, and
nothing else is left behind. LIBRARY is tests/faults/fail.c, preloaded."""
import os
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

sys.dont_write_bytecode = True
from commands import TIMES, OUTPUTS, PROBLEM, PROGRAM, commands

SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGUSR1, signal.SIGALRM]
checks = 0
complaints: list[str] = []


def check(good: bool, what: str) -> None:
    global checks
    checks += 1
    if not good:
        complaints.append(what)
        print(what, flush=True)


def contct(folder, *arguments, environment=None, before=None, **more):
    try:
        done = subprocess.run([PROGRAM, *arguments], cwd=folder, env={"PATH": "/usr/bin:/bin", "SOURCE_DATE_EPOCH": "0"} |
                              (environment or {}), capture_output=True, timeout=600, preexec_fn=before, **more)
    except subprocess.TimeoutExpired as late:
        return 124, late.stdout or b"", (late.stderr or b"") + b"it hangs\n"
    return done.returncode, done.stdout, done.stderr


def signals_at_calls(all_commands) -> None:
    """Each signal at some calls of each kind."""
    died = 0
    for command in all_commands:
        for kind in ("write", "openat", "rename", "close", "pread"):
            count = command.calls(kind)
            picked = sorted(random.sample(range(1, count + 1), min(count, 6 * TIMES)))
            for number in picked:
                which = SIGNALS[number % len(SIGNALS)]
                status, files, said = command.run({"FAULT_CALL": kind, "FAULT_AT": str(number),
                                                   "FAULT_SIGNAL": str(int(which))})
                what = f"{command.name}: {which.name} at {kind} {number} of {count}"
                check(status in (command.status, -which), f"{what}: exit {status}: {said}")
                died += status == -which
                for file, content in files.items():
                    check(content in (command.made.get(file), command.prepared.get(file)),
                          f"{what}: {file} is neither whole nor as it was")
                check(command.prepared.keys() <= files.keys(), f"{what}: a file is lost")
    check(died >= 40, f"only {died} runs ended by their signal")


def memory_steps() -> None:
    """ulimit -v from 20 MB up: the loader's message, or the program's, or a whole result."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        (folder / "p.toml").write_text(PROBLEM)
        solved = ended = 0
        for mib in range(20, 400, 2 if TIMES > 1 else 9):
            def limited(bytes_allowed=mib << 20):
                resource.setrlimit(resource.RLIMIT_AS, (bytes_allowed, bytes_allowed))
            status, _, said = contct(folder, "run", "p.toml", "--quiet", *OUTPUTS, before=limited,
                                     environment={"OPENBLAS_NUM_THREADS": "1"})
            check(status in (0, 2, 127), f"{mib} MiB: exit {status}: {said!r}")  # 127: the loader's own
            check(said.count(b"\n") == (status != 0), f"{mib} MiB: exit {status}: {said!r}")
            solved += status == 0
            ended += status != 0
            if status != 0:
                for f in folder.iterdir():
                    check(f.name == "p.toml" or f.read_bytes().endswith((b"\n", b">")), f"{mib} MiB: half of {f.name}")
                    if f.name != "p.toml":
                        f.unlink()
        check(solved >= 1 and ended >= 1, f"memory: {solved} runs solved, {ended} ended")


def names() -> None:
    """Names with line ends, quotes, blanks, a leading dash and bytes that are no UTF-8: in messages one line, and files as named."""
    odd = [b"a\nb", b"q\"u'o`te", b" blank ", b"\xff\xfe\x80", b"\x1b[31m", "\u202edcba".encode(), b"$(touch x);&|", b"%s%n", b"*",
           b"a" * 240]
    for name in odd:
        with tempfile.TemporaryDirectory() as scratch:
            folder = os.fsencode(scratch)
            with open(os.path.join(folder, name), "w") as file:
                file.write(PROBLEM)
            outputs = [a if i % 2 == 0 else name[:200] + b"." + a.encode() for i, a in enumerate(OUTPUTS)]
            status, said, errors = contct(folder, b"run", b"./" + name, *outputs)
            check(status == 0 and not errors, f"{name!r}: exit {status}: {errors!r}")
            made = sorted(os.listdir(folder))
            wanted = {name} | {o for i, o in enumerate(outputs) if i % 2 == 1}
            check(wanted <= set(made), f"{name!r}: files {made}")
            check(all(f.startswith(name[:200]) for f in made), f"{name!r}: files {made}")
            status, said, errors = contct(folder, b"run", b"./none" + name)
            check(status == 2 and errors.count(b"\n") == 1, f"{name!r}: exit {status}: {errors!r}")
            check(not re.search(rb"[\x00-\x09\x0b-\x1f\x7f]", errors), f"{name!r}: {errors!r}")
            errors.decode()  # UTF-8


def changing_files() -> None:
    """A problem, its matrix and a trace that are cut, emptied, overwritten or removed while they are read."""
    large = "[beam]\nlength = 10.0\nelements = 100\nEI = 1.0e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    for step in range(2000):
        large += f"[[step]]\npoint = [ {{ node = 50, w = {-step}.0 }} ]\n"
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        data = large.encode()
        file = folder / "p.toml"
        for i in range(100 if TIMES > 1 else 30):
            file.write_bytes(data)
            over = threading.Event()

            def disturb(seed=i):
                chance = random.Random(seed)
                while not over.is_set():
                    how = chance.randrange(4)
                    if how == 0:
                        os.truncate(file, chance.randrange(len(data)))
                    elif how == 1:
                        file.write_bytes(data[chance.randrange(len(data)):])
                    elif how == 2:
                        file.write_bytes(os.urandom(1000))
                    else:
                        file.write_bytes(data)
            disturber = threading.Thread(target=disturb)
            disturber.start()
            try:
                status, _, errors = contct(folder, "check", "p.toml", "--quiet")
            finally:
                over.set()
                disturber.join()
            check(status in (0, 2), f"a file that changes: exit {status}: {errors!r}")
            check(errors.count(b"\n") == (1 if status == 2 else 0), f"a file that changes: {errors!r}")


def full_and_closed() -> None:
    """Devices that are full, folders that cannot be written, pipes that nobody reads."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        (folder / "p.toml").write_text(PROBLEM)
        for option in OUTPUTS[::2]:
            if option == "--vtu":
                continue
            for place in ("/dev/full", "/proc/o.out", "none/o.out"):
                if option == "--csv" and place == "/dev/full":
                    continue  # its pairs would be /dev/full.pairs
                status, _, errors = contct(folder, "run", "p.toml", "--quiet", option, place)
                check(status == 2 and errors.count(b"\n") == 1 and place.encode() in errors,
                      f"{option} {place}: exit {status}: {errors!r}")
        check([f.name for f in folder.iterdir()] == ["p.toml"], f"left: {list(folder.iterdir())}")
        for arguments in (["run", "p.toml"], ["run", "p.toml", "--json", "-"], ["explain", "p.toml"], ["exact", "p.toml"],
                          ["check", "p.toml"], ["kernels"]):
            reading, writing = os.pipe()
            os.close(reading)
            done = subprocess.run([PROGRAM, *arguments], cwd=folder, stdout=writing, stderr=subprocess.PIPE, timeout=600)
            os.close(writing)
            check(done.returncode == -signal.SIGPIPE and not done.stderr, f"{arguments} to a closed pipe: exit "
                  f"{done.returncode}: {done.stderr!r}")


random.seed(21)
full_and_closed()
names()
memory_steps()
changing_files()
signals_at_calls(commands())
print(f"{checks} checks, {len(complaints)} wrong")
if complaints or checks < 1000:
    raise SystemExit("disturbed.py: allowed: none wrong, 1000 checks or more")
