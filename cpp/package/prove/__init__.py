"""The prover: symbolic execution of a kernel's machine code against the specification of CONTCT.

`python3 -m contct_prove LIBRARY` is its command line, and reference/proved-equal.md says what is proved and how."""


class Undecided(Exception):
    """Why nothing is proved and nothing is refuted, with the place in the disassembly where there is one."""
