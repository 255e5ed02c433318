"""The interfaces of kernels: the places of the arguments on entry, and the results on return."""

from typing import Callable, NamedTuple

import z3

from .machine import BASE, RETURN, Machine
from .runtime import END
from .specification import Toggle
from .state import KEPT, Start, State

REGISTERS = ["rdi", "rsi", "rdx", "rcx", "r8", "r9"]  # for the first six arguments; further arguments are on the stack
POINTERS = [BASE[name] for name in ("DD", "DTEST", "CC", "SS", "SMIN", "ID", "ISEP", "ISURF")]


class Interface(NamedTuple):
    """An interface of a kernel."""

    arguments: list[z3.BitVecRef]
    cells: dict[tuple[str, int], z3.BitVecRef]  # contents of memory on entry
    events: Callable[[Toggle], list[z3.BitVecRef]]  # the numbers of the events of a toggle
    smin: tuple[str, int] = ("SMIN", 0)
    returns_count: bool = False
    no_event: list[z3.BitVecRef] = []  # the numbers that tell that no pair is toggled


def fortran(machine: Machine) -> Interface:
    """contct_, the listing: pointers to all arguments, COMMON /DOF/, and WRITEs as events."""
    spec, common = machine.spec, machine.image.take("dof_")
    label = lambda number: z3.BitVecVal(number, 32)

    def events(t: Toggle) -> list[z3.BitVecRef]:
        return [label(40 if t.makes else 50), END, label(60), z3.Extract(31, 0, t.i) + 1, t.node, t.isurf, t.smin, END]

    cells = {("NC", 0): spec.nc, ("IMAGE", common): spec.indof, ("IMAGE", common + 4): spec.ndofpn}
    return Interface([*POINTERS, BASE["NC"]], cells, events, no_event=[label(20), spec.one, END])


def cpp(machine: Machine) -> Interface:
    """contct<Real> of contct.hpp: a struct with spans, and an array of events, whose number is returned."""
    spec = machine.spec
    places = {"DD": 0, "DTEST": 16, "CC": 32, "SS": 48, "ID": 72, "ISEP": 88, "ISURF": 104}
    cells = {("CALL", at): BASE[name] for name, at in places.items()}
    cells |= {("CALL", at + 8): spec.length(name) for name, at in places.items()}
    cells |= {("CALL", 120): spec.indof, ("CALL", 124): spec.ndofpn, ("CALL", 128): on_entry("at_rest", 32)}
    events = lambda t: [z3.Extract(31, 0, t.i), z3.BitVecVal(not t.makes, 32)]
    return Interface([BASE["CALL"], BASE["EVENTS"]], cells, events, smin=("CALL", 64), returns_count=True)


def plugin(machine: Machine) -> Interface:
    """contct_kernel of plugin.h, which has no events."""
    spec = machine.spec
    numbers = [spec.nc, spec.indof, spec.ndofpn, z3.Extract(31, 0, spec.dofs)]
    arguments = [z3.Concat(on_entry(f"upper {k}", 32), n) for k, n in enumerate(numbers)]
    return Interface([*POINTERS, *arguments], {}, lambda t: [])


def on_entry(name: str, width: int = 64) -> z3.BitVecRef:
    """The unknown value of a register or an argument on entry."""
    return z3.BitVec("entry " + name, width)


def entry(machine: Machine, interface: Interface, address: int, start: Start) -> State:
    """The state on entry of the function."""
    machine.output = interface.smin
    s = State(address, start)
    for name in KEPT:
        s.set_register(name, on_entry(name))
    s.set_register("rsp", BASE["STACK"])
    s.write("STACK", 0, RETURN)
    for register, value in zip(REGISTERS, interface.arguments):
        s.set_register(register, value)
    for k, value in enumerate(interface.arguments[len(REGISTERS) :]):
        s.write("STACK", 8 * (k + 1), value)
    for (region, at), value in (interface.cells | {interface.smin: on_entry("SMIN", machine.spec.width)}).items():
        s.write(region, at, value)
    return s


def fault_of_return(machine: Machine, s: State, results: dict[tuple[str, int], z3.BitVecRef]) -> str:
    """The registers and results that are wrong when the function returns; empty if all are right. `results`: the right
    values of some places."""
    expected = {(name, 0): on_entry(name) for name in KEPT} | {("rsp", 0): BASE["STACK"] + 8} | results
    wrong = [region for (region, at), value in expected.items() if not machine.same(s, s.value(region, at, value.size() // 8), value)]
    return f"the function returns with another {', '.join(wrong)}" if wrong else ""
