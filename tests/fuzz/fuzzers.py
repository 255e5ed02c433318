"""Runs the fuzzers of targets.txt; tests/fuzz/run.sh builds them and says how. usage: fuzzers.py PROGRAMS CORPUS [SECONDS] [NAME]..."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LIMITS = ["-timeout=10", "-rss_limit_mb=2560"]


class Target:
    """A line of targets.txt."""

    def __init__(self, line):
        self.name, longest, least_runs, *words = line.split()
        self.longest = int(longest)
        self.least_runs = int(least_runs)
        self.options = [w for w in words if w.startswith("-")]
        patterns = [w for w in words if not w.startswith("-")]
        self.seeds = [f for p in [*patterns, f"tests/fuzz/seeds/{self.name}/*"] for f in sorted(ROOT.glob(p))]

    def copy_seeds(self, folder):
        """The seeds that are no longer than an input may be; libFuzzer would cut others in two."""
        folder.mkdir(parents=True)
        fitting = [f for f in self.seeds if f.stat().st_size <= self.longest]
        for file in fitting:
            shutil.copy(file, folder / str(file.relative_to(ROOT)).replace("/", "_"))
        if not fitting:
            sys.exit(f"{self.name}: found no seed of at most {self.longest} bytes; allowed: one or more")
        return folder


def read_targets(names):
    lines = (HERE / "targets.txt").read_text(encoding="utf-8").splitlines()
    targets = [Target(line) for line in lines if line.strip() and not line.startswith("#")]
    built = {f.name.removesuffix("_fuzz.cpp") for f in HERE.glob("*_fuzz.cpp")}
    if built != {t.name for t in targets}:
        sys.exit(f"targets.txt: found other fuzzers than there are: {sorted(built ^ {t.name for t in targets})}")
    unknown = [n for n in names if n not in built]
    if unknown:
        print(f"fuzzers: found {', '.join(unknown)}; allowed: {', '.join(sorted(built))}", file=sys.stderr)
        sys.exit(2)
    return [t for t in targets if not names or t.name in names]


def fuzz(target, program, corpus, seconds, work):
    """Run one fuzzer. What it finds stays beside its corpus. True where all is well."""
    options = [f"-max_total_time={seconds}", f"-max_len={target.longest}", "-print_final_stats=1",
               f"-artifact_prefix={corpus}-", f"-dict={HERE / 'numbers.dict'}", *LIMITS, *target.options]
    seeds = target.copy_seeds(work / "seeds")
    environment = {**os.environ, "UBSAN_OPTIONS": "print_stacktrace=1",
                   "ASAN_OPTIONS": "malloc_context_size=6"}
    done = subprocess.run([program, *options, corpus, seeds], cwd=work, env=environment, stderr=subprocess.PIPE,
                          stdout=subprocess.DEVNULL, text=True, errors="replace", check=False)
    found = re.search(r"^stat::number_of_executed_units: *(\d+)", done.stderr, re.MULTILINE)
    runs = int(found.group(1)) if found else 0
    if done.returncode != 0:
        lines = [line for line in done.stderr.splitlines() if not line.startswith("#")]
        print("\n".join(lines[-60:]))
        print(f"{target.name}: found an input that is not handled, after {runs} runs; it is beside {corpus}")
        return False
    least = target.least_runs * seconds // 60
    if runs < least:
        print(f"{target.name}: found {runs} runs in {seconds} s; allowed: at least {least}")
        return False
    print(f"{target.name}: {runs} runs in {seconds} s, nothing found", flush=True)
    return True


def main():
    programs, corpora, *rest = sys.argv[1:]
    seconds = int(rest.pop(0)) if rest and rest[0].isdigit() else 60
    good = []
    with tempfile.TemporaryDirectory() as work:
        for target in read_targets(rest):
            corpus = pathlib.Path(corpora).resolve() / target.name
            corpus.mkdir(parents=True, exist_ok=True)
            own = pathlib.Path(work) / target.name
            own.mkdir()
            good.append(fuzz(target, pathlib.Path(programs).resolve() / f"{target.name}_fuzz", corpus, seconds, own))
    print(f"fuzzers: {sum(good)} of {len(good)} found nothing")
    sys.exit(0 if all(good) else 1)


main()
