"""The proof that a kernel equals the specification from loop head to loop head, for any number of pairs."""

from typing import NamedTuple

import z3

from . import Undecided
from .interfaces import Interface, entry, fault_of_return
from .machine import Machine, symbols
from .reals import comparisons_are_ieee
from .specification import Position, Toggle
from .state import State

MOST_ROUNDS = 40
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
        self.cuts = machine.cuts(address, set(), set())
        self.heads: dict[int, Head] = {}
        self.taken: dict[int, tuple[int, list[Arrival]]] = {}  # of each head, the version and the paths

    def prove(self) -> None:
        if not comparisons_are_ieee(self.spec.width) or not self.spec.is_kept():
            raise Undecided("the lemmas of the specification are not proved")
        for _ in range(MOST_ROUNDS):
            arrivals = self._arrivals()
            new = [a for a in arrivals if a.s.pc and a.s.pc not in self.heads]
            if not any([self._weaken(a) for a in arrivals if a.s.pc in self.heads]):
                if not new:
                    return self._judge_all(arrivals)
                self._make_head(new[0])  # earlier heads need no further change
        raise Undecided(f"no invariant after {MOST_ROUNDS} rounds")

    # Paths.

    def _arrivals(self) -> list[Arrival]:
        """All paths. Paths from a head whose assumptions did not change are reused."""
        first = Position(1, z3.BitVecVal(0, 64), self.spec.one, z3.BitVecVal(0, 32))
        if not self.taken:
            self.taken[0] = 0, self._paths(entry(self.machine, self.interface, self.address), 0, first, [])
        for pc, head in self.heads.items():
            if self.taken.get(pc, (-1,))[0] != head.version:
                s, at = State(pc), self.spec.here._replace(loop=head.loop)
                for (region, place, size), options in head.guesses.items():
                    s.write(region, place, options[0] if options else self.machine.fresh(8 * size))
                self.taken[pc] = head.version, self._paths(s, pc, at, head.facts)
        return [a for _, arrivals in self.taken.values() for a in arrivals]

    def _paths(self, s: State, origin: int, at: Position, facts: list[z3.BoolRef]) -> list[Arrival]:
        """The paths from a state in which `facts`, the preconditions and the specification's invariant hold."""
        facts = facts + self.spec.of_call() + self.spec.of_position(at)
        facts += [fact for k in range(3) for fact in self.spec.of_pair(at.i + k)]
        self.machine.begin(at, facts)
        return [Arrival(end, origin, at, facts) for end in self.machine.explore(s, self.cuts)]

    # Assumptions.

    def _make_head(self, a: Arrival) -> None:
        """Make a head with an assumption for every slot: its current value, or its growth in the first turn of the
        loop."""
        self.machine.begin(a.at, a.facts)
        to = self._advance(a).to
        known = (self.heads[a.origin].facts if a.origin else []) + a.s.path
        facts = [f for f in known if symbols(f).isdisjoint(VARYING | {"()"})]
        again = self._paths(State(a.s.pc, dict(a.s.cells)), a.s.pc, to, a.facts + a.s.path)
        turns = [b.s for b in again if b.s.pc == a.s.pc and b.s.pairs]
        self.machine.begin(a.at, a.facts)
        slots = [(region, at, value.size() // 8) for (region, at), value in a.s.cells.items()]
        guesses = {slot: self._guesses(a, to, slot, turns) for slot in slots}
        self.heads[a.s.pc] = Head(to.loop, [z3.ULT(self.spec.here.i, self.spec.pairs), *facts], guesses)

    def _guesses(self, a: Arrival, to: Position, slot: Slot, turns: list[State]) -> list[z3.BitVecRef]:
        """Possible values of a slot when the loop begins a pair: its current value with growth, SMIN, or the number of
        events."""
        here, start = self.spec.here, a.s.read(*slot)
        guesses = []
        if symbols(start).isdisjoint(VARYING):
            grown = [_growing(start, s.read(*slot), len(s.pairs), here.i - to.i) for s in turns] or [start]
            guesses = grown[:1] if all(g is not None and g.eq(grown[0]) for g in grown) else []
        if start.size() == self.spec.width and self.machine.same(a.s, start, to.smin):
            guesses.append(here.smin)
        if z3.is_bv_value(start) and start.as_long() == 0 and start.size() >= 32:
            guesses += [extend(start.size() - 32, here.toggled) for extend in (z3.ZeroExt, z3.SignExt)]
        return guesses

    def _weaken(self, a: Arrival) -> bool:
        """Remove the assumptions that this arrival refutes. True if any was removed."""
        head = self.heads[a.s.pc]
        if a.origin and self.heads[a.origin].version != self.taken[a.origin][0]:
            return False  # this path began with assumptions that are now removed
        self.machine.begin(a.at, a.facts)
        to = self._advance(a).to
        when = lambda term: z3.simplify(z3.substitute(term, *zip(self.spec.here[1:], to[1:])))  # the term at position `to`
        kept = [fact for fact in head.facts if self.machine.holds(a.s, when(fact))]
        refuted = [options for slot, options in head.guesses.items() if options and not self._holds(a, slot, when(options[0]))]
        changed = len(kept) < len(head.facts) or bool(refuted)
        head.facts, head.version = kept, head.version + changed
        for options in refuted:
            del options[0]
        return changed

    def _holds(self, a: Arrival, slot: Slot, value: z3.BitVecRef) -> bool:
        found = a.s.read(*slot)
        return found is not None and self.machine.same(a.s, found, value)

    # The listing along a path.

    def _advance(self, a: Arrival) -> Advance:
        """Run the listing along this path, for as many pairs as have an element of SS read or written."""
        at, elements, toggles = a.at, {}, []
        for k in sorted(a.s.pairs):
            if at.loop == 1:
                elements["SS", k] = self.spec.scale_factor(at.i)
                at = at._replace(smin=self.spec.smaller(elements["SS", k], at.smin))
            else:
                toggles.append(self.spec.toggle(at))
                elements["ISEP", k] = self.spec.isep_after(toggles[-1])
                at = at._replace(toggled=z3.If(toggles[-1].happens, at.toggled + 1, at.toggled))
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
        for a in arrivals:
            try:
                self._judge(a)
            except Differs as why:
                to = f"to {a.s.pc:#x}" if a.s.pc else "to the end"
                raise Differs(f"from {a.origin or self.address:#x} {to}: {why}") from why
            if a.s.pc in self.heads and a.origin and not a.s.pairs and self.heads[a.s.pc].loop == a.at.loop:
                raise Undecided(f"the loop at {a.s.pc:#x} may never end")

    def _judge(self, a: Arrival) -> None:
        self.machine.begin(a.at, a.facts)
        s, listing, same = a.s, self._advance(a), self.machine.same
        for (array, k), value in listing.elements.items():
            found = s.elements.get((array, k), None if array == "SS" else self.spec.element(array, a.at.i + k))
            if found is None or not same(s, found, value):
                raise Differs(f"a pair has another {array}")
        if any(key not in listing.elements for key in s.elements if key[0] != "EVENTS"):
            raise Differs("an element is written that the listing does not change")
        happened = [t for t in listing.toggles if self.machine.holds(s, t.happens)]
        if not all(self.machine.holds(s, z3.Not(t.happens)) for t in listing.toggles if t not in happened):
            raise Differs("this path does not determine whether a pair has an event")
        expected = self.interface.expected(happened, listing.to.loop == 0 and a.at.loop == 1)
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
