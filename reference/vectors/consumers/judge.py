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
    smin, ss, isep = contct(pairs_of(call))
    expected = doubles({"hex": [call["smin"]["hex"]]}) + doubles(call["ss"])
    if [*map(bits, [smin, *ss])] != [*map(bits, expected)] or isep != call["isep_after"]:
        wrong += 1
        if wrong == 1:
            print(f"{name}, call {call['call']} ({call['why']}): found", smin, ss, isep, "expected", expected, call["isep_after"])
print(f"{len(calls)} calls, {wrong} differ")
sys.exit(2 if not calls else wrong > 0)
