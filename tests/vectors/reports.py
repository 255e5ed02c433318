"""reports.py ROOT PROGRAM: tests that the reports in reference/vectors/reports and a report of `fuzz` follow their
schema, and that verify_report.py verifies those of built-in kernels and refuses a changed number, kernel or trace.
"""
import hashlib
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import jsonschema


def main(root, program):
    root = Path(root).resolve()
    script, reports = root / "reference/vectors/verify_report.py", sorted((root / "reference/vectors/reports").glob("*.json"))

    schema = jsonschema.Draft202012Validator(json.loads((root / "reference/vectors/contct-report-1.schema.json").read_text()))

    def verified(file, kernel):
        line = [sys.executable, script, file, "--kernel", kernel, "--contct", program]
        return subprocess.run(line, capture_output=True, text=True, check=False).returncode

    built_in = [r for r in reports if r.stem in ("fortran", "cpp", "fortran-r4", "cpp-r4")]
    if len(reports) < 8 or not all(schema.is_valid(json.loads(report.read_text())) for report in reports):
        return "a report of reference/vectors/reports is not as contct-report-1.schema.json says"
    if len(built_in) != 4 or any(verified(report, report.stem) != 0 for report in built_in):
        return "a report of reference/vectors/reports is not verified"
    traces = json.loads(built_in[0].read_text())["traces"]
    if any(t["sha256"] != hashlib.sha256((root / f"reference/traces/{t['name']}.trace").read_bytes()).hexdigest() for t in traces):
        return "a report has another SHA-256 of a trace than Python"
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "fuzz.json"
        subprocess.run([program, "fuzz", "--quiet", "--calls", "1500", "--report", file], check=True)
        if verified(file, "cpp") != 0 or not schema.is_valid(json.loads(file.read_text())):
            return "a report of fuzz is not verified, or not as contct-report-1.schema.json says"
        good = json.loads(built_in[0].read_text())
        for change in ({"calls": good["calls"] + 1}, {"mismatches": 1}, {"rung": "ulps"}, {"kernel": {**good["kernel"], "sha256": "0" * 64}},
                       {"traces": traces[1:]}, {"traces": [{**traces[0], "sha256": "0" * 64}, *traces[1:]]}, {"command": "replay; true"}):
            file.write_text(json.dumps({**good, **change}))
            if verified(file, built_in[0].stem) not in (1, 2):
                return f"verified although it has {list(change)}"
    print(f"{len(built_in)} reports of replays and one of fuzz are verified; seven changed ones are not")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
