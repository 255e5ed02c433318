"""What the instructions of x86-64 do to a state. A mnemonic that is not here leaves a proof undecided."""

from typing import Callable

import capstone
import z3
from capstone import x86 as names

from . import reals
from .state import State

_HALF = {"sd": 64, "ss": 32, "pd": 64, "ps": 32}
CONDITIONS = {
    "o": lambda f: f("o"), "b": lambda f: f("c"), "e": lambda f: f("z"), "s": lambda f: f("s"), "p": lambda f: f("p"),
    "be": lambda f: z3.Or(f("c"), f("z")), "l": lambda f: f("s") != f("o"),
    "le": lambda f: z3.Or(f("z"), f("s") != f("o")),
}  # fmt: skip
_OPPOSITE = {"no": "o", "ae": "b", "ne": "e", "ns": "s", "np": "p", "a": "be", "ge": "l", "g": "le"}


def condition(s: State, suffix: str) -> z3.BoolRef | None:
    """The condition of jcc, setcc and cmovcc; none where `suffix` is not one."""
    flag = lambda name: s.flags[name]()
    if suffix in CONDITIONS:
        return z3.simplify(CONDITIONS[suffix](flag))
    return z3.simplify(z3.Not(CONDITIONS[_OPPOSITE[suffix]](flag))) if suffix in _OPPOSITE else None


class Operands:
    """The operands of one instruction, read and written in a state."""

    def __init__(self, machine, s: State, ins: capstone.CsInsn):
        self.machine, self.s, self.ins, self.list = machine, s, ins, ins.operands

    def __len__(self) -> int:
        return len(self.list)

    def width(self, k: int) -> int:
        return 8 * self.list[k].size

    def is_memory(self, k: int) -> bool:
        return self.list[k].type == names.X86_OP_MEM

    def is_vector(self, k: int) -> bool:
        return self.list[k].type == names.X86_OP_REG and self.ins.reg_name(self.list[k].reg).startswith("xmm")

    def address(self, k: int) -> z3.BitVecRef:
        m = self.list[k].mem
        if m.segment:
            raise self.machine.undecided(self.ins, "a segment register is used")
        total = z3.BitVecVal(m.disp, 64)
        if m.base:
            name = self.ins.reg_name(m.base)
            total += self.machine.in_image(self.ins.address + self.ins.size) if name == "rip" else self.s.register(name)
        if m.index:
            total += self.s.register(self.ins.reg_name(m.index)) * m.scale
        return z3.simplify(total)

    def get(self, k: int, width: int = 0) -> z3.BitVecRef:
        """Operand `k`: its lowest `width` bits, or all of them."""
        op = self.list[k]
        width = width or self.width(k)
        if op.type == names.X86_OP_IMM:
            return z3.BitVecVal(op.imm, width)
        if op.type == names.X86_OP_MEM:
            return self.machine.load(self.s, self.address(k), width)
        whole = self.s.register(self.ins.reg_name(op.reg))
        return whole if whole.size() == width else z3.simplify(z3.Extract(width - 1, 0, whole))

    def set(self, k: int, value: z3.BitVecRef) -> None:
        """Write all of operand `k`."""
        if self.is_memory(k):
            self.machine.store(self.s, self.address(k), z3.simplify(value))
        else:
            self.s.set_register(self.ins.reg_name(self.list[k].reg), value)

    def set_low(self, k: int, value: z3.BitVecRef) -> None:
        """Write the lowest bits of a vector register and keep the others."""
        self.set(k, z3.Concat(z3.Extract(127, value.size(), self.get(k)), value))


Action = Callable[[Operands], None]
ACTIONS: dict[str, Action] = {}


def _action(*mnemonics: str) -> Callable[[Action], Action]:
    def register(function: Action) -> Action:
        ACTIONS.update({m: function for m in mnemonics})
        return function

    return register


def _flags_of(o: Operands, result: z3.BitVecRef, carry, overflow) -> None:
    low = z3.Extract(7, 0, result)
    parity = lambda: z3.Extract(0, 0, low ^ (low >> 1) ^ (low >> 2) ^ (low >> 3) ^ (low >> 4) ^ (low >> 5) ^ (low >> 6)
                                ^ z3.LShR(low, 7)) == 0  # fmt: skip
    o.s.flags = {"z": lambda: result == 0, "s": lambda: result < 0, "p": parity, "c": carry, "o": overflow}


def _unknown(o: Operands) -> z3.BoolRef:
    return o.machine.fresh(1) == 1


def _no() -> z3.BoolRef:
    return z3.BoolVal(False)


