"""port.py ROOT PROGRAMS: the kernels in the making of reference/course/port. The empty ones in C, Fortran and Python answer no golden call;
each stage in Python answers as many calls, and `contct replay` passes as many traces, as stages.toml says; the last one passes a fuzz run."""
import subprocess
import sys
import tempfile
from pathlib import Path

root, programs = (Path(a).resolve() for a in sys.argv[1:])
port = root / "reference/course/port"
sys.path.insert(0, str(port))
import hint  # noqa: E402
import stages  # noqa: E402

CONTCT, CALLS = str(programs / "contct"), hint.golden_calls()
wrong = []


def check(holds, what):
    print(("" if holds else "WRONG: ") + what, flush=True)
    wrong.extend([what] * (not holds))


def judged(kernel):
    """How many golden calls are right, how many traces contct replay finds equal, and its exit status."""
    done = subprocess.run([CONTCT, "replay", "--kernel", kernel, *sorted(map(str, (root / "reference/traces").glob("*.trace")))],
                          capture_output=True, text=True, check=False)
    found, _ = hint.findings(CALLS, hint.answers_of(kernel, CALLS))
    return found["right"], done.stdout.count("equal to the bit"), done.returncode


def check_stages(folder):
    last = 0
    for number, stage in enumerate(stages.STAGES, start=1):
        file = folder / f"stage-{number}.py"
        file.write_text(stages.kernel_after(number))
        kernel = f"pipe:{sys.executable} {file} 2>/dev/null"
        calls, traces, status = judged(kernel)
        check({"calls": calls, "traces": traces} == stage["right"] and calls > last and status == (0 if calls == len(CALLS) else 1),
              f"stage {number} answers {calls} calls, passes {traces} traces, and replay ends with {status}; allowed: {stage['right']}")
        last = calls
    check(last == len(CALLS), "the last stage answers every golden call")
    fuzzed = subprocess.run([CONTCT, "fuzz", "--calls", "3000", "--kernels", f"fortran,{kernel}"], capture_output=True, text=True, check=False)
    check(fuzzed.returncode == 0, f"the last stage is equal in a fuzz run: exit {fuzzed.returncode}")


def check_empty(folder):
    c, fortran = folder / "c.so", folder / "f90.so"
    strict = ["-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-shared", "-fPIC"]
    subprocess.run(["cc", "-std=c11", "-Werror", *strict, "-I", root / "cpp", "-o", c, port / "kernel.c"], check=True)
    subprocess.run(["gfortran", "-std=f2018", *strict, "-J", folder, "-o", fortran, port / "kernel.f90"], check=True, capture_output=True)
    for kernel in (f"plugin:{c}", f"plugin:{fortran}", f"pipe:{sys.executable} {port}/kernel.py"):
        found = judged(kernel)
        check(found == (0, 0, 1), f"the empty kernel {Path(kernel).name} answers {found[0]} calls and passes {found[1]} traces; allowed: 0")


with tempfile.TemporaryDirectory() as name:
    check_empty(Path(name))
    check_stages(Path(name))
sys.exit(1 if wrong else 0)
