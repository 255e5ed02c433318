"""What runs before the first call of a kernel: the initialisers of its library, and contct_kernel_abi."""

import z3

from . import Undecided
from .elf import Image
from .interfaces import Interface, entry, on_entry
from .machine import Machine
from .specification import Position, Specification
from .state import KEPT, State

ABI = "contct_kernel_abi"


def check(image: Image) -> None:
    """Raise Undecided unless each initialiser only writes static data, which no proved kernel reads, and returns. A
    program's initialisers are trusted: nobody else calls its kernels."""
    for place in [] if image.is_program else image.initialisers():
        if isinstance(place, str):
            raise Undecided(f"{image.path}: found {place} among the initialisers")
        try:
            _ends(image, place)
        except (Undecided, LookupError) as why:
            raise Undecided(f"an initialiser may change how the kernel answers: {why}") from why


def check_abi(image: Image) -> None:
    """Raise Undecided unless contct_kernel_abi returns 1 and does nothing else."""
    at = image.symbol(ABI)
    machine, ends = _ends(image, at.address, starting=False)
    if not all(machine.same(s, s.register("eax"), z3.BitVecVal(1, 32)) for s in ends):
        raise Undecided(f"{image.path}: {ABI} returns another number than 1")


def _ends(image: Image, address: int, starting: bool = True) -> tuple[Machine, list[State]]:
    """The ends of all paths of a function without arguments."""
    machine = Machine(image, Specification(64))
    machine.starting = starting
    machine.begin(Position(1, z3.BitVecVal(0, 64), machine.spec.one, z3.BitVecVal(0, 32)), [])
    start = entry(machine, Interface([], {}, lambda s: [], lambda toggles, no_event: []), address)
    ends = list(machine.explore(start))
    for s in ends:
        if not all(machine.same(s, s.register(name), on_entry(name)) for name in KEPT):
            raise machine.undecided(s, "the function returns with other registers than it must keep")
    return machine, ends
