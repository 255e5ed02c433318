"""port.py ROOT PROGRAMS: the kernels in the making of reference/course/port. The empty ones in C, Fortran and Python answer no golden call;
each stage in each language answers as many calls, and `contct replay` passes as many traces, as stages.toml says, with the next stage as
hint; the last one passes a fuzz run."""
import sys
import tempfile
from pathlib import Path

root, programs = (Path(a).resolve() for a in sys.argv[1:])
port = root / "reference/course/port"
sys.path[:0] = [str(port), str(root / "tests/support")]
import hint  # noqa: E402
import stages  # noqa: E402
from testing import Checks, run  # noqa: E402

LANGUAGES = ("py", "c", "f90")
TABLE = hint.read_table()
CONTCT, CALLS, check = programs / "contct", hint.golden_calls(), Checks()


def judged(kernel):
    """How many golden calls are right, how many traces contct replay finds equal, its exit status, and the hints."""
    done = run(CONTCT, "replay", "--kernel", kernel, *sorted((root / "reference/traces").glob("*.trace")))
    found, first = hint.findings(CALLS, hint.answers_of(kernel, CALLS))
    return found["right"], done.stdout.count("equal to the bit"), done.returncode, hint.hints(found, first[1][0], TABLE)[1] if first else []


def built(file):
    """The name of a kernel: a plug-in compiled from C or Fortran without warnings, or a command that runs Python."""
    library, strict = file.with_suffix(".so"), ["-O2", "-ffp-contract=off", "-Wall", "-Werror", "-shared", "-fPIC"]
    if file.suffix == ".py":
        return f"pipe:{sys.executable} {file} 2>/dev/null"
    compiler = ["cc", "-std=c11", "-Wextra", "-I", root / "cpp"] if file.suffix == ".c" else ["gfortran", "-std=f2018", "-Wno-unused-dummy-argument", "-J", file.parent]
    run(*compiler, *strict, "-o", library, file, status=0)
    return f"plugin:{library}"


def check_stages(folder, language):
    last, nexts = 0, [[stage["adds"]] for stage in stages.STAGES[1:]]
    nexts[-1:] = [[TABLE["toggled-by-sign"]["says"]], []]  # stage 9 answers like a known fault, stage 10 is right
    for number, (stage, after) in enumerate(zip(stages.STAGES, nexts), start=1):
        file = folder / f"{language}-{number}.{language}"
        file.write_text(stages.kernel_after(number, language))
        kernel = built(file)
        calls, traces, status, hints = judged(kernel)
        check({"calls": calls, "traces": traces} == stage["right"] and calls > last and status == (0 if calls == len(CALLS) else 1),
              f"{language}, stage {number} answers {calls} calls, passes {traces} traces, and replay ends with {status}; allowed: {stage['right']}")
        check(hints == after, f"{language}, stage {number}: the hint is {hints}; allowed: {after}")
        last = calls
    check(last == len(CALLS), "the last stage answers every golden call")
    fuzzed = run(CONTCT, "fuzz", "--calls", 3000, "--kernels", f"fortran,{kernel}")
    check(fuzzed.returncode == 0, f"{language}, the last stage is equal in a fuzz run: exit {fuzzed.returncode}")


# Likely faults of a port: entries of hints.toml, and edits of the complete kernel in Python.
LIKELY = {"port-gap-with-n": [("gap = face - d", "gap = isurf * (face - d)")],
          "port-gap-with-n-and-sign": [("gap = face - d", "gap = isurf * (face - d)"), ("abs(gap)", "gap")],
          "port-without-epsmul": [("abs(s - smin) / smin < 0.390625e-02", "s == smin")]}


def check_likely_faults(folder):
    for key, edits in LIKELY.items():
        source = stages.kernel_after(10)
        for old, new in edits:
            check(source.count(old) == 1, f"{key}: found {source.count(old)} times: {old}")
            source = source.replace(old, new)
        (folder / "likely.py").write_text(source)
        answers = hint.answers_of(built(folder / "likely.py"), CALLS)
        found, first = hint.findings(CALLS, answers)
        check({**found, "says": TABLE.get(key, {}).get("says")} == TABLE.get(key), f"{key}: found {found}; hints.toml has {TABLE.get(key)}")
        check(hint.hints(found, first[1][0], TABLE)[1] == [TABLE.get(key, {}).get("says")], f"{key}: its hint")


with tempfile.TemporaryDirectory() as name:
    check_likely_faults(Path(name))
    for language in LANGUAGES:
        file = Path(name, f"{language}-0.{language}")
        file.write_text(stages.kernel_after(0, language))
        found = judged(built(file))
        check(found[:3] == (0, 0, 1), f"the empty kernel {file.name} answers {found[0]} calls and passes {found[1]} traces; allowed: 0")
        check_stages(Path(name), language)
check.end(70)
