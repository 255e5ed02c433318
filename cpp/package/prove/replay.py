"""Looks for a call that a kernel of one's own answers otherwise than the 1989 code: contct.py runs both."""

import random
import struct
from typing import Iterable, Iterator, NamedTuple

from .reals import INFINITY
from .specification import CONSTANTS

MOST_PAIRS = 3_000_000  # of a call that is tried
WIDTH = 64  # of REAL in plugin.h


class Call(NamedTuple):
    """The arguments of one call. Reals are their bits."""

    dd: list[int]
    dtest: list[int]
    cc: list[int]
    id: list[int]
    isep: list[int]
    isurf: list[int]
    indof: int
    ndofpn: int

    def words(self) -> str:
        """The call, one argument a line; of many pairs the first few."""
        lines = [f"  {name.upper():6}{_reals(getattr(self, name)[:8])}" for name in ("dd", "dtest", "cc")]
        lines += [f"  {name.upper():6}{getattr(self, name)[:8]}" for name in ("id", "isep", "isurf")]
        return "\n".join([*lines, f"  NC {len(self.cc)}, INDOF {self.indof}, NDOFPN {self.ndofpn}"])


def bits(value: float) -> int:
    return int.from_bytes(struct.pack("<d", value), "little")


def _reals(values: list[int]) -> list[float]:
    return [struct.unpack("<d", v.to_bytes(8, "little"))[0] for v in values]


def answers(kernel: str, call: Call) -> list[tuple[str, str]]:
    """SMIN, SS and ISEP after a call, each with its name. Every NaN is the same."""
    import contct

    reals = [_reals(values) for values in (call.dd, call.dtest, call.cc)]
    answer = contct.call(kernel, *reals, call.id, call.isep, call.isurf, call.indof, call.ndofpn)
    words = [("SMIN", float(answer.smin).hex())]
    words += [(f"SS({k})", float(s).hex()) for k, s in enumerate(answer.ss, 1)]
    return words + [(f"ISEP({k})", str(i)) for k, i in enumerate(answer.isep, 1)]


def search(path: str, constants: set[int]) -> str:
    """The first call found that the kernel in a file answers otherwise, and how; empty if none is found."""
    for call in tried_calls(constants):
        pairs = zip(answers("plugin:" + path, call), answers("fortran", call))
        for (name, ours), (_, listing) in pairs:
            if ours != listing:
                return f"{name} is {ours}, by the 1989 code {listing}, in the call\n{call.words()}"
    return ""


def _around(constants: Iterable[int]) -> list[int]:
    """Bit patterns that decide something: those of the listing and of the kernel, with their neighbours, and special ones."""
    sign, infinity = 1 << WIDTH - 1, INFINITY[WIDTH]
    known = [*CONSTANTS[WIDTH].values(), 0, 1, infinity, infinity + 1, bits(2.0), bits(0.3)]
    found = {c + d for c in [*known, *constants] for d in (-1, 0, 1)}
    return sorted({v ^ s for v in found for s in (0, sign) if 0 <= v < sign})


def tried_calls(constants: set[int]) -> Iterator[Call]:
    """Calls with the constants that a kernel uses, as values, statuses and numbers of pairs; then random ones."""
    draw = random.Random(1989)
    own = [c for c in constants if c < 1 << WIDTH]
    pool, one, half = _around(own), bits(1.0), bits(0.5)
    small = [c - (1 << 32 if c >> 31 else 0) for c in constants if c < 1 << 32]
    for c in _around(own):
        for dd, dtest, cc in ((0, one, c), (c, one, 0), (0, c, one), (0, c, half), (0, c, c), (c, c, 0), (0, c, 0)):
            yield Call([dd, 0], [dtest, one], [cc, half], [1, 2], [1, -1], [1, -1], 1, 1)
    for value in [*small, 2, -2, 0, 3]:
        for isep, isurf in ((value, 1), (1, value)):
            yield Call([0], [one], [0], [1], [isep], [isurf], 1, 1)
            yield Call([0], [one], [half], [1], [isep], [isurf], 1, 1)
    for _ in range(3000):
        nc, ndofpn = draw.randint(0, 5), draw.randint(1, 3)
        reals = [[draw.choice(pool) if draw.random() < 0.4 else bits(draw.uniform(-2, 2)) for _ in range(n)]
                 for n in (3 * ndofpn, 3 * ndofpn, nc)]  # fmt: skip
        signs = [[draw.choice((1, -1, 1, -1, 2, 0, 7)) for _ in range(nc)] for _ in range(2)]
        yield Call(*reals, [draw.randint(1, 3) for _ in range(nc)], *signs, draw.randint(1, ndofpn), ndofpn)
    numbers = [n // size for size in (1, 4, 8) for n in sorted(small) if n % size == 0]  # of a pair, or its offset
    for nc in dict.fromkeys(n + 3 for n in numbers if 5 < n <= MOST_PAIRS):
        near = [bits(0.5 + k % 7 * 1e-4) for k in range(nc)]
        yield Call([0], [one], near, [1] * nc, [1 - k % 2 * 2 for k in range(nc)], [1] * nc, 1, 1)
