"""vectors.py ROOT: tests that contct-vectors-1.json follows its schema and has every call of the golden set.

Every call has a reason, unless it is from a recorded path. The hex float and the shortest decimal of a number are the
same double, and the text form has the same numbers. Every erratum that changes numbers or text if undone is the flag of
a call.
"""
import json
import math
import re
import struct
import sys
import tomllib
from pathlib import Path

import jsonschema


def bits(x):
    return "NaN" if math.isnan(x) else struct.pack("d", x)


def of_hex(text):
    return float(text) if text[-1] in "nf" else float.fromhex(text)


def numbers(call):
    for key in ("dd", "dtest", "cc", "ss"):
        yield from zip(call[key]["hex"], call[key]["decimal"], strict=True)
    yield call["smin"]["hex"], call["smin"]["decimal"]


def shortest(call):
    """Returns True if each decimal is the shortest decimal of its hex float."""
    return all(bits(of_hex(h)) == bits(float(d)) and (isinstance(d, str) or repr(float(repr(d))) == repr(d)) for h, d in numbers(call))


def main(root):
    folder = Path(root) / "reference/vectors"
    document, schema = (json.loads((folder / f"contct-vectors-1.{kind}").read_text()) for kind in ("json", "schema.json"))
    if wrong := next(jsonschema.Draft202012Validator(schema).iter_errors(document), None):
        return f"{wrong.json_path}: {wrong.message[:300]}"
    calls = [call for case in document["cases"] for call in case["calls"]]
    traces = sorted((Path(root) / "reference/traces").glob("*.trace"))
    recorded = sum(len(re.findall(r"^call ", trace.read_text(), re.M)) for trace in traces)
    if [trace.stem for trace in traces] != [case["name"] for case in document["cases"]] or len(calls) != recorded:
        return f"found {len(calls)} calls, allowed: the {recorded} of the traces"
    if wrong := next((call for call in calls if not shortest(call)), None):
        return f"call {wrong['call']} ({wrong['why']}): a decimal is not its hex float's number"
    words = (folder / "contct-vectors-1.txt").read_text().split()
    in_text = [w for w in words if "." in w or w in ("nan", "inf", "-inf") or re.fullmatch(r"-?\d+e[+-]\d+", w)]
    values = [d for call in calls for _, d in numbers(call)]
    if sorted(map(repr, (bits(float(w)) for w in in_text[1:]))) != sorted(repr(bits(float(d))) for d in values):
        return "contct-vectors-1.txt has other numbers"
    if wrong := next((case["name"] for case in document["cases"] if not case["name"].startswith("path-") and not all(c["why"] for c in case["calls"])), None):
        return f"{wrong}: a call has no reason why it is there"
    flags = {flag for call in calls for flag in call["flags"]}
    errata = tomllib.loads((Path(root) / "reference/errata.toml").read_text())["erratum"]
    undone = {f"erratum {e['number']}, {u['name']}" for e in errata for u in e["undo"] if u["expect"] in ("other-numbers", "other-text")}
    if len(undone) < 15 or undone != {flag for flag in flags if flag.startswith("erratum ")}:
        return f"found errata {sorted(undone ^ {f for f in flags if f.startswith('erratum ')})} in errata.toml or in the flags alone; allowed: in both"
    print(f"{len(calls)} calls, {len(values)} numbers twice, {len(flags)} flags, {sum(f.startswith('mutant ') for f in flags)} of them mutants")
    return 0 if len(flags) >= 90 else f"found {len(flags)} flags; allowed: 90 or more"


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
