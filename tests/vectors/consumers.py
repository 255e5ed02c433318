"""consumers.py ROOT LANGUAGE [PROGRAM [REPLAY]]: tests that the consumer of reference/vectors/consumers in this
language accepts the correct kernel, and detects each fault of faults.toml. With PROGRAM (contct), `replay` and `fuzz`
must give the same verdicts on the kernels, and the faulty line of the listing must be that of faults.toml, or of the
mutant with the same name. Each judge must name the first wrong value of the first wrong call, and its right value. With
REPLAY (the static contct-replay), it must give the same verdicts on the kernels as commands. Exit status 77: the
language is missing.
"""
import json
import os
import re
import shutil
import sys
import tempfile
import tomllib
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "support"), str(TESTS / "mutants")]
import mutants  # noqa: E402
from edits import edited  # noqa: E402
import testing  # noqa: E402

STRICT = "-O2 -ffp-contract=off"
# the tool; the file with the kernel: in reference/kernels, or the consumer; how it is built; how it is run; the vectors
LANGUAGES = {
    "c": ("cc", "contct_kernel.c", f"cc {STRICT} -I ROOT/cpp -o judge judge.c contct_kernel.c -lm", "./judge VECTORS", "txt"),
    "fortran": ("gfortran", "contct_kernel.f90", f"gfortran {STRICT} -o judge contct_kernel.f90 judge.f90", "./judge VECTORS", "txt"),
    "python": ("python3", "contct_kernel.py", "", "python3 judge.py VECTORS .", "json"),
    "rust": ("rustc", "judge.rs", "rustc -O -o judge judge.rs", "./judge VECTORS", "txt"),
    "go": ("go", "judge.go", "go build -o judge judge.go", "./judge VECTORS", "json"),
    "julia": ("julia", "judge.jl", "", "julia --startup-file=no judge.jl VECTORS", "txt"),
    "javascript": ("node", "judge.js", "", "node judge.js VECTORS", "json"),
    "octave": ("octave-cli", "judge.m", "", "octave-cli --quiet --norc judge.m VECTORS", "txt"),
}
WARN = "-Wall -Wextra -Wpedantic -Wconversion -Werror -shared -fPIC"
OUTSIDE = {
    "c": (f"cc {STRICT} -std=c11 {WARN} -Wshadow -I ROOT/cpp -o kernel.so contct_kernel.c", "plugin:./kernel.so", 20000),
    "fortran": (f"gfortran {STRICT} -std=f2018 {WARN} -Wno-compare-reals -o kernel.so contct_kernel.f90", "plugin:./kernel.so", 20000),
    "python": ("", "pipe:python3 contct_kernel.py", 5000),
}
EXCEPTION = "python", "s-ge"  # it divides by SMIN = 0, and then has no answer that leads to a line
NO_ANSWER = r"call \d+ .*: found no answer \(ZeroDivisionError: float division by zero\), expected SMIN \S+\n"
FIRST = re.compile(r"^(.+), call (\d+)(?: \(.*\))?: found (SS\((\d+)\)|SMIN|ISEP\((\d+)\)) (\S+), expected (\S+)$", re.M)
PIPES = {
    "c": (f"cc {STRICT} -I ROOT/cpp -o mine ROOT/reference/adopt/pipe_main.c contct_kernel.c -lm", "./mine"),
    "fortran": (f"gfortran {STRICT} -o mine ROOT/reference/adopt/pipe_main.c contct_kernel.f90 -lm", "./mine"),
    "python": ("", "python3 contct_kernel.py"),
}


