"""The answer where nothing is proved and nothing is refuted."""


class Undecided(Exception):
    """Why there is no verdict, with the place in the disassembly where there is one."""
