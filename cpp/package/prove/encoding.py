"""The encodings of x86-64 that the prover knows, and the operands of an instruction. An encoding in no row makes a proof
undecided. tests/prove/processor.py compares each row with the processor."""

import re
from typing import Iterator, NamedTuple

from .state import GENERAL

# A row has the name of a meaning in x86.py, and encodings. An encoding: v if only the VEX form is known; the mandatory
# prefix and a point; w if REX.W or VEX.W is 1; the map and opcode; then /n if ModRM.reg is n, =n if ModRM is n, + if the
# last 3 bits of the opcode are a register, ? if its last 4 bits are a condition. An operand has a letter of the opcode
# maps in the processor's manual, and a size. General registers: G in ModRM.reg, E in ModRM.rm or memory, Z in the opcode,
# A rax. Vectors: V in ModRM.reg, W in ModRM.rm or memory, U in ModRM.rm, H in VEX.vvvv or, in the legacy form, the first
# operand, L in the last byte. M: memory. I: a number. J: an address, from the next instruction. Sizes: b 8, w 16, d 32,
# q 64, x 128 bits, u 128 bits at any address, a at a multiple of 16, x as a in the legacy form, as u with VEX; v 16 bits
# with prefix 66, 64 with W, else 32; y 64 bits with W, else 32; z 16 bits with prefix 66, else 32.
_ROWS = """
mov: 88 Eb Gb, 89 Ev Gv, 8A Gb Eb, 8B Gv Ev, B0+ Zb Ib, B8+ Zv Iv, C6/0 Eb Ib, C7/0 Ev Iz, 0FB6 Gv Eb, 0FB7 Gv Ew
mov: F3.0F6F Vx Wu, F3.0F7F Wu Vx, 66.0F6F Vx Wa, 66.0F7F Wa Vx, F3.0F7E Vx Wq, 66.0FD6 Mq Vq, 66.0FD6 Ux Vq
mov: 66.0F6E Vx Ed, 66.w0F6E Vx Eq, 66.0F7E Ed Vd, 66.w0F7E Eq Vq
movsx: 0FBE Gv Eb, 0FBF Gv Ew, w63 Gq Ed; cdqe: w98; lea: 8D Gv Mv
push: 50+ Zq, FF/6 Eq, 68 Id, 6A Ib; pop: 58+ Zq; leave: C9
inc: FE/0 Eb, FF/0 Ev; dec: FE/1 Eb, FF/1 Ev; not: F6/2 Eb, F7/2 Ev; neg: F6/3 Eb, F7/3 Ev
test: 84 Eb Gb, 85 Ev Gv, A8 Ab Ib, A9 Av Iz, F6/0 Eb Ib, F7/0 Ev Iz; imul: 0FAF Gv Ev, 69 Gv Ev Iz, 6B Gv Ev Ib
shl: C0/4 Eb Ib, C1/4 Ev Ib, D0/4 Eb, D1/4 Ev
shr: C0/5 Eb Ib, C1/5 Ev Ib, D0/5 Eb, D1/5 Ev
sar: C0/7 Eb Ib, C1/7 Ev Ib, D0/7 Eb, D1/7 Ev
cmov: 0F40? Gv Ev; set: 0F90? Eb; j: 70? Jb, 0F80? Jd
jmp: EB Jb, E9 Jd, FF/4 Eq; call: E8 Jd, FF/2 Eq; ret: C3; nop: 90, 0F1F/0 Ev, F3.0F1E=FA, v0F77
bits and: 0F54 Vx Hx Wx, 66.0F54 Vx Hx Wx, 66.0FDB Vx Hx Wx; bits andn: 0F55 Vx Hx Wx, 66.0F55 Vx Hx Wx, 66.0FDF Vx Hx Wx
bits or: 0F56 Vx Hx Wx, 66.0F56 Vx Hx Wx, 66.0FEB Vx Hx Wx; bits xor: 0F57 Vx Hx Wx, 66.0F57 Vx Hx Wx, 66.0FEF Vx Hx Wx
double: F2.0F12 Vx Wq; select: v66.0F3A4B Vx Hx Wx Lx
"""
_OF_REALS = """
mov: {0}0F10 Vx Wu, {0}0F11 Wu Vx, {0}0F28 Vx Wa, {0}0F29 Wa Vx, {1}0F10 Vx M{2}, {1}0F11 M{2} V{2}
merge: {1}0F10 V{2} H{2} U{2}, {1}0F11 U{2} H{2} V{2}; real: {1}0F2A V{2} H{2} Ey
order: {0}0F2E V{2} W{2}, {0}0F2F V{2} W{2}; reals cmp: {1}0FC2 V{2} H{2} W{2} Ib
"""
_OF_INTEGERS = """
{0}: {1:02X} Eb Gb, {2:02X} Ev Gv, {3:02X} Gb Eb, {4:02X} Gv Ev, {5:02X} Ab Ib, {6:02X} Av Iz
{0}: 80/{7} Eb Ib, 81/{7} Ev Iz, 83/{7} Ev Ib
"""
for _name, _number in {"add": 0, "or": 1, "and": 4, "sub": 5, "xor": 6, "cmp": 7}.items():
    _ROWS += _OF_INTEGERS.format(_name, *range(8 * _number, 8 * _number + 6), _number)
