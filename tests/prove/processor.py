"""processor.py BUILD ROOT: tests that the prover's interpreter and the processor agree on every encoding of the prover's
table, on random and special states, that every other encoding is undecided, and that a wrong row is detected."""

import ctypes
import functools
import itertools
import mmap
import os
import random
import struct
import sys
import tempfile
from pathlib import Path
from typing import Iterator

build, root = Path(sys.argv[1]), Path(sys.argv[2])
sys.path[:0] = [str(build), str(root / "tests/support")]
import z3
from contct_prove import Undecided, reals
from contct_prove.encoding import ROWS, Instruction, Row, decode
from contct_prove.machine import Machine
from contct_prove.specification import Specification
from contct_prove.state import State
from testing import run

DRAWN = 8  # encodings of a row in one form with the same prefix, W and kind of operand
STATES = 2  # states for each encoding
ORDER = ["rax", "rcx", "rdx", "rbx", "rsp", "rbp", "rsi", "rdi"] + [f"r{k}" for k in range(8, 16)]
PAGE, DATA, SIZE = 4096, 8192, 2048  # addresses of the state, and of the memory that instructions use, and its size
FLAG_BITS = [0, 2, 6, 7, 11]  # carry, parity, zero, sign, overflow
USES_STACK = ("push", "pop", "call", "ret", "leave")
MAPS = {"": 0, "0F": 1, "0F38": 2, "0F3A": 3}
KNOWS_AVX2 = {"avx2", "bmi1", "bmi2"} <= set(Path("/proc/cpuinfo").read_text().split())
draw = random.Random(1989)


