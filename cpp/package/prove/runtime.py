"""Calls of gfortran's run-time library: WRITEs become events. Two facts are trusted: the library changes only its
parameter block, and it writes the right digits."""

import re

import z3

from .specification import FORMATS
from .state import GENERAL, KEPT, State

BLOCK = 0x218  # size of st_parameter_dt; the offsets of its fields that are read:
FLAGS, UNIT, FORMAT, FORMAT_LENGTH = 0, 4, 0x50, 0x58
HAS_FORMAT = 0x1000
BEGIN, INTEGER, REAL, DONE = (
    "_gfortran_" + name for name in ("st_write", "transfer_integer_write", "transfer_real_write", "st_write_done")
)
OF_START = ("__gmon_start__", "_ITM_registerTMCloneTable")  # called by the crt files of gcc and clang if they exist
END = z3.BitVecVal(-1, 32)
CHANGED = {*GENERAL, *(f"xmm{k}" for k in range(16))} - {*KEPT, "rsp"}


def call(machine, s: State, name: str) -> None:
    """Apply the effect of a call of `name` to `s`. The return address is on the stack."""
    top = machine.stack_offset(s, "rsp")
    lost = range(0) if machine.starting and name in OF_START else _write(machine, s, name)
    for region, at in list(s.cells):
        if region in CHANGED or (region == "STACK" and (at < top or at in lost)):
            del s.cells[region, at]
    s.flags = {}


def _write(machine, s: State, name: str) -> range:
    """A part of a WRITE becomes the next number among the events. Returns the bytes of the stack that change."""
    told = sum(array == "EVENTS" for array, _ in s.elements)
    if name not in (BEGIN, INTEGER, REAL, DONE) or not (told or name == BEGIN):
        raise machine.undecided(s, f"{name} is called, whose effect is not known")
    block = machine.stack_offset(s, "rdi")
    if name == BEGIN:
        event = z3.BitVecVal(_label(machine, s, block), 32)
    elif name == DONE:
        event = END
    else:
        event = _written(machine, s, 32 if name == INTEGER else machine.spec.width)
    s.elements["EVENTS", told] = event
    return range(block, block + BLOCK)


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
    size = s.value("rdx", 0, 4)
    if not size.eq(z3.BitVecVal(width // 8, 32)):
        raise machine.undecided(s, f"a value of {size} bytes is written; expected {width // 8}")
    return machine.load(s, s.register("rsi"), width)