for _of in (("66.", "F2.", "q"), ("", "F3.", "d")):
    _ROWS += _OF_REALS.format(*_of)
    for _name, _code in {"add": "58", "mul": "59", "sub": "5C", "min": "5D", "div": "5E", "max": "5F"}.items():
        _ROWS += f"reals {_name}: {_of[1]}0F{_code} V{_of[2]} H{_of[2]} W{_of[2]}\n"
_WIDTH = {"b": 8, "w": 16, "d": 32, "q": 64, "x": 128, "a": 128, "u": 128}


class Row(NamedTuple):
    """One encoding of the table, for one opcode."""

    name: str
    forms: tuple[bool, ...]  # False: the legacy form is known; True: the VEX form
    prefix: bytes
    wide: bool
    modrm: set[int]  # possible bytes; empty if there is none
    operands: list[str]
    marks: set[str]  # the letters and sizes of the operands


class Operand(NamedTuple):
    """A register, memory or a number. The address in memory is base + scale * index + number, where rip counts as 0."""

    where: str  # the full register, "memory", "guard" or "number"
    width: int  # in bits
    first: int = 0  # of a register, the first byte
    number: int = 0
    base: str = ""
    index: str = ""
    scale: int = 1
    is_aligned: bool = False  # the address must be a multiple of 16


class Instruction(NamedTuple):
    """An instruction that is known, or the name ""."""

    address: int
    size: int = 0
    name: str = ""
    operands: list[Operand] = []
    condition: int = 0


def _read(rows: str) -> Iterator[tuple[str, Row]]:
    form = re.compile(r"(v?)(?:(..)\.)?(w?)((?:0F(?:3A)?)?)(..)(?:/(.)|=(..)|([+?]))?")
    for name, _, encodings in (row.partition(": ") for row in re.split("\n+|; ", rows.strip())):
        for encoding, *operands in map(str.split, encodings.split(", ")):
            vex, prefix, wide, map_, code, reg, modrm, many = form.fullmatch(encoding).groups("")
            marks = set("".join(operands))
            fits = lambda m: (int(reg or m >> 3 & 7), int(modrm or f"{m:x}", 16)) == (m >> 3 & 7, m) and not marks & set("MU"[m < 0xC0])
            possible = {m for m in range(256) if (reg or modrm or marks & set("GEVWUM")) and fits(m)}
            forms = (True,) if vex else (False, True) if marks & set("VU") else (False,)
            row = Row(name, forms, bytes.fromhex(prefix), bool(wide), possible, operands, marks)
            for k in range({"": 1, "+": 8, "?": 16}[many]):
                yield map_ + f"{int(code, 16) + k:02X}", row


ROWS: dict[str, list[Row]] = {}  # by map and opcode
for _code, _row in _read(_ROWS):
    ROWS.setdefault(_code, []).append(_row)


def _is_guard(raw: bytes) -> bool:
    """True for mov, sub, cmp and xor of a 64-bit register with %fs:0x28, the guard of -fstack-protector."""
    return raw[:1] == b"\x64" and raw[1] in (0x48, 0x4C) and raw[2] in (0x8B, 0x2B, 0x3B, 0x33) and raw[3] & 0xC7 == 4 and raw[4:9] == b"\x25\x28\0\0\0"


