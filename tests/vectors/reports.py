"""reports.py ROOT PROGRAM: tests that the reports in reference/vectors/reports and a report of `fuzz` follow their
schema, and that verify_report.py verifies those of built-in kernels and refuses a changed number, kernel or trace.
"""
import hashlib
import json
import sys
import tempfile
from pathlib import Path

import jsonschema

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import Checks, run  # noqa: E402

root, program, check = Path(sys.argv[1]).resolve(), sys.argv[2], Checks()
schema = jsonschema.Draft202012Validator(json.loads((root / "reference/vectors/contct-report-1.schema.json").read_text()))
reports = {file.stem: file for file in sorted((root / "reference/vectors/reports").glob("*.json"))}


def is_verified(file, kernel):
    done = run(sys.executable, root / "reference/vectors/verify_report.py", file, "--kernel", kernel, "--contct", program)
    said = done.stdout + done.stderr
    check(said.count("\n") == 1 and len(said) < 700, f"{file}, {kernel}: found a message of {len(said)} bytes; allowed: one line of less than 700")
    return done.returncode


for name, file in reports.items():
    check(schema.is_valid(json.loads(file.read_text())), f"{name} is as contct-report-1.schema.json says")
for name in ("fortran", "cpp", "fortran-r4", "cpp-r4"):
    check(is_verified(reports[name], name) == 0, f"{name} is verified")
good = json.loads(reports["cpp"].read_text())
traces = good["traces"]
for t in traces:
    check(t["sha256"] == hashlib.sha256((root / f"reference/traces/{t['name']}.trace").read_bytes()).hexdigest(), f"the SHA-256 of {t['name']}")
with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "fuzz.json"
    run(program, "fuzz", "--quiet", "--calls", 1500, "--report", file, status=0)
    check(is_verified(file, "cpp") == 0 and schema.is_valid(json.loads(file.read_text())), "a report of fuzz is verified, and as the schema says")
    for change in ({"calls": good["calls"] + 1}, {"mismatches": 1}, {"rung": "ulps"}, {"kernel": {**good["kernel"], "sha256": "0" * 64}},
                   {"traces": traces[1:]}, {"traces": [{**traces[0], "sha256": "0" * 64}, *traces[1:]]}, {"command": "replay; true"}):
        file.write_text(json.dumps({**good, **change}))
        check(is_verified(file, "cpp") in (1, 2), f"a report with {change} is refused")
check.end(8 + 4 + 8 + 8 + 12)
