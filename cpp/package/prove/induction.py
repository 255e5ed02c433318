"""The proof that a kernel equals the specification from loop head to loop head, for any number of pairs."""

import itertools
from typing import Iterator, NamedTuple

import z3

from . import Undecided
from .interfaces import Interface, entry, fault_of_return
from .machine import ARRAYS, BASE, Machine, NewCut, Split, symbols
from .reals import are_ieee
from .specification import Position, Toggle
from .state import State

MOST_ROUNDS = 400
MOST_TURNS = 8  # paths of a loop from which the growth of a value in a turn is guessed
Slot = tuple[str, int, int]  # a region, the first byte and the size
VARYING = {"i", "smin", "toggled", "unknown"}  # symbols whose meaning depends on the position


class Differs(Exception):
    """The reason why a path differs from the specification."""


class Head:
    """A loop head: the loop of the listing, and assumptions about the symbols of Specification.here. Assumptions that
    an arrival refutes are removed until none is refuted. The remaining assumptions are an invariant."""

    def __init__(self, loop: int, facts: list[z3.BoolRef], guesses: dict[Slot, list[z3.BitVecRef]]):
        self.loop, self.facts = loop, facts
        self.guesses = guesses  # possible values of each slot; the first is assumed
        self.version = 0  # number of changes of the assumptions


class Arrival(NamedTuple):
    """The end of a path, and its beginning: the head (0: the function's entry), the position, and the known facts."""

    s: State
    origin: int
    at: Position
    facts: list[z3.BoolRef]


class Advance(NamedTuple):
    """The listing along a path: its final position, the elements of SS and ISEP that it writes, and the toggles of DO
    30."""

    to: Position
    elements: dict[tuple[str, int], z3.BitVecRef]
    toggles: list[Toggle]


