"""An ELF file of x86-64 as the loader maps it: program headers and the dynamic table. Sections are not read."""

import functools
import itertools
import struct
from typing import NamedTuple

from . import Undecided

_X86_64 = 62
_LOAD, _DYNAMIC, _RELRO = 1, 2, 0x6474E552  # kinds of program headers
_EXECUTABLE, _WRITABLE = 1, 2
_PAGE = 4096
_MOST = 1 << 30  # bytes of memory
_R_64, _R_COPY, _R_GLOB_DAT, _R_JUMP_SLOT, _R_RELATIVE = 1, 5, 6, 7, 8
_DATA_OR_FUNCTION = (0, 1, 2)  # types of symbols: no type, datum, function; not TLS, not IFUNC
_UNIQUE = 10  # a binding: one definition in the whole process
_ABSOLUTE = 0xFF00  # from here on, a section number means something else
_TAGS = {"PLTRELSZ": 2, "STRTAB": 5, "SYMTAB": 6, "RELA": 7, "RELASZ": 8, "INIT": 12, "SYMBOLIC": 16, "REL": 17,
         "TEXTREL": 22, "JMPREL": 23, "INIT_ARRAY": 25, "INIT_ARRAYSZ": 27, "FLAGS": 30, "PREINIT_ARRAYSZ": 33,
         "RELR": 36, "GNU_HASH": 0x6FFFFEF5, "FLAGS_1": 0x6FFFFFFB}  # fmt: skip
_REFUSED = ("REL", "RELR", "TEXTREL", "PREINIT_ARRAYSZ")
_PIE = 0x08000000  # in FLAGS_1


class Symbol(NamedTuple):
    """A symbol of the dynamic table. `address` is 0 if another file defines it. `is_plain`: a datum or function at this
    address. `is_here`: and the loader takes this definition, so no other object can replace it."""

    name: str
    address: int
    size: int
    is_plain: bool
    is_here: bool


