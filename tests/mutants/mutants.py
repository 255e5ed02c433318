"""mutants.py BUILD.json [--first N | --errata | --caught FILE]: builds every mutant of mutants.toml, and the listing with each erratum
of reference/errata.toml undone that changes numbers or text, and puts it to the golden set.

A mutant is contct-replay linked with an object of the mutated kernel in front of the libraries: what an object defines keeps a
library's member out. Before the mutants of a source it goes the same way as it is, and has to live. With
--first only so many mutants of each source are tried, with --errata only errata. The first call of each trace that shows a mutant of the
listing has to be the one in reference/vectors/caught.json; --caught writes these calls to FILE. Exit status 1 where a mutant lives, or does
not compile: it is none.
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
    """(name, replacements, options of the compiler)"""
    for erratum in tomllib.loads((ROOT / "reference/errata.toml").read_text())["erratum"]:
        for undo in erratum["undo"]:
            if undo["expect"] in ("other-numbers", "other-text"):
                yield f"erratum {erratum['number']}, {undo['name']}", [(r["from"], r["to"]) for r in undo["replace"]], undo.get("compile", [])


def compile_listing(build, copy, folder, options):
    """Under both of its names. A line cut at column 72 would be another mutant than the one that is written down."""
    common = [build["fortran"], *build["fortran_flags"].split(), "-O2", "-std=legacy", "-ffp-contract=off",
              "-Werror=line-truncation", *options, "-cpp", "-c", copy]
    run_tool([*common, "-DCONTCT=CONTC8", "-fdefault-real-8", "-o", "r8.o"], folder)
    run_tool([*common, "-DCONTCT=CONTC4", "-o", "r4.o"], folder)
    return ["r8.o", "r4.o"]


def compile_cpp(build, copy, folder, _):
    """The folder of the mutant comes before the tree, so that a header in it is the one that is included."""
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
    """(the first trace that shows the mutant, in words, or None where none does; the lines that are named, one for each kernel; the
    first call of each trace that shows it)"""
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
    """(is it as it has to be, what came of it, the lines that are named, the calls that show it)"""
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
    """The lines of the listing at fault: of the table, or that the edit changes; beside an insertion both. None where there is none."""
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
