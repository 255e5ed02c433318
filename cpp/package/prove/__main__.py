"""contct prove: is this machine code CONTCT, for every input?"""

import argparse
import functools
import gc
import hashlib
import json
import multiprocessing
import os
import subprocess
import sys
import time
import traceback
from typing import Callable, NamedTuple

from . import Undecided

try:
    import capstone
    import z3
except ImportError as missing:
    if __name__ != "__main__":
        raise
    print(f"contct prove: {missing.name} is not found; it needs the Python packages capstone and z3.\n"
          "On Debian: apt-get install python3-capstone python3-z3", file=sys.stderr)  # fmt: skip
    sys.exit(2)

from . import interfaces, replay, startup
from .elf import Image
from .induction import Differs, Proof
from .machine import Machine
from .specification import PRECONDITIONS, Specification

PROVED, DIFFERS, UNDECIDED = 0, 1, 2  # the exit status
VERDICTS = ("proved", "differs", "undecided")
PLUGIN = "contct_kernel"
CLAIM = f"""
For every call within the preconditions, each kernel that is proved leaves the bits of the specification in SS, SMIN and
ISEP and makes its events, by machine-checked induction.
Preconditions: {"; ".join(PRECONDITIONS.values())};
ISEP and ISURF are any such numbers, where `contct fuzz` draws ISEP from -2 to 2 and ISURF 1 or -1;
no array overlaps another or the middle of the address space; one rounding mode, subnormals kept, floating-point exceptions masked.
Trusted: Z3 {z3.get_version_string()} and the interpreter of instructions; that libgfortran changes only its parameter block.
Not covered: the digits that a FORMAT writes, and other builds."""


class Kernel(NamedTuple):
    """A function that answers calls of CONTCT."""

    symbol: str
    width: int  # bits of REAL
    interface: Callable[[Machine], interfaces.Interface]
    words: str


_CPP = "_ZN6contct6contctI{}EEiRNS_4callIT_EESt4spanINS_5eventELm18446744073709551615EE"
KERNELS = [
    Kernel("contc8_", 64, interfaces.fortran, "contct.f, 8-byte REAL"),
    Kernel("contc4_", 32, interfaces.fortran, "contct.f, 4-byte REAL"),
    Kernel(_CPP.format("d"), 64, interfaces.cpp, "contct<double>"),
    Kernel(_CPP.format("f"), 32, interfaces.cpp, "contct<float>"),
    Kernel(PLUGIN, 64, interfaces.plugin, PLUGIN),
]


def kernels_of(image: Image, symbol: str) -> list[Kernel]:
    """The kernel `symbol`, with the interface of plugin.h unless it is a known kernel. Without `symbol`: contct_kernel
    if the file has it, otherwise all four kernels of the program, so that a missing kernel is noticed."""
    if symbol:
        return [k for k in KERNELS if k.symbol == symbol] or [Kernel(image.symbol(symbol).name, 64, interfaces.plugin, symbol)]
    *ours, plugin = KERNELS
    if image.find(plugin.symbol):
        return [plugin]
    if not any(image.find(k.symbol) for k in ours):
        allowed = ", ".join(k.symbol for k in KERNELS)
        raise Undecided(f"{image.path}: found no kernel; allowed: a file with one of {allowed}, or --symbol")
    return ours


