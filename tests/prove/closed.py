"""closed.py BUILD ROOT: tests that kernels with code unknown to the prover stay undecided, and that an empty kernel
differs."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

build, root = Path(sys.argv[1]), Path(sys.argv[2])
sys.path.insert(0, str(build))
import contct

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


def prove(*words: str, python: tuple[str, ...] = ("/usr/bin/python3",)) -> tuple[int, str]:
    """Runs the prover, and returns its exit status and output."""
    said = subprocess.run([*python, "-m", "contct_prove", *words], env=os.environ | {"PYTHONPATH": str(build)},
                          capture_output=True, text=True)  # fmt: skip
    return said.returncode, said.stdout + said.stderr


def check(name: str, found: tuple[int, str], expected: str) -> None:
    """Checks that the prover's result is undecided, for this reason."""
    assert found[0] == 2 and expected in found[1], f"{name}: expected exit 2 and {expected!r}; found {found}"
    assert "proved:" not in found[1], name


with tempfile.TemporaryDirectory() as folder:
    library = f"{folder}/mine.so"
    for body, expected in CASES.items():
        Path(f"{folder}/mine.s").write_text(KERNEL.format(body))
        subprocess.run(["cc", "-shared", "-o", library, f"{folder}/mine.s"], check=True)
        check(body, prove(library), expected)
    found = contct.prove(library)["contct_kernel"]
    assert found.startswith("undecided: ") and expected in found, f"by the Python module: {found}"
    Path(f"{folder}/mine.s").write_text(KERNEL.format("ret"))
    subprocess.run(["cc", "-shared", "-o", library, f"{folder}/mine.s"], check=True)
    status, said = prove(library)
    assert status == 1 and "differs: SMIN is " in said, f"a kernel that does nothing: {status} {said}"
    check("no such symbol", prove(library, "--symbol", "other"), "found no symbol other")
check("no ELF file", prove(str(root / "README.md")), "found no ELF file of x86-64")
check("no file", prove("/no/such.so"), "No such file")
check("no kernel", prove("/bin/true"), "found no kernel")
check("no packages", prove("/bin/true", python=("/usr/bin/python3", "-S")), "apt-get install python3-capstone python3-z3")
said = subprocess.run([build / "contct", "prove", root / "README.md"], capture_output=True, text=True)
check("by the program", (said.returncode, said.stdout + said.stderr), "found no ELF file of x86-64")
print(f"{len(CASES) + 6} cases are undecided")
