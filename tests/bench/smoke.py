"""Runs the benchmark on small problems of each family and checks the output, but not the times."""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

bench = sys.argv[1]
problems = ["rail-3", "rail-6", "grid-8", "grid-12", "mat-24"]
with tempfile.TemporaryDirectory() as folder:
    rows_file = Path(folder, "rows.json")
    command = [bench, "--problem", ",".join(problems), "--rounds", "1", "--json", rows_file]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    document = json.loads(rows_file.read_text())

rows = document["rows"]
kernels = document["kernels"]
assert document["blas"] in text and document["core"] in text
assert [k["pairs"] for k in kernels] == [10, 100, 1000, 10000, 100000, 1000000]
# The listing's time without its line of text is a difference of two times, which may be negative on a busy machine.
assert all(k["fortran_us"] + k["text_us"] > 0 and k["cpp_us"] > 0 for k in kernels), kernels
assert all(abs(k["ratio"] * k["cpp_us"] - k["fortran_us"]) <= 1e-9 * abs(k["fortran_us"]) for k in kernels), kernels
engines = {row["engine"] for row in rows}
events = 0
for row in rows:
    where = f"{row['problem']} on {row['engine']}"
    assert row["same_events"] and row["certified"], where
    assert row["max_load_fraction_diff"] <= 1e-8 and row["max_d_diff"] <= 1e-8, where
    assert row["peak_mib"] > 1, where
    if row["engine"] == "refactor":
        assert row["ratio_to_refactor"] == 1 and row["factors"] > row["events"], where
    events += row["events"]
# Every engine has a row for each problem, but condensed only for beams.
plain = engines - {"condensed"}
expected = {(name, engine) for name in problems for engine in (engines if name.startswith("rail") else plain)}
assert {(row["problem"], row["engine"]) for row in rows} == expected and len(rows) == len(expected), rows
assert engines == {"refactor", "updated", "condensed"}, engines
assert events >= 200, events
# CHOLMOD's rows, which a build without CHOLMOD does not have. Its path has our events; Newton's method is for problems of one load step.
for peer in document["peers"]:
    assert 8.5 <= peer["digits"] <= 15 and peer["wrong_statuses"] == 0 and peer["values"] >= 100 and peer["ms"] > 0 and peer["mib"] > 0, peer
    if peer["method"] == "path, up/downdating":
        assert {peer["steps"]} == {row["events"] for row in rows if row["problem"] == peer["problem"]}, peer
assert [p["problem"] for p in document["peers"]] in ([], [name for name in problems[:4] for _ in range(3)] + problems[4:]), document["peers"]

# --events limits the events, and unknown names are refused.
short = subprocess.run([bench, "--without-kernels", "--problem", "grid-12", "--engine", "refactor,updated", "--events", "5", "--rounds", "1"],
                       check=True, capture_output=True, text=True).stdout
assert "not whole" in short, short
for wrong in (["--problem", "rial-3"], ["--engine", "warp"], ["--problem", "rail-1"]):
    refused = subprocess.run([bench, "--without-kernels", *wrong], capture_output=True, text=True)
    assert refused.returncode != 0 and wrong[1] in refused.stderr, refused.stderr
print(f"{len(rows)} rows, {events} events")
