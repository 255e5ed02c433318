"""peers.py BENCH PROGRAM: the rows of one program in contct_bench --peers on small problems. No times are judged.

Right digits are: those of doubles where K is the same, those of other elements where they are CalculiX's own.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

PROBLEMS = ("rail-5", "grid-14", "solid-2")
METHODS = {"ours": ("path", "path-certified", "final", "final-certified"), "cholmod": ("updown", "factor"),
           "siconos": ("lemke", "newton-min-fb", "pgs"), "petsc": ("newton", "rsls", "ssls"), "calculix": ("newton",)}
SAME_MATRIX = {"rail-5": 8.5, "grid-14": 11.5, "solid-2": 11.5}  # digits that rounding leaves
OTHER_ELEMENTS = {"rail-5": 3.0, "grid-14": 2.3, "solid-2": 6.0}  # and seven that CalculiX prints
VALUES = {"rail-5": 1000, "grid-14": 650, "solid-2": 500}  # compared: displacements and forces
VALUES_PRINTED = {"rail-5": 500, "grid-14": 200, "solid-2": 200}  # neither slopes nor what is inside of an element


def check(row):
    where = f"{row['problem']}, {row['program']}, {row.get('method')}"
    assert row["status"] == "found", f"{where}: {row}"
    others = row["program"] == "calculix"
    floor = (OTHER_ELEMENTS if others else SAME_MATRIX)[row["problem"]]
    if row.get("method", "").endswith("certified"):
        floor = 13  # a bound, which has the rounding of extremes inside elements in it
    assert floor <= row["digits"] <= 15, f"{where}: found {row['digits']:.2f} digits; allowed: {floor} to 15"
    assert row["wrong_statuses"] == 0, f"{where}: found {row['wrong_statuses']} wrong statuses; allowed: 0"
    least = (VALUES_PRINTED if others else VALUES)[row["problem"]]
    assert row["values"] >= least, f"{where}: found {row['values']} values compared; allowed: {least} or more"
    assert row["ms"] > 0 and row["peak_mib"] > 2, f"{where}: {row}"
    return row["values"]


def main():
    bench, program, has_calculix = sys.argv[1], sys.argv[2], sys.argv[3] == "TRUE"
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "rows.json")
        text = subprocess.run([bench, "--peers", "--peer", program, "--problem", ",".join(PROBLEMS), "--rounds", "1", "--json", file],
                              check=True, capture_output=True, text=True).stdout
        rows = json.loads(file.read_text())["peers"]
    if not has_calculix:  # it makes the solid's matrix
        assert "solid-2: not found" in text, text
        rows = [row for row in rows if row["problem"] != "solid-2"]
    problems = [name for name in PROBLEMS if has_calculix or name != "solid-2"]
    expected = [(name, program, method) for name in problems for method in METHODS[program]]
    assert [(row["problem"], row["program"], row["method"]) for row in rows] == expected, rows
    values = sum(check(row) for row in rows)
    print(f"{len(rows)} answers of {program}, {values} values")


if __name__ == "__main__":
    main()
