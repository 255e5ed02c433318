"""The state of a symbolic execution. Registers and memory are regions of bytes, which do not overlap."""

import copy
import itertools
from typing import Callable

import z3

from .reals import EFFORT
from .specification import Position

GENERAL = ["rax", "rcx", "rdx", "rbx", "rsp", "rbp", "rsi", "rdi"] + [f"r{k}" for k in range(8, 16)]  # by number
KEPT = ["rbx", "rbp", "r12", "r13", "r14", "r15"]  # registers that a callee must preserve by the System V ABI
_numbers = itertools.count(1)


def bits(value: z3.BitVecRef, low: int, width: int) -> z3.BitVecRef:
    """`width` bits of a value from bit `low` up."""
    return z3.simplify(z3.Extract(low + width - 1, low, value))


def fresh(width: int) -> z3.BitVecRef:
    """An unknown value."""
    return z3.BitVec(f"unknown {next(_numbers)}", width)


class Start:
    """The beginning of paths: the head (0: the function's entry), the position of the listing, the facts that hold, and
    Z3 with these facts and the preconditions for the pairs that were told."""

    def __init__(self, origin: int, at: Position, facts: list[z3.BoolRef]):
        self.origin, self.at, self.facts = origin, at, facts
        self.solver, self.told = z3.SimpleSolver(), set()
        self.solver.set("rlimit", EFFORT)
        self.solver.add(*facts)


class State:
    """One symbolic state. Values are shared between copies and never changed."""

    def __init__(self, pc: int, start: Start):
        self.pc, self.start = pc, start
        self.steps = 0
        self.cells: dict[tuple[str, int], tuple[z3.BitVecRef, int]] = {}  # by region and place: a value, and which byte of it
        self.flags: dict[str, Callable[[], z3.BoolRef]] = {}  # the known conditions
        self.elements: dict[tuple[str, int], z3.BitVecRef] = {}  # written values, by array and pair; the numbers of events
        self.pairs: set[int] = set()  # pairs with a read or written element of SS, from the path's first pair
        self.path: list[z3.BoolRef] = []  # conditions of the taken branches
        self.models: list[tuple[int, z3.ModelRef]] = []  # examples of this path, with the number of pairs told: see Machine.holds
        self.known: dict[int, tuple[z3.BoolRef, bool]] = {}  # answers of Z3 on this path, by the number of the term
        self.judged: dict = {}  # what the proof found out about this state as the end of a path

    def learn(self, *claims: z3.BoolRef) -> None:
        """Add facts about this path."""
        self.path += claims
        self.models = [m for m in self.models if all(z3.is_true(m[1].eval(claim, True)) for claim in claims)]
        self.known = {key: told for key, told in self.known.items() if told[1]}
        self.known |= {claim.get_id(): (claim, True) for claim in claims}

    def halves(self, condition: z3.BoolRef) -> list["State"]:
        """Two copies: where the condition holds, and where it does not."""
        both = []
        for claim in (condition, z3.simplify(z3.Not(condition))):
            both.append(copy.copy(self))
            for name in ("cells", "elements", "pairs", "path"):
                setattr(both[-1], name, getattr(self, name).copy())
            both[-1].judged = {}
            both[-1].learn(claim)
        return both

    def write(self, region: str, at: int, value: z3.BitVecRef) -> None:
        value = z3.simplify(value)
        self.cells |= {(region, at + k): (value, k) for k in range(value.size() // 8)}

    def read(self, region: str, at: int, size: int) -> z3.BitVecRef | None:
        """The value of `size` bytes; None if any byte is unknown."""
        cells = [self.cells.get((region, at + k)) for k in range(size)]
        if None in cells:
            return None
        value, first = cells[0]
        if all(cell[0] is value and cell[1] == first + k for k, cell in enumerate(cells)):
            return value if 8 * size == value.size() else bits(value, 8 * first, 8 * size)
        return z3.simplify(z3.Concat(*(z3.Extract(8 * k + 7, 8 * k, term) for term, k in reversed(cells))))

    def value(self, region: str, at: int, size: int) -> z3.BitVecRef:
        """The value of `size` bytes. Bytes that are unknown get a name."""
        unknown = [place for place in range(at, at + size) if (region, place) not in self.cells]
        if unknown:
            self.write(region, unknown[0], fresh(8 * (unknown[-1] + 1 - unknown[0])))
        return self.read(region, at, size)

    def whole(self) -> list[tuple[str, int, int]]:
        """The regions, first bytes and sizes of the values of which every byte is held."""
        places = [(region, at, value.size() // 8) for (region, at), (value, k) in self.cells.items() if k == 0]
        return [place for place in places if self.read(*place) is self.cells[place[:2]][0]]

    def register(self, name: str) -> z3.BitVecRef:
        return self.value(name, 0, 8)

    def set_register(self, name: str, value: z3.BitVecRef) -> None:
        self.write(name, 0, value)
