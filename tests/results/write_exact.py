"""Writes the exact numbers into reference/verification.toml, or with --check compares the existing ones:

    python3 tests/results/write_exact.py CONTCT reference            writes
    python3 tests/results/write_exact.py CONTCT reference --check --least 723 [--most-nodes N]

CONTCT is the program. `contct exact --json` has the displacements, forces and shares of every path as fractions;
moments, shears, extremes and changes of sign come from exact_structures.py. A number is written as a fraction if its
numerator and denominator have at most 40 digits together, and otherwise rounded to 40 significant digits.
"""
import argparse
import json
import subprocess
import sys
import tomllib
from decimal import ROUND_HALF_UP, Decimal, localcontext
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

sys.dont_write_bytecode = True
from exact_structures import Beam, Plate, decimal

DIGITS = 40


def words(x):
    """Returns x as a fraction if it is short, and otherwise rounded to 40 digits."""
    if len(str(abs(x.numerator))) + len(str(x.denominator)) <= DIGITS:
        return str(x)
    with localcontext(prec=DIGITS, rounding=ROUND_HALF_UP):
        d = Decimal(x.numerator) / Decimal(x.denominator)
    exponent = d.adjusted()
    return f"{d:.{DIGITS - 1 - exponent}f}" if -5 <= exponent < DIGITS else f"{d:.{DIGITS - 1}e}".replace("e+", "e")


def zero_right_of(way, w, start):
    """Returns the distance from `start` to the next change of sign of w to the right; w is linear between the nodes."""
    for (s, node), (beyond, following) in zip(way, way[1:]):
        left, right = w[node], w[following]
        if s >= start and left * right <= 0 and left != right:
            return s + (beyond - s) * left / (left - right) - start
    raise ValueError("w does not change its sign")


class ExactPath:
    """The exact path of one problem."""

    def __init__(self, program, file):
        problem = tomllib.loads(Path(file).read_text(), parse_float=decimal)
        # All numbers of a structure given by its matrix come from the exact path.
        matrix = SimpleNamespace(dofs=["value"], nodes=lambda: 0)
        self.structure = Beam(problem) if "beam" in problem else Plate(problem) if "plate" in problem else matrix
        self.program, self.file = program, file
        self.steps = None

    def follow(self):
        run = subprocess.run([self.program, "exact", self.file, "--quiet", "--json", "-"], check=True, capture_output=True)
        result = json.loads(run.stdout)
        if result["status"] != "solved":
            raise ValueError(f"{self.file}: found status {result['status']}, allowed: solved")
        self.steps = result["steps"]
        for step in self.steps:
            step["displacement"] = [Fraction(x) for x in step["displacement"]]

    def of(self, check):
        """Returns the exact value of the quantity in a [[case.check]]: a Fraction, or a state."""
        step, quantity = self.steps[check["step"] - 1], check["quantity"]
        u, names = step["displacement"], self.structure.dofs
        if quantity in names:
            return u[(check["node"] - 1) * len(names) + names.index(quantity)]
        if quantity in ("force", "gap"):
            return Fraction(step["pairs"][check["pair"] - 1][quantity])
        if quantity == "state":
            return step["pairs"][check["pair"] - 1]["state"]
        if quantity == "contacts":
            return Fraction(sum(pair["state"] == "contact" for pair in step["pairs"]))
        events = [(Fraction(i["fraction"]), event) for i in step["increments"] for event in i["events"]]
        if quantity == "events":
            return Fraction(len(events))
        if quantity == "event":
            return next(share for share, event in events
                        if (event["pair"], event["change"]) == (check["pair"], check["change"]))
        if quantity == "reaction":
            return next(Fraction(r["value"]) for r in step["reactions"] if (r["node"], r["dof"]) == (check["node"], check["dof"]))
        number = check["step"] - 1
        if quantity == "hinge_moment":
            return self.structure.place(u, number, "moment", check["node"] - 1, "right")
        if quantity == "hinge_rotation":
            return self.structure.hinge_rotation(u, number, check["node"])
        if quantity == "zero":
            way = self.structure.way(check.get("along"))
            return zero_right_of(way, u[:: len(names)], Fraction(check["from"]))
        if " " in quantity:
            *place, bound, what = quantity.split(" ")
            value, places = self.structure.extreme(u, number, what, bound == "max")
            # A symmetric structure may have the extreme at several places, of which the table may name any.
            return min(places, key=lambda x: abs(x - check["value"])) if place else value
        return self.structure.place(u, number, quantity, check["element"], check.get("end", check.get("corner")))


