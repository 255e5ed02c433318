"""Calls of gfortran's run-time library: WRITEs become events. Two facts are trusted: the library changes only its
parameter block, and it writes the right digits."""

import re

import z3

from .specification import FORMATS
from .state import KEPT, REGISTERS, State

BLOCK = 0x218  # size of st_parameter_dt; the offsets of its fields that are read:
FLAGS, UNIT, FORMAT, FORMAT_LENGTH = 0, 4, 0x50, 0x58
HAS_FORMAT = 0x1000
BEGIN, INTEGER, REAL, DONE = (
    "_gfortran_" + name for name in ("st_write", "transfer_integer_write", "transfer_real_write", "st_write_done")
)
OF_START = ("__gmon_start__", "_ITM_registerTMCloneTable")  # called by the crt files of gcc and clang if they exist
END = z3.BitVecVal(-1, 32)
CHANGED = {region for region, _, _ in REGISTERS.values()} - {*KEPT, "rsp"}


def call(machine, s: State, name: str) -> None:
    """Apply the effect of a call of `name` to `s`. The return address is on the stack."""
    if machine.starting and name in OF_START:
        for region, at in [place for place in s.cells if place[0] in CHANGED]:
            s.cells[region, at] = machine.fresh(s.cells[region, at].size())
        s.flags = {}
        return
    if name not in (BEGIN, INTEGER, REAL, DONE) or not (s.events or name == BEGIN):
        raise machine.undecided(s, f"{name} is called, whose effect is not known")
    block, top = machine.stack_offset(s, "rdi"), machine.stack_offset(s, "rsp")
    if name == BEGIN:
        s.events.append(z3.BitVecVal(_label(machine, s, block), 32))
    elif name == DONE:
        s.events.append(END)
    else:
        s.events.append(_written(machine, s, 32 if name == INTEGER else machine.spec.width))
    for (region, at), value in list(s.cells.items()):
        if region == "STACK" and (at < top or block - value.size() // 8 < at < block + BLOCK):
            del s.cells[region, at]  # the call may change the block and everything below the return address
        elif region in CHANGED:
            s.cells[region, at] = machine.fresh(value.size())
    s.flags = {}


def _label(machine, s: State, block: int) -> int:
    """The label of the FORMAT in WRITE(26, label)."""
    numbers = [s.read("STACK", block + at, size) for at, size in ((FLAGS, 4), (UNIT, 4), (FORMAT_LENGTH, 8))]
    if not all(n is not None and z3.is_bv_value(n) for n in numbers):
        raise machine.undecided(s, "a WRITE whose parameters are not constants")
    flags, unit, length = (n.as_long() for n in numbers)
    region, offset = machine.locate(s, s.read("STACK", block + FORMAT, 8))
    text = machine.image.constant(offset, length) if region == "IMAGE" else None
    if (flags, unit) != (HAS_FORMAT, 26) or text is None:
        raise machine.undecided(s, f"a WRITE to unit {unit} with flags {flags:#x}, not WRITE(26, label)")
    pieces = re.split(r"('[^']*')", text.decode("latin-1"))  # blanks matter only inside quotes
    format_ = "".join(piece if piece.startswith("'") else piece.replace(" ", "") for piece in pieces)
    labels = [label for label, known in FORMATS.items() if known == format_]
    if not labels:
        raise machine.undecided(s, f"the FORMAT is not in the listing: {format_}")
    return labels[0]


def _written(machine, s: State, width: int) -> z3.BitVecRef:
    size = s.register("edx")
    if not size.eq(z3.BitVecVal(width // 8, 32)):
        raise machine.undecided(s, f"a value of {size} bytes is written; expected {width // 8}")
    return machine.load(s, s.register("rsi"), width)
