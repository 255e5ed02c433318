"""mutants.py BUILD.json [--first N]: builds every mutant of mutants.toml and has it judged by the golden set and random calls.

A mutant is the judge (judge_main.cpp) linked with an object of the mutated kernel in front of the libraries: what an object
defines keeps a library's member out. Before the mutants of a source it goes the same way as it is, and has to live. With
--first only so many mutants of each source are tried. Exit status 1 where a mutant lives, or does not compile: it is none.
"""
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE.parent / "support"))
from edits import edited  # noqa: E402

CALLS, SEED, CPU_SECONDS = "5000", "1989", 5  # a mutant that lives takes a quarter of a second
LEAST = 100
UNMUTATED = "(as it is)"


def run_tool(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ValueError(f"does not compile or link:\n{done.stderr}")


def compile_listing(build, copy, folder):
    """Under both of its names. A line cut at column 72 would be another mutant than the one that is written down."""
    common = [build["fortran"], *build["fortran_flags"].split(), "-O2", "-std=legacy", "-ffp-contract=off",
              "-Werror=line-truncation", "-cpp", "-c", copy]
    run_tool([*common, "-DCONTCT=CONTC8", "-fdefault-real-8", "-o", "r8.o"], folder)
    run_tool([*common, "-DCONTCT=CONTC4", "-o", "r4.o"], folder)
    return ["r8.o", "r4.o"]


def compile_cpp(build, copy, folder):
    """The folder of the mutant comes before the tree, so that a header in it is the one that is included."""
    unit = ROOT / "cpp/contct/kernel/contct.cpp" if copy.suffix == ".hpp" else copy
    names = [f'-DCONTCT_{name}=""' for name in ("FORTRAN_COMPILER", "CXX_COMPILER", "FORTRAN_FLAGS", "CXX_FLAGS")]
    run_tool([build["cxx"], *build["cxx_flags"].split(), "-O1", "-std=c++20", "-ffp-contract=off", *names,
              "-I", folder / "cpp", "-I", ROOT / "cpp", "-c", unit, "-o", "kernel.o"], folder)
    return ["kernel.o"]


def build_program(build, file, source, folder):
    copy = folder / file
    copy.parent.mkdir(parents=True)
    copy.write_text(source)
    objects = (compile_listing if copy.suffix == ".f" else compile_cpp)(build, copy, folder)
    run_tool([build["cxx"], *build["cxx_flags"].split(), build["judge"], *objects, *build["libraries"].split(),
              *build["link_flags"].split(), "-o", "mutant"], folder)


def judged(file, folder):
    """What the judge sees first, as (where, what): ("trace ties", "call 3, SS(2)"); None where it sees nothing."""
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    language = "fortran" if file.endswith(".f") else "cpp"
    done = subprocess.run([folder / "mutant", language, ROOT / "reference/traces", CALLS, SEED], cwd=folder, timeout=60,
                          capture_output=True, text=True, errors="replace", preexec_fn=limited, check=False)
    at, ended = "start", False
    for line in done.stdout.splitlines():  # a mutant may print lines of its own
        told = line.removeprefix("judge ") if line.startswith("judge ") else ""
        ended = told == "end"
        if told.startswith("at "):
            at = told[3:]
        if told.startswith("differs "):
            call, _, field = told[8:].partition(" ")
            return at, f"call {call}, {field}"
    if done.returncode == 9:  # of the judge itself, judge_main.cpp
        raise ValueError(done.stderr)
    if done.returncode == 0 and ended:
        return None
    return at, "hangs" if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL) else f"ends with {done.returncode}"


def tried(build, file, name, replacements):
    """(is it as it has to be, what came of it)"""
    try:
        with tempfile.TemporaryDirectory() as folder:
            build_program(build, file, edited((ROOT / file).read_text(), replacements), Path(folder))
            seen = judged(file, Path(folder))
    except ValueError as wrong:
        return False, f"is none: {wrong}"
    except subprocess.TimeoutExpired:
        seen = "start", "hangs"
    if seen is None:
        return name == UNMUTATED, "lives"
    return name != UNMUTATED, f"is noticed by {seen[0]}: {seen[1]}"


def main(build_file, first=None):
    build = json.loads(Path(build_file).read_text())
    trials = []
    for source in tomllib.loads((HERE / "mutants.toml").read_text())["source"]:
        trials.append((source["file"], UNMUTATED, []))
        some = source["mutants"][:first and int(first)]
        trials += [(source["file"], name, [(old, new)]) for name, old, new in some]
    wrong, noticed = 0, Counter()
    with ThreadPoolExecutor(os.cpu_count()) as workers:
        for (file, name, _), (good, words) in zip(trials, workers.map(lambda t: tried(build, *t), trials)):
            print(f"{'' if good else 'WRONG: '}{file}, {name}: {words}", flush=True)
            wrong += not good
            noticed[words.split()[3] if good and name != UNMUTATED else "not"] += 1
    print(f"{noticed['trace']} mutants noticed by the golden set, {noticed['random']} by random calls alone, {wrong} wrong")
    if first is None and len(trials) < LEAST:
        return f"found {len(trials)} mutants; allowed: {LEAST} or more"
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *sys.argv[3:]))
