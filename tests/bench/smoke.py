"""Runs the benchmark on small problems of each family and checks the output, but not the times."""
import json
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import Checks, run  # noqa: E402

bench, problems, check = sys.argv[1], ["rail-3", "rail-6", "grid-8", "grid-12", "mat-24"], Checks()
with tempfile.TemporaryDirectory() as folder:
    text = run(bench, "--problem", ",".join(problems), "--rounds", 1, "--json", f"{folder}/rows.json", status=0).stdout
    document = json.loads(Path(folder, "rows.json").read_text())
rows, kernels, peers = (document[key] for key in ("rows", "kernels", "peers"))
check(document["blas"] in text and document["core"] in text, "BLAS and core are printed")
check([k["pairs"] for k in kernels] == [10, 100, 1000, 10000, 100000, 1000000], f"kernels: {kernels}")
for k in kernels:  # the listing's time without its line of text is a difference of two times, which may be negative on a busy machine
    check(k["fortran_us"] + k["text_us"] > 0 and k["cpp_us"] > 0 and abs(k["ratio"] * k["cpp_us"] - k["fortran_us"]) <= 1e-9 * abs(k["fortran_us"]), f"{k}")
for row in rows:
    check(row["same_events"] and row["certified"] and max(row["max_load_fraction_diff"], row["max_d_diff"]) <= 1e-8 and row["peak_mib"] > 1, f"{row}")
    check(row["engine"] != "refactor" or (row["ratio_to_refactor"] == 1 and row["factors"] > row["events"]), f"refactor: {row}")
    check.counted["events"] += row["events"]
# Every engine has a row for each problem, but condensed only for beams.
expected = [(name, engine) for name in problems for engine in ("refactor", "updated", "condensed") if engine != "condensed" or name.startswith("rail")]
check(sorted((row["problem"], row["engine"]) for row in rows) == sorted(expected), f"rows: {rows}")
# A build without CHOLMOD has no rows of it. Its path has our events; Newton's method is for problems of one load step.
for peer in peers:
    check(8.5 <= peer["digits"] <= 15 and peer["wrong_statuses"] == 0 and peer["values"] >= 100 and peer["ms"] > 0 and peer["mib"] > 0, f"{peer}")
    own = {row["events"] for row in rows if row["problem"] == peer["problem"]}
    check(peer["method"] != "path, up/downdating" or own == {peer["steps"]}, f"{peer}: {own}")
check([p["problem"] for p in peers] in ([], [name for name in problems[:4] for _ in range(3)] + problems[4:]), f"peers: {peers}")

short = run(bench, "--without-kernels", "--problem", "grid-12", "--engine", "refactor,updated", "--events", 5, "--rounds", 1, status=0).stdout
check("whole false" in short, f"--events limits the events: {short}")
for wrong in (["--problem", "rial-3"], ["--engine", "warp"], ["--problem", "rail-1"]):
    refused = run(bench, "--without-kernels", *wrong)
    check(refused.returncode != 0 and wrong[1] in refused.stderr, f"{wrong}: {refused.stderr}")
check.end(events=200)
