"""Runs the fuzzers of targets.txt, or measures what their inputs reach; tests/fuzz/run.sh builds them and says how.
usage: fuzzers.py PROGRAMS CORPUS [SECONDS | --coverage] [NAME]..."""

import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
LEAST_COVERAGE = 90.0  # per cent of a source's lines
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


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def hours_with(ledger, name, began):
    """Of all fuzzers with this corpus, in processor hours; what has just run is added to the ledger."""
    with open(ledger, "a", encoding="utf-8") as file:
        file.write(f"{name} {processor_seconds() - began:.0f}\n")
    return sum(int(line.split()[1]) for line in ledger.read_text(encoding="utf-8").splitlines()) / 3600.0


def profile_of(target, program, corpus, work):
    """What the seeds and the corpus of a fuzzer reach, as a file."""
    raw = work / "raw"
    seeds = target.copy_seeds(work / "seeds")
    subprocess.run([program, "-runs=0", f"-max_len={target.longest}", corpus, seeds], cwd=work, check=True,
                   env={**os.environ, "LLVM_PROFILE_FILE": str(raw)}, capture_output=True)
    return raw


def cover(programs, profiles, work):
    """Which share of the lines of each reader all fuzzers together reach. True where that is enough everywhere."""
    profile = work / "all"
    subprocess.run(["llvm-profdata", "merge", "-sparse", *profiles, "-o", profile], check=True)
    lines_of_list = (HERE / "readers.txt").read_text(encoding="utf-8").splitlines()
    least = {s.split()[0]: float([*s.split(), LEAST_COVERAGE][1]) for s in lines_of_list if s and s[0] != "#"}
    sources = list(least)
    objects = [programs[0], *[f"-object={p}" for p in programs[1:]]]
    export = ["llvm-cov", "export", "-summary-only", f"-instr-profile={profile}", *objects, *[ROOT / s for s in sources]]
    told = json.loads(subprocess.run(export, check=True, capture_output=True).stdout)
    counts = {f["filename"]: f["summary"]["lines"] for f in told["data"][0]["files"]}
    short = []
    for source in sources:
        lines = counts[str(ROOT / source)]
        share = 100.0 * lines["covered"] / lines["count"]
        print(f"{source}: {lines['covered']} of {lines['count']} lines, {share:.1f} %")
        short += [f"{source} {least[source]:.0f} %"] if share < least[source] else []
    allowed = f"; allowed: at least {', '.join(short)}" if short else ""
    print(f"readers: {len(sources) - len(short)} of {len(sources)} are covered{allowed}")
    return not short


def main():
    programs, corpora, *rest = sys.argv[1:]
    coverage = rest[:1] == ["--coverage"]
    seconds = 60
    if rest and (coverage or rest[0].isdigit()):
        seconds = 0 if coverage else int(rest[0])
        rest = rest[1:]
    good = []
    profiles = {}
    with tempfile.TemporaryDirectory() as work:
        for target in read_targets(rest):
            program = pathlib.Path(programs).resolve() / f"{target.name}_fuzz"
            corpus = pathlib.Path(corpora).resolve() / target.name
            corpus.mkdir(parents=True, exist_ok=True)
            own = pathlib.Path(work) / target.name
            own.mkdir()
            if coverage:
                profiles[program] = profile_of(target, program, corpus, own)
            else:
                began = processor_seconds()
                good.append(fuzz(target, program, corpus, seconds, own))
                hours = hours_with(corpus.parent / "ran.txt", target.name, began)
        if coverage:
            sys.exit(0 if cover(list(profiles), profiles.values(), pathlib.Path(work)) else 1)
    print(f"fuzzers: {sum(good)} of {len(good)} found nothing; {hours:.1f} processor hours with this corpus")
    sys.exit(0 if all(good) else 1)


main()
