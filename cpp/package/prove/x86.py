"""The effects of x86-64 instructions on a state, by the names of encoding.py."""

from typing import Callable

import z3

from . import reals
from .encoding import Instruction, Operand
from .state import State, bits


class Operands:
    """The operands of one instruction, read and written in a state."""

    def __init__(self, machine, s: State, ins: Instruction):
        self.machine, self.s, self.ins, self.list = machine, s, ins, ins.operands

    def width(self, k: int) -> int:
        return self.list[k].width

    def address(self, op: Operand) -> z3.BitVecRef:
        total = self.machine.in_image(op.number) if op.base == "rip" else z3.BitVecVal(op.number, 64)
        total = total + self.s.register(op.base) if op.base not in ("", "rip") else total
        total = z3.simplify(total + self.s.register(op.index) * op.scale if op.index else total)
        if op.is_aligned:
            self.machine.check_alignment(self.s, total)
        return total

    def get(self, k: int) -> z3.BitVecRef:
        op = self.list[k]
        if op.where == "number":
            return z3.BitVecVal(op.number, op.width)
        if op.where == "memory":
            return self.machine.load(self.s, self.address(op), op.width)
        if op.where == "guard":
            return self.machine.guard
        return self.s.value(op.where, op.first, op.width // 8)

    def both(self) -> tuple[z3.BitVecRef, z3.BitVecRef]:
        """The last two operands."""
        return self.get(-2), self.get(-1)

    def set(self, value: z3.BitVecRef) -> None:
        """Write the first operand. Above a real, a vector gets the bits of the second operand."""
        to, size, real = self.list[0], value.size() // 8, self.machine.spec.width
        if to.where == "memory":
            return self.machine.store(self.s, self.address(to), z3.simplify(value))
        if not to.where.startswith("xmm"):
            return self.s.write(to.where, to.first, z3.ZeroExt(32, value) if size == 4 else value)
        if size < 16 and self.list[1].where != to.where:
            value = z3.Concat(self.s.value(self.list[1].where, size, 16 - size), value)
        if value.size() < 128:
            return self.s.write(to.where, 0, value)
        self.s.write(to.where, 0, bits(value, 0, real))
        self.s.write(to.where, real // 8, bits(value, real, 128 - real))

    def holds(self, claim: z3.BoolRef) -> bool:
        """Whether a condition holds. Each instruction asks before it writes. See Machine.decide."""
        return self.machine.decide(self.s, claim)

    def condition(self) -> bool:
        """Whether the condition of jcc, setcc or cmovcc holds."""
        known = self.s.flags.get(("o", "b", "e", "be", "s", "p", "l", "le")[self.ins.condition // 2])
        if known is None:
            raise self.machine.undecided(self.s, "the flag that the instruction reads is not known")
        return self.holds(known()) != bool(self.ins.condition % 2)


def _compare(o: Operands, a: z3.BitVecRef, b: z3.BitVecRef) -> z3.BitVecRef:
    """Set the flags of a - b, and return a - b."""
    o.s.flags = {
        "e": lambda: a == b, "b": lambda: z3.ULT(a, b), "be": lambda: z3.ULE(a, b), "l": lambda: a < b,
        "le": lambda: a <= b, "s": lambda: a - b < 0, "o": lambda: (a < b) != (a - b < 0),
    }  # fmt: skip
    return a - b


def _compare_reals(o: Operands) -> None:
    a, b = o.both()
    nan = lambda: reals.unordered(a, b)
    o.s.flags = {"p": nan, "e": lambda: z3.Or(nan(), reals.equal(a, b)), "b": lambda: z3.Or(nan(), reals.less(a, b)),
                 "be": lambda: z3.Not(reals.less(b, a))}  # fmt: skip


def _logic(o: Operands, result: z3.BitVecRef) -> z3.BitVecRef:
    """Set the flags of result - 0."""
    return _compare(o, result, z3.BitVecVal(0, result.size()))


def _sum(o: Operands, result: z3.BitVecRef) -> z3.BitVecRef:
    """Set only the flags of a sum or shift that depend on the result."""
    o.s.flags = {"e": lambda: result == 0, "s": lambda: result < 0}
    return result


def _multiply(o: Operands) -> None:
    o.set(reals.product(*o.both()))
    o.s.flags = {}


def _shift(o: Operands, work: Callable) -> None:
    by = o.list[1].number if len(o.list) == 2 else 1
    if not 0 < by < o.width(0):
        raise o.machine.undecided(o.s, "a shift by a number that is not from 1 to the operand's width")
    o.set(_sum(o, work(o.get(0), z3.BitVecVal(by, o.width(0)))))


def _leave(o: Operands) -> None:
    o.s.set_register("rsp", o.s.register("rbp"))
    o.s.set_register("rbp", o.machine.pop(o.s))


def _select(o: Operands) -> None:
    """Each half from the third operand if the sign bit of the last operand's half is 1, else from the second."""
    a, b, mask = o.get(1), o.get(2), o.get(3)
    low = bits(b if o.holds(bits(mask, 0, 64) < 0) else a, 0, 64)
    o.set(z3.Concat(z3.If(mask < 0, bits(b, 64, 64), bits(a, 64, 64)), low))


_BITWISE = {"and": lambda a, b: a & b, "andn": lambda a, b: ~a & b, "or": lambda a, b: a | b, "xor": lambda a, b: a ^ b}
_ORDERS = [reals.equal, reals.less, lambda a, b: z3.Or(reals.less(a, b), reals.equal(a, b)), reals.unordered]


def _compare_to_mask(o: Operands) -> None:
    """All bits 1 if the order holds, else 0. Orders from 4 on are the negated orders from 0 on."""
    a, b, order = o.get(1), o.get(2), o.list[3].number
    if not 0 <= order < 8:
        raise o.machine.undecided(o.s, "a comparison that only the VEX form has")
    is_so = o.holds(_ORDERS[order % 4](a, b)) != (order >= 4)
    o.set(z3.BitVecVal(-is_so, a.size()))


ACTIONS: dict[str, Callable[[Operands], None]] = {
    "add": lambda o: o.set(_sum(o, o.get(0) + o.get(1))),
    "inc": lambda o: o.set(_sum(o, o.get(0) + 1)),
    "dec": lambda o: o.set(_sum(o, o.get(0) - 1)),
    "sub": lambda o: o.set(_compare(o, *o.both())),
    "neg": lambda o: o.set(_compare(o, z3.BitVecVal(0, o.width(0)), o.get(0))),
    "cmp": lambda o: _compare(o, *o.both()),
    "test": lambda o: _logic(o, o.get(0) & o.get(1)),
    "not": lambda o: o.set(~o.get(0)),
    "imul": _multiply,
    "shl": lambda o: _shift(o, lambda a, by: a << by),
    "sar": lambda o: _shift(o, lambda a, by: a >> by),
    "shr": lambda o: _shift(o, z3.LShR),
    "mov": lambda o: o.set(z3.ZeroExt(o.width(0) - o.width(1), o.get(1))),
    "movsx": lambda o: o.set(z3.SignExt(o.width(0) - o.width(1), o.get(1))),
    "cdqe": lambda o: o.s.set_register("rax", z3.SignExt(32, o.s.value("rax", 0, 4))),
    "lea": lambda o: o.set(bits(o.address(o.list[1]), 0, o.width(0))),
    "push": lambda o: o.machine.push(o.s, o.get(0)),
    "pop": lambda o: o.set(o.machine.pop(o.s)),
    "leave": _leave,
    "nop": lambda o: None,
    "set": lambda o: o.set(z3.BitVecVal(o.condition(), 8)),
    "cmov": lambda o: o.set(o.both()[o.condition()]),
    "merge": lambda o: o.set(o.get(2)),
    "double": lambda o: o.set(z3.Concat(o.get(1), o.get(1))),
    "select": _select,
    "order": _compare_reals,
    "reals cmp": _compare_to_mask,
    "reals min": lambda o: o.set(o.both()[not o.holds(reals.less(*o.both()))]),  # the second if both are equal or one is NaN
    "reals max": lambda o: o.set(o.both()[not o.holds(reals.less(*reversed(o.both())))]),
    "real": lambda o: o.set(reals.from_integer(o.get(2), o.width(0))),
}
for _name in ("add", "sub", "mul", "div"):
    ACTIONS["reals " + _name] = lambda o, name=_name: o.set(reals.arithmetic(name, *o.both()))
for _name, _work in _BITWISE.items():
    ACTIONS[_name] = lambda o, work=_work: o.set(_logic(o, work(*o.both())))
    ACTIONS["bits " + _name] = lambda o, work=_work: o.set(work(*o.both()))
