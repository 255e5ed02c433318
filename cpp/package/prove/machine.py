"""Symbolic execution of one function: memory in regions that do not overlap, branches, and calls."""

import sys
from typing import Iterator

import capstone
import z3

from . import Undecided, runtime, x86
from .elf import Image
from .encoding import Instruction, decode
from .reals import EFFORT, follows
from .specification import Position, Specification
from .state import State, condition_of

LONGEST_PATH = 4000  # instructions from one loop head to the next
RED_ZONE = 128  # bytes below the stack pointer that no signal handler overwrites
FRAME = 64 * 1024  # bytes of the stack that a call may use
ARRAYS = ["DD", "DTEST", "CC", "SS", "ID", "ISEP", "ISURF", "EVENTS"]
CELLS = ["STACK", "IMAGE", "CALL", "SMIN", "NC"]  # regions in which offsets are constants
BASE = {name: z3.BitVec(name, 64) for name in [*ARRAYS, *CELLS]}
RETURN = z3.BitVec("return", 64)
sys.setrecursionlimit(20_000)  # Machine.cuts calls itself for each instruction


class NewCut(Exception):
    """A path must be cut at an address that was found on it."""


class Split(Exception):
    """A condition that a path does not determine."""

    def __init__(self, condition: z3.BoolRef):
        self.condition = condition