def judgements(root, language, folder, program, replay):
    """Returns {judge: (exit status, output)}; judges are the vectors, `replay` and `fuzz`."""
    def run(command, build="", status=None):
        if build:
            run(build, status=0)
        done = testing.run("sh", "-c", command.replace("ROOT", str(root)), cwd=folder, status=status,
                           env={**os.environ, "GOCACHE": str(folder / "cache"), "PYTHONDONTWRITEBYTECODE": "1"})
        return done.returncode, done.stdout + done.stderr

    _, _, build, judge, kind = LANGUAGES[language]
    found = {"vectors": run(judge.replace("VECTORS", f"ROOT/reference/vectors/contct-vectors-1.{kind}"), build)}
    if program and language in OUTSIDE:
        build, kernel, calls = OUTSIDE[language]
        found["replay"] = run(f"{program} replay --quiet --kernel '{kernel}' ROOT/reference/traces/*.trace", build)
        found["fuzz"] = run(f"{program} fuzz --quiet --problems 5 --calls {calls} --kernels 'fortran,{kernel}'")
    if replay and language in PIPES:
        build, kernel = PIPES[language]
        found["static replay"] = run(f"{replay} --quiet --kernel 'pipe:{kernel}' ROOT/reference/traces/*.trace", build)
    return found


def misnamed(said, document):
    """Returns what is wrong in a judge's line about the first wrong value, or an empty text."""
    first = FIRST.search(said)
    if not first and re.search(NO_ANSWER, said):
        return ""
    if not first:
        return "it names no value"
    case, number, field, pair, toggled, found, expected = first.groups()
    call = next(call for c in document["cases"] if c["name"] == case for call in c["calls"] if call["call"] == int(number))
    words = call["ss"]["decimal"][int(pair) - 1] if pair else call["isep_after"][int(toggled) - 1] if toggled else call["smin"]["decimal"]
    right = float(words)
    if not (right == float(expected) or right != right != float(expected)):
        return f"{field}: it names {expected} as right; allowed: {words}"
    return f"{field}: found equals expected" if float(found) == right and str(float(found)) == str(right) else ""


root, language, (program, replay) = Path(sys.argv[1]).resolve(), sys.argv[2], [a and Path(a).resolve() for a in (*sys.argv[3:5], None, None)[:2]]
tool, kernel, *_ = LANGUAGES[language]
if not shutil.which(tool):
    print(f"{tool} is not installed")
    sys.exit(77)
folders = [root / "reference/vectors/consumers", root / "reference/kernels"]
source = next(folder / kernel for folder in folders if (folder / kernel).exists()).read_text()
document = json.loads((root / "reference/vectors/contct-vectors-1.json").read_text())
calls = sum(len(case["calls"]) for case in document["cases"] if case["real"] == 8)
faults = tomllib.loads((TESTS / "vectors/faults.toml").read_text())[language]
table = tomllib.loads((TESTS / "mutants/mutants.toml").read_text())
listing, of_mutants = table["source"][0], {n: lines for lines, names in table["lines"] for n in names}
faulty_lines = {mutant: mutants.lines_of(listing["file"], mutant, [(old, new)], of_mutants) for mutant, old, new in listing["mutants"]}
for name, *edit in [["as it is"], *faults]:
    faulty_lines.update((name, {line}) for line in edit[2:])
    with tempfile.TemporaryDirectory() as work:
        shutil.copytree(folders[0], work, dirs_exist_ok=True)
        (Path(work) / kernel).write_text(edited(source, [edit[:2]] if edit else []))
        found = judgements(root, language, Path(work), program, replay)
    print(name, {who: status for who, (status, _) in found.items()}, flush=True)
    for who, (status, said) in found.items():
        of_vectors, excepted = who == "vectors", (language, name) == EXCEPTION
        named = {int(line) for line in re.findall(r"at fault: line (\d+),", said)}
        for wrong, what in ((status != (1 if edit else 0), f"found exit status {status}"),
                            (of_vectors and f"{calls} calls" + (", " if edit else "") not in said, "it ended early"),
                            (edit and of_vectors and misnamed(said, document), "the first wrong value is not named"),
                            (any(int(some) > int(of) for some, of in re.findall(r"explains (\d+) of (\d+)", said)), "a value counts twice"),
                            (edit and not of_vectors and not ((named or excepted) and named <= set(faulty_lines[name])), f"found lines {named}")):
            if wrong:
                sys.exit(f"{language}, {name}, judged by {who}: {what}: {wrong}\n{said[-2000:]}")
print(f"{language}: {len(faults)} faults are found")
