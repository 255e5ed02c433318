"""closed.py BUILD ROOT: tests that kernels with code unknown to the prover stay undecided, as do files of which something
else decides what runs, and that an empty kernel differs."""

import json
import os
import sys
import tempfile
from pathlib import Path
from unittest import mock

build, root = Path(sys.argv[1]), Path(sys.argv[2])
sys.path[:0] = [str(build), str(root / "tests/support")]
import contct
import contct_prove.__main__ as prover
from contct_prove import Undecided
from contct_prove.elf import Image
from contct_prove.induction import Proof
from contct_prove.interfaces import plugin
from contct_prove.machine import Machine
from contct_prove.specification import Specification
from testing import run

ABI = ".globl contct_kernel_abi\ncontct_kernel_abi:\nmov $1, %eax\nret\n"
KERNEL = ABI + ".globl contct_kernel\n.type contct_kernel,@function\ncontct_kernel:\n{}\nud2\n.size contct_kernel, .-contct_kernel\n.section .note.GNU-stack\n"
CASES = {  # a kernel's body, and the reason that the prover must give
    "cpuid": "this encoding is not known",
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
    "mov %rax, -70000(%rsp)": "more than 65536 bytes of the stack are used",
    "mov pointer(%rip), %rax\n.data\npointer: .quad pointer\n.text": "static data is read that may have changed",
    "pushw $1": "this encoding is not known",
    ".byte 0x66, 0xe9, 0, 0": "this encoding is not known",
    ".byte 0x63, 0xc0": "this encoding is not known",
    ".byte 0xf2, 0x0f, 0x54, 0xc1": "this encoding is not known",
    ".byte 0x66, 0xf2, 0x0f, 0x10, 0x07": "this encoding is not known",
    "movsl": "this encoding is not known",
    "vaddpd %ymm0, %ymm1, %ymm2": "this encoding is not known",
    "vaddsd {rn-sae}, %xmm0, %xmm1, %xmm2": "this encoding is not known",
    "vcmpsd $8, %xmm0, %xmm1, %xmm2": "a comparison that only the VEX form has",
    "movaps %xmm0, -32(%rsp)": "not known to be a multiple of 16",
    "vmovapd %xmm0, -32(%rsp)": "not known to be a multiple of 16",
    "andpd (%rdi), %xmm0": "not known to be a multiple of 16",
    "lea after(%rip), %rax\npush %rax\nadd $256, %rsp\nmov -256(%rsp), %rax\njmp *%rax\nafter: ud2": "not known to be in one region",
}  # fmt: skip
KERNEL_ALONE = KERNEL.removeprefix(ABI).format("nop")
SETS_ROUNDING = "ldmxcsr 4(%rsp)\nmov $1, %eax\nret\n"
FILES = {  # a library, and the reason
    KERNEL_ALONE: "found no symbol contct_kernel_abi",
    ABI.replace("$1", "$2") + KERNEL_ALONE: "contct_kernel_abi must return 1 and do nothing else",
    ABI.replace("mov $1", "movl $1, changed(%rip)\nmov $1") + KERNEL_ALONE + ".data\nchanged: .long 0\n": "IMAGE is written",
    ABI.replace("mov $1, %eax\nret\n", SETS_ROUNDING) + KERNEL_ALONE: "this encoding is not known",
    KERNEL.format("nop") + '.section .init_array,"aw"\n.quad begin\n.text\nbegin:\n' + SETS_ROUNDING: "an initialiser may change how the kernel answers",
    KERNEL.format("nop") + '.section .both,"awx",@progbits\nnop\n': "writable and executable",
    KERNEL.format("call helper@plt") + ".text\n.globl helper\nhelper: ret\n": "helper, which another object may define, is called",
    KERNEL.format("call helper@plt") + ".text\n.hidden helper\n.globl helper\n.type helper,@gnu_indirect_function\nhelper: lea local(%rip), %rax\nret\nlocal: ret\n":
        "the place of relocation 37 is called",
    KERNEL.format("mov constant@GOTPCREL(%rip), %rax\nmov (%rax), %eax") + '.section .rodata\n.globl constant\nconstant: .long 1\n': "not known to be in one region",
    KERNEL.format("mov dof_@GOTPCREL(%rip), %rax\nmov (%rax), %eax") + '.section .rodata\n.globl dof_\ndof_: .long 1\n': "not known to be in one region",
    KERNEL.format("nop").replace("@function", "@gnu_indirect_function"): "a type of symbol that is not supported",
    KERNEL.format("nop") + '.section .init_array,"aw"\n.quad begin\n.data\npointer: .quad pointer\n.text\nbegin: movq $0, pointer(%rip)\nret\n':
        "an initialiser may change how the kernel answers",
}  # fmt: skip
UNKNOWN = """lock incl (%rcx); rep movsb; fld1; emms; bswap %eax; xchg %eax, (%rcx); rdtsc; syscall; int3; enter $16, $0; loop .; jrcxz .
std; popf; sahf; ldmxcsr (%rsp); stmxcsr (%rsp); fxrstor (%rsp); vzeroall; mov %fs:0x30, %rax; mov %gs:0x28, %rax; addl $1, %fs:0x28
cmpq %rax, %fs:0x30; adc $1, %eax; sbb %eax, %eax; rol $1, %eax; shld $1, %eax, %ecx; bt $1, %eax; bsr %ecx, %eax; div %ecx; cwtl
mulq %rcx; sqrtsd %xmm0, %xmm0; rcpss %xmm0, %xmm0; cvtsd2ss %xmm0, %xmm0; cvttsd2si %xmm0, %eax; roundsd $0, %xmm0, %xmm0
addpd %xmm0, %xmm1; haddpd %xmm0, %xmm1; vaddpd %ymm0, %ymm1, %ymm2; vmovapd %ymm0, %ymm1; vfmadd231sd %xmm0, %xmm1, %xmm2
movntpd %xmm0, (%rcx); movhpd (%rdi), %xmm0; unpckhpd %xmm0, %xmm1; pshufd $0, %xmm0, %xmm1; crc32b %al, %eax; rdrand %rax; .byte 0x48, 0x26, 0x90
.byte 0x67, 0x8b, 0x07; data16 jmp .; .byte 0xf3, 0x66, 0x0f, 0x10, 0xc1; .byte 0x40, 0x66, 0x89, 0xc1; .byte 0xf1; .byte 0xc5, 0xfd, 0x10, 0x07
.byte 0xc4, 0xe1, 0x81, 0x58, 0xc1, 0xf0; .byte 0xc5, 0xe3, 0x10, 0x07; .byte 0x62, 0xf1, 0xff, 0x08, 0x58, 0xc1; mov %eax, %ds; in $1, %al"""
PROVE, ENVIRONMENT = ("-m", "contct_prove"), os.environ | {"PYTHONPATH": str(build)}


