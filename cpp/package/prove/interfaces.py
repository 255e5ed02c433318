"""The interfaces of kernels: the places of the arguments on entry, and the results on return."""

from typing import Callable, NamedTuple

import z3

from .machine import BASE, RETURN, Machine
from .runtime import END
from .specification import Toggle
from .state import GENERAL, KEPT, State

REGISTERS = ["rdi", "rsi", "rdx", "rcx", "r8", "r9"]  # for the first six arguments; further arguments are on the stack
POINTERS = [BASE[name] for name in ("DD", "DTEST", "CC", "SS", "SMIN", "ID", "ISEP", "ISURF")]


class Interface(NamedTuple):
    """An interface of a kernel."""

    arguments: list[z3.BitVecRef]
    cells: dict[tuple[str, int], z3.BitVecRef]  # contents of memory on entry
    told: Callable[[State], list[z3.BitVecRef]]  # the events of a path
    expected: Callable[[list[Toggle], bool], list[z3.BitVecRef]]  # the right events for toggles, or without an event
    smin: tuple[str, int] = ("SMIN", 0)
    returns_count: bool = False


def fortran(machine: Machine) -> Interface:
    """contct_, the listing: pointers to all arguments, COMMON /DOF/, and WRITEs as events."""
    spec, common = machine.spec, machine.image.take("dof_")

    def expected(toggles: list[Toggle], no_event: bool) -> list[z3.BitVecRef]:
        label = lambda number: z3.BitVecVal(number, 32)
        events = [label(20), spec.one, END] if no_event else []
        for t in toggles:
            events += [label(40 if t.makes else 50), END]
            events += [label(60), z3.Extract(31, 0, t.i) + 1, t.node, t.isurf, t.smin, END]
        return events

    cells = {("NC", 0): spec.nc, ("IMAGE", common): spec.indof, ("IMAGE", common + 4): spec.ndofpn}
    return Interface([*POINTERS, BASE["NC"]], cells, lambda s: s.events, expected)


def cpp(machine: Machine) -> Interface:
    """contct<Real> of contct.hpp: a struct with spans, and an array of events, whose number is returned."""
    spec = machine.spec
    places = {"DD": 0, "DTEST": 16, "CC": 32, "SS": 48, "ID": 72, "ISEP": 88, "ISURF": 104}
    cells = {("CALL", at): BASE[name] for name, at in places.items()}
    cells |= {("CALL", at + 8): spec.length(name) for name, at in places.items()}
    cells |= {("CALL", 120): spec.indof, ("CALL", 124): spec.ndofpn, ("CALL", 128): z3.BitVec("entry at_rest", 32)}

    def told(s: State) -> list[z3.BitVecRef]:
        halves = {k: value for (array, k), value in s.elements.items() if array == "EVENTS"}
        return [halves.get(k, z3.BitVec("nothing", 32)) for k in range(len(halves))]

    def expected(toggles: list[Toggle], no_event: bool) -> list[z3.BitVecRef]:
        return [half for t in toggles for half in (z3.Extract(31, 0, t.i), z3.BitVecVal(not t.makes, 32))]

    return Interface([BASE["CALL"], BASE["EVENTS"]], cells, told, expected, smin=("CALL", 64), returns_count=True)


def plugin(machine: Machine) -> Interface:
    """contct_kernel of plugin.h, which has no events."""
    spec = machine.spec
    numbers = [spec.nc, spec.indof, spec.ndofpn, z3.Extract(31, 0, spec.dofs)]
    arguments = [z3.Concat(z3.BitVec(f"entry upper {k}", 32), n) for k, n in enumerate(numbers)]
    return Interface([*POINTERS, *arguments], {}, lambda s: [], lambda toggles, no_event: [])


def on_entry(name: str, width: int = 64) -> z3.BitVecRef:
    """The unknown value of a register or an argument on entry."""
    return z3.BitVec("entry " + name, width)


def entry(machine: Machine, interface: Interface, address: int) -> State:
    """The state on entry of the function."""
    machine.output = interface.smin
    s, real = State(address), machine.spec.width
    for name in GENERAL:
        s.set_register(name, on_entry(name, 64))
    for k in range(16):
        s.write(f"xmm{k}", 0, on_entry(f"xmm{k}", real))
        s.write(f"xmm{k}", real // 8, on_entry(f"upper xmm{k}", 128 - real))
    s.set_register("rsp", BASE["STACK"])
    s.write("STACK", 0, RETURN)
    for register, value in zip(REGISTERS, interface.arguments):
        s.set_register(register, value)
    for k, value in enumerate(interface.arguments[len(REGISTERS) :]):
        s.write("STACK", 8 * (k + 1), value)
    for (region, at), value in (interface.cells | {interface.smin: on_entry("SMIN", real)}).items():
        s.write(region, at, value)
    return s


def fault_of_return(machine: Machine, interface: Interface, s: State, smin: z3.BitVecRef, toggled: z3.BitVecRef) -> str:
    """The registers and results that are wrong when the function returns; empty if all are right."""
    expected = {name: on_entry(name, 64) for name in KEPT} | {"rsp": BASE["STACK"] + 8}
    expected |= {"eax": toggled} if interface.returns_count else {}
    wrong = [name for name, value in expected.items() if not machine.same(s, s.register(name), value)]
    wrong += [] if machine.same(s, s.read(*interface.smin, smin.size() // 8), smin) else ["SMIN"]
    return f"the function returns with another {', '.join(wrong)}" if wrong else ""
