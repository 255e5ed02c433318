"""An ELF file of x86-64 as the loader maps it: program headers and the dynamic table. Sections are not read."""

import bisect
import struct
from typing import Iterator, NamedTuple

from . import Undecided

_X86_64 = 62
_LOAD, _DYNAMIC, _RELRO = 1, 2, 0x6474E552  # kinds of program headers
_EXECUTABLE, _WRITABLE = 1, 2
_PAGE = 4096
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
        try:
            self._read()
        except (struct.error, IndexError, ValueError) as broken:
            raise Undecided(f"{path}: found a broken ELF file: {broken}") from broken

    def _read(self) -> None:
        found = struct.unpack_from("<6s10xHH12xQ14xHH", self.data) if len(self.data) >= 64 else (b"", 0, 0)
        if found[0] != b"\x7fELF\x02\x01" or found[2] != _X86_64:
            raise Undecided(f"{self.path}: found no ELF file of x86-64; allowed: machine code of x86-64 in an ELF file")
        _, self._type, _, programs, size, count = found
        if size != 56:
            raise ValueError(f"found program headers of {size} bytes; allowed: 56")
        headers = [h for h in struct.iter_unpack("<IIQQQQQQ", self.data[programs : programs + size * count])]
        self._segments = sorted((h for h in headers if h[0] == _LOAD), key=lambda h: h[3])
        self._check_segments()
        self._constant = [(start // _PAGE * _PAGE, (start + in_memory) // _PAGE * _PAGE)
                          for kind, _, _, start, _, _, in_memory, _ in headers if kind == _RELRO]  # fmt: skip
        self._touched: list[tuple[int, int]] = []  # first byte and end of each relocation
        self.relocations: dict[int, str | int] = {}  # a symbol that may be of another object, or an address
        self._replaceable: list[tuple[Symbol, int, int]] = []
        self.symbols: dict[str, Symbol] = {}
        dynamic = [h for h in headers if h[0] == _DYNAMIC]
        if len(dynamic) != 1:
            raise Undecided(f"{self.path}: found {len(dynamic)} dynamic tables; allowed: 1, of a linked file")
        self._tags = self._dynamic(dynamic[0][3], dynamic[0][6])
        for name in _REFUSED:
            if name in self._tags:
                raise Undecided(f"{self.path}: found DT_{name} in the dynamic table, which is not supported")
        self.symbols = {s.name: s for s in self._exported()}
        self._relocate()

    def _check_segments(self) -> None:
        end = 0
        for _, flags, offset, start, _, in_file, in_memory, _ in self._segments:
            if flags & _EXECUTABLE and flags & _WRITABLE:
                raise Undecided(f"{self.path}: found a segment at {start:#x} that is writable and executable")
            if start // _PAGE * _PAGE < end or in_file > in_memory or offset + in_file > len(self.data) or (start - offset) % _PAGE:
                raise Undecided(f"{self.path}: found a segment at {start:#x} that overlaps another or the end of the file")
            end = -(-(start + in_memory) // _PAGE) * _PAGE

    def _dynamic(self, at: int, size: int) -> dict[str, int]:
        names, tags = {tag: name for name, tag in _TAGS.items()}, {}
        for tag, value in struct.iter_unpack("<Qq", self._bytes(at, size // 16 * 16)):
            if tag == 0:
                return tags
            if tag in names and names[tag] in tags:
                raise ValueError(f"DT_{names[tag]} stands twice")
            if tag in names:
                tags[names[tag]] = value
        return tags

    # Symbols.

    @property
    def is_program(self) -> bool:
        """Whether the file is a program, whose symbols no library replaces."""
        return self._type == 2 or bool(self._tags.get("FLAGS_1", 0) & _PIE)

    def _symbol(self, index: int) -> Symbol:
        name, info, other, section, value, size = struct.unpack("<IBBHQQ", self._bytes(self._tags["SYMTAB"] + 24 * index, 24))
        begin, text = self._tags["STRTAB"] + name, b""
        while b"\0" not in text:
            text += self._some(begin + len(text), 64)
        is_bound = self.is_program or info >> 4 == 0 or other & 3 or "SYMBOLIC" in self._tags or self._tags.get("FLAGS", 0) & 2
        is_plain = 0 < section < _ABSOLUTE and info & 15 in _DATA_OR_FUNCTION
        is_here = is_plain and bool(is_bound) and info >> 4 != _UNIQUE
        return Symbol(text[: text.index(b"\0")].decode(), value if section else 0, size, is_plain, is_here)

    def _exported(self) -> Iterator[Symbol]:
        """The defined symbols that the loader finds by the GNU hash table. A name that stands twice has versions."""
        if "GNU_HASH" not in self._tags:
            raise Undecided(f"{self.path}: found no GNU hash table; allowed: a file linked with --hash-style=gnu or both")
        at, seen = self._tags["GNU_HASH"], set()
        count, first, words, shift = struct.unpack("<IIII", self._bytes(at, 16))
        bloom = struct.unpack(f"<{words}Q", self._bytes(at + 16, 8 * words))
        buckets = struct.unpack(f"<{count}I", self._bytes(at + 16 + 8 * words, 4 * count))
        chains = at + 16 + 8 * words + 4 * count
        for bucket, index in enumerate(buckets):
            last = index == 0
            while not last:
                (told,) = struct.unpack("<I", self._bytes(chains + 4 * (index - first), 4))
                s, last = self._symbol(index), bool(told & 1)
                hashed = _hash(s.name)
                word = bloom[hashed // 64 % words]
                if (hashed | 1, hashed % count) != (told | 1, bucket) or not word >> hashed % 64 & word >> (hashed >> shift) % 64 & 1:
                    raise ValueError(f"the hash of {s.name} is another")
                if s.name in seen:
                    raise Undecided(f"{self.path}: found two versions of {s.name}; allowed: 1")
                seen.add(s.name)
                if s.address:
                    yield s
                index += 1

    def symbol(self, name: str) -> Symbol:
        """The function or datum `name`."""
        if name not in self.symbols:
            raise Undecided(f"{self.path}: found no symbol {name}; a file has only exported symbols")
        if not self.symbols[name].is_plain:
            raise Undecided(f"{self.path}: found {name} with a type of symbol that is not supported, such as IFUNC")
        return self.symbols[name]

    # Relocations.

    def _relocate(self) -> None:
        rows = []
        for table, size in (("RELA", "RELASZ"), ("JMPREL", "PLTRELSZ")):
            if table in self._tags:
                rows += struct.iter_unpack("<QQq", self._bytes(self._tags[table], self._tags.get(size, 0)))
        for where, kind, addend in rows:
            s, kind = self._symbol(kind >> 32), kind & 0xFFFFFFFF
            is_address = kind == _R_64 or (kind in (_R_GLOB_DAT, _R_JUMP_SLOT) and addend == 0)
            if kind == _R_RELATIVE:
                self._touch(where, addend)
            elif is_address and s.is_here:
                self._touch(where, s.address + addend)
            elif is_address and not s.address and addend == 0:
                self._touch(where, s.name)
            elif is_address and s.address:
                self._touch(where, f"{s.name}, which another object may define,")
                self._replaceable.append((s, where, s.address + addend))
            else:
                self._touch(where, f"the place of relocation {kind}", s.size if kind == _R_COPY else 8)
        self._touched.sort()
        for (a, end), (b, _) in zip(self._touched, self._touched[1:]):
            if b < end:
                self.relocations[a] = self.relocations[b] = "a place with two relocations"

    def take(self, name: str) -> int:
        """The address of the datum `name`, which is an argument, so that it does not matter where the loader puts it."""
        for s, where, address in self._replaceable:
            if s.name == name and s.is_plain:
                self.relocations[where] = address
        return self.symbol(name).address

    def _touch(self, where: int, value: str | int, size: int = 8) -> None:
        self._touched.append((where, where + size))
        self.relocations[where] = value

    def is_relocated(self, address: int, size: int) -> bool:
        """Whether a relocation changes one of these bytes."""
        k = bisect.bisect_left(self._touched, (address + size, 0))
        return any(end > address for _, end in self._touched[max(0, k - 2) : k])

    # Bytes.

    def _segment(self, address: int) -> tuple:
        for segment in self._segments:
            if segment[3] <= address < segment[3] + segment[6]:
                return segment
        raise Undecided(f"{self.path}: address {address:#x} is not in the file")

    def _some(self, address: int, size: int) -> bytes:
        """`size` bytes as they are loaded, or fewer at the end of the segment."""
        _, _, offset, start, _, in_file, in_memory, _ = self._segment(address)
        held = self.data[offset + address - start : offset + in_file][:size]
        return held.ljust(min(size, start + in_memory - address), b"\0")

    def _bytes(self, address: int, size: int) -> bytes:
        found = self._some(address, size) if size else b""
        if len(found) < size:
            raise ValueError(f"{size} bytes at {address:#x} are not in one segment")
        return found

    def is_constant(self, address: int) -> bool:
        """Whether nobody writes the byte after the file is loaded: it is in a segment that cannot be written, or in RELRO."""
        return not self._segment(address)[1] & _WRITABLE or any(a <= address < b for a, b in self._constant)

    def constant(self, address: int, size: int) -> bytes | None:
        """`size` bytes that neither the loader nor the program changes; None if they may change."""
        found = self._some(address, size)
        ends = (address, address + size - 1)
        return found if len(found) == size and all(map(self.is_constant, ends)) and not self.is_relocated(address, size) else None

    def is_free(self, address: int, size: int) -> bool:
        """Whether these bytes can be written without a change of a constant or of a place that the loader fills."""
        return not any(map(self.is_constant, (address, address + size - 1))) and not self.is_relocated(address, size)

    def code_at(self, address: int) -> bytes:
        """Up to 15 bytes of code that nothing changes."""
        found = self._some(address, 15)
        while found and self.constant(address, len(found)) is None:
            found = found[:-1]
        return found if self._segment(address)[1] & _EXECUTABLE else b""

    def code_of(self, name: str) -> bytes:
        """The bytes of a function."""
        return self._some(self.symbol(name).address, self.symbol(name).size)

    def initialisers(self) -> list[int | str]:
        """What the loader calls: DT_INIT and the entries of DT_INIT_ARRAY, as addresses or the names of symbols."""
        first = self._tags.get("INIT_ARRAY", 0)
        slots = range(first, first + self._tags.get("INIT_ARRAYSZ", 0), 8)
        return [self._tags[name] for name in ("INIT",) if name in self._tags] + [self.relocations.get(at, f"the slot at {at:#x}") for at in slots]


def _hash(name: str) -> int:
    value = 5381
    for c in name.encode():
        value = (33 * value + c) & 0xFFFFFFFF
    return value