class Proof:
    """The proof of the function at `address`. `prove` returns if the function is proved; else raises Differs or
    Undecided."""

    def __init__(self, machine: Machine, interface: Interface, address: int):
        self.machine, self.spec, self.interface, self.address = machine, machine.spec, interface, address
        machine.find_cuts(address)
        self.heads: dict[int, Head] = {}
        self._varying: dict[int, tuple[z3.ExprRef, bool]] = {}
        self.taken: dict[int, tuple[int, list[Arrival]]] = {}  # of each head, the version and the paths

    def prove(self) -> None:
        if not are_ieee(self.spec.width) or not self.spec.is_kept():
            raise Undecided("the lemmas of the specification are not proved")
        for _ in range(MOST_ROUNDS):
            try:
                arrivals = self._arrivals()
                if not any([self._weaken(a) for a in arrivals if a.s.pc in self.heads]):
                    new = [a for a in arrivals if a.s.pc and a.s.pc not in self.heads]
                    if not new:
                        return self._judge_all(arrivals)
                    first = max((a.s.pc for a in new), key=lambda pc: self.machine.order.get(pc, 0))
                    self._make_head([a for a in new if a.s.pc == first])  # earlier heads need no further change
            except NewCut:
                self.taken.clear()  # older paths may go on beyond the new cut
        raise Undecided(f"no invariant after {MOST_ROUNDS} rounds")

    # Paths.

    def _arrivals(self) -> list[Arrival]:
        """All paths. Paths from a head whose assumptions did not change are reused."""
        first = Position(1, z3.BitVecVal(0, 64), self.spec.one, z3.BitVecVal(0, 32))
        if 0 not in self.taken:
            self.taken[0] = 0, list(self._paths(entry(self.machine, self.interface, self.address), 0, first, []))
        for pc, head in self.heads.items():
            if self.taken.get(pc, (-1,))[0] != head.version:
                s, at = State(pc), self.spec.here._replace(loop=head.loop)
                for (region, place, size), options in head.guesses.items():
                    s.write(region, place, options[0] if options else self.machine.fresh(8 * size))
                self.taken[pc] = head.version, list(self._paths(s, pc, at, head.facts))
        return [a for _, arrivals in self.taken.values() for a in arrivals]

    def _paths(self, s: State, origin: int, at: Position, facts: list[z3.BoolRef]) -> Iterator[Arrival]:
        """The paths from a state in which `facts`, the preconditions and the specification's invariant hold."""
        facts = facts + self.spec.of_call() + self.spec.of_position(at)
        facts += [z3.ULT(BASE[name], 1 << 63) for name in ARRAYS]  # so that no address in an array overflows
        self.machine.begin(at, facts)
        return (Arrival(end, origin, at, facts) for end in self.machine.explore(s))

    # Assumptions.

    def _make_head(self, arrivals: list[Arrival]) -> None:
        """Make a head with assumptions that its arrivals do not refute: for every slot its value there, as it depends on
        the pair, or its growth in a turn of the loop."""
        cases = [case for a in arrivals for case in self._cases(a)]
        a, to = cases[0][0], cases[0][1].to
        known = (self.heads[a.origin].facts if a.origin else []) + a.s.path
        facts = [f for f in known if symbols(f).isdisjoint(VARYING | {"()"})]
        facts += [z3.ULT(self.spec.here.i, self.spec.pairs)]
        turns = self._turns(a, to) if z3.is_bv_value(to.i) else []
        slots = [(region, at, value.size() // 8) for (region, at), value in a.s.cells.items()]
        guesses = {slot: self._guesses(cases, slot, turns) for slot in slots}
        head = self.heads[a.s.pc] = Head(to.loop, facts, guesses)
        if not turns and z3.is_bv_value(to.i):
            head.facts.append(self.spec.here.i == to.i)

    def _turns(self, a: Arrival, to: Position) -> list[tuple[State, int]]:
        """Ends of some paths from this arrival back to the same place, with the numbers of their pairs."""
        ends = self._paths(State(a.s.pc, dict(a.s.cells)), a.s.pc, to, a.facts + a.s.path)
        turns = ((b.s, len(b.s.pairs)) for b in ends if b.s.pc == a.s.pc and b.s.pairs)
        return list(itertools.islice(turns, MOST_TURNS))

    def _guesses(self, cases: list[tuple[Arrival, Advance]], slot: Slot, turns: list[tuple[State, int]]) -> list[z3.BitVecRef]:
        """Possible values of a slot when the loop begins a pair: a value that depends on the pair, SMIN, or the number of
        events."""
        here, guesses, fixed = self.spec.here, [], []
        found = [(a.s.read(*slot), listing.to) for a, listing in cases]
        if any(start is None for start, _ in found):
            return []
        for start, to in {(start.get_id(), to.i.get_id()): (start, to) for start, to in found}.values():
            least = [here.smin] if start.eq(z3.simplify(to.smin)) else []
            before = z3.simplify(to.i - here.i)
            if "()" in symbols(start):
                guesses += least  # a value in an array or of reals is hardly needed for the next pair
                continue
            if z3.is_bv_value(before):
                start = z3.simplify(z3.substitute(start, (here.i, here.i - before)))
            if symbols(start).isdisjoint(VARYING - ({"i"} if z3.is_bv_value(before) else set())):
                grown = [_growing(start, s.read(*slot), pairs, here.i - to.i) for s, pairs in turns] or [start]
                guesses += grown[:1] if all(g is not None and g.eq(grown[0]) for g in grown) else []
                fixed += [(start, to.i)] if z3.is_bv_value(to.i) else []
            guesses += least
            if z3.is_bv_value(start) and start.as_long() == 0 and start.size() >= 32:
                guesses += [extend(start.size() - 32, here.toggled) for extend in (z3.ZeroExt, z3.SignExt)]
        for (start, i), (after, j) in zip(fixed, fixed[1:]):
            if i.as_long() < j.as_long():
                start, after, i, j = after, start, j, i
            grown = None if i.eq(j) else _growing(after, start, i.as_long() - j.as_long(), here.i - j)
            guesses += [] if grown is None else [grown]
        return list({g.get_id(): g for g in guesses}.values())

    def _weaken(self, a: Arrival) -> bool:
        """Remove the assumptions that this arrival refutes. True if any was removed."""
        head = self.heads[a.s.pc]
        if a.origin and self.heads[a.origin].version != self.taken[a.origin][0]:
            return False  # this path began with assumptions that are now removed
        if a.s.judged.get("refutes nothing of version") == head.version:
            return False
        before, cases = head.version, self._cases(a)
        while cases and head.version == before:  # further cases began with assumptions that are now removed
            (case, listing), *cases = cases
            there = list(zip(self.spec.here[1:], listing.to[1:]))
            when = lambda term: z3.substitute(term, *there) if self._varies(term) else term  # the term there
            kept = [fact for fact in head.facts if self.machine.holds(case.s, when(fact))]
            refuted = [options for slot, options in head.guesses.items() if options and not self._holds(case, slot, when(options[0]))]
            changed = len(kept) < len(head.facts) or bool(refuted)
            head.facts, head.version = kept, head.version + changed
            for slot, options in head.guesses.items():
                if any(options is found for found in refuted):
                    del options[0]
        if head.version == before:
            a.s.judged["refutes nothing of version"] = before
        return head.version > before

    def _varies(self, term: z3.ExprRef) -> bool:
        """Whether the meaning of a term depends on the position."""
        if term.get_id() not in self._varying:  # with the term, whose number is the key
            self._varying[term.get_id()] = term, not symbols(term).isdisjoint(VARYING)
        return self._varying[term.get_id()][1]

    def _holds(self, a: Arrival, slot: Slot, value: z3.BitVecRef) -> bool:
        found = a.s.read(*slot)
        return found is not None and self.machine.same(a.s, found, value)

    # The listing along a path.

    def _cases(self, a: Arrival) -> list[tuple[Arrival, Advance]]:
        """The path with the listing along it, once for each answer to the listing's conditions that it leaves open."""
        self.machine.begin(a.at, a.facts)
        key = "cases", a.s.pc in self.heads
        if key not in a.s.judged:
            try:
                a.s.judged[key] = [(a, self._advance(a))]
            except Split as split:
                claims = [split.condition, z3.simplify(z3.Not(split.condition))]
                halves = [a._replace(s=a.s.branch(a.s.pc, claim)) for claim in claims]
                a.s.judged[key] = [case for half in halves for case in self._cases(half)]
        return a.s.judged[key]

    def _advance(self, a: Arrival) -> Advance:
        """Run the listing along this path, for as many pairs as have an element of SS read or written."""
        at, elements, toggles = a.at, {}, []
        holds = lambda *claims: self.machine.decide(a.s, *claims)
        for k in sorted(a.s.pairs):
            if at.loop == 1:
                elements["SS", k] = self.spec.scale_factor(at.i, holds)
                at = at._replace(smin=self.spec.smaller(elements["SS", k], at.smin, holds))
            elif toggle := self.spec.toggle(at, holds):
                toggles.append(toggle)
                elements["ISEP", k] = z3.BitVecVal(-1 if toggle.makes else 1, 32)  # 55, 58
                at = at._replace(toggled=z3.simplify(at.toggled + 1))
            at = at._replace(i=z3.simplify(at.i + 1))
        return Advance(self._turned(a, at), elements, toggles)

    def _turned(self, a: Arrival, at: Position) -> Position:
        """Move to the next loop or to the end if the path implies that no pair remains. A new head may be in either
        loop."""
        ended = lambda: self.machine.holds(a.s, at.i == self.spec.pairs)
        smin_is_1 = lambda: self.machine.holds(a.s, at.smin == self.spec.one)
        below_1 = lambda: self.machine.holds(a.s, at.smin != self.spec.one)
        if a.s.pc == 0:
            if not ended() or (at.loop == 1 and not smin_is_1()):
                raise Differs(f"the function returns in loop {at.loop} before the end of this loop")
            return at._replace(loop=0)
        if a.s.pc in self.heads:
            if self.heads[a.s.pc].loop != at.loop and not (at.loop == 1 and ended() and below_1()):
                raise Differs(f"the loop at {a.s.pc:#x} is reached, but the listing is in loop {at.loop}")
            turns = self.heads[a.s.pc].loop != at.loop
        else:
            turns = at.loop == 1 and a.s.pc != a.origin and ended() and below_1()
        return at._replace(loop=2, i=z3.BitVecVal(0, 64)) if turns else at

    # The verdict.

    def _judge_all(self, arrivals: list[Arrival]) -> None:
        idle = {(a.origin, a.s.pc) for a in arrivals if a.origin and a.s.pc and not a.s.pairs and self.heads[a.s.pc].loop == a.at.loop}
        while idle:  # paths without a pair, from head to head: every sequence of them must end
            ended = {step for step in idle if step[1] not in {origin for origin, _ in idle}}
            if not ended:
                raise Undecided(f"the loop at {min(idle)[0]:#x} may never end")
            idle -= ended
        for a in arrivals:
            try:
                for case in self._cases(a):
                    self._judge(*case)
            except Differs as why:
                to = f"to {a.s.pc:#x}" if a.s.pc else "to the end"
                raise Differs(f"from {a.origin or self.address:#x} {to}: {why}") from why

    def _judge(self, a: Arrival, listing: Advance) -> None:
        s, same = a.s, self.machine.same
        for key in listing.elements.keys() | {key for key in s.elements if key[0] != "EVENTS"}:
            array, k = key
            before = None if array == "SS" else self.spec.element(array, a.at.i + k)
            found, value = s.elements.get(key, before), listing.elements.get(key, before)
            if found is None or value is None or not same(s, found, value):
                raise Differs(f"a pair has another {array}")
        expected = self.interface.expected(listing.toggles, listing.to.loop == 0 and a.at.loop == 1)
        found = self.interface.told(s)
        if len(found) != len(expected) or not all(same(s, *both) for both in zip(found, expected)):
            raise Differs("the events differ")
        fault = "" if s.pc else fault_of_return(self.machine, self.interface, s, listing.to.smin, listing.to.toggled)
        if fault:
            raise Differs(fault)


def _growing(start: z3.BitVecRef, after: z3.BitVecRef | None, pairs: int, i: z3.BitVecRef) -> z3.BitVecRef | None:
    """A value that grows by a constant with each pair, in all bits or in the lower 32 bits."""
    if after is None or start.size() > 64:
        return start if after is not None and after.eq(start) else None
    for width in {start.size(), min(start.size(), 32)}:
        low = lambda x: z3.Extract(width - 1, 0, x)
        step = z3.simplify(low(after) - low(start))
        if z3.is_bv_value(step):
            grown = low(start) + low(i) * (step.as_signed_long() // pairs)
            return z3.simplify(z3.ZeroExt(start.size() - width, grown))
    return None
