#!/usr/bin/env python3
"""verify_report.py REPORT --kernel NAME [--contct PROGRAM] [--traces FOLDER]: repeats the run of a report with the
kernel NAME, and compares the results. REPORT: a file that `contct replay --report` or `contct fuzz --report` wrote.

Exit status 0: the results and the kernel's SHA-256 are the same; 1: something differs; 2: no such report, or usage.
"""
import argparse
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
COMPARED = "mismatches", "rung", "calls", "values_compared", "vectors", "format", "listing_sha256"
FUZZ = re.compile(r"contct fuzz --kernels ([\w-]+),.* (--calls \d+ --problems \d+ --seed \d+ --shard \d+/\d+)")


def command_of(report, kernel, traces, program):
    """Returns the command that repeats a report, made from numbers and known names in the report only."""
    if report["command"] == "replay":
        golden = {path.stem: path for path in sorted(traces.glob("*.trace"))}
        if unknown := [trace["name"] for trace in report["traces"] if trace["name"] not in golden]:
            raise ValueError(f"found the trace {unknown[0]}; allowed: those of {traces}")
        return [program, "replay", "--quiet", "--kernel", kernel, *(golden[trace["name"]] for trace in report["traces"])]
    fuzz = FUZZ.fullmatch(report["command"])
    if not fuzz:
        raise ValueError(f"found the command {report['command']!r}; allowed: replay, or contct fuzz")
    return [program, "fuzz", "--quiet", "--kernels", f"{fuzz[1]},{kernel}", *fuzz[2].split()]


def repeated(report, kernel, traces, program):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "report.json"
        command = [*map(str, command_of(report, kernel, traces, program)), "--report", str(file)]
        subprocess.run(command, capture_output=True, check=False)
        if not file.exists():
            raise ValueError(f"{command[0]} {command[1]} wrote no report")
        return json.loads(file.read_text())


def differences(report, again):
    """Yields each difference in a few words. The values are cut, because a report can contain any text."""
    two = lambda a, b: f"found {str(a)[:16]}, repeated: {str(b)[:16]}"
    for key in COMPARED:
        if report[key] != again[key]:
            yield f"{key}: {two(report[key], again[key])}"
    if report["kernel"]["sha256"] != again["kernel"]["sha256"]:
        yield f"SHA-256 of the kernel: {two(report['kernel']['sha256'], again['kernel']['sha256'])}"
    traces = [(a, b) for a, b in zip(report["traces"], again["traces"]) if a != b]
    for a, b in traces[:1]:
        key = next(key for key in sorted(a.keys() | b.keys()) if a.get(key) != b.get(key))
        yield f"{len(traces)} of {len(again['traces'])} traces, first {b['name']}: {key[:16]}: {two(a.get(key), b.get(key))}"
    if len(report["traces"]) != len(again["traces"]):
        yield f"number of traces: {two(len(report['traces']), len(again['traces']))}"


def main():
    options = argparse.ArgumentParser(description="Repeat a report and compare.")
    options.add_argument("report", type=Path)
    options.add_argument("--kernel", required=True)
    options.add_argument("--contct", default="contct")
    options.add_argument("--traces", type=Path, default=HERE.parent / "traces")
    o = options.parse_args()
    try:
        report = json.loads(o.report.read_text())
        wrong = list(differences(report, repeated(report, o.kernel, o.traces, o.contct)))
    except (OSError, ValueError, KeyError, TypeError) as fault:
        print(f"{o.report}: {fault}", file=sys.stderr)
        return 2
    if wrong:
        print(f"{o.report}: not verified: {'; '.join(wrong)}", file=sys.stderr)
    if not wrong:
        print(f"{o.report}: verified: {report['calls']} calls, {report['mismatches']} mismatches, rung {report['rung']}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
