"""The proof of one kernel: it does what the specification does, from loop head to loop head, for any number of pairs."""

from typing import NamedTuple

import z3

from .interfaces import Interface
from .machine import Machine
from .reals import comparisons_are_ieee
from .specification import Position, Toggle
from .state import State
from .undecided import Undecided

MOST_PAIRS = 8  # between one head and the next
MOST_ROUNDS = 40
Slot = tuple  # ("register", name), ("low", name) and ("high", name) of vectors, ("cells", region, offset, size)


class Differs(Exception):
    """Why a path is not the specification's, and what Z3 found, if anything."""

    def __init__(self, why: str, model: z3.ModelRef | None = None):
        super().__init__(why)
        self.model = model


class Head:
    """A loop head: where the listing is there, and what is assumed to hold. Assumptions that an arrival refutes are
    weakened, until none is: what is left is an invariant."""

    def __init__(self, pc: int, first: Position, facts: list[z3.BoolRef], guesses: dict[Slot, list[z3.BitVecRef]]):
        self.pc, self.loop, self.first, self.facts = pc, first.loop, first, facts
        self.guesses = guesses  # what each slot may hold, over the symbols of Specification.here; the first is assumed
        self.widths = {slot: options[0].size() for slot, options in guesses.items()}
        self.counted: set[Slot] = set()
        self.one_more = True  # the loop has not ended: i < NC
        self.version = 0  # how often the assumptions changed

    def value(self, slot: Slot) -> z3.BitVecRef | None:
        """What is assumed of a slot; nothing where every guess was refuted."""
        return self.guesses[slot][0] if self.guesses[slot] else None


class Arrival(NamedTuple):
    """The end of a path, with what the listing does on it."""

    s: State
    origin: Head | None
    values: dict[Slot, z3.BitVecRef]  # of the slots, at the origin
    at: Position  # at the origin
    facts: list[z3.BoolRef]  # at the origin


class Advance(NamedTuple):
    """What the listing does from one position to another. Loop 0: it has returned."""

    to: Position
    pairs: list[z3.BitVecRef]  # of DO 10
    toggles: list[Toggle]  # of DO 30


