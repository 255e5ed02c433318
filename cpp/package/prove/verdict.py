"""One kernel's verdict: proved, differs or undecided."""

import enum
import hashlib
import os
import time
from typing import NamedTuple

import z3

from . import interfaces, replay
from .elf import Image
from .induction import Differs, Proof
from .machine import Machine
from .specification import Specification
from .undecided import Undecided


class Kernel(NamedTuple):
    """A function that answers calls of CONTCT."""

    symbol: str
    width: int  # of REAL, in bits
    interface: type[interfaces.Interface]
    words: str


_CPP = "_ZN6contct7kernels6contctI{}EEiRNS0_4callIT_EESt4spanINS0_5eventELm18446744073709551615EE"
KERNELS = [
    Kernel("contc8_", 64, interfaces.Fortran, "contct.f, 8-byte REAL"),
    Kernel("contc4_", 32, interfaces.Fortran, "contct.f, 4-byte REAL"),
    Kernel(_CPP.format("d"), 64, interfaces.Cpp, "contct<double>"),
    Kernel(_CPP.format("f"), 32, interfaces.Cpp, "contct<float>"),
    Kernel("contct_kernel", 64, interfaces.Plugin, "contct_kernel"),
]


class Outcome(enum.IntEnum):
    """The exit status, by itself."""

    PROVED = 0
    DIFFERS = 1
    UNDECIDED = 2


class Verdict(NamedTuple):
    """What is known of one kernel, in words."""

    kernel: Kernel
    outcome: Outcome
    words: str


def kernels_of(image: Image, symbol: str) -> list[Kernel]:
    """The kernels of a file whose interfaces are known, or the one of that name, by default with plugin.h's interface."""
    if symbol:
        image.symbol(symbol)
        known = [k for k in KERNELS if k.symbol == symbol]
        return known or [Kernel(symbol, 64, interfaces.Plugin, symbol)]
    found = [k for k in KERNELS if k.symbol in image.symbols]
    if not found:
        allowed = ", ".join(k.symbol for k in KERNELS)
        raise Undecided(f"{image.path}: found no kernel; allowed: a file with one of {allowed}, or --symbol")
    return found


def _refuted(path: str, kernel: Kernel, machine: Machine, why: str) -> Verdict | None:
    """A call that the kernel answers otherwise, both having been run: only that is a difference."""
    if kernel.symbol != "contct_kernel":
        return None
    try:
        found = replay.search(os.path.abspath(path), machine.constants)
    except Exception as failure:  # no library, a kernel that crashes: no call was compared
        return Verdict(kernel, Outcome.UNDECIDED, f"undecided: {why}; run with contct.py: {failure}")
    return Verdict(kernel, Outcome.DIFFERS, f"differs: {found}") if found else None


def judge(path: str, kernel: Kernel, left_out: str = "") -> Verdict:
    """The verdict on one kernel of a file."""
    start = time.process_time()
    image = Image(path)
    machine = Machine(image, Specification(kernel.width, left_out))
    try:
        proof = Proof(machine, kernel.interface(machine), image.symbol(kernel.symbol).address)
        proof.prove()
    except (Undecided, z3.Z3Exception, LookupError) as why:  # the latter from code of a form that nobody thought of
        return _refuted(path, kernel, machine, str(why)) or Verdict(kernel, Outcome.UNDECIDED, f"undecided: {why}")
    except Differs as why:
        words = f"undecided: {why}; no call was found that shows it"
        return _refuted(path, kernel, machine, str(why)) or Verdict(kernel, Outcome.UNDECIDED, words)
    symbol = image.symbol(kernel.symbol)
    code = hashlib.sha256(image.bytes_at(symbol.address, symbol.size)[0]).hexdigest()
    return Verdict(kernel, Outcome.PROVED,
                   f"proved: {symbol.size} bytes of SHA-256 {code}; {len(proof.heads)} loops, {machine.paths} paths, "
                   f"{machine.questions} questions, {time.process_time() - start:.1f} s of processor time")  # fmt: skip
