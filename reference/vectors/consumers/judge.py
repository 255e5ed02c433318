#!/usr/bin/env python3
"""Compares a kernel in Python with the vectors: python3 judge.py ../contct-vectors-1.json FOLDER. The kernel is the
function `contct` of FOLDER/contct_kernel.py; FOLDER is, for example, ../../kernels.
Exit status 0: equal to the bit in every call; 1: otherwise; 2: nothing was compared.
"""
import json
import struct
import sys

sys.path.insert(0, sys.argv[2])
from contct_kernel import contct  # noqa: E402


def doubles(values):
    return [float(x) if x[-1:] in ("n", "f") else float.fromhex(x) for x in values["hex"]]


def bits(x):
    return "NaN" if x != x else struct.pack("d", x)


def pairs_of(call):
    """Returns (D, d*, face, ISEP, ISURF) of each pair."""
    dofs = dict(zip(call["dof"], zip(doubles(call["dd"]), doubles(call["dtest"]))))
    at = [dofs[(node - 1) * call["ndofpn"] + call["indof"]] for node in call["id"]]
    return [(*both, *rest) for both, *rest in zip(at, doubles(call["cc"]), call["isep"], call["isurf"])]


with open(sys.argv[1]) as file:
    calls = [(case["name"], call) for case in json.load(file)["cases"] if case["real"] == 8 for call in case["calls"]]
wrong = 0
for name, call in calls:
    pairs = range(1, 1 + len(call["id"]))
    names = [*(f"SS({i})" for i in pairs), "SMIN", *(f"ISEP({i})" for i in pairs)]
    expected = [*doubles(call["ss"]), *doubles({"hex": [call["smin"]["hex"]]}), *call["isep_after"]]
    try:
        smin, ss, isep = contct(pairs_of(call))
        answers = zip(names, [*ss, smin, *isep], expected, strict=True)
        first = next((f"{what} {x}, expected {y}" for what, x, y in answers if bits(x) != bits(y)), None)
    except Exception as fault:  # the kernel divides by zero, or returns something else
        first = f"no answer ({type(fault).__name__}: {fault}), expected SMIN {call['smin']['decimal']}"
    wrong += first is not None
    if first and wrong == 1:
        print(f"{name}, call {call['call']} ({call['why']}): found {first}")
print(f"{len(calls)} calls, {wrong} differ")
sys.exit(2 if not calls else wrong > 0)
