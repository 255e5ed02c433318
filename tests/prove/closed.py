"""closed.py BUILD ROOT: tests that kernels with code unknown to the prover stay undecided, and that an empty kernel
differs."""

import os
import sys
import tempfile
from pathlib import Path

build, root = Path(sys.argv[1]), Path(sys.argv[2])
sys.path[:0] = [str(build), str(root / "tests/support")]
import contct
from testing import run

ABI = ".globl contct_kernel_abi\ncontct_kernel_abi:\nmov $1, %eax\nret\n"
KERNEL = ABI + ".globl contct_kernel\n.type contct_kernel,@function\ncontct_kernel:\n{}\nud2\n.size contct_kernel, .-contct_kernel\n.section .note.GNU-stack\n"
CASES = {  # a kernel's body, and the reason that the prover must give
    "cpuid": "this mnemonic is not known",
    ".rept 5000\nnop\n.endr": "no end of the path after 4000 instructions",
    "jmp *%rax": "an address that is not known to be in one region",
    "mov 4(%r9), %eax": "a subscript of ID that is not that of the next pair",
    "mov here(%rip), %eax\n.data\nhere: .long 1\n.text": "static data is read",
    "mov (%rax), %rax": "an address that is not known to be in one region",
    "mov %rax, (%rdi)": "DD is written, which the function may not change",
    "mov -4(%rdi), %eax": "32 bits of DD",
    "mov %rax, -12(%rip)": "IMAGE is written",
    "call abort@plt": "abort is called, whose effect is not known",
    "mov %rdi, (%rsp)\nret": "the target of the jump is not known",
    "mov %rax, -4096(%rsp)": "a write below the red zone",
}  # fmt: skip
PROVE, ENVIRONMENT = ("-m", "contct_prove"), os.environ | {"PYTHONPATH": str(build)}


def check(expected: str, *command: str, status: int = 2) -> None:
    """Checks the result of a command: undecided, for this reason, or the other status."""
    said = run(*command, env=ENVIRONMENT)
    words = said.stdout + said.stderr
    assert said.returncode == status and expected in words and "proved:" not in words, f"{command}: allowed: {status}, {expected}; found {said}"


with tempfile.TemporaryDirectory() as folder:
    library = f"{folder}/mine.so"
    for body, expected in {**CASES, "ret": "differs: SMIN is "}.items():
        Path(f"{folder}/mine.s").write_text(KERNEL.format(body))
        run("cc", "-shared", "-o", library, f"{folder}/mine.s", status=0)
        check(expected, "/usr/bin/python3", *PROVE, library, status=1 if body == "ret" else 2)
        if body == "cpuid":
            found = contct.prove(library)["contct_kernel"]
            assert found.startswith("undecided: ") and expected in found, f"by the Python module: {found}"
    check("found no symbol other", "/usr/bin/python3", *PROVE, library, "--symbol", "other")
check("found no ELF file of x86-64", "/usr/bin/python3", *PROVE, str(root / "README.md"))
check("No such file", "/usr/bin/python3", *PROVE, "/no/such.so")
check("found no kernel", "/usr/bin/python3", *PROVE, "/bin/true")
check("apt-get install python3-capstone python3-z3", "/usr/bin/python3", "-S", *PROVE, "/bin/true")
check("found no ELF file of x86-64", str(build / "contct"), "prove", str(root / "README.md"))
print(f"{len(CASES) + 6} cases are undecided")
