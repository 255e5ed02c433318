"""A linked ELF file of x86-64: its bytes, its symbols, and what the loader puts where."""

import hashlib
import struct
from pathlib import Path
from typing import NamedTuple

from .undecided import Undecided

_X86_64, _WRITABLE, _LOAD, _RELA, _SYMBOLS, _DYNAMIC_SYMBOLS = 62, 2, 1, 4, 2, 11
_R_64, _R_GLOB_DAT, _R_JUMP_SLOT, _R_RELATIVE = 1, 6, 7, 8


class Symbol(NamedTuple):
    """A symbol of the file. `address` is 0 where another file defines it."""

    name: str
    address: int
    size: int


class Image:
    """The file as it stands in memory, loaded at an address that only the loader knows."""

    def __init__(self, path: str | Path):
        self.path = str(path)
        self.data = Path(path).read_bytes()
        if self.data[:6] != b"\x7fELF\x02\x01" or struct.unpack_from("<H", self.data, 18)[0] != _X86_64:
            raise Undecided(f"{path}: found no ELF file of x86-64, the only machine code that is read")
        self.sha256 = hashlib.sha256(self.data).hexdigest()
        first, size, count = self._at("<Q", 32), *struct.unpack_from("<HH", self.data, 54)
        headers = [struct.unpack_from("<IIQQQQQQ", self.data, first + size * k) for k in range(count)]
        self.segments = [h for h in headers if h[0] == _LOAD]
        self.symbols: dict[str, Symbol] = {}
        self.relocations: dict[int, str | int] = {}  # a name of another file, or an address of this one
        sections = self._sections()
        for section in sections:
            if section[1] in (_SYMBOLS, _DYNAMIC_SYMBOLS):
                self.symbols |= {s.name: s for s in self._table(section, sections) if s.address}
        for section in sections:
            if section[1] == _RELA and sections[section[6]][1] == _DYNAMIC_SYMBOLS:
                self._relocate(section, self._table(sections[section[6]], sections))

    def _at(self, form: str, place: int) -> int:
        return struct.unpack_from(form, self.data, place)[0]

    def _sections(self) -> list[tuple]:
        first, (size, count) = self._at("<Q", 40), struct.unpack_from("<HH", self.data, 58)
        return [struct.unpack_from("<IIQQQQIIQQ", self.data, first + size * k) for k in range(count)]

    def _table(self, section: tuple, sections: list[tuple]) -> list[Symbol]:
        names = sections[section[6]][4]
        found = []
        for place in range(section[4], section[4] + section[5], 24):
            name, _, _, where, value, size = struct.unpack_from("<IBBHQQ", self.data, place)
            end = self.data.index(b"\0", names + name)
            found.append(Symbol(self.data[names + name : end].decode(), value if where else 0, size))
        return found

    def _relocate(self, section: tuple, symbols: list[Symbol]) -> None:
        for place in range(section[4], section[4] + section[5], 24):
            where, kind, addend = struct.unpack_from("<QQq", self.data, place)
            symbol = symbols[kind >> 32]
            if kind & 0xFFFFFFFF == _R_RELATIVE:
                self.relocations[where] = addend
            elif kind & 0xFFFFFFFF in (_R_64, _R_GLOB_DAT, _R_JUMP_SLOT):
                self.relocations[where] = symbol.address + addend if symbol.address else symbol.name

    def bytes_at(self, address: int, size: int) -> tuple[bytes, bool]:
        """`size` bytes from the file, and whether the program may write them."""
        for _, flags, offset, start, _, in_file, in_memory, _ in self.segments:
            if start <= address and address + size <= start + in_memory:
                held = self.data[offset + address - start : offset + min(address - start + size, in_file)]
                return held.ljust(size, b"\0"), bool(flags & _WRITABLE)
        raise Undecided(f"{self.path}: address {address:#x} is not in the file")

    def symbol(self, name: str) -> Symbol:
        """The symbol of that name."""
        if name not in self.symbols:
            raise Undecided(f"{self.path}: found no symbol {name}; a stripped file keeps exported symbols only")
        return self.symbols[name]
