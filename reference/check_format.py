"""Checks keys, types, lengths, words and indices of a proof file by proof-format.md, for check_proof.py."""
import json
from math import isfinite

from check_plate import need

FORCES = ["step", "certified", "error", "force", "reactions", "elements"]
STATE = ["displacement", "state", "u", "closed", "z", "scale", "row_of", "shift", "L"]


def whole(x, least, most):
    return type(x) is int and least <= x <= most


def real(x):
    return type(x) is int or (type(x) is float and isfinite(x))


def each(values, count, fits, what):
    need(type(values) is list and len(values) == count and all(map(fits, values)), f"{what}: not {count} of what they should be")


def pair(x):
    return type(x) is list and len(x) == 2 and all(map(real, x))


def once(pairs):
    need(len(dict(pairs)) == len(pairs), "a key stands twice")
    return dict(pairs)


def parsed(file):
    """Returns the entries of "steps". Raises ValueError unless their numbers are 1, 2, ..."""
    proof = json.load(file, object_pairs_hook=once, parse_constant=lambda word: need(False, f"{word} is no number"))
    need(type(proof) is dict and list(proof) == ["format", "steps"], "the keys are not format and steps")
    need(proof["format"] == "contct-proof-2", "the format is not contct-proof-2")
    each(proof["steps"], len(proof["steps"]) if type(proof["steps"]) is list else 0, lambda s: type(s) is dict, "steps")
    for i, s in enumerate(proof["steps"]):
        need(whole(s.get("step"), i + 1, i + 1), f"step {i + 1}: its number is not {i + 1}")
        need(type(s.get("certified")) is bool, f"step {i + 1}: certified is not true or false")
    return proof["steps"]


def check_format(p, s):
    """Raises ValueError if the entry s of a step breaks the format."""
    if s.get("error", 0) is None:
        need(sorted(s) == ["because", "certified", "error", "step"] and type(s["because"]) is str, "without bounds: other keys")
        return
    held = "L" in s
    other = set(s) ^ {*FORCES, *(STATE if held else []), *[key for key in ("L_low", "mesh") if held and key in s]}
    need(not other, f"missing or unknown keys: {sorted(other)}")
    need(type(s["error"]) is dict and set(s["error"]) == set(p.kinds), f"the bounds are not those of {sorted(p.kinds)}")
    for kind, bound in s["error"].items():
        none = p.kinds[kind] == 0 or (not held and kind in ("w", "slope", "gap"))
        need(bound is None if none else real(bound) and bound >= 0, f"the bound on {kind} is {bound}")
    each(s["force"], len(p.pairs), real, "force")
    each(s["reactions"], len(p.supports), real, "reactions")
    each(s["elements"], p.of_elements, real, "elements")
    if held:
        check_state(p, s)


def check_state(p, s):
    each(s["displacement"], p.n, real, "displacement")
    each(s["state"], len(p.pairs), lambda x: x in ("contact", "separated"), "state")
    each(s["z"], p.n if s["z"] else 0, pair, "z")
    check_held(s, p.n, len(p.pairs))
    if "mesh" in s:
        check_line(p, s["mesh"])


def check_held(s, n, pairs):
    """Raises ValueError if u, A or the factor of K_A, for n dofs and so many pairs, breaks the format."""
    each(s["u"], n, pair, "u")
    each(s["scale"], n, lambda x: whole(x, -1100, 1100), "scale")
    each(s["row_of"], n, lambda x: whole(x, 0, n - 1), "row_of")
    need(len(set(s["row_of"])) == n, "row_of: two dofs have one row")
    need(real(s["shift"]) and s["shift"] > 0, "shift: not a positive number")
    ascends(s["closed"], pairs, "closed")
    each(s["L"], n, lambda row: type(row) is list and all(map(real, row)), "L")
    need(all(1 <= len(row) <= i + 1 for i, row in enumerate(s["L"])), "L: a row is empty or too long")
    if "L_low" in s:
        each(s["L_low"], n, lambda row: type(row) is list and all(map(real, row)), "L_low")
        need(list(map(len, s["L"])) == list(map(len, s["L_low"])), "L_low: not the rows of L")


def ascends(numbers, most, what):
    each(numbers, len(numbers) if type(numbers) is list else 0, lambda x: whole(x, 1, most), what)
    need(all(a < b for a, b in zip(numbers, numbers[1:])), f"{what}: not in increasing order")


LINE = {"kind", "error", "of", "extremes", "halvings", "ends", "u", "closed", "parts", "scale", "row_of", "shift", "L"}


def check_line(p, line):
    """Raises ValueError if the line of a mesh's error breaks the format. A stretch or pair of A that stood twice would count twice."""
    need(type(line) is dict and set(line) - {"L_low"} == LINE and line["kind"] == "proved" and p.continuum, "mesh: other keys")
    need(whole(line["halvings"], 0, 6), "halvings: not from 0 to 6")
    kinds = {kind for kind, count in p.kinds.items() if count} | {"pressure", "bed_force", "bed_contact"}
    need(all(type(line[key]) is dict and set(line[key]) == kinds and all(map(real, line[key].values())) for key in ("error", "of")), "mesh: other bounds")
    nodes = (len(p.lines[0]) - 1) * 2**line["halvings"] + 1
    check_held(line, 2 * nodes + sum(element.free > 0 for element, _, _ in p.elements), p.contacts)
    for values in (line["ends"], *(part["before"] for part in line["parts"])):
        each(values, len(values), real, "a number of the line")
    for part in line["parts"]:
        ascends(part["pressed"], len(p.continuum), "pressed")
        ascends([number for number, _, _ in part["certain"]], len(p.continuum), "certain")
