"""processor.py BUILD ROOT: tests that the prover's interpreter and the processor agree on every instruction of the
kernels, on random and special states, and that a wrong meaning of any mnemonic is detected."""

import ctypes
import mmap
import random
import struct
import sys
import tempfile
from pathlib import Path

build, root = Path(sys.argv[1]), Path(sys.argv[2])
sys.path[:0] = [str(build), str(root / "tests/support")]
import capstone
import z3
from contct_prove import reals, x86
from contct_prove.elf import Image
from contct_prove.machine import Machine
from contct_prove.specification import Specification
from contct_prove.state import REGISTERS, State
from contct_prove.__main__ import KERNELS
from testing import run

STATES = 12
ORDER = ["rax", "rcx", "rdx", "rbx", "rsp", "rbp", "rsi", "rdi"] + [f"r{k}" for k in range(8, 16)]
PAGE, DATA = 4096, 8192  # addresses of the state, and of the memory that instructions use
FLAG_BITS = [0, 2, 6, 7, 11]  # carry, parity, zero, sign, overflow
draw = random.Random(1989)
decoder = capstone.Cs(capstone.CS_ARCH_X86, capstone.CS_MODE_64)
decoder.detail = True


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
        self.hole = code.index(b"\x90" * 16)
        self.call = ctypes.CFUNCTYPE(None)(self.base)

    def run(self, code: bytes, state: bytes) -> bytes:
        """Returns the state after the instruction: registers, flags, vectors, and then memory."""
        self.memory[self.hole : self.hole + 16] = code.ljust(16, b"\x90")
        self.memory[PAGE : PAGE + len(state)] = state
        self.call()
        return self.memory[PAGE : PAGE + len(state)]


processor = Processor()


