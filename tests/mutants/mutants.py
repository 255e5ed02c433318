"""mutants.py BUILD.json [--first N | --errata | --caught FILE]: tests that the golden set kills every mutant of
mutants.toml, and every copy of the listing with an undone erratum of reference/errata.toml that changes numbers or
text.

A mutant is contct-replay linked with an object of the mutated kernel, which replaces the member of the library. The
unchanged source, built in the same way, must survive. --first tries only N mutants of each source, and --errata only
errata. The first call of each trace that detects a mutant of the listing must be the one in
reference/vectors/caught.json; --caught writes these calls to FILE. Exit status 1: a mutant survives or does not
compile.
"""
import difflib
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.insert(0, str(HERE.parent / "support"))
from edits import edited  # noqa: E402

CPU_SECONDS = 5  # other mutants need a tenth of a second
LEAST = 100
LEAST_TOLD = 0.98  # share of mutants whose line must be named
LEAST_TOLD_LATER = 0.9  # the same for the mutants in held_out
UNMUTATED = "(as it is)"


def run_tool(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise ValueError(f"does not compile or link:\n{done.stderr}")


def undone_errata():
    """Yields (name, replacements, options of the compiler) of each undone erratum that changes numbers or text."""
    for erratum in tomllib.loads((ROOT / "reference/errata.toml").read_text())["erratum"]:
        for undo in erratum["undo"]:
            if undo["expect"] in ("other-numbers", "other-text"):
                yield f"erratum {erratum['number']}, {undo['name']}", [(r["from"], r["to"]) for r in undo["replace"]], undo.get("compile", [])


def compile_listing(build, copy, folder, options):
    """Compiles the listing under both names. A line over 72 columns is an error, because it would be cut."""
    common = [build["fortran"], *build["fortran_flags"].split(), "-O2", "-std=legacy", "-ffp-contract=off",
              "-Werror=line-truncation", *options, "-cpp", "-c", copy]
    run_tool([*common, "-DCONTCT=CONTC8", "-fdefault-real-8", "-o", "r8.o"], folder)
    run_tool([*common, "-DCONTCT=CONTC4", "-o", "r4.o"], folder)
    return ["r8.o", "r4.o"]


def compile_cpp(build, copy, folder, _):
    """Compiles the C++ kernel. The folder of the mutant is searched first, so that its header is included."""
    unit = ROOT / "cpp/contct/kernel/contct.cpp" if copy.suffix == ".hpp" else copy
    names = [f'-DCONTCT_{name}=""' for name in ("FORTRAN_COMPILER", "CXX_COMPILER", "FORTRAN_FLAGS", "CXX_FLAGS")]
    run_tool([build["cxx"], *build["cxx_flags"].split(), "-O1", "-std=c++20", "-ffp-contract=off", *names,
              "-I", folder / "cpp", "-I", ROOT / "cpp", "-c", unit, "-o", "kernel.o"], folder)
    return ["kernel.o"]


def build_program(build, file, source, folder, options):
    copy = folder / file
    copy.parent.mkdir(parents=True)
    copy.write_text(source)
    objects = (compile_listing if copy.suffix == ".f" else compile_cpp)(build, copy, folder, options)
    run_tool([build["cxx"], *build["cxx_flags"].split(), build["replay"], *objects, *build["libraries"].split(),
              *build["link_flags"].split(), "-o", "mutant"], folder)


def noticed(file, folder):
    """Returns (the first trace that detects the mutant in words, or None; the named line of each kernel; the first call
    of each trace that detects the mutant)."""
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS, CPU_SECONDS))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    kernels = "fortran,fortran-r4" if file.endswith(".f") else "cpp,cpp-r4"
    done = subprocess.run([folder / "mutant", "--kernel", kernels, "--", *sorted((ROOT / "reference/traces").glob("*.trace"))], cwd=folder,
                          timeout=60, capture_output=True, text=True, errors="replace", preexec_fn=limited, check=False)
    if done.returncode == 2:
        raise ValueError(done.stderr)
    said = [line for line in done.stdout.splitlines() if ": mismatch; " in line]
    named = [int(line) for line in re.findall(r": at fault: line (\d+),", done.stderr)]
    seen = None if done.returncode == 0 else Path(said[0].split(": ")[0]).stem if said else f"ends with {done.returncode}"
    return seen, named, {Path(trace).stem: int(call) for trace, call in re.findall(r"(\S+\.trace): [\w-]+: call (\d+):", done.stderr)}


