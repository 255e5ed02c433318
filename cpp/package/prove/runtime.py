"""Calls of gfortran's run-time library: WRITEs become events. That the library changes nothing but its parameter block
is trusted, and so are the formats' digits."""

import re

import capstone
import z3

from .specification import FORMATS
from .state import GENERAL, KEPT, State

BLOCK = 0x218  # bytes of st_parameter_dt, of which these are read:
FLAGS, UNIT, FORMAT, FORMAT_LENGTH = 0, 4, 0x50, 0x58
HAS_FORMAT = 0x1000


def call(machine, s: State, ins: capstone.CsInsn, name: str) -> None:
    """The effect of a call of `name`, whose return address is on the stack."""
    if name not in _CALLS:
        raise machine.undecided(ins, f"{name} is called, of which nothing is known")
    if not s.events and name != "_gfortran_st_write":
        raise machine.undecided(ins, "a value is written before any WRITE")
    block = machine.place(s, *_stack(machine, s, ins, s.registers["rdi"]))
    _CALLS[name](machine, s, ins, block)
    top = machine.place(s, *_stack(machine, s, ins, s.registers["rsp"]))
    for region, offset in list(s.cells):  # the block, and everything below the return address, may have changed
        if region == "STACK" and (offset < top or block <= offset < block + BLOCK):
            del s.cells[region, offset]
    for register in GENERAL:
        if register not in KEPT and register != "rsp":
            s.registers[register] = machine.fresh(64)
    for k in range(16):
        s.registers[f"xmm{k}"] = machine.fresh(128)
    s.flags = {flag: lambda: machine.fresh(1) == 1 for flag in "zcsop"}


def _stack(machine, s: State, ins: capstone.CsInsn, address: z3.BitVecRef) -> tuple[str, z3.BitVecRef]:
    region, offset = machine.region(s, address)
    if region != "STACK":
        raise machine.undecided(ins, f"a parameter block in {region}")
    return region, offset


def _number(machine, s: State, ins: capstone.CsInsn, place: int, size: int) -> int:
    value = s.cells_at("STACK", place, size)
    if value is None or not z3.is_bv_value(value):
        raise machine.undecided(ins, "a WRITE whose parameters are not constants")
    return value.as_long()


def _begin(machine, s: State, ins: capstone.CsInsn, block: int) -> None:
    flags, unit = (_number(machine, s, ins, block + at, 4) for at in (FLAGS, UNIT))
    if (flags, unit) != (HAS_FORMAT, 26):
        raise machine.undecided(ins, f"a WRITE to unit {unit} with flags {flags:#x}, not WRITE(26, label)")
    region, offset = machine.region(s, machine.load(s, machine.base["STACK"] + (block + FORMAT), 64))
    length = _number(machine, s, ins, block + FORMAT_LENGTH, 8)
    text, writable = machine.image.bytes_at(machine.place(s, region, offset), length)
    if region != "IMAGE" or writable:
        raise machine.undecided(ins, "a FORMAT that is no constant")
    pieces = re.split(r"('[^']*')", text.decode("latin-1"))  # blanks count in quotes only
    format_ = "".join(piece if piece.startswith("'") else piece.replace(" ", "") for piece in pieces)
    label = next((label for label, known in FORMATS.items() if known == format_), format_)
    s.events.append([label])


def _transfer(width: int):
    def transfer(machine, s: State, ins: capstone.CsInsn, block: int) -> None:
        size = z3.simplify(z3.Extract(31, 0, s.registers["rdx"]))
        wanted = width or machine.spec.width
        if not size.eq(z3.BitVecVal(wanted // 8, 32)):
            raise machine.undecided(ins, f"a value of {size} bytes is written; expected {wanted // 8}")
        s.events[-1].append(machine.load(s, s.registers["rsi"], wanted))

    return transfer


def _end(machine, s: State, ins: capstone.CsInsn, block: int) -> None:
    s.events[-1].append("end")


_CALLS = {
    "_gfortran_st_write": _begin,
    "_gfortran_transfer_integer_write": _transfer(32),
    "_gfortran_transfer_real_write": _transfer(0),
    "_gfortran_st_write_done": _end,
}
