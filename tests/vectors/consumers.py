"""consumers.py ROOT LANGUAGE [PROGRAM [REPLAY]]: tests that the consumer of reference/vectors/consumers in this
language accepts the correct kernel, and detects each fault of faults.toml. With PROGRAM (contct), `replay` and `fuzz`
must give the same verdicts on the kernels, and the faulty line of the listing must be that of the mutant with the same
name. Each judge must name the first wrong value of the first wrong call, and its right value. With REPLAY (the static contct-replay), it must give the same verdicts on the kernels as commands. Exit status 77:
the language is not installed.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "support"), str(HERE.parent / "mutants")]
import mutants  # noqa: E402
from edits import edited  # noqa: E402

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
OUTSIDE = {
    "c": (f"cc {STRICT} -shared -fPIC -I ROOT/cpp -o kernel.so contct_kernel.c", "plugin:./kernel.so", 20000),
    "fortran": (f"gfortran {STRICT} -shared -fPIC -o kernel.so contct_kernel.f90", "plugin:./kernel.so", 20000),
    "python": ("", "pipe:python3 contct_kernel.py", 5000),
}
EXCEPTION = "python", "s-ge"  # it divides by SMIN = 0, and then has no answer that leads to a line
FIRST = re.compile(r"^(.+), call (\d+)(?: \(.*\))?: found (SS\((\d+)\)|SMIN|ISEP\((\d+)\)) (\S+), expected (\S+)$", re.M)
PIPES = {
    "c": (f"cc {STRICT} -I ROOT/cpp -o mine ROOT/reference/adopt/pipe_main.c contct_kernel.c -lm", "./mine"),
    "fortran": (f"gfortran {STRICT} -o mine ROOT/reference/adopt/pipe_main.c contct_kernel.f90 -lm", "./mine"),
    "python": ("", "python3 contct_kernel.py"),
}


def run(command, folder):
    begun = time.monotonic()
    done = subprocess.run(["sh", "-c", command], cwd=folder, capture_output=True, text=True, errors="replace", check=False, timeout=300,
                          env={**os.environ, "GOCACHE": str(folder / "cache"), "PYTHONDONTWRITEBYTECODE": "1"})
    return done.returncode, done.stdout + done.stderr, time.monotonic() - begun


def built(command, root, folder):
    status, said, _ = run(command.replace("ROOT", str(root)), folder)
    if status != 0:
        raise ValueError(f"{command}: {said}")


def judgements(root, language, folder, program, replay):
    """Returns {judge: (exit status, output, seconds)}; judges are the vectors, `replay` and `fuzz`."""
    _, _, build, judge, kind = LANGUAGES[language]
    built(build, root, folder)
    found = {"vectors": run(judge.replace("VECTORS", f"{root}/reference/vectors/contct-vectors-1.{kind}"), folder)}
    if program and language in OUTSIDE:
        build, kernel, calls = OUTSIDE[language]
        built(build, root, folder)
        found["replay"] = run(f"{program} replay --quiet --kernel '{kernel}' {root}/reference/traces/*.trace", folder)
        found["fuzz"] = run(f"{program} fuzz --quiet --problems 0 --calls {calls} --kernels 'fortran,{kernel}'", folder)
    if replay and language in PIPES:
        build, kernel = PIPES[language]
        built(build, root, folder)
        found["static replay"] = run(f"{replay} --quiet --kernel 'pipe:{kernel}' {root}/reference/traces/*.trace", folder)
    return found


def misnamed(said, document):
    """Returns what is wrong in a judge's line about the first wrong value, or an empty text."""
    first = FIRST.search(said)
    if not first:
        return "it names no value"
    case, number, field, pair, toggled, found, expected = first.groups()
    call = next(call for c in document["cases"] if c["name"] == case for call in c["calls"] if call["call"] == int(number))
    words = call["ss"]["decimal"][int(pair) - 1] if pair else call["isep_after"][int(toggled) - 1] if toggled else call["smin"]["decimal"]
    right = float(words)
    if not (right == float(expected) or right != right != float(expected)):
        return f"{field}: it names {expected} as right; allowed: {words}"
    return f"{field}: found equals expected" if float(found) == right and str(float(found)) == str(right) else ""


def lines_at_fault(name):
    """Returns the faulty lines of the listing's mutant with this name."""
    table = tomllib.loads((HERE.parent / "mutants/mutants.toml").read_text())
    source = table["source"][0]
    edit, = ([(old, new)] for mutant, old, new in source["mutants"] if mutant == name)
    return mutants.lines_of(source["file"], name, edit, {n: lines for lines, names in table["lines"] for n in names})


def main(root, language, program=None, replay=None):
    root, (tool, kernel, *_) = Path(root).resolve(), LANGUAGES[language]
    program, replay = program and Path(program).resolve(), replay and Path(replay).resolve()
    if not shutil.which(tool):
        print(f"{tool} is not installed")
        return 77
    folders = [root / "reference/vectors/consumers", root / "reference/kernels"]
    source = next(folder / kernel for folder in folders if (folder / kernel).exists()).read_text()
    document = json.loads((root / "reference/vectors/contct-vectors-1.json").read_text())
    calls = sum(len(case["calls"]) for case in document["cases"] if case["real"] == 8)
    faults = tomllib.loads((HERE / "faults.toml").read_text())[language]
    for name, *edit in [["as it is"], *faults]:
        with tempfile.TemporaryDirectory() as work:
            shutil.copytree(folders[0], work, dirs_exist_ok=True)
            (Path(work) / kernel).write_text(edited(source, [edit] if edit else []))
            found = judgements(root, language, Path(work), program, replay)
        print(name, {who: f"{status}, {seconds:.1f} s" for who, (status, _, seconds) in found.items()}, flush=True)
        for who, (status, said, _) in found.items():
            if status != (1 if edit else 0) or (not edit and who == "vectors" and f"{calls} calls" not in said):
                return f"{language}, {name}, judged by {who}: found exit status {status}, allowed: {1 if edit else 0}\n{said[-2000:]}"
            wrong = edit and who == "vectors" and (language, name) != EXCEPTION and misnamed(said, document)
            if wrong or f"{calls} calls, " not in said and who == "vectors":
                return f"{language}, {name}, judged by {who}: {wrong or 'it ended early'}\n{said[-2000:]}"
            named = {int(line) for line in re.findall(r"at fault: line (\d+),", said)}
            if edit and who != "vectors" and not ((named or (language, name) == EXCEPTION) and named <= lines_at_fault(name)):
                return f"{language}, {name}, judged by {who}: found lines {named}, allowed: {lines_at_fault(name)}\n{said[-2000:]}"
    print(f"{language}: {len(faults)} faults are found")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