def link(library: str, source: str) -> None:
    """Makes a library of a source in assembler."""
    run("cc", "-shared", "-x", "assembler", "-o", library, "-", input=source, status=0)


def check_unknown(library: str) -> int:
    """Checks that an instruction that is not in the table is undecided as the first one of a kernel. Returns their number."""
    bodies = UNKNOWN.replace("\n", "; ").split("; ")
    link(library, "".join(f".globl k{i}\nk{i}: {body}\nret\n" for i, body in enumerate(bodies)))
    for i, body in enumerate(bodies):
        machine = Machine(Image(library), Specification(64))
        try:
            Proof(machine, plugin(machine), machine.image.symbol(f"k{i}").address).prove()
            raise AssertionError(f"{body}: found a proof")
        except Undecided as why:
            assert "this encoding is not known" in str(why), f"{body}: {why}"
    return len(bodies)


def check_library(library: str, source: str, expected: str) -> None:
    """Checks that a library of this source is undecided for this reason, without a call of the kernel."""
    link(library, source)
    try:
        with mock.patch.object(prover, "_run", return_value=("", "")):
            status, words = prover.judge(library, *prover.kernels_of(Image(library), ""))
    except Undecided as why:
        status, words = prover.UNDECIDED, str(why)
    assert status == prover.UNDECIDED and expected in words, f"{source}: allowed: undecided, {expected}; found {status}, {words}"


def check(expected: str, *command: str, status: int = 2) -> None:
    """Checks the result of a command: undecided, for this reason, or the other status."""
    said = run(*command, env=ENVIRONMENT)
    words = said.stdout + said.stderr
    assert said.returncode == status and expected in words and "proved:" not in words, f"{command}: allowed: {status}, {expected}; found {said}"


with tempfile.TemporaryDirectory() as folder:
    library, trace, verdicts = f"{folder}/mine.so", f"{folder}/call.trace", f"{folder}/verdicts.json"
    unknown = check_unknown(library)
    for source, expected in [*((KERNEL.format(body), why) for body, why in CASES.items()), *FILES.items()]:
        check_library(library, source, expected)
    link(library, KERNEL.format("cpuid"))
    check(CASES["cpuid"], "/usr/bin/python3", *PROVE, library)
    found = contct.prove(library)["contct_kernel"]
    assert found.startswith("undecided: ") and CASES["cpuid"] in found, f"by the Python module: {found}"
    link(library, KERNEL.format("ret"))
    check("contct_kernel (contct_kernel): differs: call 1: ", "/usr/bin/python3", *PROVE, library, f"--trace={trace}", f"--json={verdicts}", status=1)
    assert [k["verdict"] for k in json.loads(Path(verdicts).read_text())["kernels"]] == ["differs"]
    run(str(build / "contct"), "replay", trace, status=0)
    run(str(build / "contct"), "replay", trace, "--kernel", "plugin:" + library, status=1)
    whole = Path(library).read_bytes()
    check("found the library", "/usr/bin/python3", *PROVE, library, "--json=" + library)
    assert Path(library).read_bytes() == whole
    for size in (70, 700, len(whole) // 2):
        Path(f"{folder}/cut.so").write_bytes(whole[:size])
        check(f"{folder}/cut.so: found", "/usr/bin/python3", *PROVE, f"{folder}/cut.so")
    check("found no symbol other", "/usr/bin/python3", *PROVE, library, "--symbol", "other")
check("found no ELF file of x86-64", "/usr/bin/python3", *PROVE, str(root / "README.md"))
check("No such file", "/usr/bin/python3", *PROVE, "/no/such.so")
check("found no kernel", "/usr/bin/python3", *PROVE, "/bin/true")
check("apt-get install python3-capstone python3-z3", "/usr/bin/python3", "-S", *PROVE, "/bin/true")
check("found no ELF file of x86-64", str(build / "contct"), "prove", str(root / "README.md"))
print(f"{len(CASES) + len(FILES) + 10 + unknown} cases are undecided")