def _add(o: Operands, a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BitVecRef:
    r = z3.simplify(a + b)
    _flags_of(o, r, lambda: z3.ULT(r, a), lambda: ((a ^ r) & (b ^ r)) < 0)
    return r


def _subtract(o: Operands, a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BitVecRef:
    r = z3.simplify(a - b)
    _flags_of(o, r, lambda: z3.ULT(a, b), lambda: ((a ^ b) & (a ^ r)) < 0)
    return r


def _logic(o: Operands, r: z3.BitVecRef) -> z3.BitVecRef:
    r = z3.simplify(r)
    _flags_of(o, r, _no, _no)
    return r


@_action("add", "sub", "cmp", "and", "or", "xor", "test")
def _two_integers(o: Operands) -> None:
    a, b = o.get(0), o.get(1, o.width(0))
    work = {"add": lambda: _add(o, a, b), "sub": lambda: _subtract(o, a, b), "cmp": lambda: _subtract(o, a, b),
            "and": lambda: _logic(o, a & b), "test": lambda: _logic(o, a & b), "or": lambda: _logic(o, a | b),
            "xor": lambda: _logic(o, a ^ b)}  # fmt: skip
    result = work[o.ins.mnemonic]()
    if o.ins.mnemonic not in ("cmp", "test"):
        o.set(0, result)


@_action("inc", "dec", "neg", "not")
def _one_integer(o: Operands) -> None:
    a, carry = o.get(0), o.s.flags["c"]
    if o.ins.mnemonic == "not":
        return o.set(0, ~a)
    one, zero = z3.BitVecVal(1, a.size()), z3.BitVecVal(0, a.size())
    work = {"inc": lambda: _add(o, a, one), "dec": lambda: _subtract(o, a, one), "neg": lambda: _subtract(o, zero, a)}
    o.set(0, work[o.ins.mnemonic]())
    if o.ins.mnemonic != "neg":
        o.s.flags["c"] = carry


@_action("imul")
def _multiply(o: Operands) -> None:
    if len(o) == 1:
        raise o.machine.undecided(o.ins, "imul of one operand is not read")
    width = o.width(0)
    a, b = (o.get(0), o.get(1)) if len(o) == 2 else (o.get(1), o.get(2, width))
    o.set(0, reals.product(a, b))
    o.s.flags = {flag: lambda: _unknown(o) for flag in "zcsop"}


@_action("shl", "sal", "shr", "sar")
def _shift(o: Operands) -> None:
    a, width = o.get(0), o.width(0)
    if len(o) == 2 and o.list[1].type != names.X86_OP_IMM:
        raise o.machine.undecided(o.ins, "a shift by a register is not read")
    by = (o.list[1].imm if len(o) == 2 else 1) & (63 if width == 64 else 31)
    if by == 0:
        return
    shift = {"shr": z3.LShR, "sar": lambda x, n: x >> n}.get(o.ins.mnemonic, lambda x, n: x << n)
    out = width - by if shift not in (z3.LShR,) and o.ins.mnemonic in ("shl", "sal") else by - 1
    result = z3.simplify(shift(a, z3.BitVecVal(by, width)))
    carry = (lambda: z3.Extract(out, out, a) == 1) if out < width else (lambda: _unknown(o))
    _flags_of(o, result, carry, lambda: _unknown(o))
    o.set(0, result)


@_action("mov", "movabs", "movzx")
def _move(o: Operands) -> None:
    value = o.get(1) if o.ins.mnemonic == "movzx" else o.get(1, o.width(0))
    o.set(0, z3.ZeroExt(o.width(0) - value.size(), value))


@_action("movsx", "movsxd")
def _move_signed(o: Operands) -> None:
    o.set(0, z3.SignExt(o.width(0) - o.width(1), o.get(1)))


@_action("lea")
def _lea(o: Operands) -> None:
    o.set(0, z3.Extract(o.width(0) - 1, 0, o.address(1)))


@_action("cdqe", "cwde", "cdq", "cqo")
def _extend(o: Operands) -> None:
    source, target = {"cdqe": ("eax", "rax"), "cwde": ("ax", "eax"), "cdq": ("eax", "edx"), "cqo": ("rax", "rdx")}[
        o.ins.mnemonic
    ]
    a = o.s.register(source)
    wide = z3.SignExt(a.size(), a)
    o.s.set_register(target, wide if target in ("rax", "eax") else z3.Extract(2 * a.size() - 1, a.size(), wide))


@_action("push")
def _push(o: Operands) -> None:
    o.machine.push(o.s, o.get(0, 64))


@_action("pop")
def _pop(o: Operands) -> None:
    o.set(0, o.machine.pop(o.s))


@_action("leave")
def _leave(o: Operands) -> None:
    o.s.set_register("rsp", o.s.register("rbp"))
    o.s.set_register("rbp", o.machine.pop(o.s))


@_action("nop", "endbr64")
def _nothing(o: Operands) -> None:
    pass


@_action("xchg")
def _exchange(o: Operands) -> None:
    a, b = o.get(0), o.get(1)
    o.set(0, b)
    o.set(1, a)


def _set_on_condition(o: Operands) -> None:
    bit = z3.If(condition(o.s, o.ins.mnemonic[3:]), z3.BitVecVal(1, 8), z3.BitVecVal(0, 8))
    o.set(0, bit)


def _move_on_condition(o: Operands) -> None:
    o.set(0, z3.If(condition(o.s, o.ins.mnemonic[4:]), o.get(1), o.get(0)))


for _suffix in [*CONDITIONS, *_OPPOSITE]:
    ACTIONS["set" + _suffix], ACTIONS["cmov" + _suffix] = _set_on_condition, _move_on_condition


@_action("movapd", "movaps", "movupd", "movups", "movdqa", "movdqu")
def _move_vector(o: Operands) -> None:
    o.set(0, o.get(1, 128))


@_action("movsd", "movss", "movq", "movd")
def _move_scalar(o: Operands) -> None:
    width = {"movsd": 64, "movss": 32, "movq": 64, "movd": 32}[o.ins.mnemonic]
    value = o.get(1, width)
    if o.ins.mnemonic in ("movsd", "movss") and o.is_vector(0) and o.is_vector(1):
        o.set_low(0, value)
    else:
        o.set(0, z3.ZeroExt(128 - width, value) if o.is_vector(0) else value)


def _lanes(x: z3.BitVecRef, width: int) -> list[z3.BitVecRef]:
    return [z3.Extract(low + width - 1, low, x) for low in range(0, 128, width)]


def _join(lanes: list[z3.BitVecRef]) -> z3.BitVecRef:
    return z3.Concat(*reversed(lanes))


def _truth(claim: z3.BoolRef, width: int) -> z3.BitVecRef:
    return z3.If(claim, z3.BitVecVal(-1, width), z3.BitVecVal(0, width))


_OPERATIONS = {name: lambda a, b, name=name: reals.arithmetic(name, a, b) for name in ("add", "sub", "mul", "div")}
_OPERATIONS["min"] = lambda a, b: z3.If(reals.less(a, b), a, b)  # the second where they are equal or one is NaN
_OPERATIONS["max"] = lambda a, b: z3.If(reals.less(b, a), a, b)
_ORDERS = {
    "eq": reals.equal, "lt": reals.less, "le": lambda a, b: z3.Or(reals.less(a, b), reals.equal(a, b)),
    "unord": reals.unordered,
}  # fmt: skip
for _name, _negated in (("neq", "eq"), ("nlt", "lt"), ("nle", "le"), ("ord", "unord")):
    _ORDERS[_name] = lambda a, b, of=_ORDERS[_negated]: z3.Not(of(a, b))
for _name, _order in _ORDERS.items():
    _OPERATIONS["cmp" + _name] = lambda a, b, order=_order: _truth(order(a, b), a.size())


def _reals(o: Operands) -> None:
    """addsd and its like: one operation on the lowest lane, or on every lane."""
    name, kind = o.ins.mnemonic[:-2], o.ins.mnemonic[-2:]
    width, work = _HALF[kind], _OPERATIONS[name]
    if kind in ("sd", "ss"):
        return o.set_low(0, work(o.get(0, width), o.get(1, width)))
    o.set(0, _join([work(a, b) for a, b in zip(_lanes(o.get(0), width), _lanes(o.get(1, 128), width))]))


ACTIONS |= {name + kind: _reals for name in _OPERATIONS for kind in _HALF}


@_action("ucomisd", "ucomiss", "comisd", "comiss")
def _compare(o: Operands) -> None:
    width = _HALF[o.ins.mnemonic[-2:]]
    a, b = o.get(0, width), o.get(1, width)
    nan = lambda: reals.unordered(a, b)
    o.s.flags = {"z": lambda: z3.Or(nan(), reals.equal(a, b)), "p": nan, "c": lambda: z3.Or(nan(), reals.less(a, b)),
                 "o": _no, "s": _no}  # fmt: skip


@_action("cvtsi2sd", "cvtsi2ss")
def _convert(o: Operands) -> None:
    value = o.get(1)
    o.set_low(0, reals.from_integer(value, _HALF[o.ins.mnemonic[-2:]]))


_BITS = {"and": lambda a, b: a & b, "andn": lambda a, b: ~a & b, "or": lambda a, b: a | b, "xor": lambda a, b: a ^ b}


def _bitwise(o: Operands) -> None:
    name = o.ins.mnemonic.removeprefix("p").removesuffix("pd").removesuffix("ps")
    o.set(0, _BITS[name](o.get(0), o.get(1, 128)))


ACTIONS |= {m: _bitwise for name in _BITS for m in (name + "pd", name + "ps", "p" + name)}


@_action("unpcklpd", "unpcklps", "unpckhpd", "punpckldq", "punpcklqdq")
def _interleave(o: Operands) -> None:
    width = 32 if o.ins.mnemonic in ("unpcklps", "punpckldq") else 64
    a, b = _lanes(o.get(0), width), _lanes(o.get(1, 128), width)
    from_, count = (1, 1) if "unpckh" in o.ins.mnemonic else (0, 64 // width)
    o.set(0, _join([lane for k in range(from_, from_ + count) for lane in (a[k], b[k])]))
