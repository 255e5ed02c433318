"""repeat.py PROGRAM REPLAY ROOT: tests that every command prints and writes the same bytes in every run.

Each command runs twice, in folders of different names. The second time memory is not 0, and time zone and terminal are
different; the language has a decimal comma if one can be installed. Prints the first line that differs, after removing
durations.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

program, replay, root = (Path(p).resolve() for p in sys.argv[1:4])
DURATIONS = [r'"seconds": [\d.e+-]+', r'(?<= )time="[\d.]+"', r"\b[\d.]+ s\b", r'timestamp="[^"]*"']
OUTPUTS = ("json", "html", "csv", "vtu", "trace", "junit", "markdown", "log", "proof")
PROBLEMS = ("problems/pb07-three-gap-supports.toml", "problems/pb11a-strip-footing-n20.toml", "problems/pp02a-settled-column-n4.toml",
            "problems/divergences/event-at-full-load.toml", "structures/frame.toml")


def run(problem, name, options=""):
    """Returns the command `contct run` with every output file."""
    outputs = [o for o in OUTPUTS if o != "vtu" or "frame" not in problem]
    return f"run reference/{problem} {options} " + " ".join(f"--{o} {name}.{o}" for o in outputs)


def commands():
    lines = []
    for i, p in enumerate(PROBLEMS):
        lines += [run(p, f"run{i}"), run(p, f"corrected{i}", "--kernels corrected --detail --envelope"),
                  f"check reference/{p}", f"exact reference/{p} --json exact.json", f"explain reference/{p}",
                  f"run reference/{p} --final-only --json final.json", f"run reference/{p} --free-run --kernels fortran,corrected"]
    lines += [f"run reference/{PROBLEMS[1]} --engine {e} --json {e}.json" for e in ("refactor", "updated", "condensed", "auto")]
    lines += ["verify --json verify.json --junit verify.xml --reference reference",
              "fuzz --calls 3000 --json fuzz.json --junit fuzz.xml --markdown fuzz.md", "kernels", "new beam -", "new plate -", "--version", "--help"]
    return [[program, *line.split()] for line in lines] + [[replay, "--kernel", "fortran,cpp", "reference/traces/full-load.trace"]]


def settings(folder):
    """Returns the environments of the two runs."""
    plain = {"PATH": os.environ["PATH"], "SOURCE_DATE_EPOCH": "1700000000"}
    other = plain | {"MALLOC_PERTURB_": "165", "TZ": "Asia/Kolkata", "LANGUAGE": "de", "TERM": "dumb", "LC_ALL": "C.UTF-8"}
    if shutil.which("localedef") and not subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", folder / "de_DE.UTF-8"], capture_output=True).returncode:
        other |= {"LOCPATH": str(folder), "LC_ALL": "de_DE.UTF-8"}
    return plain, other


def told(out, command, environment):
    """Returns {name: bytes without durations} of all files, the standard streams and the exit status of a command."""
    out.mkdir(parents=True)
    (out / "reference").symlink_to(root / "reference")
    run = subprocess.run(list(map(str, command)), cwd=out, env=environment, capture_output=True)
    texts = {"standard output": run.stdout, "standard error": run.stderr, "exit status": str(run.returncode).encode()}
    texts |= {f.name: f.read_bytes() for f in out.iterdir() if f.is_file()}
    shutil.rmtree(out)
    cut = re.compile("|".join(DURATIONS).encode())
    return {name: cut.sub(b"DURATION", text) for name, text in texts.items()}


def difference(a, b):
    pairs = zip(a.split(b"\n"), b.split(b"\n"))
    number, (x, y) = next(((i, p) for i, p in enumerate(pairs, 1) if p[0] != p[1]), (0, (b"", b"more or fewer lines")))
    return f"line {number}: {x[:150]!r} | {y[:150]!r}"


def main():
    different = compared = 0
    with tempfile.TemporaryDirectory() as scratch:
        plain, other = settings(Path(scratch))
        for number, command in enumerate(commands()):
            once = told(Path(scratch) / f"once {number}", command, plain)
            again = told(Path(scratch) / "again/deep" / str(number), command, other)
            for name in sorted(once.keys() | again.keys()):
                compared += 1
                a, b = once.get(name, b"no such file"), again.get(name, b"no such file")
                if a != b:
                    different += 1
                    print(f"{' '.join(str(w).rsplit('/', 1)[-1] for w in command[:4])}: {name} differs: {difference(a, b)}")
    print(f"{compared} files of {number + 1} commands compared with {other['LC_ALL']}; {different} differ")
    least = 300
    if compared < least:
        print(f"found {compared} files; allowed: {least} or more")
    return 0 if different == 0 and compared >= least else 1


sys.exit(main())
