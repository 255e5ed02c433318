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
            "problems/divergences/%s", "structures/frame.toml")


def run(problem, name, *options):
    """Returns the command `contct run` with every output file."""
    files = [word for output in OUTPUTS for word in (f"--{output}", f"{name}.{output}")]
    files = files if "frame" not in problem else [w for w in files if w != "--vtu" and not w.endswith(".vtu")]
    return [program, "run", f"reference/{problem}", *options, *files]


def commands():
    divergence = sorted((root / "reference/problems/divergences").glob("*.toml"))[0].name
    problems = [p % divergence if "%" in p else p for p in PROBLEMS]
    of_problem = [run(p, f"run{i}") for i, p in enumerate(problems)]
    of_problem += [run(p, f"corrected{i}", "--kernels", "corrected", "--detail", "--envelope") for i, p in enumerate(problems)]
    for p in problems:
        of_problem += [[program, "check", f"reference/{p}"], [program, "exact", f"reference/{p}", "--json", "exact.json"],
                       [program, "explain", f"reference/{p}"], [program, "run", f"reference/{p}", "--final-only", "--json", "final.json"],
                       [program, "run", f"reference/{p}", "--free-run", "--kernels", "fortran,corrected"]]
    engines = [[program, "run", f"reference/{PROBLEMS[1]}", "--engine", e, "--json", f"{e}.json"] for e in ("refactor", "updated", "condensed", "auto")]
    others = [[program, "verify", "--json", "verify.json", "--junit", "verify.xml", "--reference", "reference"],
              [program, "fuzz", "--calls", "3000", "--json", "fuzz.json", "--junit", "fuzz.xml", "--markdown", "fuzz.md"],
              [program, "kernels"],
              [program, "new", "beam", "-"], [program, "new", "plate", "-"], [program, "--version"], [program, "--help"],
              [replay, "--kernel", "fortran,cpp", "reference/traces/full-load.trace"]]
    return of_problem + engines + others


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
