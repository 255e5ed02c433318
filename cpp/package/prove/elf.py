"""A linked ELF file of x86-64: its bytes, symbols and relocations."""

import struct
from typing import NamedTuple

from . import Undecided

_HEADER = "<6s12xH12xQQ6xHHHH"  # file header: magic number, machine, and the places, sizes and counts of tables
_X86_64, _LOAD, _RELOCATIONS, _SYMBOLS, _DYNAMIC_SYMBOLS = 62, 1, 4, 2, 11
_WRITABLE = 2
_R_64, _R_GLOB_DAT, _R_JUMP_SLOT, _R_RELATIVE = 1, 6, 7, 8


class Symbol(NamedTuple):
    """A symbol of the file. `address` is 0 if another file defines the symbol."""

    name: str
    address: int
    size: int


class Image:
    """The file as loaded in memory, at an unknown address."""

    def __init__(self, path: str):
        self.path = path
        with open(path, "rb") as file:
            self.data = file.read()
        found = struct.unpack_from(_HEADER, self.data) if len(self.data) >= 64 else (b"", 0)
        if found[:2] != (b"\x7fELF\x02\x01", _X86_64):
            raise Undecided(f"{path}: found no ELF file of x86-64; allowed: machine code of x86-64 in an ELF file")
        programs, sections, program_size, program_count, section_size, section_count = found[2:]
        self._segments = self._rows("<IIQQQQQQ", programs, program_size * program_count)
        sections = self._rows("<IIQQQQIIQQ", sections, section_size * section_count)
        self.symbols: dict[str, Symbol] = {}
        self.relocations: dict[int, str | int] = {}  # a symbol of another file, or an address
        for _, kind, _, _, at, size, link, *_ in sections:
            if kind in (_SYMBOLS, _DYNAMIC_SYMBOLS):
                self.symbols |= {s.name: s for s in self._table(at, size, sections[link]) if s.address}
            if kind == _RELOCATIONS and sections[link][1] == _DYNAMIC_SYMBOLS:
                _, _, _, _, symbols_at, symbols_size, names, *_ = sections[link]
                self._relocate(at, size, self._table(symbols_at, symbols_size, sections[names]))

    def _rows(self, form: str, at: int, size: int) -> list[tuple]:
        return list(struct.iter_unpack(form, self.data[at : at + size]))

    def _table(self, at: int, size: int, names: tuple) -> list[Symbol]:
        text = self.data[names[4] : names[4] + names[5]]
        return [Symbol(text[name : text.index(b"\0", name)].decode(), value if where else 0, length)
                for name, _, _, where, value, length in self._rows("<IBBHQQ", at, size)]  # fmt: skip

    def _relocate(self, at: int, size: int, symbols: list[Symbol]) -> None:
        for where, kind, addend in self._rows("<QQq", at, size):
            symbol = symbols[kind >> 32]
            if kind & 0xFFFFFFFF == _R_RELATIVE:
                self.relocations[where] = addend
            elif kind & 0xFFFFFFFF in (_R_64, _R_GLOB_DAT, _R_JUMP_SLOT):
                self.relocations[where] = symbol.address + addend if symbol.address else symbol.name

    def bytes_at(self, address: int, size: int) -> tuple[bytes, bool]:
        """`size` bytes, or fewer at the end of the segment, and whether the program may write them."""
        for kind, flags, offset, start, _, in_file, in_memory, _ in self._segments:
            if kind == _LOAD and start <= address < start + in_memory:
                held = self.data[offset + address - start : offset + in_file][:size]
                return held.ljust(min(size, start + in_memory - address), b"\0"), bool(flags & _WRITABLE)
        raise Undecided(f"{self.path}: address {address:#x} is not in the file")

    def symbol(self, name: str) -> Symbol:
        """The symbol `name`."""
        if name not in self.symbols:
            raise Undecided(f"{self.path}: found no symbol {name}; a stripped file has only exported symbols")
        return self.symbols[name]

    def code_of(self, name: str) -> bytes:
        """The bytes of a function."""
        return self.bytes_at(self.symbol(name).address, self.symbol(name).size)[0]