class Processor:
    """Executes the bytes of one instruction on a state by this machine's processor."""

    def __init__(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            run("as", "-o", f"{folder}/stub.o", root / "tests/prove/stub.s", status=0)
            run("objcopy", "-O", "binary", f"{folder}/stub.o", f"{folder}/stub", status=0)
            code = Path(f"{folder}/stub").read_bytes()
        self.memory = mmap.mmap(-1, 4 * PAGE, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
        self.base = ctypes.addressof(ctypes.c_char.from_buffer(self.memory))
        self.memory[: len(code)] = code
        self.hole = code.index(b"\x90" * 32)
        self.address, self.landing = self.base + self.hole, self.base + self.hole + 34
        self.call = ctypes.CFUNCTYPE(None)(self.base)

    def run(self, code: bytes, state: bytes) -> bytes:
        """Returns the state after the instruction: registers, flags, vectors, and then memory. Bytes after the instruction
        are no instruction, but for a jump across them."""
        self.memory[self.hole : self.hole + 32] = (code + b"\xeb\x06" + 6 * b"\x06").ljust(32, b"\x90")
        self.memory[PAGE : PAGE + len(state)] = state
        self.call()
        return self.memory[PAGE : PAGE + len(state)]


processor = Processor()


class Concrete(Machine):
    """The prover's machine for a single instruction, with memory in bytes and only known numbers as values."""

    def __init__(self, code: bytes, data: bytes):
        self.code, self.data, self.constants = code, bytearray(data), set()
        self.spec = Specification(64)

    def instruction(self, address: int) -> Instruction:
        return decode(self.code, address)

    def undecided(self, s: State, why: str) -> Undecided:
        return Undecided(why)

    def at(self, s: State, address: z3.BitVecRef, width: int) -> int:
        at = z3.simplify(address).as_long() - processor.base - DATA
        if not 0 <= at <= SIZE - width // 8:
            raise Undecided("an address outside the memory")
        return at

    def load(self, s: State, address: z3.BitVecRef, width: int) -> z3.BitVecRef:
        at = self.at(s, address, width)
        return z3.BitVecVal(int.from_bytes(self.data[at : at + width // 8], "little"), width)

    def store(self, s: State, address: z3.BitVecRef, value: z3.BitVecRef) -> None:
        at, size = self.at(s, address, value.size()), value.size() // 8
        self.data[at : at + size] = constant(value).as_long().to_bytes(size, "little")

    def check_alignment(self, s: State, address: z3.BitVecRef) -> None:
        if z3.simplify(address).as_long() % 16:
            raise Undecided("the processor would fault")

    def in_image(self, address: int) -> z3.BitVecRef:
        return z3.BitVecVal(address, 64)

    def decide(self, s: State, claim: z3.BoolRef) -> bool:
        return z3.is_true(constant(claim))

    def _go(self, s: State, target: z3.BitVecRef) -> None:
        s.pc = z3.simplify(target).as_long()


def constant(term: z3.ExprRef) -> z3.ExprRef:
    """Returns the value of a term. Uninterpreted functions get the results of the processor's scalar instructions,
    which they represent."""
    term = term if z3.is_bv_value(term) else z3.simplify(term)
    if z3.is_bv_value(term) or z3.is_true(term) or z3.is_false(term):
        return term
    known = [constant(child) for child in term.children()]
    if term.decl().kind() != z3.Z3_OP_UNINTERPRETED:
        return constant(term.decl()(*known))
    return z3.BitVecVal(applied(term.decl().name(), term.size(), [(k.as_long(), k.size()) for k in known]), term.size())


def applied(name: str, width: int, arguments: list[tuple[int, int]]) -> int:
    if name.startswith("product"):
        return arguments[0][0] * arguments[1][0] % (1 << width)
    prefix, state = b"\xf2" if width == 64 else b"\xf3", bytearray(128 + 16 + 256 + 64)
    if name.startswith("from_int"):
        struct.pack_into("<Q", state, 0, arguments[0][0])
        code = prefix + b"\x48\x0f\x2a\xc0"
    else:
        struct.pack_into("<Q8xQ", state, 144, arguments[0][0], arguments[1][0])
        code = prefix + bytes([0x0F, {"add": 0x58, "mul": 0x59, "sub": 0x5C, "div": 0x5E}[name[:3]], 0xC1])
    return struct.unpack_from("<Q", processor.run(code, bytes(state)), 144)[0] % (1 << width)


SPECIAL = [0, 1, 2, (1 << 64) - 1, 1 << 63, 1 << 31, (1 << 31) - 1, 0x7FF0000000000000, 0xFFF8000000000000, 0x3FF0000000000000,
           0x7FC000007F800000, 0x3F8000003F800000, 0x80000000, 0x7FFFFFFFFFFFFFFF, 0xBFF0000000000000, 0xFFF0000000000000,
           0x7FF0000000000001, 0x000FFFFFFFFFFFFF, 0x8000000000000001, 0x7FA00001FF800000, 0x807FFFFF00000001]  # fmt: skip


KNOWN = [*SPECIAL * 10, *(draw.getrandbits(64) for _ in range(300))]
any_64 = lambda: draw.choice(KNOWN)
number_64 = functools.lru_cache(4096)(lambda value: z3.BitVecVal(value, 64))


class Encoded:
    """The parts of an instruction, from which `code` makes its bytes."""

    def __init__(self, map_: str, opcode: int, vex: bool, prefix: bytes, wide: int, modrm: int | None):
        self.map, self.opcode, self.vex, self.prefix, self.wide = map_, opcode, vex, prefix, wide
        self.tail = b"" if modrm is None else bytes([modrm])
        self.r = self.x = self.b = self.vector = self.long = self.rex = 0

    def add_memory(self) -> None:
        """Appends a random SIB and displacement, as the ModRM asks for. The displacement of rip is replaced later."""
        (modrm,) = self.tail
        mod, rm, base = modrm >> 6, modrm & 7, modrm & 7
        if mod != 3 and rm == 4:
            self.tail += bytes([draw.choice((0x24, 0x25 | draw.randrange(256), draw.randrange(256)))])
            base = self.tail[1] & 7
        size = (4 if base == 5 else 0, 1, 4, 0)[mod]
        self.tail += draw.randrange(-64, 64).to_bytes(size, "little", signed=True) if size else b""

    def code(self) -> bytes:
        if not self.vex:
            rex = self.rex | 8 * self.wide | 4 * self.r | 2 * self.x | self.b
            return self.prefix + (bytes([0x40 | rex % 64]) if rex else b"") + bytes.fromhex(self.map) + bytes([self.opcode]) + self.tail
        last = self.wide << 7 | (~self.vector & 15) << 3 | self.long << 2 | (b"", b"\x66", b"\xf3", b"\xf2").index(self.prefix)
        high = (1 - self.r) << 7 | (1 - self.x) << 6 | (1 - self.b) << 5
        short = high & 0x60 == 0x60 and not self.wide and self.map == "0F" and draw.random() < 0.7
        return bytes([0xC5, high & 0x80 | last] if short else [0xC4, high | MAPS[self.map], last]) + bytes([self.opcode]) + self.tail


def numbers(row: Row, short: bool, wide: bool) -> bytes:
    """Returns random bytes for the numbers after an instruction's address."""
    sizes = {"b": 1, "d": 4, "x": 1, "z": 2 if short else 4, "v": 8 if wide else 2 if short else 4}
    size = sum(sizes[o[1]] for o in row.operands if o[0] in "IJL")
    return bytes([draw.choice((1, 0x80, draw.randrange(8), draw.randrange(256)))]) if size == 1 else draw.randbytes(size)


def encodings(code: str, row: Row) -> Iterator[bytes]:
    """Returns encodings of a row with each form, prefix, W and kind of operand, and random registers and addresses."""
    memory = [m for m in row.modrm if m < 0xC0]
    kinds = [k for k in (memory + [m for m in memory if m & 7 in (4, 5)] * 3, [m for m in row.modrm if m >= 0xC0]) if k] or [[None]]
    prefixes = [row.prefix, b"\x66"] if not row.prefix and "v" in row.marks else [row.prefix]
    wides = [0, 1] if row.marks & set("vy") else [row.wide]
    for vex, prefix, wide, kind in itertools.product(row.forms, prefixes, wides, kinds):
        short = prefix != row.prefix
        if not (short and wide):
            for _ in range(DRAWN):
                e = Encoded(code[:-2], int(code[-2:], 16), vex, prefix, wide, draw.choice(kind))
                if row.operands:
                    e.r, e.x, e.b = (draw.getrandbits(1) for _ in range(3))
                    e.rex = draw.choice((0, 0, 64))
                if {o[0] for o in row.operands} & set("HB") and vex:
                    e.vector = draw.randrange(16)
                if e.tail:
                    e.add_memory()
                e.tail += numbers(row, short, bool(wide))
                yield e.code()


def aimed(code: bytes, k: int, target: int) -> bytes:
    """Returns the instruction with a distance from its end such that operand `k` is at `target`."""
    ins = decode(code, processor.address)
    wanted = [o._replace(number=target) if n == k else o for n, o in enumerate(ins.operands)]
    distance = (target - processor.address - ins.size) % (1 << 32)
    tried = (code[:at] + distance.to_bytes(4, "little")[:size] + code[at + size :] for size in (1, 4) for at in range(1, ins.size - size + 1))
    return next(c for c in tried if decode(c, processor.address).operands == wanted)


def prepared(code: bytes) -> tuple[bytes, bytes]:
    """Returns the instruction's bytes and a random state. In most states the instruction addresses only existing memory,
    and jumps only to the landing."""
    ins, values = decode(code, processor.address), {name: any_64() for name in ORDER}
    place = lambda: processor.base + DATA + 512 + draw.choice((16, 16, 1)) * draw.randrange(16)
    values |= {"rsp": place()} | ({"rbp": place()} if ins.name == "leave" else {})
    target = values["rsp"] if ins.name == "ret" else place()
    for k, op in enumerate(ins.operands):
        if op.where == "memory" and op.base == "rip":
            code = aimed(code, k, target)
        elif op.base == "rip":
            code = aimed(code, k, processor.landing)
        elif op.where == "memory":
            alone, factor, rest = op.base or op.index, 1 if op.base else op.scale, op.number
            if op.index == op.base:
                factor = 1 + op.scale
            elif op.base and op.index:
                scaled = draw.randrange(-8, 8)
                values[op.index] = scaled % (1 << 64)
                rest += scaled * op.scale
            if alone == "rsp" and ins.name in USES_STACK:
                target = values["rsp"] + rest
            elif alone:
                target += (rest - target) % factor
                values[alone] = (target - rest) // factor % (1 << 64)
        elif ins.name in ("call", "jmp"):
            values[op.where] = processor.landing
    vectors = [any_64() for _ in range(32)]
    if draw.random() < 0.3:
        vectors = vectors[:2] * 16  # equal operands
    flags = 0x202 | sum(draw.getrandbits(1) << bit for bit in FLAG_BITS)
    data = b"".join(struct.pack("<Q", any_64()) for _ in range(SIZE // 8))
    at = target - processor.base - DATA
    if ins.name in ("ret", "call", "jmp") and 0 <= at <= SIZE - 8:
        data = data[:at] + struct.pack("<Q", processor.landing) + data[at + 8 :]
    state = struct.pack("<16QQQ32Q", *(values[name] for name in ORDER), flags, 0, *vectors)
    return code, state.ljust(DATA - PAGE, b"\0") + data


Outcome = tuple[list[int], bytes, dict[str, bool]]  # registers, whether it jumped, and vectors; the memory; known conditions


def conditions(flags: int) -> dict[str, bool]:
    """Returns {condition: value} for these flags, by the table of setcc in the processor's manual."""
    carry, parity, zero, sign, overflow = (bool(flags >> bit & 1) for bit in FLAG_BITS)
    return {"o": overflow, "b": carry, "e": zero, "s": sign, "p": parity, "be": carry or zero, "l": sign != overflow,
            "le": zero or sign != overflow}  # fmt: skip


def interpreted(code: bytes, state: bytes) -> Outcome:
    """Returns the outcome of an instruction in the interpreter. Raises Undecided for what is not supported."""
    machine, held = Concrete(code, state[DATA - PAGE :]), struct.unpack_from("<16QQQ32Q", state)
    before = {(name, 0): value for name, value in zip(ORDER, held)} | {(f"xmm{k // 2}", k % 2 * 8): held[18 + k] for k in range(32)}
    s = State(processor.address, None)
    s.cells = {(name, at + k): (number_64(value), k) for (name, at), value in before.items() for k in range(8)}
    start = s.flags = {name: lambda is_so=is_so: z3.BoolVal(is_so) for name, is_so in conditions(held[16]).items()}
    machine._step(s)
    values = [constant(s.read(name, at, 8)).as_long() for name, at in before]
    assert s.pc in (processor.landing, processor.address + len(code)), "another jump"
    known = conditions(held[16]) if s.flags is start else {name: z3.is_true(constant(claim())) for name, claim in s.flags.items()}
    return [*values, s.pc == processor.landing], bytes(machine.data), known


def natively(code: bytes, state: bytes) -> Outcome:
    after = processor.run(code, state)
    held = struct.unpack_from("<16QQQ32Q", after)
    return [*held[:16], *held[18:], held[17] == 1], after[DATA - PAGE :], conditions(held[16])


def differs(found: Outcome, expected: Outcome) -> bool:
    return found[:2] != expected[:2] or not found[2].items() <= expected[2].items()


def compared(code: bytes) -> tuple[bytes, bytes, Outcome] | None:
    """Compares the interpreter with the processor on one state. Returns the instruction, the state and the outcome, or
    None if the interpreter does not support the instruction in this state."""
    ins = decode(code, processor.address)
    if ins.name in ("call", "jmp") and ins.operands[0].where == "rsp":
        return None  # it jumps to the stack
    code, state = prepared(code)
    try:
        found = interpreted(code, state)
    except Undecided:
        return None
    expected = natively(code, state)
    assert not differs(found, expected), f"{code.hex(' ')}, {decode(code, 0)}: the interpreter is not the processor: {found[0]}, {expected[0]}, {found[2]}, {expected[2]}"
    return code, state, expected


def neighbours() -> Iterator[bytes]:
    """Returns instructions with each map, opcode, W, ModRM.reg and kind of operand: in the legacy form with known and other
    prefixes, and with VEX of 128 and 256 bits."""
    prefixes = [b"", *(bytes([p]) for p in (0x66, 0xF2, 0xF3, 0x67, 0xF0, 0x64)), b"\x66\xf2", b"\x66\x66"]
    for map_, opcode, wide, modrm in itertools.product(MAPS, range(256), (0, 1), [m for m in range(256) if m & 0xC7 in (0x06, 0xC1)]):
        for prefix in prefixes:
            e = Encoded(map_, opcode, False, prefix, wide, modrm)
            e.tail, e.b = e.tail + bytes(8), draw.getrandbits(1)
            yield e.code()
        for prefix, e.long, e.vector in itertools.product(prefixes[:4], (0, 1), (0, 3)) if map_ else ():
            e.vex, e.prefix, e.b = True, prefix, draw.getrandbits(1)
            yield e.code()


# The names of similar meanings.
SIMILAR = {"add": "sub", "sub": "add", "and": "or", "or": "and", "xor": "or", "cmp": "test", "test": "cmp", "movsx": "mov", "shl": "shr", "shr": "sar",
           "sar": "shr", "reals sub": "reals add", "reals div": "reals mul", "reals mul": "reals div", "reals min": "reals max", "reals max": "reals min",
           "reals add": "reals sub", "bits and": "bits andn", "bits andn": "bits and", "bits or": "bits xor", "bits xor": "bits or", "call": "jmp", "set": "not",
           "cmov": "mov", "inc": "dec", "dec": "inc", "neg": "not", "not": "neg"}  # fmt: skip


def is_noticed(code: str, row: Row, name: str, cases: list[tuple[bytes, bytes, Outcome]]) -> bool:
    """Returns True if the comparison detects another meaning of a row."""
    rows = ROWS[code]
    ROWS[code] = [r._replace(name=name) if r is row else r for r in rows]
    try:
        return any(differs(interpreted(*case), expected) for *case, expected in cases)
    except (AssertionError, Undecided):
        return True
    finally:
        ROWS[code] = rows


def check() -> None:
    for name, width in itertools.product(("add", "mul"), (32, 64)):
        for _ in range(200):
            a, known = any_64() % (1 << width), any_64() % (1 << width)
            if known & (1 << width - 1) - 1 <= reals.INFINITY[width]:  # not a NaN
                both = {applied(name, width, [(x, width), (y, width)]) for x, y in ((a, known), (known, a))}
                assert len(both) == 1, f"{name} of {a:#x} and {known:#x} depends on their order"
    forms = states = rows = 0
    runs = lambda raw: KNOWS_AVX2 or not {0xC4, 0xC5} & set(raw[:1])
    for code, row in [(code, row) for code in ROWS for row in ROWS[code]]:
        drawn = list(encodings(code, row))
        assert all((d := decode(e, 0)).name == row.name and d.size == len(e) for e in drawn), f"{code} {row}: is not read"
        cases = [case for e in filter(runs, drawn) for _ in range(STATES) if (case := compared(e))]
        forms, states, rows = forms + len(drawn), states + len(cases), rows + 1
        assert 3 * len(cases) >= len(drawn) or not KNOWS_AVX2, f"{code} {row}: {len(cases)} states"
        for wrong in {"nop", SIMILAR.get(row.name, "nop")} if row.name != "nop" and cases else ():
            assert is_noticed(code, row, wrong, cases), f"{code} {row}: the meaning {wrong} is not noticed"
    tried = decided = same = 0
    for e in neighbours():
        tried += 1
        if not decode(e, 0).name:
            continue
        decided += 1
        e = e[:decode(e, 0).size]
        same += compared(e) is not None if runs(e) else 0
    assert rows > 250 and tried - decided > 500_000 and (same > 5000 or not KNOWS_AVX2), f"{rows} rows, {tried}, {decided} and {same} neighbours"
    print(f"{rows} rows, {forms} encodings, {states} states: the interpreter does what the processor does\n"
          f"{tried} neighbours: {tried - decided} undecided, {decided} read, {same} compared{'' if KNOWS_AVX2 else '; without AVX2 no VEX form'}", flush=True)


child = os.fork()
if not child:
    check()
    os._exit(0)
status = os.waitpid(child, 0)[1]
if os.WIFSIGNALED(status):
    print(f"signal {os.WTERMSIG(status)} at {processor.memory[processor.hole : processor.hole + 24].hex(' ')}, 06 is no part of it")
sys.exit(status != 0)