class Image:
    """The file as loaded in memory, at an unknown address."""

    def __init__(self, path: str):
        self.path = path
        with open(path, "rb") as file:
            self.data = file.read()
        self._memory = bytearray()
        self._constant: list[range] = []  # what nobody writes after the file is loaded: constant segments, and RELRO
        self._writable: list[range] = []
        self._code: list[range] = []
        self.relocations: dict[int, str | int] = {}  # a symbol that may be of another object, or an address
        self._relocated: set[int] = set()  # each byte that a relocation changes
        self._replaceable: list[tuple[Symbol, int, int]] = []
        try:
            self._read()
        except (struct.error, LookupError, ValueError) as broken:
            raise Undecided(f"{path}: found a broken ELF file: {broken}") from broken

    def _read(self) -> None:
        found = struct.unpack_from("<6s10xHH12xQ14xHH", self.data) if len(self.data) >= 64 else (b"", 0, 0)
        if found[0] != b"\x7fELF\x02\x01" or found[2] != _X86_64:
            raise Undecided(f"{self.path}: found no ELF file of x86-64; allowed: machine code of x86-64 in an ELF file")
        _, self._type, _, programs, size, count = found
        if size != 56:
            raise ValueError(f"found program headers of {size} bytes; allowed: 56")
        headers = list(struct.iter_unpack("<IIQQQQQQ", self.data[programs : programs + size * count]))
        self._map(sorted((h for h in headers if h[0] == _LOAD), key=lambda h: h[3]))
        self._constant += [range(h[3] // _PAGE * _PAGE, (h[3] + h[6]) // _PAGE * _PAGE) for h in headers if h[0] == _RELRO]
        dynamic = [h for h in headers if h[0] == _DYNAMIC]
        if len(dynamic) != 1:
            raise Undecided(f"{self.path}: found {len(dynamic)} dynamic tables; allowed: 1, of a linked file")
        self._tags = self._dynamic(dynamic[0][3], dynamic[0][6])
        for name in _REFUSED:
            if name in self._tags:
                raise Undecided(f"{self.path}: found DT_{name} in the dynamic table, which is not supported")
        self._relocate()

    def _map(self, segments: list[tuple]) -> None:
        """Lay out the memory as the loader does."""
        for _, flags, offset, start, _, in_file, in_memory, _ in segments:
            if flags & _EXECUTABLE and flags & _WRITABLE:
                raise Undecided(f"{self.path}: found a segment at {start:#x} that is writable and executable")
            end, first = -(-len(self._memory) // _PAGE) * _PAGE, start // _PAGE * _PAGE
            if not end <= first <= start + in_memory <= _MOST or in_file > in_memory or offset + in_file > len(self.data) or (start - offset) % _PAGE:
                raise Undecided(f"{self.path}: found a segment at {start:#x} that overlaps another or the end of the file")
            self._memory = self._memory.ljust(start, b"\0") + self.data[offset : offset + in_file].ljust(in_memory, b"\0")
            (self._writable if flags & _WRITABLE else self._constant).append(range(start, start + in_memory))
            self._code += [range(start, start + in_memory)] if flags & _EXECUTABLE else []

    def _dynamic(self, at: int, size: int) -> dict[str, int]:
        names = {tag: name for name, tag in _TAGS.items()}
        rows = itertools.takewhile(lambda row: row[0], struct.iter_unpack("<Qq", self._bytes(at, size // 16 * 16)))
        known = [(names[tag], value) for tag, value in rows if tag in names]
        if len(dict(known)) < len(known):
            raise ValueError("an entry of the dynamic table stands twice")
        return dict(known)

    # Symbols.

    @property
    def is_program(self) -> bool:
        """Whether the file is a program, whose symbols no library replaces."""
        return self._type == 2 or bool(self._tags.get("FLAGS_1", 0) & _PIE)

    def _symbol(self, index: int) -> Symbol:
        name, info, other, section, value, size = self._unpack("<IBBHQQ", self._tags["SYMTAB"] + 24 * index)
        begin = self._tags["STRTAB"] + name
        text = self._memory[begin : self._memory.index(b"\0", begin)].decode()
        is_bound = self.is_program or info >> 4 == 0 or other & 3 or "SYMBOLIC" in self._tags or self._tags.get("FLAGS", 0) & 2
        is_plain = 0 < section < _ABSOLUTE and info & 15 in _DATA_OR_FUNCTION
        is_here = is_plain and bool(is_bound) and info >> 4 != _UNIQUE
        return Symbol(text, value if section else 0, size, is_plain, is_here)

    def find(self, name: str) -> Symbol | None:
        """The definition that the loader finds by the GNU hash table. A name that stands twice has versions."""
        if "GNU_HASH" not in self._tags:
            raise Undecided(f"{self.path}: found no GNU hash table; allowed: a file linked with --hash-style=gnu or both")
        at, found = self._tags["GNU_HASH"], []
        count, first, words, shift = self._unpack("<IIII", at)
        if not count * words:
            return None
        hashed = functools.reduce(lambda value, c: (33 * value + c) % (1 << 32), name.encode(), 5381)
        (word,) = self._unpack("<Q", at + 16 + 8 * (hashed // 64 % words))
        buckets = at + 16 + 8 * words
        (index,) = self._unpack("<I", buckets + 4 * (hashed % count))
        while index and word >> hashed % 64 & word >> (hashed >> shift) % 64 & 1:
            (told,) = self._unpack("<I", buckets + 4 * count + 4 * (index - first))
            s = self._symbol(index)
            found += [s] if told | 1 == hashed | 1 and s.name == name and s.address else []
            index = 0 if told & 1 else index + 1
        if len(found) > 1:
            raise Undecided(f"{self.path}: found two versions of {name}; allowed: 1")
        return found[0] if found else None

    def symbol(self, name: str) -> Symbol:
        """The function or datum `name`."""
        found = self.find(name)
        if not found:
            raise Undecided(f"{self.path}: found no symbol {name}; a file has only exported symbols")
        if not found.is_plain:
            raise Undecided(f"{self.path}: found {name} with a type of symbol that is not supported, such as IFUNC")
        return found

    # Relocations.

    def _relocate(self) -> None:
        rows = []
        for table, size in (("RELA", "RELASZ"), ("JMPREL", "PLTRELSZ")):
            if table in self._tags:
                rows += struct.iter_unpack("<QQq", self._bytes(self._tags[table], self._tags.get(size, 0)))
        for where, kind, addend in rows:
            s, kind = self._symbol(kind >> 32), kind & 0xFFFFFFFF
            is_address = kind == _R_64 or (kind in (_R_GLOB_DAT, _R_JUMP_SLOT) and addend == 0)
            places = range(where, min(where + (s.size if kind == _R_COPY else 8), len(self._memory)))
            value = f"the place of relocation {kind}"
            if kind == _R_RELATIVE:
                value = addend
            elif is_address and s.is_here and self.find(s.name) == s:
                value = s.address + addend
            elif is_address and not s.address and addend == 0:
                value = s.name
            elif is_address and s.address:
                value = f"{s.name}, which another object may define,"
                self._replaceable.append((s, where, s.address + addend))
            self.relocations[where] = value if self._relocated.isdisjoint(places) else "a place with two relocations"
            self._relocated.update(places)

    def take(self, name: str) -> int:
        """The address of the datum `name`, which is an argument, so that it does not matter where the loader puts it."""
        for s, where, address in self._replaceable:
            if s.name == name and s.is_plain:
                self.relocations[where] = address
        return self.symbol(name).address

    # Bytes.

    def _bytes(self, address: int, size: int) -> bytes:
        if not 0 <= address <= len(self._memory) - size:
            raise Undecided(f"{self.path}: found {size} bytes at {address:#x}, which are not in a segment")
        return bytes(self._memory[address : address + size])

    def _unpack(self, form: str, address: int) -> tuple:
        return struct.unpack(form, self._bytes(address, struct.calcsize(form)))

    def _is_relocated(self, address: int, size: int) -> bool:
        return not self._relocated.isdisjoint(range(address, address + size))

    def is_constant(self, address: int, size: int) -> bool:
        """Whether nobody writes these bytes after the file is loaded."""
        return _are_within(self._constant, address, size)

    def constant(self, address: int, size: int) -> bytes | None:
        """`size` bytes that neither the loader nor the program changes; None if they may change."""
        return self._bytes(address, size) if self.is_constant(address, size) and not self._is_relocated(address, size) else None

    def is_free(self, address: int, size: int) -> bool:
        """Whether these bytes can be written without a change of a constant or of a place that the loader fills."""
        constants = any(self.is_constant(place, 1) for place in range(address, address + size))
        return _are_within(self._writable, address, size) and not constants and not self._is_relocated(address, size)

    def code_at(self, address: int) -> bytes:
        """Up to 15 bytes of code that nothing changes."""
        sizes = (size for size in range(15, 0, -1) if _are_within(self._code, address, size) and not self._is_relocated(address, size))
        return bytes(self._memory[address:][: next(sizes, 0)])

    def code_of(self, name: str) -> bytes:
        """The bytes of a function."""
        return self._bytes(self.symbol(name).address, self.symbol(name).size)

    def initialisers(self) -> list[int]:
        """The addresses that the loader calls: DT_INIT and the entries of DT_INIT_ARRAY."""
        first = self._tags.get("INIT_ARRAY", 0)
        slots = range(first, first + self._tags.get("INIT_ARRAYSZ", 0), 8)
        entries = [self.relocations.get(at, f"the slot at {at:#x}") for at in slots]
        for place in entries:
            if isinstance(place, str):
                raise Undecided(f"{self.path}: found {place} among the initialisers")
        return entries + [self._tags[name] for name in ("INIT",) if name in self._tags]


def _are_within(ranges: list[range], address: int, size: int) -> bool:
    """Whether one range has all these bytes."""
    return any(address in one and address + size - 1 in one for one in ranges)
