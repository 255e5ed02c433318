"""The state of a symbolic execution. Registers and memory are regions of bytes, which do not overlap."""

import copy
from typing import Callable

import z3

GENERAL = ["rax", "rcx", "rdx", "rbx", "rsp", "rbp", "rsi", "rdi"] + [f"r{k}" for k in range(8, 16)]  # by number
LONGEST = 16  # bytes of a value: a register xmm
KEPT = ["rbx", "rbp", "r12", "r13", "r14", "r15"]  # registers that a callee must preserve by the System V ABI
REGISTERS = {f"xmm{k}": (f"xmm{k}", 0, 16) for k in range(16)}  # name: (full register, first byte, size)
for _full in GENERAL:
    _old = _full[1:]  # such as ax and si; for r8 to r15 the number
    _parts = [f"r{_old}d", f"r{_old}w", f"r{_old}b"] if _old.isdigit() else [f"e{_old}", _old, _old.rstrip("x") + "l"]
    REGISTERS |= {name: (_full, 0, size) for name, size in zip([_full, *_parts], (8, 4, 2, 1))}
    REGISTERS |= {_old[0] + "h": (_full, 1, 1)} if _old.endswith("x") else {}


def bits(value: z3.BitVecRef, low: int, width: int) -> z3.BitVecRef:
    """`width` bits of a value from bit `low` up."""
    return z3.simplify(z3.Extract(low + width - 1, low, value))


def condition_of(value: z3.ExprRef) -> z3.BoolRef | None:
    """The condition of a value that is one of two, perhaps with other bits above it."""
    kind = value.decl().kind()
    if kind == z3.Z3_OP_CONCAT:
        return condition_of(value.arg(value.num_args() - 1))
    return value.arg(0) if kind == z3.Z3_OP_ITE else None


class State:
    """One symbolic state. Values are shared between copies and never changed."""

    def __init__(self, pc: int, cells: dict[tuple[str, int], z3.BitVecRef] | None = None):
        self.pc = pc
        self.steps = 0
        self.cells = cells or {}  # stored values, by region and first byte
        self.flags: dict[str, Callable[[], z3.BoolRef]] = {}  # the known conditions
        self.elements: dict[tuple[str, int], z3.BitVecRef] = {}  # written values, by array and pair
        self.pairs: set[int] = set()  # pairs with a read or written element of SS, from the path's first pair
        self.events: list[z3.BitVecRef] = []  # labels and numbers written to unit 26
        self.path: list[z3.BoolRef] = []  # conditions of the taken branches
        self.models: list[tuple[int, z3.ModelRef]] = []  # examples of this path, with the number of pairs told: see Machine.holds
        self.known: dict[int, tuple[z3.BoolRef, bool]] = {}  # answers of Z3 on this path, by the number of the term
        self.judged: dict = {}  # what the proof found out about this state as the end of a path
        self.choices: list[tuple[str, int]] = []  # cells of this instruction whose value depends on a condition

    def branch(self, pc: int, *claims: z3.BoolRef) -> "State":
        """A copy that continues at `pc`, where `claims` hold."""
        other = copy.copy(self)
        other.pc = pc
        for name in ("cells", "elements", "pairs", "events", "path", "choices"):
            setattr(other, name, getattr(self, name).copy())
        other.path += claims
        other.judged = {}
        other.models = [m for m in self.models if all(z3.is_true(m[1].eval(claim, True)) for claim in claims)]
        other.known = {key: told for key, told in self.known.items() if told[1]}
        for claim in claims:
            opposite = z3.simplify(z3.Not(claim))
            other.known |= {claim.get_id(): (claim, True), opposite.get_id(): (opposite, False)}
        return other

    def write(self, region: str, at: int, value: z3.BitVecRef) -> None:
        """Store a value. If older values overlap the new value, their other bytes do not change."""
        end = at + value.size() // 8
        for place, start in [key for key in self.cells if key[0] == region and at - LONGEST < key[1] < end]:
            old = self.cells[place, start]
            above = start + old.size() // 8 - end
            if above > at - end:
                del self.cells[place, start]
                if start < at:
                    self.cells[place, start] = bits(old, 0, 8 * (at - start))
                if above > 0:
                    self.cells[place, end] = bits(old, old.size() - 8 * above, 8 * above)
        self.cells[region, at] = value = z3.simplify(value)
        if condition_of(value) is not None:
            self.choices.append((region, at))

    def read(self, region: str, at: int, size: int) -> z3.BitVecRef | None:
        """The value of `size` bytes; None if any byte is unknown."""
        whole = self.cells.get((region, at))
        if whole is not None and whole.size() == 8 * size:
            return whole
        for start, value in [(key[1], value) for key, value in self.cells.items() if key[0] == region and at - LONGEST < key[1] <= at]:
            held = start + value.size() // 8 - at  # number of bytes from `at`
            if held > 0:
                low = bits(value, 8 * (at - start), 8 * min(size, held))
                rest = self.read(region, at + held, size - held) if held < size else None
                return low if held >= size else None if rest is None else z3.simplify(z3.Concat(rest, low))
        return None

    def register(self, name: str) -> z3.BitVecRef:
        return self.read(*REGISTERS[name])

    def set_register(self, name: str, value: z3.BitVecRef) -> None:
        """Write a register. A write of 32 bits clears the upper half of a 64-bit register; shorter writes do not."""
        full, at, size = REGISTERS[name]
        self.write(full, at, z3.ZeroExt(32, value) if size == 4 else value)