def judge(path: str, kernel: Kernel, trace: str = "") -> tuple[int, str]:
    """The verdict on one kernel of a file: exit status and words. `trace`: a file for a call with a difference."""
    gc.disable()  # Z3's terms have no cycles
    start, image = time.process_time(), Image(path)
    machine, why = Machine(image, Specification(kernel.width)), ""
    try:
        startup.check(image)
        if kernel.symbol == PLUGIN:
            startup.check_abi(image)
        proof = Proof(machine, kernel.interface(machine), image.symbol(kernel.symbol).address)
        proof.prove()
    except (Undecided, Differs, z3.Z3Exception, LookupError) as error:  # LookupError: unknown code
        why = str(error)
    found, failure = _run(path, trace, machine.constants if why else set()) if kernel.symbol == PLUGIN else ("", "")
    if found:
        return DIFFERS, f"differs: {found}"
    if why or failure:
        return UNDECIDED, "; ".join(filter(None, (f"undecided: {why or 'its code is proved'}", failure)))
    code = image.code_of(kernel.symbol)
    return PROVED, (f"proved: {len(code)} bytes of SHA-256 {hashlib.sha256(code).hexdigest()}; {len(proof.heads)} loops, "
                    f"{machine.paths} paths, {machine.questions} questions, {time.process_time() - start:.1f} s of "
                    "processor time")  # fmt: skip


def _run(path: str, trace: str, constants: set[int]) -> tuple[str, str]:
    """Run a plug-in: a call that it and FORTRAN answer differently, if one is found, and why no calls were compared.
    `constants`: for them there are more calls."""
    # In a process of its own: it is small, so that children start quickly.
    command = [sys.executable, "-m", f"{__package__}.replay", os.path.abspath(path), trace, *map(str, sorted(constants))]
    said = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)})
    failure = (said.stderr.splitlines() or [f"exit status {said.returncode}"])[-1]
    return ("", f"run with contct.py: {failure}") if said.returncode else (said.stdout, "")


def main() -> int:
    """Print the verdicts; return the exit status."""
    p = argparse.ArgumentParser("contct prove", description=__doc__)
    p.add_argument("library", metavar="LIBRARY", help="an ELF file of x86-64 with a kernel, such as mine.so")
    p.add_argument("--symbol", default="", help="the kernel's name, if it is not contct_kernel")
    p.add_argument("--json", default="", metavar="FILE", help="write the verdicts to this file (- is standard output)")
    p.add_argument("--trace", default="", metavar="FILE", help="write a call that is answered differently to this file, for contct replay")
    o = p.parse_args()
    try:
        return _print_verdicts(o)
    except (OSError, Undecided) as error:
        print(f"contct prove: {error}", file=sys.stderr)
    except BaseException:  # Python's exit status 1 would mean a difference
        traceback.print_exc()
    return UNDECIDED


def _print_verdicts(o: argparse.Namespace) -> int:
    say = functools.partial(print, file=sys.stderr if o.json == "-" else sys.stdout, flush=True)
    if o.trace == "-":
        raise Undecided("--trace: found -; allowed: the name of a file")
    for name in filter(None, (o.json, o.trace)):
        if os.path.realpath(name) == os.path.realpath(o.library):
            raise Undecided(f"{name}: found the library; allowed: another file for the output")
    image = Image(o.library)
    kernels, rows, found = kernels_of(image, o.symbol), [], set()
    digest = hashlib.sha256(image.data).hexdigest()
    say(f"{o.library}\nSHA-256 {digest}\n")
    with multiprocessing.Pool(2) as pool:
        for kernel, (status, words) in zip(kernels, pool.imap(functools.partial(judge, o.library, trace=o.trace), kernels)):
            found.add(status)
            rows.append({"symbol": kernel.symbol, "kernel": kernel.words, "verdict": VERDICTS[status], "words": words})
            say(f"{kernel.words} ({kernel.symbol}): {words}")
    if DIFFERS in found:
        say("ISEP and ISURF may be any numbers here; `contct fuzz` draws ISEP from -2 to 2 and ISURF 1 or -1.")
    if PROVED in found:
        say(CLAIM)
    text = json.dumps({"library": o.library, "sha256": digest, "kernels": rows}, indent=2) + "\n"
    if o.json == "-":
        print(text, end="")
    elif o.json:
        replay.write_whole(o.json, text)
    return next(status for status in (DIFFERS, UNDECIDED, PROVED) if status in found)


if __name__ == "__main__":
    sys.exit(main())