def with_exact(text, found):
    """Returns the table with a line "exact" after each "value". `found`: the exact numbers of all checks, in order."""
    lines, values = [], iter(found)
    for line in text.splitlines():
        if line.startswith("exact "):
            continue
        lines.append(line)
        if line.startswith("value "):
            lines.append(f'exact     = "{next(values)}"')
    return "\n".join(lines) + "\n"


def compare(case, check, found):
    """Returns True if the table has the exact number; otherwise prints the difference."""
    if check.get("exact") == found:
        return True
    place = ", ".join(f"{k} {check[k]}" for k in ("step", "quantity", "node", "pair", "element", "dof") if k in check)
    print(f"{case['file']}: {place}: exact: found {check.get('exact')}, allowed: {found}")
    return False


def printing(words, exact):
    """Returns how a printed decimal follows from the exact number: "rounded", "cut" (truncated), or "neither"."""
    x, unit = Fraction(words), Fraction(10) ** Decimal(words).as_tuple().exponent
    if x == exact or (x != 0 and exact != 0 and 2 * abs(exact - x) <= unit):
        return "rounded"
    return "cut" if 0 < abs(exact) - abs(x) < unit and x * exact > 0 else "neither"


def misprints(case, check):
    """Prints the numbers of a check that are not rounded or truncated as the table says, and returns how many.

    The floats of the table are texts.
    """
    wrong = 0
    for key, allowed in (("value", "neither" if "relation" in check else "rounded"), ("printed", "rounded"), ("cut", "cut")):
        if key not in check or check["quantity"] == "state":
            continue
        found = printing(str(check[key]), Fraction(check["exact"]))
        if found != allowed and not (found == "cut" and "relation" in check and key == "value"):
            print(f"{case['file']}, step {check['step']}, {check['quantity']}: {key} {check[key]} is {found}, not {allowed}: "
                  f"exactly {check['exact']}")
            wrong += 1
    return wrong


def main():
    sys.set_int_max_str_digits(0)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("reference", type=Path)
    parser.add_argument("--check", action="store_true", help="compare and write nothing")
    parser.add_argument("--most-nodes", type=int, help="with --check: leave larger problems out")
    parser.add_argument("--least", type=int, default=1, help="numbers that must have been compared")
    options = parser.parse_args()
    if options.most_nodes and not options.check:
        parser.error("--most-nodes: found without --check; a table is written whole")
    table = options.reference / "verification.toml"
    text = table.read_text()
    found, problems, wrong = [], 0, 0
    misprinted = sum(misprints(case, check) for case in tomllib.loads(text, parse_float=str)["case"]
                     for check in case["check"] if options.check)
    for case in tomllib.loads(text, parse_float=decimal)["case"]:
        path = ExactPath(options.program, str(options.reference / "problems" / case["file"]))
        if options.most_nodes and path.structure.nodes() > options.most_nodes:
            continue
        path.follow()
        problems += 1
        for check in case["check"]:
            number = path.of(check)
            found.append(number if isinstance(number, str) else words(number))
            wrong += options.check and not compare(case, check, found[-1])
    if not options.check:
        unfinished = table.with_suffix(".unfinished")
        unfinished.write_text(with_exact(text, found))
        unfinished.replace(table)
    print(f"{len(found)} exact numbers of {problems} problems, {wrong} of them not in the table, {misprinted} misprinted")
    if len(found) < options.least:
        print(f"found {len(found)} numbers, allowed: {options.least} or more")
    return 1 if wrong or misprinted or len(found) < options.least else 0


if __name__ == "__main__":
    sys.exit(main())
