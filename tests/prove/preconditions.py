"""preconditions.py BUILD ROOT: tests that a kernel that computes subscripts and products in 64 bits is proved under the
preconditions, and is not proved if one of them is left out."""

import sys
import tempfile
from pathlib import Path

build, root = Path(sys.argv[1]), Path(sys.argv[2])
sys.path[:0] = [str(build), str(root / "tests/support")]
from contct_prove import Undecided
from contct_prove.elf import Image
from contct_prove.induction import Differs, Proof
from contct_prove.interfaces import plugin
from contct_prove.machine import Machine
from contct_prove.specification import PRECONDITIONS, Specification
from edits import edited
from testing import run

WIDER = [("const int dof = (id[i] - 1) * ndofpn", "const long dof = ((long)id[i] - 1) * ndofpn"),
         ("isep * isurf / d_star", "(double)((long)isep * isurf) / d_star")]  # fmt: skip


def fault_without(left_out: str) -> str:
    """Returns why there is no proof without this precondition; empty if there is a proof."""
    machine = Machine(Image(library), Specification(64, left_out))
    try:
        Proof(machine, plugin(machine), machine.image.symbol("contct_kernel").address).prove()
    except (Undecided, Differs) as why:
        return str(why)
    return ""


with tempfile.TemporaryDirectory() as folder:
    library = f"{folder}/wide.so"
    Path(f"{folder}/wide.c").write_text(edited((root / "reference/kernels/contct_kernel.c").read_text(), WIDER))
    run("cc", "-O2", "-ffp-contract=off", "-shared", "-fPIC", "-I", root / "cpp", f"{folder}/wide.c", "-o", library, status=0)
    assert not fault_without("none"), fault_without("none")
    for left_out in PRECONDITIONS:
        assert fault_without(left_out), f"proved without {left_out}"
print(f"{len(PRECONDITIONS)} preconditions, each needed")
