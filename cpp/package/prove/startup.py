"""What runs before the first call of a kernel: the initialisers of its library, and contct_kernel_abi."""

import z3

from . import Undecided
from .elf import Image
from .interfaces import Interface, entry, fault_of_return
from .machine import Machine
from .specification import Specification
from .state import Start

ABI = "contct_kernel_abi"


def check(image: Image) -> None:
    """Raise Undecided unless each initialiser only writes static data, which no proved kernel reads, and returns. A
    program's initialisers are trusted: nobody else calls its kernels."""
    for address in [] if image.is_program else image.initialisers():
        _check(image, address, True, {}, "an initialiser may change how the kernel answers")


def check_abi(image: Image) -> None:
    """Raise Undecided unless contct_kernel_abi returns 1 and does nothing else."""
    _check(image, image.symbol(ABI).address, False, {("rax", 0): z3.BitVecVal(1, 32)}, f"{ABI} must return 1 and do nothing else")


def _check(image: Image, address: int, starting: bool, results: dict[tuple[str, int], z3.BitVecRef], rule: str) -> None:
    """Raise Undecided, with the rule, unless a function without arguments returns with these results on all paths."""
    machine = Machine(image, Specification(64), starting)
    start = entry(machine, Interface([], {}, lambda t: []), address, Start(0, machine.spec.first, []))
    try:
        for s in machine.explore(start):
            if fault := fault_of_return(machine, s, results):
                raise machine.undecided(s, fault)
    except (Undecided, LookupError) as why:  # LookupError: unknown code
        raise Undecided(f"{rule}: {why}") from why