class Machine:
    """The data that all states of a proof use: the file, the arrays, and Z3."""

    def __init__(self, image: Image, spec: Specification):
        self.image, self.spec = image, spec
        self.output: tuple[str, int] = ("", 0)  # place of SMIN, the only written argument that is not an array
        self.constants: set[int] = set()  # constants in the function's code
        self.starting = False  # True for initialisers, which may write static data
        self.questions = self.paths = self._names = 0
        self.guard = z3.BitVec("guard", 64)  # of -fstack-protector: the loader sets it once
        self.at, self.facts = None, None
        self.cuts: set[int] = set()  # addresses that cut every loop
        self.order: dict[int, int] = {}  # of each instruction, the place in a depth-first search; the entry is last
        self._is_element: dict[tuple, tuple[bool, list]] = {}  # with the terms, whose numbers are in the key
        self._of_numbers: dict[int, tuple[z3.BoolRef, bool]] = {}
        self._solvers: dict[int, tuple[list[z3.BoolRef], z3.Solver, set[int]]] = {}  # by the list of facts, with the told pairs
        self._located: dict[int, tuple[z3.BitVecRef, tuple[str, z3.BitVecRef | int]]] = {}
        self._decoded: dict[int, Instruction] = {}

    # Questions to Z3.

    def begin(self, at: Position, facts: list[z3.BoolRef]) -> None:
        """Set the position of the listing at which the next paths begin, and the facts that hold."""
        self.at, self.facts = at, facts
        if id(facts) not in self._solvers:
            solver = z3.SimpleSolver()
            solver.set("rlimit", EFFORT)
            solver.add(*facts)
            self._solvers[id(facts)] = facts, solver, set()
        _, self.solver, self.told = self._solvers[id(facts)]

    def _tell(self, k: int, i: z3.BitVecRef) -> None:
        """Add the preconditions for the path's pair `k` once a path uses it: fewer facts make Z3 quicker."""
        if k not in self.told:
            self.told.add(k)
            self.solver.add(*self.spec.of_pair(i))

    def possible(self, s: State, claim: z3.BoolRef) -> bool:
        """Whether `claim` can hold on this path."""
        return not self.holds(s, z3.Not(claim))

    def holds(self, s: State, claim: z3.BoolRef) -> bool:
        """Whether `claim` must hold on this path."""
        claim = z3.simplify(claim)
        if z3.is_true(claim) or z3.is_false(claim):
            return z3.is_true(claim)
        if claim.get_id() not in s.known:
            if any(told == len(self.told) and z3.is_false(model.eval(claim, True)) for told, model in s.models):
                return False
            self.questions += 1
            answer = self.solver.check(*s.path, z3.simplify(z3.Not(claim)))
            if answer == z3.unknown:
                raise self.undecided(s, "Z3 gave no answer")
            if answer == z3.sat:
                s.models = [*s.models[-3:], (len(self.told), self.solver.model())]
            s.known[claim.get_id()] = claim, answer == z3.unsat
        return s.known[claim.get_id()][1]

    def decide(self, s: State, claim: z3.BoolRef, others: list[tuple[z3.BoolRef, z3.BoolRef]] = [], lemmas: list[z3.BoolRef] = []) -> bool:
        """Whether `claim` holds on this path. Raises Split if it may or may not hold. `others`: conditions, and the claims
        that then are the same as `claim`; `lemmas` are always true."""
        claim = z3.simplify(claim)
        answer = self._is_written(s, claim)
        for condition, other in others if answer is None else []:
            found = self._is_written(s, z3.simplify(other))
            if found is not None and not self.holds(s, z3.Not(condition)):
                if not self.holds(s, condition):
                    raise Split(z3.simplify(condition))
                answer = found
        if answer is None and others:
            s.path += lemmas
            s.models = []
        if answer is None:
            answer = True if self.holds(s, claim) else False if self.holds(s, z3.Not(claim)) else None
        if answer is None:
            raise Split(claim)
        return answer

    def _is_written(self, s: State, claim: z3.BoolRef) -> bool | None:
        """Whether the conditions of this path have the claim, or its opposite; None if they have neither."""
        for term, answer in ((claim, True), (z3.simplify(z3.Not(claim)), False)):
            if s.known.get(term.get_id(), (None, False))[1]:
                return answer
        return None

    def same(self, s: State, a: z3.BitVecRef, b: z3.BitVecRef) -> bool:
        return a.eq(b) or (a.size() == b.size() and self.holds(s, a == b))

    def fresh(self, width: int) -> z3.BitVecRef:
        """An unknown value."""
        self._names += 1
        return z3.BitVec(f"unknown {self._names}", width)

    def undecided(self, s: State, why: str) -> Undecided:
        why, code = " ".join(why.split())[:300], self.image.code_at(s.pc)  # Z3 writes long terms in many lines
        text = next(capstone.Cs(capstone.CS_ARCH_X86, capstone.CS_MODE_64).disasm_lite(code, s.pc, 1), (0, 0, code.hex(" "), ""))
        return Undecided(f"{self.image.path}, at {s.pc:#x} `{' '.join(text[2:])}`: {why}")

    # Addresses.

    def in_image(self, address: int) -> z3.BitVecRef:
        return z3.simplify(BASE["IMAGE"] + address)

    def locate(self, s: State, address: z3.BitVecRef) -> tuple[str, z3.BitVecRef | int]:
        """The region of an address, and the offset from its first byte: a constant, except in arrays."""
        if address.get_id() not in self._located:  # with the term, whose number is the key
            self._located[address.get_id()] = address, self._locate(s, z3.simplify(address))
        return self._located[address.get_id()][1]

    def _locate(self, s: State, address: z3.BitVecRef) -> tuple[str, z3.BitVecRef | int]:
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
            i = z3.simplify(self.at.i + k)
            if self._stands_at(s, array, i, offset) and self.holds(s, z3.ULT(i, self.spec.pairs)):
                s.pairs |= {k} if array == "SS" else set()
                self._tell(k, i)
                return k
        if array == "SS" and self.at.loop == 1 and s.pc not in self.cuts and self._stands_at(s, array, z3.BitVecVal(0, 64), offset):
            self.cuts.add(s.pc)  # DO 30 begins here, without the head of a loop before it
            raise NewCut
        raise self.undecided(s, f"a subscript of {array} that is not that of the next pair: {offset}")

    def _stands_at(self, s: State, array: str, i: z3.BitVecRef, offset: z3.BitVecRef) -> bool:
        """True if pair `i`'s element has this offset and is inside the array, provided that the pair exists. The answer
        depends only on facts about the call's numbers, not on arrays, so that it can be stored."""
        index, known = self.spec.index(array, i), list(filter(self._is_of_numbers, [*self.facts, *s.path]))
        place = z3.simplify(index * (self.spec.widths[array] // 8))
        key = (array, *(term.get_id() for term in (offset, place, *known)))
        if key not in self._is_element:
            more = [*self.spec.of_call(), *self.spec.of_pair(i), z3.ULT(i, self.spec.pairs)]
            right = z3.And(offset == place, z3.ULT(index, self.spec.length(array)))
            self._is_element[key] = follows(right, *known, *more), [offset, place, *known]
        return self._is_element[key][0]

    def _is_of_numbers(self, fact: z3.BoolRef) -> bool:
        """True if a fact has no symbols but NC, INDOF, NDOFPN, the arrays' lengths and I."""
        if fact.get_id() not in self._of_numbers:
            answer = symbols(fact).isdisjoint({"()", "unknown", "smin", "toggled"})
            self._of_numbers[fact.get_id()] = fact, answer
        return self._of_numbers[fact.get_id()][1]

    def _event(self, s: State, offset: z3.BitVecRef) -> int:
        """The number of the 32-bit half of an event at an offset, counted from the path's first event."""
        for k in range(2 * len(s.pairs)):
            if self.same(s, offset, z3.ZeroExt(32, self.at.toggled) * 8 + 4 * k):
                return k
        raise self.undecided(s, f"an event that is not the next: {offset}")

    # Memory.

    def load(self, s: State, address: z3.BitVecRef, width: int) -> z3.BitVecRef:
        region, offset = self.locate(s, address)
        if region == "EVENTS":
            raise self.undecided(s, f"{region} is read")
        if region in ARRAYS:
            k = self.element(s, region, offset, width)
            if region == "SS" and self.at.loop == 1:  # not written yet: the caller's value
                return s.elements.get((region, k), self.fresh(width))
            return s.elements.get((region, k), self.spec.element(region, self.at.i + k))
        value = s.read(region, offset, width // 8)
        return self._initial(s, region, offset, width) if value is None else value

    def _initial(self, s: State, region: str, offset: int, width: int) -> z3.BitVecRef:
        """The value at a place to which this call has not written."""
        if region == "STACK" and offset < 0:
            s.write(region, offset, self.fresh(width))
            return s.read(region, offset, width // 8)
        if region != "IMAGE":
            raise self.undecided(s, f"{region} is read at {offset}, which is no argument")
        target, size = self.image.relocations.get(offset), width // 8
        if width == 64 and isinstance(target, str):
            return z3.BitVec("extern " + target, 64)
        if width == 64 and target is not None and self.image.is_constant(offset):
            return self.in_image(target)
        held = self.image.constant(offset, size)
        if held is None and self.starting:
            return self.fresh(width)
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

    def find_cuts(self, at: int, above: set[int] | None = None) -> None:
        """Find addresses that cut every loop: the targets of back edges in a depth-first search."""
        above = set() if above is None else above
        if at in above:
            self.cuts.add(at)
        elif at not in self.order:
            above.add(at)
            for to in self._next(at):
                self.find_cuts(to, above)
            above.remove(at)
            self.order[at] = len(self.order)

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
            s.choices, top = [], s.cells.get(("rsp", 0))
            for end in self._step(s):
                if end.cells.get(("rsp", 0)) is not top:
                    self._forget(end)
                waiting.append(end)

    def _forget(self, s: State) -> None:
        """Forget what is below the red zone, where a signal handler may write."""
        least = self.stack_offset(s, "rsp") - RED_ZONE
        for region, at in [place for place in s.cells if place[0] == "STACK" and place[1] < least]:
            del s.cells[region, at]

    def _step(self, s: State) -> list[State]:
        ins = self.instruction(s.pc)
        self.constants |= {op.number % (1 << op.width) for op in ins.operands if op.where == "number" and not op.base}
        o, after = x86.Operands(self, s, ins), ins.address + ins.size
        if ins.name in ("call", "jmp"):
            target = self.in_image(ins.operands[0].number) if ins.operands[0].where == "number" else o.get(0)
            if ins.name == "call":
                self.push(s, self.in_image(after))
            return self._go(s, target)
        if ins.name == "j":
            return self._branch(s, o.condition(), ins.operands[0].number, after)
        if ins.name == "ret":
            return self._go(s, self.pop(s))
        if not ins.name:
            raise self.undecided(s, "this encoding is not known")
        x86.ACTIONS[ins.name](o)
        s.pc = after
        return self._choose(s)

    def _choose(self, s: State) -> list[State]:
        """A path for each answer to the conditions on which the values of this instruction depend, as if it were a
        branch."""
        chosen, s.choices = [key for key in s.choices if key in s.cells and condition_of(s.cells[key]) is not None], []
        if not chosen:
            return [s]
        condition, after = condition_of(s.cells[chosen[0]]), []
        for claim, answer in ((condition, True), (z3.simplify(z3.Not(condition)), False)):
            if self.possible(s, claim):
                end = s.branch(s.pc, claim)
                for key in chosen:
                    end.write(*key, z3.substitute(end.cells[key], (condition, z3.BoolVal(answer))))
                after += self._choose(end)
        return after

    def _branch(self, s: State, condition: z3.BoolRef, to: int, after: int) -> list[State]:
        if z3.is_true(condition) or z3.is_false(condition):
            s.pc = to if z3.is_true(condition) else after
            return [s]
        opposite, ends = z3.simplify(z3.Not(condition)), []
        if self.possible(s, condition):
            ends.append(s.branch(to, condition))
        if not ends or self.possible(s, opposite):  # one of them is possible on every path
            ends.append(s.branch(after, opposite))
        return ends

    def _go(self, s: State, target: z3.BitVecRef) -> list[State]:
        """Jump to an address of the file, return to the caller, or call the run-time library."""
        name = target.decl().name()
        if name.startswith("extern "):
            runtime.call(self, s, name.removeprefix("extern "))
            return self._go(s, self.pop(s))
        if target.eq(RETURN):
            s.pc = 0
            return [s]
        region, place = self.locate(s, target)
        if region != "IMAGE":
            raise self.undecided(s, f"the target of the jump is not known: {target}")
        s.pc = place
        return [s]


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
