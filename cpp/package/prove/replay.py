"""Searches for a call that a plug-in kernel and the 1989 code answer differently. contct.py runs both kernels."""

import os
import random
import re
import struct
import sys
from pathlib import Path
from typing import Iterator

from .reals import INFINITY
from .specification import CONSTANTS

MOST_PAIRS = 3_000_000
WIDTH = 64  # bits of REAL in plugin.h
ONE, HALF = 1023 << 52, 1022 << 52  # the bits of 1 and 0.5
HEADER = "contct-trace-1 2026-11-21\nabout a call in which `contct prove` compares a plug-in with the 1989 code\nkernel fortran\nreal 8\n"


def search(path: str, constants: set[int], trace: str = "") -> str:
    """Describe the first call that the kernel in a file and FORTRAN answer differently; empty if none is found. `trace`: a
    file for this call and the answer of FORTRAN."""
    import contct

    for calls in _calls(constants):
        texts = [_text(number, call) for number, call in enumerate(calls, 1)]
        found = contct.replay(HEADER + "".join(texts), kernel="plugin:" + path)
        if found.mismatches and " differs in " not in found.first[0].replace(path, ""):
            sys.exit(found.first[0])  # the kernel ended or hung
        if found.mismatches:
            text = HEADER + texts[int(re.match(r"call (\d+):", found.first[0])[1]) - 1]
            if trace:
                write_whole(trace, text)
            return "\n".join([*found.first, *text.splitlines()[5:25]])
    return ""


def write_whole(path: str, text: str) -> None:
    """Write a file that appears whole or not at all."""
    Path(path + ".new").write_text(text, encoding="utf-8")
    os.replace(path + ".new", path)


def _text(number: int, call: dict) -> str:
    """The call, with the answer of FORTRAN, by trace-format.md."""
    import contct

    answer = contct.call("fortran", *call.values())
    dofs = sorted({(node - 1) * call["ndofpn"] + call["indof"] for node in call["id"]})
    pairs = zip(call["id"], call["isep"], call["isurf"], call["cc"])
    lines = ["", f"call {number}", f"indof {call['indof']} ndofpn {call['ndofpn']} dofs {len(call['dd'])} nc {len(call['cc'])}"]
    lines += [f"dof {n} dd {call['dd'][n - 1].hex()} dtest {call['dtest'][n - 1].hex()}" for n in dofs]
    lines += [f"pair {k} id {node} isep {isep} isurf {isurf} cc {cc.hex()}" for k, (node, isep, isurf, cc) in enumerate(pairs, 1)]
    lines += ["ask", f"smin {float(answer.smin).hex()}"]
    lines += [f"pair {k} ss {float(s).hex()} isep {isep}" for k, (s, isep) in enumerate(zip(answer.ss, answer.isep), 1)]
    return "\n".join([*lines, *("|" + line for line in answer.text.splitlines()), "end", ""])


def _call(dd: list[int], dtest: list[int], cc: list[int], id: list[int], isep: list[int], isurf: list[int],
          indof: int = 1, ndofpn: int = 1) -> dict:  # fmt: skip
    """The arguments of a call. Reals are given as bits."""
    dd, dtest, cc = ([struct.unpack("<d", v.to_bytes(8, "little"))[0] for v in values] for values in (dd, dtest, cc))
    return {"dd": dd, "dtest": dtest, "cc": cc, "id": id, "isep": isep, "isurf": isurf, "indof": indof, "ndofpn": ndofpn}


def _calls(constants: set[int]) -> Iterator[list[dict]]:
    """Calls with the constants in a kernel's code as values and statuses, and random calls; then a call for each constant
    that may be a number of pairs."""
    draw, sign = random.Random(1989), 1 << WIDTH - 1
    known = {*constants, *CONSTANTS[WIDTH].values(), 0, 1, INFINITY[WIDTH], INFINITY[WIDTH] + 1}
    near = {(c + d) % sign for c in known if c < 1 << WIDTH for d in (-1, 0, 1)}
    pool = sorted(near | {v | sign for v in near})  # bit patterns of thresholds and constants, with their neighbours
    calls, small = [], sorted(c - (1 << 32 if c >> 31 else 0) for c in constants if c < 1 << 32)
    for c in pool:
        for dd, dtest, cc in ((0, ONE, c), (c, ONE, 0), (0, c, ONE), (0, c, HALF), (0, c, c), (c, c, 0), (0, c, 0)):
            calls.append(_call([dd, 0], [dtest, ONE], [cc, HALF], [1, 2], [1, -1], [1, -1]))
    for value in [*small, 2, -2, 0, 3]:
        for isep, isurf in ((value, 1), (1, value)):
            calls += [_call([0], [ONE], [cc], [1], [isep], [isurf]) for cc in (0, HALF)]
    for _ in range(2000):
        nc, ndofpn = draw.randint(0, 5), draw.randint(1, 3)
        reals = [[draw.choice(pool) if draw.random() < 0.4 else draw.randint(HALF, ONE) | draw.choice((0, sign))
                  for _ in range(n)] for n in (3 * ndofpn, 3 * ndofpn, nc)]  # fmt: skip
        signs = [[draw.choice((1, -1, 1, -1, 2, 0, 7)) for _ in range(nc)] for _ in range(2)]
        calls.append(_call(*reals, [draw.randint(1, 3) for _ in range(nc)], *signs, draw.randint(1, ndofpn), ndofpn))
    yield calls[:1]  # so that a kernel that crashes in each call is not started again for the others
    yield calls[1:]
    numbers = {n // size for size in (1, 4, 8) for n in small if n % size == 0}
    for nc in sorted(n + 3 for n in numbers if 5 < n <= MOST_PAIRS):
        cc = [HALF + (k % 7 << 40) for k in range(nc)]
        yield [_call([0], [ONE], cc, [1] * nc, [1 - k % 2 * 2 for k in range(nc)], [1] * nc)]


if __name__ == "__main__":  # the file of the kernel, the file for a trace or "", and the constants in the kernel's code
    print(search(sys.argv[1], set(map(int, sys.argv[3:])), sys.argv[2]), end="")
