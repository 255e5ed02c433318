"""Symbolic execution of one function: memory in regions that do not overlap, branches, and calls."""

import functools
import sys
from typing import Iterator

import capstone
import z3

from . import Undecided, runtime, x86
from .elf import Image
from .encoding import Instruction, decode
from .reals import follows
from .specification import Specification
from .state import Start, State, fresh

LONGEST_PATH = 4000  # instructions from one loop head to the next
RED_ZONE = 128  # bytes below the stack pointer that no signal handler overwrites
FRAME = 64 * 1024  # bytes of the stack that a call may use
ARRAYS = ["DD", "DTEST", "CC", "SS", "ID", "ISEP", "ISURF", "EVENTS"]
CELLS = ["STACK", "IMAGE", "CALL", "SMIN", "NC"]  # regions in which offsets are constants
BASE = {name: z3.BitVec(name, 64) for name in [*ARRAYS, *CELLS]}
RETURN = z3.BitVec("return", 64)
sys.setrecursionlimit(20_000)  # Machine.find_cuts calls itself for each instruction


class Split(Exception):
    """A condition that a path does not determine."""

    def __init__(self, condition: z3.BoolRef):
        self.condition = condition


class Machine:
    """The data that all states of a proof use: the file, the arrays, and Z3."""

    def __init__(self, image: Image, spec: Specification, starting: bool = False):
        self.image, self.spec = image, spec
        self.output: tuple[str, int] = ("", 0)  # place of SMIN, the only written argument that is not an array
        self.constants: set[int] = set()  # constants in the function's code
        self.starting = starting  # True for initialisers, which may write static data
        self.questions = self.paths = 0
        self.guard = z3.BitVec("guard", 64)  # of -fstack-protector: the loader sets it once
        self.cuts: set[int] = set()  # addresses that cut every loop
        self._seen: set[int] = set()  # by find_cuts
        self._decoded: dict[int, Instruction] = {}

    # Questions to Z3.

    def _tell(self, start: Start, k: int, i: z3.BitVecRef) -> None:
        """Add the preconditions for the path's pair `k` once a path uses it: fewer facts make Z3 quicker."""
        if k not in start.told:
            start.told.add(k)
            start.solver.add(*self.spec.of_pair(i))

    def holds(self, s: State, claim: z3.BoolRef) -> bool:
        """Whether `claim` must hold on this path."""
        claim = z3.simplify(claim)
        if z3.is_true(claim) or z3.is_false(claim):
            return z3.is_true(claim)
        if claim.get_id() not in s.known:
            if any(told == len(s.start.told) and z3.is_false(model.eval(claim, True)) for told, model in s.models):
                return False
            self.questions += 1
            answer = s.start.solver.check(*s.path, z3.simplify(z3.Not(claim)))
            if answer == z3.unknown:
                raise self.undecided(s, "Z3 gave no answer")
            if answer == z3.sat:
                s.models = [*s.models[-3:], (len(s.start.told), s.start.solver.model())]
            s.known[claim.get_id()] = claim, answer == z3.unsat
        return s.known[claim.get_id()][1]

    def decide(self, s: State, claim: z3.BoolRef, others: list[tuple[z3.BoolRef, z3.BoolRef]] = [], lemmas: list[z3.BoolRef] = []) -> bool:
        """Whether `claim` holds on this path. Raises Split if it may or may not hold. `others`: conditions, and the claims
        that then are the same as `claim`; `lemmas` are always true."""
        if others and _written(s, claim) is None:
            for condition, other in others:
                answer = _written(s, other)
                if answer is not None and self.decide(s, condition):
                    return answer
            s.learn(*lemmas)
        for answer in (True, False):
            if self.holds(s, claim if answer else z3.Not(claim)):
                return answer
        raise Split(z3.simplify(claim))

    def same(self, s: State, a: z3.BitVecRef, b: z3.BitVecRef) -> bool:
        return a.eq(b) or (a.size() == b.size() and self.holds(s, a == b))

    def undecided(self, s: State, why: str) -> Undecided:
        why, code = " ".join(why.split())[:300], self.image.code_at(s.pc)  # Z3 writes long terms in many lines
        text = next(capstone.Cs(capstone.CS_ARCH_X86, capstone.CS_MODE_64).disasm_lite(code, s.pc, 1), (0, 0, code.hex(" "), ""))
        return Undecided(f"{self.image.path}, at {s.pc:#x} `{' '.join(text[2:])}`: {why}")

    # Addresses.

    def in_image(self, address: int) -> z3.BitVecRef:
        return z3.simplify(BASE["IMAGE"] + address)

    def locate(self, s: State, address: z3.BitVecRef) -> tuple[str, z3.BitVecRef | int]:
        """The region of an address, and the offset from its first byte: a constant, except in arrays."""
        address = z3.simplify(address)
        for term in address.children() if address.decl().kind() == z3.Z3_OP_BADD else [address]:
            name = term.decl().name() if z3.is_const(term) else ""
            if name not in BASE:
                continue
            offset = z3.simplify(address - term)
            if name in ARRAYS:
                return name, offset
            if z3.is_bv_value(offset):
                if name == "STACK" and offset.as_signed_long() < -FRAME:
                    raise self.undecided(s, f"more than {FRAME} bytes of the stack are used")
                return name, offset.as_signed_long()
        raise self.undecided(s, f"an address that is not known to be in one region: {address}")

    def stack_offset(self, s: State, register: str) -> int:
        region, offset = self.locate(s, s.register(register))
        if region != "STACK":
            raise self.undecided(s, f"{register} points to {region}, not to the stack")
        return offset

    def element(self, s: State, array: str, offset: z3.BitVecRef, width: int) -> int:
        """The pair whose element is at an offset, counted from the path's first pair. Raises Undecided for another
        offset."""
        if width != self.spec.widths[array]:
            raise self.undecided(s, f"{width} bits of {array}, whose elements have {self.spec.widths[array]}")
        for k in range(len(s.pairs) + 1):
            i = z3.simplify(s.start.at.i + k)
            if self._stands_at(s, array, i, offset) and self.holds(s, z3.ULT(i, self.spec.pairs)):
                s.pairs |= {k} if array == "SS" else set()
                self._tell(s.start, k, i)
                return k
        raise self.undecided(s, f"a subscript of {array} that is not that of the next pair: {offset}")

    def _stands_at(self, s: State, array: str, i: z3.BitVecRef, offset: z3.BitVecRef) -> bool:
        """True if pair `i`'s element has this offset and is inside the array, provided that the pair exists. Only facts
        about the call's numbers, not about arrays, are used: with others Z3 gives no answer."""
        index = self.spec.index(array, i)
        right = z3.And(offset == index * (self.spec.widths[array] // 8), z3.ULT(index, self.spec.length(array)))
        known = filter(is_of_numbers, [*s.start.facts, *s.path])
        return follows(right, *known, *self.spec.of_pair(i), z3.ULT(i, self.spec.pairs))

    def _event(self, s: State, offset: z3.BitVecRef) -> int:
        """The number of the 32-bit half of an event at an offset, counted from the path's first event."""
        for k in range(2 * len(s.pairs)):
            if self.same(s, offset, z3.ZeroExt(32, s.start.at.toggled) * 8 + 4 * k):
                return k
        raise self.undecided(s, f"an event that is not the next: {offset}")

    # Memory.

    def load(self, s: State, address: z3.BitVecRef, width: int) -> z3.BitVecRef:
        region, offset = self.locate(s, address)
        if region == "EVENTS":
            raise self.undecided(s, f"{region} is read")
        if region in ARRAYS:
            k = self.element(s, region, offset, width)
            if region == "SS" and s.start.at.loop == 1:  # not written yet: the caller's value
                return s.elements.get((region, k), fresh(width))
            return s.elements.get((region, k), self.spec.element(region, s.start.at.i + k))
        value = s.read(region, offset, width // 8)
        return self._initial(s, region, offset, width) if value is None else value

    def _initial(self, s: State, region: str, offset: int, width: int) -> z3.BitVecRef:
        """The value at a place to which this call has not written."""
        if region == "STACK" and offset < 0:
            return s.value(region, offset, width // 8)
        if region != "IMAGE":
            raise self.undecided(s, f"{region} is read at {offset}, which is no argument")
        target, size = self.image.relocations.get(offset), width // 8
        if width == 64 and isinstance(target, str):
            return z3.BitVec("extern " + target, 64)
        if width == 64 and target is not None and self.image.is_constant(offset, 8):
            return self.in_image(target)
        held = self.image.constant(offset, size)
        if held is None and self.starting:
            return fresh(width)
        if held is None:
            raise self.undecided(s, "static data is read that may have changed")
        self.constants.add(int.from_bytes(held, "little"))
        return z3.BitVecVal(int.from_bytes(held, "little"), width)

    def check_alignment(self, s: State, address: z3.BitVecRef) -> None:
        """Raise Undecided unless the address is a multiple of 16. On entry, 8 bytes above the stack pointer are."""
        region, offset = self.locate(s, address)
        if region not in ("STACK", "IMAGE") or (offset + 8 * (region == "STACK")) % 16:
            raise self.undecided(s, "the address is not known to be a multiple of 16")

    def store(self, s: State, address: z3.BitVecRef, value: z3.BitVecRef) -> None:
        region, offset = self.locate(s, address)
        size = value.size() // 8
        if region in ("SS", "ISEP"):
            s.elements[region, self.element(s, region, offset, value.size())] = value
        elif region == "EVENTS" and size in (4, 8):
            first = self._event(s, offset)
            s.elements |= {(region, first + k): z3.simplify(z3.Extract(32 * k + 31, 32 * k, value)) for k in range(size // 4)}
        elif (region, offset, size) == (*self.output, self.spec.width // 8):
            s.write(region, offset, value)
        elif region == "STACK" and (offset < 0 or s.read(region, offset, size) is not None):
            if offset < self.stack_offset(s, "rsp") - RED_ZONE:
                raise self.undecided(s, "a write below the red zone")
            s.write(region, offset, value)
        elif not (self.starting and region == "IMAGE" and self.image.is_free(offset, size)):
            raise self.undecided(s, f"{region} is written, which the function may not change")

    def push(self, s: State, value: z3.BitVecRef) -> None:
        s.set_register("rsp", s.register("rsp") - 8)
        self.store(s, s.register("rsp"), value)

    def pop(self, s: State) -> z3.BitVecRef:
        value = self.load(s, s.register("rsp"), 64)
        s.set_register("rsp", s.register("rsp") + 8)
        return value

    # Control.

    def instruction(self, address: int) -> Instruction:
        if address not in self._decoded:
            self._decoded[address] = decode(self.image.code_at(address), address)
        return self._decoded[address]

    def find_cuts(self, at: int, above: frozenset[int] = frozenset()) -> None:
        """Find addresses that cut every loop: the targets of back edges in a depth-first search."""
        if at in above:
            self.cuts.add(at)
        elif at not in self._seen:
            self._seen.add(at)
            for to in self._next(at):
                self.find_cuts(to, above | {at})

    def _next(self, address: int) -> list[int]:
        ins = self.instruction(address)
        if ins.name not in ("j", "jmp", "call"):
            return [] if ins.name in ("ret", "") else [address + ins.size]
        target = ins.operands[0]  # a number, or an entry of the linkage table
        to = target.number if target.where == "number" else self.image.relocations.get(target.number) if target.base == "rip" else None
        return ([to] if isinstance(to, int) else []) + ([address + ins.size] if ins.name != "jmp" else [])

    def explore(self, start: State) -> Iterator[State]:
        """Every path from `start` to a cut or to the end. At the end, pc is 0."""
        waiting = [start]
        while waiting:
            s = waiting.pop()
            if s.steps and (s.pc in self.cuts or s.pc == 0):
                self.paths += 1
                yield s
                continue
            s.steps += 1
            if s.steps > LONGEST_PATH:
                raise self.undecided(s, f"no end of the path after {LONGEST_PATH} instructions")
            top = s.cells.get(("rsp", 0))
            try:
                self._step(s)
            except Split as split:
                waiting += s.halves(split.condition)  # in which the instruction is executed again
                continue
            if s.cells.get(("rsp", 0)) is not top:
                self._forget(s)
            waiting.append(s)

    def _forget(self, s: State) -> None:
        """Forget what is below the red zone, where a signal handler may write."""
        least = self.stack_offset(s, "rsp") - RED_ZONE
        for region, at in [place for place in s.cells if place[0] == "STACK" and place[1] < least]:
            del s.cells[region, at]

    def _step(self, s: State) -> None:
        """Execute an instruction. Raises Split if it depends on a condition that the path does not determine."""
        ins = self.instruction(s.pc)
        self.constants |= {op.number % (1 << op.width) for op in ins.operands if op.where == "number" and not op.base}
        o, after = x86.Operands(self, s, ins), ins.address + ins.size
        if ins.name in ("call", "jmp"):
            target = self.in_image(ins.operands[0].number) if ins.operands[0].where == "number" else o.get(0)
            if ins.name == "call":
                self.push(s, self.in_image(after))
            self._go(s, target)
        elif ins.name == "j":
            s.pc = ins.operands[0].number if o.condition() else after
        elif ins.name == "ret":
            self._go(s, self.pop(s))
        elif not ins.name:
            raise self.undecided(s, "this encoding is not known")
        else:
            x86.ACTIONS[ins.name](o)
            s.pc = after

    def _go(self, s: State, target: z3.BitVecRef) -> None:
        """Jump to an address of the file, return to the caller, or call the run-time library."""
        name = target.decl().name()
        if name.startswith("extern "):
            runtime.call(self, s, name.removeprefix("extern "))
            target = self.pop(s)
        if target.eq(RETURN):
            s.pc = 0
            return
        region, place = self.locate(s, target)
        if region != "IMAGE":
            raise self.undecided(s, f"the target of the jump is not known: {target}")
        s.pc = place


def _written(s: State, claim: z3.BoolRef) -> bool | None:
    """Whether the conditions of a path have the claim, or its opposite; None if they have neither."""
    known = [s.known.get(z3.simplify(term).get_id(), (None, False))[1] for term in (claim, z3.Not(claim))]
    return known[0] if any(known) else None


def symbols(term: z3.ExprRef) -> set[str]:
    """The first words of the names of a term's symbols, and "()" if it has unknown functions."""
    found, seen, waiting = set(), set(), [term]
    while waiting:
        term = waiting.pop()
        if term.get_id() not in seen:
            seen.add(term.get_id())
            waiting += term.children()
            unknown = term.decl().kind() == z3.Z3_OP_UNINTERPRETED
            found |= {term.decl().name().split()[0] if term.num_args() == 0 else "()"} if unknown else set()
    return found


@functools.cache
def is_of_numbers(fact: z3.BoolRef) -> bool:
    """True if a fact has no symbols but NC, INDOF, NDOFPN, the arrays' lengths and I."""
    return symbols(fact).isdisjoint({"()", "unknown", "smin", "toggled"})
