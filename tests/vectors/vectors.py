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

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import Checks  # noqa: E402


bits = lambda x: "NaN" if math.isnan(x) else struct.pack("d", x)
of_hex = lambda text: float(text) if text[-1] in "nf" else float.fromhex(text)


def numbers(call):
    for key in ("dd", "dtest", "cc", "ss"):
        yield from zip(call[key]["hex"], call[key]["decimal"], strict=True)
    yield call["smin"]["hex"], call["smin"]["decimal"]


# Each decimal is the shortest decimal of its hex float.
shortest = lambda call: all(bits(of_hex(h)) == bits(float(d)) and (isinstance(d, str) or repr(float(repr(d))) == repr(d)) for h, d in numbers(call))
folder, check = Path(sys.argv[1]) / "reference/vectors", Checks()
document, schema = (json.loads((folder / f"contct-vectors-1.{kind}").read_text()) for kind in ("json", "schema.json"))
for wrong in jsonschema.Draft202012Validator(schema).iter_errors(document):
    check(False, f"{wrong.json_path}: {wrong.message[:300]}")
cases = document["cases"]
calls = [call for case in cases for call in case["calls"]]
traces = sorted((folder.parent / "traces").glob("*.trace"))
recorded = sum(len(re.findall(r"^call ", trace.read_text(), re.M)) for trace in traces)
check([trace.stem for trace in traces] == [case["name"] for case in cases] and len(calls) == recorded, f"found {len(calls)} calls, allowed: the {recorded} of the traces")
for case in cases:
    for call in case["calls"]:
        check(shortest(call), f"call {call['call']} ({call['why']}): a decimal is the shortest of its hex float's number")
        check(call["why"] or case["name"].startswith("path-"), f"{case['name']}: a call has a reason why it is there")
words = (folder / "contct-vectors-1.txt").read_text().split()
in_text = [w for w in words if "." in w or w in ("nan", "inf", "-inf") or re.fullmatch(r"-?\d+e[+-]\d+", w)]
values = [d for call in calls for _, d in numbers(call)]
check(sorted(repr(bits(float(w))) for w in in_text[1:]) == sorted(repr(bits(float(d))) for d in values), "contct-vectors-1.txt has the same numbers")
flags = {flag for call in calls for flag in call["flags"]}
errata = tomllib.loads((folder.parent / "errata.toml").read_text())["erratum"]
undone = {f"erratum {e['number']}, {u['name']}" for e in errata for u in e["undo"] if u["expect"] in ("other-numbers", "other-text")}
other = undone ^ {flag for flag in flags if flag.startswith("erratum ")}
check(len(undone) >= 15 and not other, f"found errata {sorted(other)} in errata.toml or in the flags alone; allowed: in both")
check.counted.update({"calls": len(calls), "numbers": len(values), "flags": len(flags)})
check.end(flags=90)
