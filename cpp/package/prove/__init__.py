"""The prover compares a kernel's machine code with the specification of CONTCT by symbolic execution.

Its command line is `python3 -m contct_prove LIBRARY`. reference/proved-equal.md describes the proof."""


class Undecided(Exception):
    """The reason why nothing is proved or refuted, with the place in the disassembly if known."""
