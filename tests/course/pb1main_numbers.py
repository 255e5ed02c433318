"""pb1main_numbers.py PROBLEM TOLERANCE CONTCT PRINTOUT..: what the 1989 main program prints against `contct run`.

CONTCT is the program; PRINTOUT.. is the command that prints. Every increment: its scale factor, its share of the step, its
event; every end of a step: two deflections and the pair's force. Numbers agree within TOLERANCE, relative to the largest of
their kind; events are the same.
"""
import json
import re
import subprocess
import sys

problem, tolerance, contct, *printout = sys.argv[1:]
tolerance = float(tolerance)
EVENT = {"MAKES": "make", "BREAKS": "break"}


def read_printout(text):
    """The steps: each its increments (R before, SMIN, R after, events) and its end (w2, w3, force)."""
    steps = []
    for line in text.split(" UNIT 26")[0].splitlines():
        words = line.split()
        if not words:
            continue
        number = float(words[-1]) if re.fullmatch(r"-?[0-9.]+E[+-][0-9]+", words[-1]) else None
        if words[0] == "STEP":
            steps.append({"increments": [], "end": []})
        elif words[0] == "INCREMENT":
            steps[-1]["increments"].append({"r": [number], "s": None, "events": []})
        elif line.strip().startswith("LOAD LEFT"):
            steps[-1]["increments"][-1]["r"].append(number)
        elif words[0] == "SMIN":
            steps[-1]["increments"][-1]["s"] = number
        elif words[0] == "PAIR":
            steps[-1]["increments"][-1]["events"].append((int(words[1]), int(words[4]), EVENT[words[5]]))
        elif words[0] in ("END", "W", "FORCE"):
            steps[-1]["end"].append(number)
    return steps


def run(command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


theirs = read_printout(run(printout))
ours = json.loads(run([contct, "run", problem, "--quiet", "--json", "-"]))["steps"]
compared = 0


def same(what, found, wanted, scale):
    global compared
    compared += 1
    assert abs(found - wanted) <= tolerance * scale, f"{what}: found {found!r}, contct run has {wanted!r}"


assert len(theirs) == len(ours) == 4, f"steps: found {len(theirs)}, contct run has {len(ours)}"
for step, (one, other) in enumerate(zip(theirs, ours), start=1):
    assert len(one["increments"]) == len(other["increments"]), f"step {step}: another number of increments"
    first = one["increments"][0]["r"][0]
    for number, (a, b) in enumerate(zip(one["increments"], other["increments"]), start=1):
        where = f"increment {step}.{number}"
        events = [(e["pair"], e["node"], e["change"]) for e in b["events"]]
        assert a["events"] == events, f"{where}: found {a['events']}, contct run has {events}"
        compared += 1
        same(f"{where}, s", a["s"], b["s"], 1.0)
        same(f"{where}, share of the step", 1 - a["r"][1] / first, b["fraction"], 1.0)
    w2, w3, force = one["end"]
    same(f"step {step}, w at node 2", w2, other["w"][1], 5e-3)
    same(f"step {step}, w at node 3", w3, other["w"][2], 5e-3)
    same(f"step {step}, force", force, other["pairs"][0]["force"], 50.0)
assert compared == 30, f"found {compared} comparisons, allowed: 30"
print(f"{compared} comparisons, all within {tolerance:g}")
