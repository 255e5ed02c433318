"""The state of a symbolic execution: registers, flags and memory, in which every pointer has a region of its own."""

from typing import Callable

import z3

GENERAL = ["rax", "rbx", "rcx", "rdx", "rsi", "rdi", "rbp", "rsp"] + [f"r{k}" for k in range(8, 16)]
KEPT = ["rbx", "rbp", "r12", "r13", "r14", "r15"]  # by a callee, in the ABI of System V
_LETTERS = {"a": "rax", "b": "rbx", "c": "rcx", "d": "rdx"}
_WIDE = {"si": "rsi", "di": "rdi", "bp": "rbp", "sp": "rsp"}


def _names() -> dict[str, tuple[str, int, int]]:
    """Each register's name, with the register that holds it, its lowest bit and its width."""
    names = {}
    for letter, full in _LETTERS.items():
        names |= {full: (full, 0, 64), f"e{letter}x": (full, 0, 32), f"{letter}x": (full, 0, 16)}
        names |= {f"{letter}l": (full, 0, 8), f"{letter}h": (full, 8, 8)}
    for name, full in _WIDE.items():
        names |= {full: (full, 0, 64), "e" + name: (full, 0, 32), name: (full, 0, 16), name + "l": (full, 0, 8)}
    for k in range(8, 16):
        names |= {f"r{k}{end}": (f"r{k}", 0, width) for end, width in (("", 64), ("d", 32), ("w", 16), ("b", 8))}
    return names | {f"xmm{k}": (f"xmm{k}", 0, 128) for k in range(16)}


REGISTERS = _names()
Flag = Callable[[], z3.BoolRef]
Cell = tuple[z3.BitVecRef, int]  # a stored value, and which byte of it this is


class State:
    """One symbolic state. Values are shared between copies and never changed."""

    def __init__(self) -> None:
        self.pc = 0
        self.steps = 0
        self.registers: dict[str, z3.BitVecRef] = {}
        self.flags: dict[str, Flag] = {}
        self.cells: dict[tuple[str, int], Cell] = {}  # bytes of the regions whose every byte has a known place
        self.written: dict[str, list[tuple[z3.BitVecRef, z3.BitVecRef]]] = {}  # of arrays: offset and value
        self.visited: list[z3.BitVecRef] = []  # offsets at which SS was read or written
        self.events: list[list] = []  # WRITEs: the FORMAT's label and the values
        self.path: list[z3.BoolRef] = []  # what the branches that were taken say

    def copy(self) -> "State":
        other = State()
        other.pc, other.steps = self.pc, self.steps
        other.registers, other.flags, other.cells = dict(self.registers), dict(self.flags), dict(self.cells)
        other.written = {array: list(log) for array, log in self.written.items()}
        other.visited, other.path = list(self.visited), list(self.path)
        other.events = [list(event) for event in self.events]
        return other

    def register(self, name: str) -> z3.BitVecRef:
        full, low, width = REGISTERS[name]
        whole = self.registers[full]
        return whole if width == whole.size() else z3.simplify(z3.Extract(low + width - 1, low, whole))

    def set_register(self, name: str, value: z3.BitVecRef) -> None:
        """The upper half of a 64-bit register is cleared by a write of 32 bits, and stays with 8 or 16."""
        full, low, width = REGISTERS[name]
        if width == 32:
            value = z3.ZeroExt(32, value)
        elif width in (8, 16):
            whole = self.registers[full]
            parts = [z3.Extract(63, low + width, whole), value] + ([z3.Extract(low - 1, 0, whole)] if low else [])
            value = z3.Concat(*parts)
        self.registers[full] = z3.simplify(value)

    def set_cells(self, region: str, offset: int, value: z3.BitVecRef) -> None:
        for k in range(value.size() // 8):
            self.cells[region, offset + k] = (value, k)

    def cells_at(self, region: str, offset: int, size: int) -> z3.BitVecRef | None:
        """What stands in `size` bytes, or nothing where one of them is unknown."""
        held = [self.cells.get((region, offset + k)) for k in range(size)]
        if any(cell is None for cell in held):
            return None
        value, first = held[0]
        if all(cell[0].eq(value) and cell[1] == first + k for k, cell in enumerate(held)):
            return z3.simplify(z3.Extract(8 * (first + size) - 1, 8 * first, value))
        return z3.simplify(z3.Concat(*(z3.Extract(8 * k + 7, 8 * k, v) for v, k in reversed(held))))

    def slots(self) -> list[tuple[str, int, int]]:
        """The stored values that stand whole in memory, and single bytes of others: region, offset, size."""
        found = []
        for (region, offset), (value, byte) in self.cells.items():
            size = value.size() // 8
            start = offset - byte
            whole = all(self.cells.get((region, start + k), (None, -1))[1] == k
                        and self.cells[region, start + k][0].eq(value) for k in range(size))  # fmt: skip
            if not whole:
                found.append((region, offset, 1))
            elif byte == 0:
                found.append((region, start, size))
        return found
