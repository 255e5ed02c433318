"""The proof that a kernel equals the specification from loop head to loop head, for any number of pairs."""

import functools
import itertools

import z3

from . import Undecided
from .interfaces import Interface, entry, fault_of_return
from .machine import ARRAYS, BASE, Machine, Split, symbols
from .reals import are_ieee
from .specification import Position
from .state import Start, State, fresh

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


# The end of a path with the listing along it: the listing's final position, and the elements of SS and ISEP and the
# numbers of events that it writes.
Case = tuple[State, Position, dict[tuple[str, int], z3.BitVecRef]]


class Proof:
    """The proof of the function at `address`. `prove` returns if the function is proved; else raises Differs or
    Undecided."""

    def __init__(self, machine: Machine, interface: Interface, address: int):
        self.machine, self.spec, self.interface, self.address = machine, machine.spec, interface, address
        machine.find_cuts(address)
        self.heads: dict[int, Head] = {}
        self.taken: dict[int, tuple[int, list[State]]] = {}  # of each head, the version and the ends of its paths

    def prove(self) -> None:
        if not are_ieee(self.spec.width) or not self.spec.is_kept():
            raise Undecided("the lemmas of the specification are not proved")
        for _ in range(MOST_ROUNDS):
            arrivals = self._arrivals()
            if not any([self._weaken(s) for s in arrivals if s.pc in self.heads]):
                new = [s for s in arrivals if s.pc and s.pc not in self.heads]
                if not new:
                    return self._judge_all(arrivals)
                self._make_head([s for s in new if s.pc == new[0].pc])
        raise Undecided(f"no invariant after {MOST_ROUNDS} rounds")

    # Paths.

    def _arrivals(self) -> list[State]:
        """The ends of all paths. Paths from a head whose assumptions did not change are reused."""
        if 0 not in self.taken:
            start = self._start(0, self.spec.first, [])
            self.taken[0] = 0, list(self.machine.explore(entry(self.machine, self.interface, self.address, start)))
        for pc, head in self.heads.items():
            if self.taken.get(pc, (-1,))[0] != head.version:
                s = State(pc, self._start(pc, self.spec.here._replace(loop=head.loop), head.facts))
                for (region, place, size), options in head.guesses.items():
                    s.write(region, place, options[0] if options else fresh(8 * size))
                self.taken[pc] = head.version, list(self.machine.explore(s))
        return [s for _, arrivals in self.taken.values() for s in arrivals]

    def _start(self, origin: int, at: Position, facts: list[z3.BoolRef]) -> Start:
        """Where `facts`, the preconditions and the specification's invariant hold."""
        within = [z3.ULT(BASE[name], 1 << 63) for name in ARRAYS]  # so that no address in an array overflows
        return Start(origin, at, facts + self.spec.of_call() + self.spec.of_position(at) + within)

    # Assumptions.

    def _make_head(self, arrivals: list[State]) -> None:
        """Make a head with assumptions that its arrivals do not refute: for every slot its value there, as it depends on
        the pair, or its growth in a turn of the loop."""
        cases = [case for s in arrivals for case in self._cases(s)]
        s, to, _ = cases[0]
        known = (self.heads[s.start.origin].facts if s.start.origin else []) + s.path
        facts = [f for f in known if symbols(f).isdisjoint(VARYING | {"()"})]
        turns = self._turns(s, to) if z3.is_bv_value(to.i) else []
        guesses = {slot: self._guesses(cases, slot, turns) for slot in s.whole()}
        self.heads[s.pc] = Head(to.loop, [*facts, z3.ULT(self.spec.here.i, self.spec.pairs)], guesses)

    def _turns(self, s: State, to: Position) -> list[tuple[State, int]]:
        """Ends of some paths from this arrival back to the same place, with the numbers of their pairs."""
        again = State(s.pc, self._start(s.pc, to, s.start.facts + s.path))
        again.cells = s.cells.copy()
        turns = ((end, len(end.pairs)) for end in self.machine.explore(again) if end.pc == s.pc and end.pairs)
        return list(itertools.islice(turns, MOST_TURNS))

    def _guesses(self, cases: list[Case], slot: Slot, turns: list[tuple[State, int]]) -> list[z3.BitVecRef]:
        """Possible values of a slot when the loop begins a pair: a value that depends on the pair, SMIN, or the number of
        events."""
        here, guesses = self.spec.here, []
        found = [(s.read(*slot), to) for s, to, _ in cases]
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
            guesses += least
            if z3.is_bv_value(start) and start.as_long() == 0 and start.size() >= 32:
                guesses += [extend(start.size() - 32, here.toggled) for extend in (z3.ZeroExt, z3.SignExt)]
        return list({g.get_id(): g for g in guesses}.values())

    def _weaken(self, s: State) -> bool:
        """Remove the assumptions that this arrival refutes. True if any was removed."""
        head, origin = self.heads[s.pc], s.start.origin
        if origin and self.heads[origin].version != self.taken[origin][0]:
            return False  # this path began with assumptions that are now removed
        if s.judged.get("refutes nothing of version") == head.version:
            return False
        for case, to, _ in self._cases(s):
            there = list(zip(self.spec.here[1:], to[1:]))
            kept = [fact for fact in head.facts if self.machine.holds(case, z3.substitute(fact, *there))]
            refuted = [options for slot, options in head.guesses.items()
                       if options and not self.machine.same(case, case.value(*slot), z3.substitute(options[0], *there))]  # fmt: skip
            if refuted or len(kept) < len(head.facts):
                for options in refuted:
                    del options[0]
                head.facts, head.version = kept, head.version + 1
                return True  # further cases may have begun with the assumptions that are now removed
        s.judged["refutes nothing of version"] = head.version
        return False

    # The listing along a path.

    def _cases(self, s: State) -> list[Case]:
        """The path with the listing along it, once for each answer to the listing's conditions that it leaves open."""
        key = "cases", s.pc in self.heads
        if key not in s.judged:
            try:
                s.judged[key] = [(s, *self._advance(s))]
            except Split as split:
                s.judged[key] = [case for half in s.halves(split.condition) for case in self._cases(half)]
        return s.judged[key]

    def _advance(self, s: State) -> tuple[Position, dict[tuple[str, int], z3.BitVecRef]]:
        """Run the listing along this path, for as many pairs as have an element of SS read or written."""
        at, elements, events = s.start.at, {}, []
        holds = functools.partial(self.machine.decide, s)
        for k in sorted(s.pairs):
            if at.loop == 1:
                elements["SS", k] = self.spec.scale_factor(at.i, holds)
                at = at._replace(smin=self.spec.smaller(elements["SS", k], at.smin, holds))
            elif toggle := self.spec.toggle(at, holds):
                events += self.interface.events(toggle)
                elements["ISEP", k] = z3.BitVecVal(-1 if toggle.makes else 1, 32)  # 55, 58
                at = at._replace(toggled=z3.simplify(at.toggled + 1))
            at = at._replace(i=z3.simplify(at.i + 1))
        to = self._turned(s, at)
        if to.loop == 0 and s.start.at.loop == 1:
            events = self.interface.no_event
        return to, elements | {("EVENTS", k): value for k, value in enumerate(events)}

    def _turned(self, s: State, at: Position) -> Position:
        """Move to the next loop or to the end if the path implies that no pair remains. A new head may be in either
        loop."""
        ended = lambda: self.machine.holds(s, at.i == self.spec.pairs)
        smin_is_1 = lambda: self.machine.holds(s, at.smin == self.spec.one)
        below_1 = lambda: self.machine.holds(s, at.smin != self.spec.one)
        if s.pc == 0:
            if not ended() or (at.loop == 1 and not smin_is_1()):
                raise Differs(f"the function returns in loop {at.loop} before the end of this loop")
            return at._replace(loop=0)
        head = self.heads.get(s.pc)
        turns = (head.loop == 2 if head else s.pc != s.start.origin) and at.loop == 1 and ended() and below_1()
        if head and head.loop != (2 if turns else at.loop):
            raise Differs(f"the loop at {s.pc:#x} is reached, but the listing is in loop {at.loop}")
        return at._replace(loop=2, i=z3.BitVecVal(0, 64)) if turns else at

    # The verdict.

    def _judge_all(self, arrivals: list[State]) -> None:
        for s in arrivals:
            if s.start.origin and s.pc and not s.pairs and self.heads[s.pc].loop == s.start.at.loop:
                raise Undecided(f"the loop at {s.start.origin:#x} may never end")  # from head to head without a pair
            for case in self._cases(s):
                if fault := self._fault(*case):
                    to = f"to {s.pc:#x}" if s.pc else "to the end"
                    raise Differs(f"from {s.start.origin or self.address:#x} {to}: {fault}")

    def _fault(self, s: State, to: Position, right: dict[tuple[str, int], z3.BitVecRef]) -> str:
        """What the path leaves otherwise than the listing; empty if all is right."""
        for array, k in right.keys() | s.elements.keys():
            before = self.spec.element(array, s.start.at.i + k) if array == "ISEP" else None
            found, value = s.elements.get((array, k), before), right.get((array, k), before)
            if found is None or value is None or not self.machine.same(s, found, value):
                return f"another value of {array} is left"
        results = {self.interface.smin: to.smin} | ({("rax", 0): to.toggled} if self.interface.returns_count else {})
        return "" if s.pc else fault_of_return(self.machine, s, results)


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
