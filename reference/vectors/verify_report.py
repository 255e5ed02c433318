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
COMPARED = "format", "listing_sha256", "vectors", "calls", "values_compared", "mismatches", "rung", "traces"
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
    for key in COMPARED:
        if report[key] != again[key]:
            yield f"{key}: found {report[key]}, repeated: {again[key]}"
    if report["kernel"]["sha256"] != again["kernel"]["sha256"]:
        yield f"kernel: found SHA-256 {report['kernel']['sha256']}, repeated with {again['kernel']['sha256']}"


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
    for line in wrong:
        print(f"{o.report}: {line}", file=sys.stderr)
    if not wrong:
        print(f"{o.report}: verified: {report['calls']} calls, {report['mismatches']} mismatches, rung {report['rung']}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
