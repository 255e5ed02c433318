#!/usr/bin/env python3
"""make.py [--check]: writes contct-vectors-1.json and contct-vectors-1.txt from ../traces and caught.json. With
--check, compares the existing files instead (exit status 1: a file differs). README.md describes the format.

caught.json has the first call of each trace that detects each mutant of tests/mutants, and each erratum of
../errata.toml if its correction is undone; `mutants.py BUILD.json --caught FILE` writes caught.json.
"""
import hashlib
import json
import math
import struct
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
VERSION = "1.0.0"
BRANCHES = "no_response", "stationary", "check_positive", "s_positive", "s_is_smallest", "no_events", "within_epsmul", "was_separated"
NEAR = 4  # ULPs from a threshold within which a number is at the threshold


def number(hexfloat):
    return float(hexfloat) if hexfloat.lstrip("-") in ("nan", "inf") else float.fromhex(hexfloat)


def words(line):
    """Returns `key value key value ..` as a dictionary."""
    parts = line.split(" ")
    return dict(zip(parts[::2], parts[1::2]))


def read_call(lines):
    """Returns a call from its lines in a trace, from `call N` on. Real numbers stay hex floats."""
    call = {"call": int(lines[0].split()[1]), "why": "", "dof": [], "dd": [], "dtest": [], "text": []}
    call.update({key: [] for key in ("id", "isep", "isurf", "cc", "ss", "isep_after")})
    for line in lines[1:]:
        if line.startswith("|"):
            call["text"].append(line[1:])
        elif line.startswith("note "):
            call["why"] = line[5:]
        elif line.startswith("pair ") and "smin" in call:
            call["ss"].append(words(line)["ss"])
            call["isep_after"].append(int(words(line)["isep"]))
        elif line not in ("ask", "end"):
            for key, value in words(line).items():
                if key in ("indof", "ndofpn", "dofs", "smin"):
                    call[key] = value if key == "smin" else int(value)
                elif key not in ("nc", "pair"):
                    call[key].append(value if key in ("dd", "dtest", "cc") else int(value))
    return call


def read_trace(path):
    header, *blocks = path.read_bytes().decode("ascii").rstrip("\n").split("\n\n")
    lines = header.split("\n")[1:]
    facts = dict(line.split(" ", 1) for line in lines)
    about = " ".join(line[6:] for line in lines if line.startswith("about "))
    return {"name": path.stem, "real": int(facts["real"]), "sha256": hashlib.sha256(path.read_bytes()).hexdigest(), "why": about,
            "listing": facts["listing"], "calls": [read_call(block.split("\n")) for block in blocks]}


def rounded(x, real):
    if real == 8 or not math.isfinite(x):
        return x
    try:
        return struct.unpack("f", struct.pack("f", x))[0]
    except OverflowError:
        return math.copysign(math.inf, x)


def at(x, threshold, real):
    return abs(x - threshold) <= NEAR * (math.ulp(threshold) if real == 8 else threshold * 2.0**-23)


def decisions(call, real):
    """Yields (an IF of the listing, its outcome) in order, and ("at ..", True) if a number is at a threshold. The
    answer is that of the trace."""
    epsgap, epsmul = rounded(1e-10, real), 0.390625e-02
    dofs = dict(zip(call["dof"], zip(map(number, call["dd"]), map(number, call["dtest"]))))
    least = 1.0
    for node, status, side, face, s in zip(call["id"], call["isep"], call["isurf"], map(number, call["cc"]), map(number, call["ss"])):
        d, response = dofs[(node - 1) * call["ndofpn"] + call["indof"]]
        gap = abs(rounded(face - d, real))
        yield "no_response", response == 0
        if response != 0:
            yield "stationary", gap < epsgap
            yield "at EPSGAP", at(gap, epsgap, real)
            if gap < epsgap:
                yield "check_positive", rounded(status * side / response, real) > 0
            else:
                yield "at full load", at(s, 1.0, real)
        yield "s_positive", s > 0
        if s > 0:
            yield "s_is_smallest", s < least
            least = min(least, s)
    yield "no_events", least == 1
    for s, status in zip(map(number, call["ss"]), call["isep"]) if least != 1 else []:
        difference = rounded(abs(rounded(s - least, real)) / least, real)
        yield "within_epsmul", difference < epsmul
        yield "at EPSMUL", at(difference, epsmul, real)
        if difference < epsmul:
            yield "was_separated", status == 1