def tried(build, file, name, replacements, options=()):
    """Returns (True if the result is as required, the result in words, the named lines, the detecting calls)."""
    named, calls = [], {}
    try:
        with tempfile.TemporaryDirectory() as folder:
            build_program(build, file, edited((ROOT / file).read_text(), replacements), Path(folder), options)
            seen, named, calls = noticed(file, Path(folder))
    except ValueError as wrong:
        return False, f"is none: {wrong}", named, calls
    except subprocess.TimeoutExpired:
        seen = "hangs"
    if seen is None:
        return name == UNMUTATED, "lives", named, calls
    return name != UNMUTATED, f"is noticed: {seen}", named, calls


def lines_of(file, name, replacements, table):
    """Returns the faulty lines of the listing, or None: those of the table, or the lines that the edit changes; for an
    insertion, the lines before and after it."""
    if name in table or not file.endswith(".f"):
        return set(table[name]) or None
    source, lines = (ROOT / file).read_text(), set()
    new = edited(source, replacements).splitlines()
    for kind, begin, end, _, _ in difflib.SequenceMatcher(None, source.splitlines(), new, autojunk=False).get_opcodes():
        if kind != "equal":
            lines.update(range(begin + 1, end + 1) if end > begin else (begin, begin + 1))
    continued = {n for n in lines if source.splitlines()[n - 1][5:6] == "&"}
    return lines - continued | {n - 1 for n in continued}


def main(build_file, option=None, value=None):
    first = value if option == "--first" else None
    build = json.loads(Path(build_file).read_text())
    trials = []
    table = tomllib.loads((HERE / "mutants.toml").read_text())
    faulty = {name: lines for lines, names in table["lines"] for name in names}
    told, caught, later = {}, {}, set()
    for source in table["source"]:
        trials.append((source["file"], UNMUTATED, []))
        some = [] if option == "--errata" else source["mutants"][:first and int(first)]
        held_out = [] if first or option else source.get("held_out", [])
        trials += [(source["file"], name, [(old, new)]) for name, old, new in some + held_out]
        later |= {(source["file"], name) for name, _, _ in held_out}
    if first is None:
        trials += [("fortran/contct.f", *erratum) for erratum in undone_errata()]
    known = json.loads((ROOT / "reference/vectors/caught.json").read_text())
    wrong = 0
    with ThreadPoolExecutor(os.cpu_count()) as workers:
        for (file, name, edits, *_), (good, words, named, calls) in zip(trials, workers.map(lambda t: tried(build, *t), trials)):
            lines = None if name == UNMUTATED or name.startswith("erratum") else lines_of(file, name, edits, faulty)
            if lines:
                told[file, name] = bool(named) and lines.issuperset(named)
                words += f"; its fault is in {sorted(lines)}, {'named' if told[file, name] else 'MISSED, named'} {named}"
            print(f"{'' if good else 'WRONG: '}{file}, {name}: {words}", flush=True)
            wrong += not good
            if calls and file.endswith(".f") and (file, name) not in later:
                caught[name] = calls
                if option != "--caught" and known.get(name) != calls:
                    wrong += 1
                    print(f"WRONG: caught.json has other calls for {name}: found {calls}, allowed: {known.get(name)}")
    if option == "--caught":
        rows = (f"{json.dumps(name)}: {json.dumps(calls)}" for name, calls in sorted(caught.items()))
        Path(value).write_text("{\n" + ",\n".join(rows) + "\n}\n")
    print(f"{len(trials)} kernels, mutants and as they are, {wrong} wrong")
    if option == "--errata":
        least = 15
        return f"found {len(caught)} errata; allowed: {least} or more" if len(caught) < least else int(wrong > 0)
    for what, least, of_them in (("", LEAST_TOLD, [k for k in told if k not in later]), (", held out", LEAST_TOLD_LATER, later)):
        right = sum(told[k] for k in of_them)
        print(f"the line named is the faulty one, for each kernel, for {right} of {len(of_them)} mutants{what}")
        if right < least * len(of_them):
            return f"found {right} of {len(of_them)} mutants{what} whose line is named; allowed: {least:.0%} or more"
    if first is None and len(trials) < LEAST:
        return f"found {len(trials)} mutants; allowed: {LEAST} or more"
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
