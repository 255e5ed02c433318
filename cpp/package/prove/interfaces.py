"""How a kernel is called: where the arguments stand on entry, and how what it did is read at the end. The three
interfaces are contct_'s (FORTRAN), contct<Real>'s (contct.hpp) and contct_kernel's (plugin.h)."""

import z3

from .machine import Machine
from .specification import Toggle
from .state import GENERAL, KEPT, State


class Interface:
    """What the interfaces share."""

    registers: list[str] = []  # what rdi, rsi, rdx, rcx, r8 and r9 point to
    on_stack: list[str] = []  # what the arguments above the return address point to

    def __init__(self, machine: Machine):
        self.machine, self.spec = machine, machine.spec

    def entry(self, address: int) -> State:
        """The state in which the function is called."""
        s = State()
        s.pc = address
        s.registers = {name: z3.BitVec(f"entry {name}", 64) for name in GENERAL}
        s.registers |= {f"xmm{k}": z3.BitVec(f"entry xmm{k}", 128) for k in range(16)}
        s.registers["rsp"] = self.machine.base["STACK"]
        for register, name in zip(["rdi", "rsi", "rdx", "rcx", "r8", "r9"], self.registers):
            s.registers[register] = self.machine.base[name]
        s.flags = {flag: lambda: self.machine.fresh(1) == 1 for flag in "zcsop"}
        s.set_cells("STACK", 0, z3.BitVec("return", 64))
        for k, name in enumerate(self.on_stack):
            s.set_cells("STACK", 8 + 8 * k, self.machine.base[name])
        self.fill(s)
        self.constants = {key: cell for key, cell in s.cells.items() if key[0] != "STACK" and key not in self.outputs()}
        return s

    def fill(self, s: State) -> None:
        """Arguments that are no arrays."""
        s.set_cells("SMIN", 0, z3.BitVec("entry SMIN", self.spec.width))

    def smin_at(self) -> tuple[str, int]:
        """The place of SMIN."""
        return "SMIN", 0

    def outputs(self) -> set[tuple[str, int]]:
        region, offset = self.smin_at()
        return {(region, offset + k) for k in range(self.spec.width // 8)}

    def smin(self, s: State) -> z3.BitVecRef:
        region, offset = self.smin_at()
        return s.cells_at(region, offset, self.spec.width // 8)

    def fault_of_events(self, s: State, toggles: list[Toggle], ends_at_1: bool) -> str:
        """What is wrong with the events of a path, on which the listing makes these; empty if nothing is."""
        return ""

    def fault_of_return(self, s: State, toggled: z3.BitVecRef) -> str:
        """What is wrong with the state in which the function returns: SMIN is judged elsewhere."""
        start = self.machine.base["STACK"]
        wrong = [name for name in KEPT if not self.machine.same(s, s.registers[name], z3.BitVec(f"entry {name}", 64))]
        if not self.machine.same(s, s.registers["rsp"], start + 8):
            wrong.append("rsp")
        wrong += [f"{region} at {at}" for (region, at), (value, k) in self.constants.items()
                  if not self._is_kept(s, (region, at), value, k)]  # fmt: skip
        return f"{', '.join(wrong)} must be as on entry" if wrong else ""

    def _is_kept(self, s: State, key: tuple[str, int], value: z3.BitVecRef, k: int) -> bool:
        return self.machine.same(s, s.cells_at(*key, 1), z3.Extract(8 * k + 7, 8 * k, value))

    def decided(self, s: State, claim: z3.BoolRef) -> bool | None:
        """Whether `claim` holds on a path, or does not; none where both can be."""
        return True if self.machine.holds(s, claim) else False if self.machine.holds(s, z3.Not(claim)) else None


class Fortran(Interface):
    """contct_: pointers to everything, COMMON /DOF/, and WRITEs."""

    registers = ["DD", "DTEST", "CC", "SS", "SMIN", "ID"]
    on_stack = ["ISEP", "ISURF", "NC"]

    def fill(self, s: State) -> None:
        super().fill(s)
        s.set_cells("NC", 0, self.spec.nc)
        common = self.machine.image.symbol("dof_").address
        s.set_cells("IMAGE", common, self.spec.indof)
        s.set_cells("IMAGE", common + 4, self.spec.ndofpn)

    def fault_of_events(self, s: State, toggles: list[Toggle], ends_at_1: bool) -> str:
        expected: list[list] = []
        for t in toggles:
            happens, makes = self.decided(s, t.happens), self.decided(s, t.makes)
            if happens is None or (happens and makes is None):
                return "this path does not tell whether a pair has an event"
            if happens:
                expected += [[40 if makes else 50], [60, z3.Extract(31, 0, t.i) + 1, t.node, t.isurf, t.smin]]
        if ends_at_1:
            expected.append([20, self.spec.one])
        found = [event[:-1] for event in s.events if event[-1] == "end"]
        if [e[0] for e in found] != [e[0] for e in expected] or len(found) != len(s.events):
            return f"WRITEs of {[e[0] for e in s.events]}; the listing has {[e[0] for e in expected]}"
        for ours, listing in zip(found, expected):
            if len(ours) != len(listing) or not all(self.machine.same(s, a, b) for a, b in zip(ours[1:], listing[1:])):
                return f"other values in WRITE(26,{listing[0]})"
        return ""


class Cpp(Interface):
    """contct<Real>: a struct, and events as data, as many as it returns."""

    registers = ["CALL", "EVENTS"]
    spans = {"DD": 0, "DTEST": 16, "CC": 32, "SS": 48, "ID": 72, "ISEP": 88, "ISURF": 104}

    def fill(self, s: State) -> None:
        for name, at in self.spans.items():
            s.set_cells("CALL", at, self.machine.base[name])
            s.set_cells("CALL", at + 8, z3.simplify(self.machine.lengths[name]))
        s.set_cells("CALL", 128, z3.BitVec("entry at_rest", 32))
        s.set_cells("CALL", 64, z3.BitVec("entry SMIN", self.spec.width))
        s.set_cells("CALL", 120, self.spec.indof)
        s.set_cells("CALL", 124, self.spec.ndofpn)

    def smin_at(self) -> tuple[str, int]:
        return "CALL", 64

    def fault_of_events(self, s: State, toggles: list[Toggle], ends_at_1: bool) -> str:
        expected: dict[int, z3.BitVecRef] = {}  # halves of events, counted from the first of this path
        for t in toggles:
            happens = self.decided(s, t.happens)
            if happens is None:
                return "this path does not tell whether a pair has an event"
            if happens:
                expected[len(expected)] = z3.Extract(31, 0, t.i)
                expected[len(expected)] = z3.If(t.makes, z3.BitVecVal(0, 32), z3.BitVecVal(1, 32))
        first = z3.ZeroExt(32, self.machine.at.toggled) * 8
        found = {}
        for offset, value in s.written.get("EVENTS", []):
            half = next((k for k in expected if self.machine.same(s, offset, first + 4 * k)), None)
            if half is None:
                return "an event that the listing does not have"
            found |= {half: value} if value.size() == 32 else self._halves(half, value)
        if found.keys() != expected.keys():
            return f"{len(found) / 2:g} events; the listing has {len(expected) // 2}"
        wrong = [k for k in expected if not self.machine.same(s, found[k], expected[k])]
        return "other values in an event" if wrong else ""

    def _halves(self, half: int, value: z3.BitVecRef) -> dict[int, z3.BitVecRef]:
        return {half + k: z3.Extract(32 * k + 31, 32 * k, value) for k in range(value.size() // 32)}

    def fault_of_return(self, s: State, toggled: z3.BitVecRef) -> str:
        if not self.machine.same(s, z3.Extract(31, 0, s.registers["rax"]), toggled):
            return "another number of events is returned"
        return super().fault_of_return(s, toggled)


class Plugin(Interface):
    """contct_kernel of plugin.h: no events."""

    registers = ["DD", "DTEST", "CC", "SS", "SMIN", "ID"]
    on_stack = ["ISEP", "ISURF"]

    def fill(self, s: State) -> None:
        super().fill(s)
        numbers = [self.spec.nc, self.spec.indof, self.spec.ndofpn, z3.Extract(31, 0, self.spec.dofs)]
        for k, value in enumerate(numbers):
            s.set_cells("STACK", 24 + 8 * k, z3.simplify(z3.Concat(z3.BitVec(f"entry upper {k}", 32), value)))