class Concrete:
    """The prover's machine for a single instruction, with memory in bytes and only known numbers as values."""

    def __init__(self, data: bytes):
        self.data = bytearray(data)
        self.spec = Specification(64)

    def at(self, address: z3.BitVecRef) -> int:
        return z3.simplify(address).as_long() - processor.base - DATA

    def load(self, s: State, address: z3.BitVecRef, width: int) -> z3.BitVecRef:
        at = self.at(address)
        return z3.BitVecVal(int.from_bytes(self.data[at : at + width // 8], "little"), width)

    def store(self, s: State, address: z3.BitVecRef, value: z3.BitVecRef) -> None:
        at, size = self.at(address), value.size() // 8
        self.data[at : at + size] = constant(value).as_long().to_bytes(size, "little")

    def check_alignment(self, s: State, address: z3.BitVecRef) -> None:
        assert self.at(address) % 16 == 0, "the processor would fault"

    def in_image(self, address: int) -> z3.BitVecRef:
        return z3.BitVecVal(address, 64)

    push, pop = Machine.push, Machine.pop


def constant(term: z3.ExprRef) -> z3.ExprRef:
    """Returns the value of a term. Uninterpreted functions get the results of the processor's scalar instructions,
    which they represent."""
    term = z3.simplify(term)
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
           0x7FC000007F800000, 0x3F8000003F800000, 0x80000000, 0x7FFFFFFFFFFFFFFF, 0xBFF0000000000000]  # fmt: skip


any_64 = lambda: draw.choice(SPECIAL) if draw.random() < 0.4 else draw.getrandbits(64)


def prepared(ins: capstone.CsInsn) -> tuple[bytes, bytes, int]:
    """Returns the instruction's bytes, a random state in which it addresses only existing memory, and its address."""
    code, address = bytearray(ins.bytes), processor.base + processor.hole
    values = {name: any_64() for name in ORDER}
    values["rsp"] = processor.base + DATA + 1024
    for op in ins.operands:
        if op.type == capstone.x86.X86_OP_MEM:
            base, index = (ins.reg_name(r) if r else "" for r in (op.mem.base, op.mem.index))
            target = processor.base + DATA + 1024 + 16 * draw.randrange(8)
            if base == "rip":
                code[ins.disp_offset : ins.disp_offset + 4] = struct.pack("<i", target - address - ins.size)
                continue
            scaled = draw.randrange(-8, 8) if index and index != base else 0
            if index:
                values[REGISTERS[index][0]] = scaled % (1 << 64)
            if base and base != "rsp":
                values[REGISTERS[base][0]] = (target - op.mem.disp - scaled * op.mem.scale) % (1 << 64)
    vectors = [any_64() for _ in range(32)]
    if draw.random() < 0.3:
        vectors[2:4] = vectors[0:2]  # equal operands
    flags = 0x202 | sum(draw.getrandbits(1) << bit for bit in FLAG_BITS)
    data = b"".join(struct.pack("<Q", any_64()) for _ in range(256))
    state = struct.pack("<16QQ8x32Q", *(values[name] for name in ORDER), flags, *vectors)
    return bytes(code), state.ljust(DATA - PAGE, b"\0") + data, address


def conditions(flags: int) -> dict[str, bool]:
    """Returns {condition: value} for these flags, by the table of setcc in the processor's manual."""
    carry, parity, zero, sign, overflow = (bool(flags >> bit & 1) for bit in FLAG_BITS)
    return {"o": overflow, "b": carry, "e": zero, "s": sign, "p": parity, "be": carry or zero, "l": sign != overflow,
            "le": zero or sign != overflow}  # fmt: skip


def interpreted(code: bytes, state: bytes, address: int, act) -> tuple[list[int], bytes, dict[str, bool]]:
    """Returns registers and vectors, the memory, and the known conditions after an instruction in the interpreter."""
    ins = next(decoder.disasm(code, address, 1))
    s, machine = State(address), Concrete(state[DATA - PAGE :])
    held = struct.unpack_from("<16QQ8x32Q", state)
    for name, value in zip(ORDER, held):
        s.set_register(name, z3.BitVecVal(value, 64))
    for k in range(32):
        s.write(f"xmm{k // 2}", k % 2 * 8, z3.BitVecVal(held[17 + k], 64))
    s.flags = lambda: {name: z3.BoolVal(is_so) for name, is_so in conditions(held[16]).items()}
    act(x86.Operands(machine, s, ins))
    values = [constant(s.register(name)).as_long() for name in [*ORDER, *(f"xmm{k}" for k in range(16))]]
    return values, bytes(machine.data), {name: z3.is_true(constant(claim)) for name, claim in s.flags().items()}


def natively(code: bytes, state: bytes) -> tuple[list[int], bytes, dict[str, bool]]:
    after = processor.run(code, state)
    held = struct.unpack_from("<16QQ8x32Q", after)
    values = [*held[:16], *(held[17 + 2 * k] | held[18 + 2 * k] << 64 for k in range(16))]
    return values, after[DATA - PAGE :], conditions(held[16])


def agrees(ins: capstone.CsInsn, act) -> bool:
    """Returns True if the interpreter, with the meaning `act`, agrees with the processor on one state."""
    code, state, address = prepared(ins)
    *found, known = interpreted(code, state, address, act)
    *expected, meant = natively(code, state)
    return found == expected and known.items() <= meant.items()


def wrong(mnemonic: str):
    """Returns a wrong meaning of a mnemonic: that of a similar mnemonic, or no effect."""
    neighbour = {"add": "sub", "sub": "add", "and": "or", "or": "and", "xor": "or", "cmp": "test", "test": "cmp", "movzx": "movsx",
                 "movsx": "movzx", "subsd": "addsd", "divsd": "mulsd", "mulsd": "divsd", "subss": "addss", "divss": "mulss",
                 "mulss": "divss", "minsd": "maxsd", "minss": "maxss", "sete": "setne", "setne": "sete"}  # fmt: skip
    other = neighbour.get(mnemonic, "sete" if mnemonic.startswith("set") else "")
    return x86.ACTIONS.get(other, lambda o: None)


def setting(jump: capstone.CsInsn) -> capstone.CsInsn:
    """Returns the setcc with the condition of a jump; the last 4 bits of both opcodes are the condition."""
    number = jump.opcode[1 if jump.opcode[0] == 0x0F else 0] & 0x0F
    ins = next(decoder.disasm(bytes([0x0F, 0x90 | number, 0xC0]), 0))
    assert ins.mnemonic[3:] == jump.mnemonic[1:], f"{ins.mnemonic} for {jump.mnemonic}"
    return ins


for name, width in (("add", 32), ("add", 64), ("mul", 32), ("mul", 64)):
    for _ in range(200):
        a, known = any_64() % (1 << width), any_64() % (1 << width)
        if known & (1 << width - 1) - 1 <= reals.INFINITY[width]:  # not a NaN
            both = {applied(name, width, [(x, width), (y, width)]) for x, y in ((a, known), (known, a))}
            assert len(both) == 1, f"{name} of {a:#x} and {known:#x} depends on their order"

image = Image(build / "contct")
forms: dict[str, capstone.CsInsn] = {}
for kernel in KERNELS[:4]:
    for ins in decoder.disasm(image.code_of(kernel.symbol), image.symbol(kernel.symbol).address):
        forms.setdefault(f"{ins.mnemonic} {[(o.type, o.size) for o in ins.operands]}", ins)
compared, unnoticed, mnemonics = 0, [], set()
for form, ins in forms.items():
    mnemonic = ins.mnemonic
    if mnemonic in ("jmp", "call", "ret", "nop"):
        continue
    ins = setting(ins) if mnemonic.startswith("j") else ins
    meant, otherwise = x86.ACTIONS[ins.mnemonic], wrong(ins.mnemonic)
    for _ in range(STATES):
        assert agrees(ins, meant), f"{ins.mnemonic} {ins.op_str}: the interpreter is not the processor"
        compared += 1
    mnemonics.add(mnemonic)
    if all(agrees(ins, otherwise) for _ in range(STATES)):
        unnoticed.append(form)
assert not unnoticed, f"a wrong meaning is not noticed: {unnoticed}"
assert len(mnemonics) >= 30, mnemonics
print(f"{len(mnemonics)} mnemonics, {len(forms)} forms, {compared} states: the interpreter does what the processor does")
