"""Symbolic execution of one function: memory by regions that do not overlap, branches, calls."""

from typing import Iterator

import capstone
import z3
from capstone import x86 as names

from . import runtime, x86
from .elf import Image
from .specification import Position, Specification
from .state import State
from .undecided import Undecided

LONGEST_PATH = 4000  # instructions from one loop head to the next
RED_ZONE = 128  # bytes below the stack pointer that no signal handler overwrites
# Work of Z3 for a question, by its own count, so that no verdict depends on the machine's load: with what it has learnt
# from others, and then from the beginning, with all its means.
QUICK, THOROUGH = 1_000_000, 100_000_000

ARRAYS = ["DD", "DTEST", "CC", "SS", "ID", "ISEP", "ISURF"]
CELLS = ["STACK", "IMAGE", "CALL", "SMIN", "NC"]  # their bytes have places that are known numbers


class Machine:
    """What all states of one proof share: the file, the arrays, and Z3."""

    def __init__(self, image: Image, spec: Specification):
        self.image, self.spec = image, spec
        self.base = {name: z3.BitVec(name, 64) for name in [*ARRAYS, *CELLS, "EVENTS"]}
        self.lengths = {a: spec.pairs() for a in ARRAYS} | {"DD": spec.dofs, "DTEST": spec.dofs}
        self.strict = True  # while invariants are guessed, subscripts may be anything
        self.questions = 0
        self.thorough = 0
        self.paths = 0
        self.static_read: set[int] = set()  # bytes of writable data whose value is the file's,
        self.static_written: set[int] = set()  # and bytes that change: no byte may be both
        self.constants: set[int] = set()  # that the function uses
        self._decoder = capstone.Cs(capstone.CS_ARCH_X86, capstone.CS_MODE_64)
        self._decoder.detail = True
        self._decoded: dict[int, capstone.CsInsn] = {}
        self._names = 0
        self._same_subscript: dict[tuple[str, str, str], bool] = {}
        self.begin(spec.here, [])

    # Questions to Z3.

    def begin(self, at: Position, facts: list[z3.BoolRef]) -> None:
        """From now on paths begin `at` a place of the listing, and `facts` hold."""
        self.at = at
        self.solver = z3.SimpleSolver()
        self.solver.set("rlimit", QUICK)
        self.solver.add(*facts)
        self.facts = facts
        self._literals: dict[int, tuple[z3.BoolRef, z3.BoolRef]] = {}

    def _literal(self, claim: z3.BoolRef) -> z3.BoolRef:
        """A name for `claim`: Z3 keeps what it learnt about it from question to question."""
        if claim.get_id() not in self._literals:
            name = z3.Bool(f"claim{len(self._literals)}")
            self.solver.add(z3.Implies(name, claim))
            self._literals[claim.get_id()] = (name, claim)
        return self._literals[claim.get_id()][0]

    def possible(self, s: State, *claims: z3.BoolRef) -> bool:
        """Whether `claims` can hold on this path."""
        self.questions += 1
        answer = self.solver.check(*(self._literal(c) for c in [*s.path, *claims]))
        if answer == z3.unknown:
            self.thorough += 1
            solver = z3.Solver()
            solver.set("rlimit", THOROUGH)
            solver.add(*self.facts, *s.path, *claims)
            answer = solver.check()
        if answer == z3.unknown:
            raise self.undecided(self.instruction(s.pc), f"Z3 gave no answer")
        return answer == z3.sat

    def holds(self, s: State, claim: z3.BoolRef) -> bool:
        """Whether `claim` must hold on this path."""
        claim = z3.simplify(claim)
        if z3.is_true(claim) or any(claim.eq(c) for c in s.path):
            return True
        return not self.possible(s, z3.simplify(z3.Not(claim)))

    def same(self, s: State, a: z3.BitVecRef, b: z3.BitVecRef) -> bool:
        a, b = z3.simplify(a), z3.simplify(b)
        return a.eq(b) or self.holds(s, a == b)

    def fresh(self, width: int) -> z3.BitVecRef:
        """A value of which nothing is known."""
        self._names += 1
        return z3.BitVec(f"unknown{self._names}", width)

    def undecided(self, ins: capstone.CsInsn, why: str) -> Undecided:
        return Undecided(f"{self.image.path}, at {ins.address:#x} `{ins.mnemonic} {ins.op_str}`: {why}")

    # Memory.

    def in_image(self, address: int) -> z3.BitVecRef:
        return z3.simplify(self.base["IMAGE"] + address)

    def region(self, s: State, address: z3.BitVecRef) -> tuple[str, z3.BitVecRef]:
        """The region into which an address points, and the offset from its first byte."""
        address = z3.simplify(address)
        for term in address.children() if address.decl().kind() == z3.Z3_OP_BADD else [address]:
            if z3.is_const(term) and term.decl().name() in self.base:
                return term.decl().name(), z3.simplify(address - term)
        raise self.undecided(self.instruction(s.pc), f"an address that is in no region: {address}")

    def place(self, s: State, region: str, offset: z3.BitVecRef) -> int:
        if not z3.is_bv_value(offset):
            raise self.undecided(self.instruction(s.pc), f"an offset in {region} that depends on the input: {offset}")
        return offset.as_signed_long()

    def load(self, s: State, address: z3.BitVecRef, width: int) -> z3.BitVecRef:
        region, offset = self.region(s, address)
        if region in ARRAYS:
            return self._load_element(s, region, offset, width)
        if region not in CELLS:
            raise self.undecided(self.instruction(s.pc), f"{region} is read")
        place = self.place(s, region, offset)
        value = s.cells_at(region, place, width // 8)
        if value is None:
            value = self._initial(s, region, place, width // 8)
        return value

    def _initial(self, s: State, region: str, place: int, size: int) -> z3.BitVecRef:
        """What stands where this call has not written."""
        if region == "STACK" and place < 0:
            value = self.fresh(8 * size)
            s.set_cells(region, place, value)
            return value
        if region != "IMAGE":
            raise self.undecided(self.instruction(s.pc), f"{region} is read at {place}, which is no argument")
        held, writable = self.image.bytes_at(place, size)
        if writable:
            self.static_read |= set(range(place, place + size))
        if size == 8 and place in self.image.relocations:
            target = self.image.relocations[place]
            return self.in_image(target) if isinstance(target, int) else z3.BitVec("extern " + target, 64)
        if any((region, place + k) in s.cells for k in range(size)):
            raise self.undecided(self.instruction(s.pc), "static data of which a part was written")
        self.constants.add(int.from_bytes(held, "little"))
        return z3.BitVecVal(int.from_bytes(held, "little"), 8 * size)

    def _inside(self, s: State, array: str, offset: z3.BitVecRef, width: int) -> None:
        size = self.spec.widths[array] // 8
        if width != 8 * size:
            raise self.undecided(self.instruction(s.pc), f"{width} bits of {array}, whose elements have {8 * size}")
        if self.strict and not self.holds(s, z3.And(z3.ULE(offset, (self.lengths[array] - 1) * size), self.lengths[array] != 0)):
            raise self.undecided(self.instruction(s.pc), f"a subscript of {array} that may be outside: {offset}")

    def _written_at(self, s: State, array: str, offset: z3.BitVecRef) -> int | None:
        """Which write of this path `offset` meets. Elements must be the same or apart, not overlap."""
        size = self.spec.widths[array] // 8
        for k, (other, _) in enumerate(s.written.get(array, [])):
            if self.same(s, offset, other):
                return k
            if self.strict and not self.holds(s, z3.And(z3.UGE(offset - other, size), z3.UGE(other - offset, size))):
                raise self.undecided(self.instruction(s.pc), f"{array} at {offset} or at {other}")
        return None

    def _load_element(self, s: State, array: str, offset: z3.BitVecRef, width: int) -> z3.BitVecRef:
        self._inside(s, array, offset, width)
        if array == "SS":
            self._visit(s, offset)
        k = self._written_at(s, array, offset)
        if k is not None:
            return s.written[array][k][1]
        if array == "SS" and self.at.loop != 2 and not self.holds(s, z3.ULT(offset, self.at.i * (width // 8))):
            return self.fresh(width)  # what the caller left there
        if array == "ISEP" and not self.holds(s, z3.UGE(offset, self.at.i * 4)):
            return self.fresh(width)  # perhaps toggled by now
        return self.spec.at_byte(array, self._as_listing_says(s, offset, width) if array in ("DD", "DTEST") else offset)

    def _as_listing_says(self, s: State, offset: z3.BitVecRef, width: int) -> z3.BitVecRef:
        """The subscript of one of the next pairs in the listing's words, if it is that: equal terms cost no question."""
        layout = [f for f in [*self.facts, *s.path] if str(f) in ("ndofpn == 1", "Not(ndofpn == 1)")]
        for k in range(len(s.visited) + 1):
            pair = z3.simplify(self.at.i + k)
            listing = z3.simplify(self.spec.subscript(pair) * (width // 8))
            key = (offset.sexpr(), listing.sexpr(), str(layout))
            if key not in self._same_subscript:
                solver = z3.Solver()
                solver.set("rlimit", THOROUGH)
                solver.add(*self.spec.of_pair(pair), *layout, offset != listing)
                self._same_subscript[key] = solver.check() == z3.unsat
            if self._same_subscript[key] and self.holds(s, z3.ULT(pair, self.spec.pairs())):
                return listing
        return offset

    def _visit(self, s: State, offset: z3.BitVecRef) -> None:
        if not any(self.same(s, offset, other) for other in s.visited):
            s.visited.append(offset)

    def store(self, s: State, address: z3.BitVecRef, value: z3.BitVecRef) -> None:
        region, offset = self.region(s, address)
        if region in ("SS", "ISEP"):
            self._inside(s, region, offset, value.size())
            if region == "SS":
                self._visit(s, offset)
            k = self._written_at(s, region, offset)
            log = s.written.setdefault(region, [])
            if k is None:
                log.append((offset, value))
            else:
                log[k] = (log[k][0], value)
        elif region == "EVENTS":
            s.written.setdefault(region, []).append((offset, value))
        elif region in CELLS:
            self._store_cells(s, region, self.place(s, region, offset), value)
        else:
            raise self.undecided(self.instruction(s.pc), f"{region} is written, which is an input")

    def _store_cells(self, s: State, region: str, place: int, value: z3.BitVecRef) -> None:
        size = value.size() // 8
        if region == "STACK":
            if place < self.place(s, region, self._stack_offset(s)) - RED_ZONE:
                raise self.undecided(self.instruction(s.pc), "a write below the red zone")
        if region == "IMAGE":
            if not self.image.bytes_at(place, size)[1]:
                raise self.undecided(self.instruction(s.pc), "a write to constant data")
            self.static_written |= set(range(place, place + size))
        elif (region != "STACK" or place >= 0) and s.cells_at(region, place, size) is None:
            raise self.undecided(self.instruction(s.pc), f"{region} is written at {place}, which is no argument")
        s.set_cells(region, place, value)

    def _stack_offset(self, s: State) -> z3.BitVecRef:
        region, offset = self.region(s, s.registers["rsp"])
        if region != "STACK":
            raise self.undecided(self.instruction(s.pc), "the stack pointer has left the stack")
        return offset

    def push(self, s: State, value: z3.BitVecRef) -> None:
        s.set_register("rsp", s.registers["rsp"] - 8)
        self.store(s, s.registers["rsp"], value)

    def pop(self, s: State) -> z3.BitVecRef:
        value = self.load(s, s.registers["rsp"], 64)
        s.set_register("rsp", s.registers["rsp"] + 8)
        return value

    # Control.

    def instruction(self, address: int) -> capstone.CsInsn:
        if address not in self._decoded:
            for size in range(15, 0, -1):  # the last instructions of a segment have fewer bytes behind them
                try:
                    code = self.image.bytes_at(address, size)[0]
                    break
                except Undecided:
                    continue
            found = next(self._decoder.disasm(code, address, 1), None)
            if found is None:
                raise Undecided(f"{self.image.path}, at {address:#x}: no instruction that capstone knows")
            self._decoded[address] = found
        return self._decoded[address]

    def heads(self, entry: int) -> set[int]:
        """Places at which every loop is cut: the targets of edges that lead back in a search in depth."""
        found: set[int] = set()
        done, open_ = set(), {entry}
        stack = [(entry, iter(self._next(entry)))]
        while stack:
            at, edges = stack[-1]
            to = next(edges, None)
            if to is None:
                stack.pop()
                open_.discard(at)
                done.add(at)
            elif to in open_:
                found.add(to)
            elif to not in done:
                open_.add(to)
                stack.append((to, iter(self._next(to))))
        return found

    def _next(self, address: int) -> list[int]:
        ins = self.instruction(address)
        after = address + ins.size
        direct = [o.imm for o in ins.operands if o.type == names.X86_OP_IMM]
        if ins.mnemonic in ("ret", "hlt", "ud2"):
            return []
        if ins.mnemonic == "jmp":
            return direct
        if ins.mnemonic == "call" or ins.mnemonic.startswith("j"):
            return [*direct, after]
        return [after]

    def explore(self, start: State, heads: set[int]) -> Iterator[State]:
        """Every path from `start` to a head or to the end, whose states have pc 0."""
        waiting = [start]
        while waiting:
            s = waiting.pop()
            if s.steps and (s.pc in heads or s.pc == 0):
                self.paths += 1
                yield s
                continue
            s.steps += 1
            if s.steps > LONGEST_PATH:
                raise self.undecided(self.instruction(s.pc), f"no end of the path after {LONGEST_PATH} instructions")
            waiting += self._step(s)

    def _step(self, s: State) -> list[State]:
        ins = self.instruction(s.pc)
        self.constants |= {op.imm % (1 << 8 * max(op.size, 1)) for op in ins.operands if op.type == names.X86_OP_IMM}
        o = x86.Operands(self, s, ins)
        after = ins.address + ins.size
        if ins.mnemonic.startswith("j"):
            return self._jump(s, ins, o, after)
        if ins.mnemonic == "call":
            self.push(s, self.in_image(after))
            return self._go(s, ins, o)
        if ins.mnemonic == "ret" and not len(o):
            return self._return(s, ins)
        if ins.mnemonic not in x86.ACTIONS or ins.prefix[0]:
            raise self.undecided(ins, "this mnemonic is not known")
        x86.ACTIONS[ins.mnemonic](o)
        s.pc = after
        return [s]

    def _jump(self, s: State, ins: capstone.CsInsn, o: x86.Operands, after: int) -> list[State]:
        if ins.mnemonic == "jmp":
            return self._go(s, ins, o)
        taken = x86.condition(s, ins.mnemonic[1:])
        if taken is None:
            raise self.undecided(ins, "this mnemonic is not known")
        found = []
        for claim, to in ((taken, o.list[0].imm), (z3.simplify(z3.Not(taken)), after)):
            if z3.is_true(claim) or (not z3.is_false(claim) and self.possible(s, claim)):
                branch = s.copy()
                branch.pc = to
                if not z3.is_true(claim):
                    branch.path.append(claim)
                found.append(branch)
        return found

    def _go(self, s: State, ins: capstone.CsInsn, o: x86.Operands) -> list[State]:
        """To a place in the function, in another one, or in the run-time library, which comes back."""
        target = o.get(0, 64)
        if z3.is_bv_value(target) and o.list[0].type == names.X86_OP_IMM:
            s.pc = target.as_long()
            return [s]
        if z3.is_const(target) and target.decl().name().startswith("extern "):
            runtime.call(self, s, ins, target.decl().name().removeprefix("extern "))
            return self._return(s, ins)
        raise self.undecided(ins, f"where does it lead? {target}")

    def _return(self, s: State, ins: capstone.CsInsn) -> list[State]:
        to = self.pop(s)
        if to.eq(z3.BitVec("return", 64)):
            s.pc = 0
            return [s]
        region, offset = self.region(s, to)
        if region != "IMAGE":
            raise self.undecided(ins, "a return address that was overwritten")
        s.pc = self.place(s, region, offset)
        return [s]