def decode(raw: bytes, address: int) -> Instruction:
    """The instruction at the beginning of `raw`."""
    if _is_guard(raw):
        guarded = decode(raw[1:], address + 1)
        return guarded._replace(address=address, size=9, operands=[guarded.operands[0], Operand("guard", 64)])
    code, k, rex, vector, is_known = raw + bytes(32), 0, 0, 0, True
    while code[k] in (0x66, 0xF2, 0xF3, 0x2E):
        k += 1
    prefixes, vex = code[:k], code[k] in (0xC4, 0xC5)
    if vex:
        high, last = (code[k + 1], code[k + 2]) if code[k] == 0xC4 else (code[k + 1] & 0x80 | 0x61, code[k + 1] & 0x7F)
        k += 3 if code[k] == 0xC4 else 2
        r, x, b = (8 * (high >> bit & 1 ^ 1) for bit in (7, 6, 5))
        wide, vector, is_known = last >> 7, ~last >> 3 & 15, not prefixes and not last & 4  # bit 2: vectors of 256 bits
        map_, prefixes = {1: "0F", 3: "0F3A"}.get(high & 31, "none"), (b"", b"\x66", b"\xf3", b"\xf2")[last & 3]
    else:
        rex = code[k] if code[k] >> 4 == 4 else 0
        k += rex > 0
        wide, r, x, b = rex >> 3 & 1, *(8 * (rex >> bit & 1) for bit in (2, 1, 0))
        map_ = "0F" if code[k] == 0x0F else ""
        k += bool(map_)
    opcode, modrm, short = code[k], code[k + 1], prefixes == b"\x66" and not wide
    for row in ROWS.get(map_ + f"{opcode:02X}", []):
        several = row.name == "nop" and not vex and not row.prefix and set(prefixes) <= {0x66, 0x2E}
        if (is_known and vex in row.forms and (not row.modrm or modrm in row.modrm) and (wide == row.wide or row.marks & set("vy"))
                and (prefixes == row.prefix or several or (short and not row.prefix and "v" in row.marks))
                and (row.operands or not r | x | b) and (not vector or "H" in row.marks)):  # fmt: skip
            break
    else:
        return Instruction(address)
    memory, at = _memory(code, k + 1, x, b) if row.modrm else (None, k + 1)
    widths = _WIDTH | {"v": 64 if wide else 16 if short else 32, "y": 64 if wide else 32, "z": 16 if short else 32}
    operands: list[Operand] = []
    for letter, size in row.operands:
        width, reg = widths[size], modrm >> 3 & 7 | r
        registers = {"G": reg, "V": reg, "Z": opcode & 7 | b, "H": vector, "A": 0, "L": code[at] >> 4}
        number = registers.get(letter, modrm & 7 | b)
        if letter in "IJ":
            number = int.from_bytes(code[at : at + width // 8], "little", signed=True)
            operands.append(Operand("number", operands[0].width if operands else 64, 0, number, "rip" if letter == "J" else ""))
        elif letter in "EWM" and memory:
            operands.append(memory._replace(width=width, is_aligned=size == "a" or (size == "x" and not vex)))
        elif letter in "VWUHL":
            operands.append(Operand(f"xmm{number}", width) if vex or letter != "H" else operands[0])
        else:
            of_second = width == 8 and not rex and 4 <= number < 8  # ah, ch, dh and bh
            operands.append(Operand(GENERAL[number - 4 * of_second], width, int(of_second)))
        at += width // 8 if letter in "IJ" else letter == "L"
    operands = [o._replace(number=o.number + address + at) if o.base == "rip" else o for o in operands]
    return Instruction(address, at, row.name, operands, opcode & 15) if at <= len(raw) else Instruction(address)


def _memory(code: bytes, at: int, x: int, b: int) -> tuple[Operand | None, int]:
    """The operand in memory of the ModRM at `at`, if there is one, and the place after its displacement."""
    mod, rm, index, scale, at = code[at] >> 6, code[at] & 7, 4, 1, at + 1
    if mod == 3:
        return None, at
    base = GENERAL[rm | b] if (mod, rm) != (0, 5) else "rip"
    if rm == 4:
        rm, index, scale, at = code[at] & 7, code[at] >> 3 & 7 | x, 1 << (code[at] >> 6), at + 1
        base = GENERAL[rm | b] if (mod, rm) != (0, 5) else ""
    size = 4 if mod == 2 or base in ("", "rip") else mod
    number = int.from_bytes(code[at : at + size], "little", signed=True)
    return Operand("memory", 0, 0, number, base, "" if index == 4 else GENERAL[index], scale), at + size