class Proof:
    """The proof of the function at `entry`. `prove` returns where it holds, or raises Differs or Undecided."""

    def __init__(self, machine: Machine, interface: Interface, entry: int):
        self.machine, self.interface, self.entry = machine, interface, entry
        self.spec = machine.spec
        self.places = machine.heads(entry)
        self.heads: dict[int, Head] = {}
        self.known_paths: dict[int, tuple[int, list[Arrival]]] = {}  # from each head, under the assumptions of a version
        self.passed: dict[tuple[int, int], Arrival] = {}  # those that agreed with a version of their head's assumptions

    def prove(self) -> None:
        if not comparisons_are_ieee(self.spec.width) or not self.spec.is_kept():
            raise Undecided("the specification's own lemmas do not hold")
        self.machine.strict = False
        for _ in range(MOST_ROUNDS):
            arrivals = [a for a in self._arrivals() if a.s.pc]
            known = [a for a in arrivals if a.s.pc in self.heads]
            # Counters first: before they are known, nothing else agrees. A head is made when all before it is settled.
            weakened: set[tuple[int, Slot]] = set()
            if not any([self._count(a) for a in known]) and not any([self._weaken(a, weakened) for a in known]):
                if len(known) == len(arrivals):
                    break
                for a in arrivals:
                    self._make_head(a)
        else:
            raise Undecided(f"no invariant after {MOST_ROUNDS} rounds")
        self.machine.strict = True
        self.known_paths, self.passed = {}, {}
        arrivals = self._arrivals()
        for a in arrivals:
            if (a.s.pc and a.s.pc not in self.heads) or self._weaken(a, set()):
                raise Undecided("no invariant holds when subscripts are checked")
            self._judge(a)
        self._judge_progress(arrivals)
        moving = self.machine.static_read & self.machine.static_written
        if moving:
            raise Undecided(f"static data at {min(moving):#x} is read, and written: what a call answers would depend on it")

    # Paths.

    def _arrivals(self) -> list[Arrival]:
        """All paths. Those from a head whose assumptions are what they were are not taken again."""
        found = []
        for pc in [0, *self.heads]:
            version = self.heads[pc].version if pc else 0
            if self.known_paths.get(pc, (-1, []))[0] != version:
                self.known_paths[pc] = (version, self._from(self.heads.get(pc)))
            found += self.known_paths[pc][1]
        return found

    def _known(self, at: Position) -> list[z3.BoolRef]:
        """What the preconditions and the specification's invariant say at a position."""
        facts = self.spec.of_call() + self.spec.of_position(at) + [z3.ULE(at.i, self.spec.pairs())]
        for k in range(3):
            within = z3.ULT(at.i + k, self.spec.pairs())
            facts += [z3.Implies(within, fact) for fact in self.spec.of_pair(at.i + k)]
        return facts

    def _from(self, origin: Head | None) -> list[Arrival]:
        """The paths from a head, or from the function's beginning."""
        if origin is None:
            at = Position(1, z3.BitVecVal(0, 64), self.spec.one, z3.BitVecVal(0, 32))
            s, facts = self.interface.entry(self.entry), self._known(at)
        else:
            at = self.spec.here._replace(loop=origin.loop)
            s, facts = self._state_at(origin), self._known(at) + origin.facts
            facts += [z3.ULT(at.i, self.spec.pairs())] if origin.one_more else []
        self.machine.begin(at, facts)
        values = self._slots(s)
        return [Arrival(end, origin, values, at, facts) for end in self.machine.explore(s, self.places)]

    def _make_head(self, a: Arrival) -> None:
        if a.s.pc in self.heads:
            return
        self.machine.begin(a.at, a.facts)
        to = self._advance(a).to
        facts = [f for f in (a.origin.facts if a.origin else []) + a.s.path if not self._mentions(f, True)]
        guesses = {slot: self._guesses(a, start, to) for slot, start in self._slots(a.s).items()}
        self.heads[a.s.pc] = Head(a.s.pc, to, facts, guesses)

    def _guesses(self, a: Arrival, start: z3.BitVecRef, to: Position) -> list[z3.BitVecRef]:
        """What a slot may hold whenever the loop begins a pair: what it holds now, SMIN, the number of events, or I."""
        here, width = self.spec.here, start.size()
        guesses = [start]
        if width == self.spec.width and self.machine.same(a.s, start, to.smin):
            guesses.append(here.smin)
        if z3.is_bv_value(start) and start.as_long() == 0:
            guesses += [form for value in (here.toggled, here.i) for form in self._forms(value, width)]
        return guesses

    def _mentions(self, term: z3.ExprRef, elements: bool) -> bool:
        """Whether a term has a symbol that is another one at another time, or, if asked for, an element of an array."""
        if z3.is_const(term):
            name = term.decl().name()
            return name in ("i", "smin", "toggled") or name.startswith("unknown")
        if elements and term.decl().kind() == z3.Z3_OP_UNINTERPRETED:
            return True
        return any(self._mentions(child, elements) for child in term.children())

    # What a state holds.

    def _slots(self, s: State) -> dict[Slot, z3.BitVecRef]:
        found: dict[Slot, z3.BitVecRef] = {}
        width = self.spec.width
        for name, value in s.registers.items():
            if value.size() == 128:
                found["low", name] = z3.simplify(z3.Extract(width - 1, 0, value))
                found["high", name] = z3.simplify(z3.Extract(127, width, value))
            else:
                found["register", name] = value
        for region, offset, size in s.slots():
            found["cells", region, offset, size] = s.cells_at(region, offset, size)
        return found

    def _held(self, s: State, slot: Slot) -> z3.BitVecRef | None:
        if slot[0] == "cells":
            return s.cells_at(*slot[1:])
        whole, width = s.registers[slot[1]], self.spec.width
        if slot[0] == "register":
            return whole
        return z3.simplify(z3.Extract(width - 1, 0, whole) if slot[0] == "low" else z3.Extract(127, width, whole))

    def _state_at(self, head: Head) -> State:
        """Any state that keeps the head's assumptions."""
        s = State()
        s.pc = head.pc
        s.flags = {flag: lambda: self.machine.fresh(1) == 1 for flag in "zcsop"}
        halves: dict[str, dict[str, z3.BitVecRef]] = {}
        for slot in head.guesses:
            value = head.value(slot)
            if value is None:
                value = self.machine.fresh(head.widths[slot])
            if slot[0] == "cells":
                s.set_cells(slot[1], slot[2], value)
            elif slot[0] == "register":
                s.registers[slot[1]] = value
            else:
                halves.setdefault(slot[1], {})[slot[0]] = value
        for name, parts in halves.items():
            s.registers[name] = z3.simplify(z3.Concat(parts["high"], parts["low"]))
        return s

    # The listing beside a path.

    def _advance(self, a: Arrival) -> Advance:
        """What the listing does while the kernel takes this path. It takes as many pairs as elements of SS are touched, and
        goes on to the next loop where the path implies that no pair is left, unless the path stays in its loop."""
        count = len(a.s.visited)
        if count > MOST_PAIRS:
            raise Undecided(f"{count} pairs between two loop heads")
        at, pairs, toggles = a.at, [], []
        for _ in range(count):
            if at.loop == 1:
                pairs.append(at.i)
                at = at._replace(i=z3.simplify(at.i + 1), smin=self.spec.smaller(self.spec.scale_factor(at.i), at.smin))
            else:
                toggles.append(self.spec.toggle(at))
                more = z3.If(toggles[-1].happens, at.toggled + 1, at.toggled)
                at = at._replace(i=z3.simplify(at.i + 1), toggled=more)
        return Advance(self._turned(a, at), pairs, toggles)

    def _turned(self, a: Arrival, at: Position) -> Position:
        known = self.heads.get(a.s.pc)
        if a.s.pc and (known.loop == at.loop if known else a.origin and a.origin.pc == a.s.pc):
            return at
        if not self.machine.holds(a.s, at.i == self.spec.pairs()):
            if a.s.pc == 0:
                raise Differs(f"the function returns in loop {at.loop} before its last pair")
            return at
        if at.loop == 2:
            return at._replace(loop=0) if a.s.pc == 0 else at
        if a.s.pc == 0:
            if not self.machine.holds(a.s, at.smin == self.spec.one):
                raise Differs("the function returns before DO 30, and SMIN may be below 1")
            return at._replace(loop=0)
        if self.machine.holds(a.s, at.smin != self.spec.one):
            return at._replace(loop=2, i=z3.BitVecVal(0, 64))
        return at

    def _at(self, head: Head, value: z3.ExprRef, to: Position) -> z3.ExprRef:
        here = self.spec.here
        return z3.simplify(z3.substitute(value, (here.i, to.i), (here.smin, to.smin), (here.toggled, to.toggled)))

    # Assumptions.

    def _weaken(self, a: Arrival, weakened: set[tuple[int, Slot]]) -> bool:
        """Give up what this arrival refutes, once a round: what is assumed instead is not what this path began with.
        Whether anything was given up."""
        head = self.heads.get(a.s.pc)
        if head is None or (id(a), head.version) in self.passed:
            return False
        self.machine.begin(a.at, a.facts)
        to = self._advance(a).to
        if to.loop != head.loop:
            raise Undecided(f"{head.pc:#x} is reached in loop {to.loop} and in loop {head.loop} of the listing")
        kept = [fact for fact in head.facts if self.machine.holds(a.s, fact)]
        changed = len(kept) < len(head.facts)
        head.facts = kept
        if head.one_more and not self.machine.holds(a.s, z3.ULT(to.i, self.spec.pairs())):
            head.one_more, changed = False, True
        for slot, options in head.guesses.items():
            if options and (head.pc, slot) not in weakened and not self._agrees(a, slot, options[0], to):
                weakened.add((head.pc, slot))
                del options[0]
                changed = True
        if changed:
            head.version += 1
        else:
            self.passed[id(a), head.version] = a
        return changed

    def _agrees(self, a: Arrival, slot: Slot, value: z3.BitVecRef, to: Position) -> bool:
        found = self._held(a.s, slot)
        return found is not None and self.machine.same(a.s, found, self._at(self.heads[a.s.pc], value, to))

    def _count(self, a: Arrival) -> bool:
        """Find what grows with each pair on a path from this head to itself. Whether anything new was found."""
        head, changed = self.heads[a.s.pc], False
        pairs = len(a.s.visited)
        if a.origin is not head or not pairs:
            return False
        for slot, options in head.guesses.items():
            found, before = self._held(a.s, slot), a.values.get(slot)
            if not options or found is None or before is None or found.eq(before) or slot in head.counted:
                continue
            guess = self._growing(head, options[0], z3.simplify(found - before), pairs)
            if guess is not None:
                head.counted.add(slot)
                options[0] = guess
                changed = True
        head.version += changed
        return changed

    def _growing(self, head: Head, start: z3.BitVecRef, step: z3.BitVecRef, pairs: int) -> z3.BitVecRef | None:
        width = step.size()
        since = self.spec.here.i - head.first.i
        if z3.is_bv_value(step):
            return z3.simplify(start + self._sized(since, width) * (step.as_signed_long() // pairs))
        low = z3.simplify(z3.Extract(31, 0, step)) if width == 64 else step
        if width != 64 or not z3.is_bv_value(low):
            return None
        low_start = z3.Extract(31, 0, start) + z3.Extract(31, 0, since) * (low.as_signed_long() // pairs)
        return z3.simplify(z3.ZeroExt(32, low_start))

    def _sized(self, value: z3.BitVecRef, width: int) -> z3.BitVecRef:
        size = value.size()
        return value if size == width else z3.Extract(width - 1, 0, value) if size > width else z3.SignExt(width - size, value)

    def _forms(self, value: z3.BitVecRef, width: int) -> list[z3.BitVecRef]:
        if value.size() >= width:
            return [self._sized(value, width)]
        return [z3.ZeroExt(width - value.size(), value), z3.SignExt(width - value.size(), value)]

    # The verdict on one path.

    def _judge(self, a: Arrival) -> None:
        self.machine.begin(a.at, a.facts)
        listing = self._advance(a)
        self._judge_elements(a.s, listing, "SS", {i: self.spec.scale_factor(i) for i in listing.pairs}, True)
        self._judge_elements(a.s, listing, "ISEP", {t.i: self.spec.isep_after(t) for t in listing.toggles}, False)
        fault = self.interface.fault_of_events(a.s, listing.toggles, listing.to.loop == 0 and a.at.loop == 1)
        if fault:
            raise Differs(fault)
        if a.s.pc == 0:
            if not self.machine.same(a.s, self.interface.smin(a.s), listing.to.smin):
                raise Differs("another SMIN is returned")
            fault = self.interface.fault_of_return(a.s, listing.to.toggled)
            if fault:
                raise Differs(fault)

    def _judge_progress(self, arrivals: list[Arrival]) -> None:
        """No loop turns without a pair: from head to head along paths that take none, nothing leads back."""
        idle = {(a.origin.pc, a.s.pc) for a in arrivals if a.origin and a.s.pc and not a.s.visited}
        while idle:
            rest = {(start, end) for start, end in idle if any(end == other for other, _ in idle)}
            if rest == idle:
                raise Undecided(f"the loop at {min(idle)[0]:#x} may turn without end")
            idle = rest

    def _judge_elements(self, s: State, listing: Advance, array: str, expected: dict, must_write: bool) -> None:
        size = self.spec.widths[array] // 8
        log = s.written.get(array, [])
        met = set()
        for i, value in expected.items():
            k = next((k for k, (offset, _) in enumerate(log) if self.machine.same(s, offset, i * size)), None)
            if k is None and must_write:
                raise Differs(f"{array} of a pair is not written")
            found = self.spec.element(array, i) if k is None else log[k][1]
            if not self.machine.same(s, found, value):
                raise Differs(f"another {array} of a pair")
            met.add(k)
        if len(met - {None}) < len(log):
            raise Differs(f"{array} is written where the listing leaves it")