def special(x, real):
    """Returns which special kinds of number x is: NaN, infinity, negative zero, subnormal."""
    smallest = sys.float_info.min if real == 8 else 2.0**-126
    kinds = {"NaN": math.isnan(x), "infinity": math.isinf(x), "negative zero": x == 0 and math.copysign(1, x) < 0, "subnormal": 0 < abs(x) < smallest}
    return {kind for kind, it_is in kinds.items() if it_is}


def flags(call, real, mutants):
    found = {f"{b}_{str(outcome).lower()}" if b in BRANCHES else b for b, outcome in decisions(call, real) if outcome or b in BRANCHES}
    for key in ("dd", "dtest", "cc", "ss"):
        found = found.union(*(special(number(x), real) for x in call[key]))
    return sorted(found) + [name if name.startswith("erratum ") else f"mutant {name}" for name in mutants]


def both(hexfloats):
    """Returns the numbers as hex floats without the sign of NaN, and as shortest decimals. NaN and infinities are
    texts, because JSON has no numbers for them."""
    names = {"nan": "NaN", "-nan": "NaN", "inf": "Infinity", "-inf": "-Infinity"}
    return {"hex": [x.replace("-nan", "nan") for x in hexfloats], "decimal": [names.get(x) or number(x) for x in hexfloats]}


def vectors():
    caught = json.loads((HERE / "caught.json").read_text())
    cases = [read_trace(path) for path in sorted((HERE.parent / "traces").glob("*.trace"))]
    listing, = {case.pop("listing") for case in cases}
    for case in cases:
        for call in case["calls"]:
            call["flags"] = flags(call, case["real"], [m for m, calls in caught.items() if calls.get(case["name"]) == call["call"]])
            for key in ("dd", "dtest", "cc", "ss"):
                call[key] = both(call[key])
            call["smin"] = {key: value[0] for key, value in both([call["smin"]]).items()}
        case["flags"] = sorted(set().union(*(call["flags"] for call in case["calls"])))
        case["calls"] = case.pop("calls")  # moved to the end of the file's entry, for readers
    return {"format": "contct-vectors-1", "version": VERSION, "listing_sha256": listing, "cases": cases}


def as_json(document):
    """Returns the vectors as JSON, with one line for each call."""
    def line(value):
        return json.dumps(value, separators=(",", ":"), allow_nan=False)
    cases = []
    for case in document["cases"]:
        head = line({key: value for key, value in case.items() if key != "calls"})[:-1]
        cases.append(head + ',"calls":[\n' + ",\n".join(map(line, case["calls"])) + "]}")
    head = line({key: value for key, value in document.items() if key != "cases"})[:-1]
    return head + ',"cases":[\n' + ",\n".join(cases) + "]}\n"


def as_text(document):
    """Returns the calls as text, for languages without a JSON reader."""
    def plain(x):
        return repr(x) if isinstance(x, float) else x.lower().replace("infinity", "inf")
    lines = []
    for case in document["cases"]:
        for c in case["calls"]:
            lines.append(f"call {case['name']} {c['call']} {case['real']} {c['indof']} {c['ndofpn']} {c['dofs']} {len(c['dof'])} "
                         f"{len(c['id'])} {plain(c['smin']['decimal'])}")
            lines += [f"{dof} {plain(d)} {plain(r)}" for dof, d, r in zip(c["dof"], c["dd"]["decimal"], c["dtest"]["decimal"])]
            lines += [f"{node} {status} {side} {plain(face)} {plain(s)} {after}" for node, status, side, face, s, after in
                      zip(c["id"], c["isep"], c["isurf"], c["cc"]["decimal"], c["ss"]["decimal"], c["isep_after"])]
    calls = sum(len(case["calls"]) for case in document["cases"])
    return f"{document['format']} {document['version']} {calls}\n" + "\n".join(lines) + "\n"


def main(option=None):
    document = vectors()
    for name, text in (("json", as_json(document)), ("txt", as_text(document))):
        file = HERE / f"contct-vectors-1.{name}"
        if option != "--check":
            file.write_text(text)
        elif file.read_text() != text:
            return f"{file.name}: is not what reference/vectors/make.py makes of the traces; run it"
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
