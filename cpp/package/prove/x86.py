"""The effects of x86-64 instructions on a state. A mnemonic that is not in ACTIONS makes a proof undecided."""

from typing import Callable

import capstone
import z3
from capstone import x86 as names

from . import reals
from .state import State, bits

OPPOSITE = {"no": "o", "ae": "b", "ne": "e", "ns": "s", "np": "p", "a": "be", "ge": "l", "g": "le"}
CONDITIONS = [*OPPOSITE, *OPPOSITE.values()]


class Operands:
    """The operands of one instruction, read and written in a state."""

    def __init__(self, machine, s: State, ins: capstone.CsInsn):
        self.machine, self.s, self.ins, self.list = machine, s, ins, ins.operands

    def width(self, k: int) -> int:
        return 8 * self.list[k].size

    def is_memory(self, k: int) -> bool:
        return self.list[k].type == names.X86_OP_MEM

    def is_vector(self, k: int) -> bool:
        return self.list[k].type == names.X86_OP_REG and self.ins.reg_name(self.list[k].reg).startswith("xmm")

    def address(self, k: int) -> z3.BitVecRef:
        m, name = self.list[k].mem, self.ins.reg_name
        if m.segment:
            raise self.machine.undecided(self.s, "a segment register is used")
        total = z3.BitVecVal(m.disp, 64)
        if m.base:
            after = self.machine.in_image(self.ins.address + self.ins.size)
            total += after if name(m.base) == "rip" else self.s.register(name(m.base))
        return z3.simplify(total + self.s.register(name(m.index)) * m.scale if m.index else total)

    def get(self, k: int, width: int = 0) -> z3.BitVecRef:
        """The lowest `width` bits of operand `k`, or all bits."""
        op, width = self.list[k], width or self.width(k)
        if op.type == names.X86_OP_IMM:
            return z3.BitVecVal(op.imm, width)
        if op.type == names.X86_OP_MEM:
            self.check_alignment(k, width)
            return self.machine.load(self.s, self.address(k), width)
        return bits(self.s.register(self.ins.reg_name(op.reg)), 0, width)

    def check_alignment(self, k: int, width: int) -> None:
        if width == 128 and self.ins.mnemonic not in ("movups", "movupd", "movdqu"):
            self.machine.check_alignment(self.s, self.address(k))

    def both(self) -> tuple[z3.BitVecRef, z3.BitVecRef]:
        """Both operands, with the width of the first."""
        return self.get(0), self.get(1, self.width(0))

    def set(self, k: int, value: z3.BitVecRef) -> None:
        """Write operand `k`. In a vector register, bits above the width of `value` do not change."""
        name, real = "" if self.is_memory(k) else self.ins.reg_name(self.list[k].reg), self.machine.spec.width
        if not name:
            self.check_alignment(k, value.size())
            self.machine.store(self.s, self.address(k), z3.simplify(value))
        elif name.startswith("xmm") and value.size() == 128:  # a real and the bits above it
            self.s.write(name, 0, bits(value, 0, real))
            self.s.write(name, real // 8, bits(value, real, 128 - real))
        else:
            self.s.set_register(name, value)

    def condition(self, suffix: str) -> z3.BoolRef:
        """The condition of jcc, setcc and cmovcc."""
        known, name = self.s.flags(), OPPOSITE.get(suffix, suffix)
        if name not in known:
            raise self.machine.undecided(self.s, "this mnemonic, or the flag that it reads, is not known")
        return z3.simplify(z3.Not(known[name]) if suffix in OPPOSITE else known[name])


def _compare(o: Operands, a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BitVecRef:
    """Set the flags of a - b, and return a - b."""
    o.s.flags = lambda: {
        "e": a == b, "b": z3.ULT(a, b), "be": z3.ULE(a, b), "l": a < b, "le": a <= b, "s": a - b < 0,
        "o": (a < b) != (a - b < 0),
    }  # fmt: skip
    return a - b


def _compare_reals(o: Operands, a: z3.BitVecRef, b: z3.BitVecRef) -> None:
    nan = reals.unordered(a, b)
    o.s.flags = lambda: {"p": nan, "e": z3.Or(nan, reals.equal(a, b)), "b": z3.Or(nan, reals.less(a, b)),
                         "be": z3.Or(nan, reals.less(a, b), reals.equal(a, b))}  # fmt: skip


def _logic(o: Operands, result: z3.BitVecRef) -> z3.BitVecRef:
    """Set the flags of result - 0."""
    return _compare(o, result, z3.BitVecVal(0, result.size()))


def _sum(o: Operands, result: z3.BitVecRef) -> z3.BitVecRef:
    """Set only the flags of a sum or shift that depend on the result."""
    o.s.flags = lambda: {"e": result == 0, "s": result < 0}
    return result


def _multiply(o: Operands) -> None:
    if len(o.list) == 1:
        raise o.machine.undecided(o.s, "imul with one operand is not supported")
    a, b = o.both() if len(o.list) == 2 else (o.get(1), o.get(2, o.width(0)))
    o.set(0, reals.product(a, b))
    o.s.flags = dict


def _shift(o: Operands, work: Callable) -> None:
    by = o.list[1].imm if len(o.list) == 2 and o.list[1].type == names.X86_OP_IMM else 1 if len(o.list) == 1 else 0
    if not 0 < by < o.width(0):
        raise o.machine.undecided(o.s, "a shift by a number that is 0 or not constant")
    o.set(0, _sum(o, work(o.get(0), z3.BitVecVal(by, o.width(0)))))


def _move(o: Operands, width: int, clears: bool) -> None:
    """Move a real or bits. A load clears the upper bits of a vector register. A move between registers may keep them."""
    value = o.get(1, width)
    o.set(0, z3.ZeroExt(128 - width, value) if o.is_vector(0) and (clears or o.is_memory(1)) else value)


def _extend(o: Operands, how: Callable) -> None:
    o.set(0, how(o.width(0) - o.width(1), o.get(1)))


def _leave(o: Operands) -> None:
    o.s.set_register("rsp", o.s.register("rbp"))
    o.s.set_register("rbp", o.machine.pop(o.s))


def _pop(o: Operands) -> None:
    value = o.machine.pop(o.s)
    if o.is_memory(0):
        raise o.machine.undecided(o.s, "pop to memory is not supported")
    o.set(0, value)


ACTIONS: dict[str, Callable[[Operands], None]] = {
    "add": lambda o: o.set(0, _sum(o, o.get(0) + o.get(1, o.width(0)))),
    "inc": lambda o: o.set(0, _sum(o, o.get(0) + 1)),
    "dec": lambda o: o.set(0, _sum(o, o.get(0) - 1)),
    "sub": lambda o: o.set(0, _compare(o, *o.both())),
    "neg": lambda o: o.set(0, _compare(o, z3.BitVecVal(0, o.width(0)), o.get(0))),
    "cmp": lambda o: _compare(o, *o.both()),
    "and": lambda o: o.set(0, _logic(o, o.get(0) & o.get(1, o.width(0)))),
    "or": lambda o: o.set(0, _logic(o, o.get(0) | o.get(1, o.width(0)))),
    "xor": lambda o: o.set(0, _logic(o, o.get(0) ^ o.get(1, o.width(0)))),
    "test": lambda o: _logic(o, o.get(0) & o.get(1, o.width(0))),
    "not": lambda o: o.set(0, ~o.get(0)),
    "imul": _multiply,
    "shl": lambda o: _shift(o, lambda a, by: a << by),
    "sar": lambda o: _shift(o, lambda a, by: a >> by),
    "shr": lambda o: _shift(o, z3.LShR),
    "mov": lambda o: o.set(0, o.get(1, o.width(0))),
    "movabs": lambda o: o.set(0, o.get(1)),
    "movzx": lambda o: _extend(o, z3.ZeroExt),
    "movsx": lambda o: _extend(o, z3.SignExt),
    "movsxd": lambda o: _extend(o, z3.SignExt),
    "cdqe": lambda o: o.s.set_register("rax", z3.SignExt(32, o.s.register("eax"))),
    "lea": lambda o: o.set(0, bits(o.address(1), 0, o.width(0))),
    "push": lambda o: o.machine.push(o.s, o.get(0, 64)),
    "pop": _pop,
    "leave": _leave,
    "nop": lambda o: None,
    "endbr64": lambda o: None,
    "movsd": lambda o: _move(o, 64, False),
    "movss": lambda o: _move(o, 32, False),
    "movq": lambda o: _move(o, 64, True),
    "movd": lambda o: _move(o, 32, True),
}
ACTIONS |= dict.fromkeys(["movapd", "movaps", "movupd", "movups", "movdqa", "movdqu"], lambda o: o.set(0, o.get(1, 128)))

for _c in CONDITIONS:
    ACTIONS["set" + _c] = lambda o, c=_c: o.set(0, z3.If(o.condition(c), z3.BitVecVal(1, 8), z3.BitVecVal(0, 8)))
    ACTIONS["cmov" + _c] = lambda o, c=_c: o.set(0, z3.If(o.condition(c), o.get(1), o.get(0)))

_BITWISE = {"and": lambda a, b: a & b, "andn": lambda a, b: ~a & b, "or": lambda a, b: a | b, "xor": lambda a, b: a ^ b}
for _name, _work in _BITWISE.items():
    _vector = lambda o, work=_work: o.set(0, work(*o.both()))
    ACTIONS |= dict.fromkeys([_name + "pd", _name + "ps", "p" + _name], _vector)

_ORDERS = {
    "eq": reals.equal, "lt": reals.less, "unord": reals.unordered,
    "le": lambda a, b: z3.Or(reals.less(a, b), reals.equal(a, b)),
}  # fmt: skip
_NEGATED = {"eq": "neq", "lt": "nlt", "le": "nle", "unord": "ord"}
_ON_REALS = {name: lambda a, b, name=name: reals.arithmetic(name, a, b) for name in ("add", "sub", "mul", "div")} | {
    "min": lambda a, b: z3.If(reals.less(a, b), a, b),  # the second operand if both are equal or one is NaN
    "max": lambda a, b: z3.If(reals.less(b, a), a, b),
}
for _name, _order in _ORDERS.items():
    _ON_REALS["cmp" + _name] = lambda a, b, order=_order: z3.If(order(a, b), ~(a ^ a), a ^ a)
    _ON_REALS["cmp" + _NEGATED[_name]] = lambda a, b, order=_order: z3.If(order(a, b), a ^ a, ~(a ^ a))
for _end, _width in (("sd", 64), ("ss", 32)):
    for _name, _work in _ON_REALS.items():
        ACTIONS[_name + _end] = lambda o, work=_work, w=_width: o.set(0, work(o.get(0, w), o.get(1, w)))
    _reals = lambda o, w=_width: _compare_reals(o, o.get(0, w), o.get(1, w))
    ACTIONS |= dict.fromkeys(["comi" + _end, "ucomi" + _end], _reals)
    ACTIONS["cvtsi2" + _end] = lambda o, w=_width: o.set(0, reals.from_integer(o.get(1), w))
