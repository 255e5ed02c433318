"""Judges another program's results of the benchmark problems by the exact numbers in this folder:

    python3 reference/benchmarks/judge.py THEIRS.json [--least N]        THEIRS.json: - is standard input

reference/benchmarks.md describes the file, whose format is contct-answers-1. Counts and states must be exact. Any other
number may have an error of `tolerance`: absolute for the share of an event, otherwise relative to the largest exact
number of its kind in the problem. Exit status 0: all pass; 1: a number fails; 2: the file is invalid, or has fewer than
N numbers.
"""
import json
import re
import sys
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
PLACE = ("step", "quantity", "node", "pair", "element", "end", "corner", "dof", "change", "from", "along")
KINDS = {"w": "length", "gap": "length", "force": "force", "shear": "force", "moment": "moment", "mx": "moment", "my": "moment",
         "mxy": "moment", "theta": "slope", "wx": "slope", "wy": "slope"}
TOP = ("format", "program", "version", "tolerance", "problems")


def place(number):
    return tuple((key, number[key]) for key in PLACE if key in number)


def kind_of(number):
    name = re.sub("^(max|min) ", "", number["quantity"])
    return KINDS["force" if number.get("dof") == "w" else "moment"] if name == "reaction" else KINDS.get(name, number["quantity"])


def refuse(condition, where, found, allowed):
    if condition:
        raise ValueError(f"{where}: found {found}; allowed: {allowed}")


def errors(problem, answers, where="answers"):
    """Yields (place, given value, exact value in words, error) of each answer; the error of a wrong count or state is
    infinite."""
    exact, sizes, given = {place(number): number["exact"] for number in problem["numbers"]}, {}, set()
    for number in (n for n in problem["numbers"] if n["quantity"] != "state"):
        sizes[kind_of(number)] = max(sizes.get(kind_of(number), 0.0), abs(float(Fraction(number["exact"]))))
    for answer in answers:
        at, value = place(answer), answer.get("value")
        refuse(set(answer) - {*PLACE, "value"}, where, sorted(set(answer) - {*PLACE, "value"}), f"{PLACE} and value")
        refuse(at not in exact, where, dict(at), [dict(p) for p in exact if p[0] == at[:1][0]] if at else "an entry of NAME.json")
        refuse(at in given, where, f"{dict(at)} twice", "each number once")
        given.add(at)
        if answer["quantity"] == "state":
            refuse(value not in ("contact", "separated"), where, value, "contact or separated")
            yield at, value, exact[at], 0.0 if value == exact[at] else float("inf")
            continue
        refuse(type(value) not in (int, float), where, value, "a number")
        size = 1.0 if answer["quantity"] == "event" else sizes[kind_of(answer)] or 1.0
        off = abs(value - float(Fraction(exact[at])))
        counts = answer["quantity"] in ("contacts", "events")
        yield at, value, exact[at], (float("inf") if off else 0.0) if counts else off / size


def judge(theirs, least):
    refuse(not isinstance(theirs, dict) or set(theirs) != set(TOP), "the file", "other keys", TOP)
    refuse(theirs["format"] != "contct-answers-1", "format", theirs["format"], "contct-answers-1")
    tolerance, judged, failures, largest = theirs["tolerance"], 0, [], 0.0
    refuse(type(tolerance) not in (int, float) or not 0 <= tolerance <= 0.1, "tolerance", tolerance, "a number from 0 to 0.1")
    known = {file.stem: file for file in sorted(HERE.glob("p[bp]*.json"))}
    for name, answers in theirs["problems"].items():
        refuse(name not in known, "problems", name, ", ".join(known))
        for at, value, exact, error in errors(json.loads(known[name].read_text()), answers, name):
            judged, largest = judged + 1, max(largest, error)
            if not error <= tolerance:  # also for NaN
                failures.append(f"{name}: {', '.join(f'{k} {v}' for k, v in at)}: found {value}; exact value {exact}; error {error:.1e}")
    missing = [name for name in known if name not in theirs["problems"]]
    print(*failures, f"{theirs['program']} {theirs['version']}: {judged} numbers of {len(theirs['problems'])} problems, {len(failures)} outside "
          f"{tolerance:g}; the largest error is {largest:.1e}; {len(missing)} problems not given", sep="\n")
    refuse(judged < least and not failures, "--least", f"{judged} numbers", f"{least} or more")
    return int(bool(failures))


def main(file, option="--least", least="1"):
    try:
        refuse(option != "--least", "usage", option, "--least")
        return judge(json.loads(sys.stdin.read() if file == "-" else Path(file).read_text()), int(least))
    except (ValueError, OSError, AttributeError, TypeError) as wrong:
        print(f"judge.py: {file}: {wrong}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) in (2, 4) else __doc__)
