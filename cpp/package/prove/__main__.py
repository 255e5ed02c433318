"""contct prove: is this machine code CONTCT, for every input?"""

import argparse
import functools
import multiprocessing
import os
import sys
from typing import Any

MISSING = """contct prove: {} is not found; it needs the Python packages capstone and z3.
On Debian: apt-get install python3-capstone python3-z3"""
CLAIM = """
For every call within the preconditions, each kernel that is proved leaves the bits of the specification in SS, SMIN and
ISEP and makes its events, by machine-checked induction.
Preconditions: {}; no array overlaps another; one rounding
mode, subnormals kept, floating-point exceptions masked.
Trusted: capstone {}, Z3 {}, and the interpreter; that libgfortran changes only its parameter block.
Not covered: the digits that a FORMAT writes, and other builds."""


def parsed() -> argparse.Namespace:
    """The command line."""
    p = argparse.ArgumentParser("contct prove", description=__doc__)
    p.add_argument("library", metavar="LIBRARY", help="an ELF file of x86-64 with a kernel, such as mine.so")
    p.add_argument("--symbol", default="", help="the kernel's name, if it is not contct_kernel")
    return p.parse_args()


def main() -> int:
    """Print the verdicts; return the exit status."""
    o = parsed()
    try:
        import capstone
        import z3
    except ImportError as missing:
        print(MISSING.format(missing.name), file=sys.stderr)
        return 2
    from .elf import Image
    from .specification import PRECONDITIONS
    from .undecided import Undecided
    from .verdict import Outcome, judge, kernels_of

    try:
        image = Image(o.library)
        kernels = kernels_of(image, o.symbol)
    except (OSError, Undecided) as error:
        print(f"contct prove: {error}", file=sys.stderr)
        return 2
    print(f"{o.library}\nSHA-256 {image.sha256}\n", flush=True)
    outcomes = set()
    with multiprocessing.Pool(2) as pool:
        for verdict in pool.imap(functools.partial(judge, o.library), kernels):
            outcomes.add(verdict.outcome)
            print(f"{verdict.kernel.words} ({verdict.kernel.symbol}): {verdict.words}", flush=True)
    if Outcome.PROVED in outcomes:
        stated = "; ".join(PRECONDITIONS.values())
        print(CLAIM.format(stated, capstone.__version__, z3.get_version_string()))
    return next(o for o in (Outcome.DIFFERS, Outcome.UNDECIDED, Outcome.PROVED) if o in outcomes)


def fail_closed(*failure: Any) -> None:
    """An error of the prover itself is no verdict, and Python's own exit status would be that of a difference."""
    sys.__excepthook__(*failure)
    os._exit(2)


if __name__ == "__main__":
    sys.excepthook = fail_closed
    sys.exit(main())
