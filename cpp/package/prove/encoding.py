"""Which encodings of a known mnemonic mean what the interpreter takes them for."""

import capstone

_PREFIXES = {0x66, 0x67, 0xF0, 0xF2, 0xF3, 0x26, 0x2E, 0x36, 0x3E, 0x64, 0x65}
_BY_END = {"pd": 0x66, "ps": 0, "sd": 0xF2, "ss": 0xF3}  # the prefix that belongs to an SSE instruction
_SSE = {"comisd": 0x66, "ucomisd": 0x66, "comiss": 0, "ucomiss": 0, "movdqa": 0x66, "movdqu": 0xF3, "movd": 0x66,
        "pand": 0x66, "pandn": 0x66, "por": 0x66, "pxor": 0x66}  # fmt: skip
_MOVQ = {(0xF3, 0x7E, 0), (0x66, 0xD6, 0), (0x66, 0x6E, 8), (0x66, 0x7E, 8)}  # prefix, opcode, REX.W
_WITH_16_BITS = {"add", "sub", "inc", "dec", "neg", "not", "and", "or", "xor", "cmp", "test", "mov", "movzx", "movsx",
                 "shl", "sar", "shr", "imul", "lea"}  # fmt: skip
_NOTHING = {"nop", "endbr64"}


def fault_of(ins: capstone.CsInsn) -> str:
    """Why this encoding is not supported; empty if it is."""
    raw, name, k = bytes(ins.bytes), ins.mnemonic, 0
    while k < len(raw) and raw[k] in _PREFIXES:
        k += 1
    prefix = raw[0] if k else 0
    rex = raw[k] if 0x40 <= raw[k] <= 0x4F else 0
    code = raw[k + 1 :] if rex else raw[k:]
    if name in _NOTHING:
        return ""
    if k > 1 or (rex and code[0] in _PREFIXES):
        return f"the prefixes of {raw.hex(' ')} are not supported"
    wanted = _SSE.get(name, _BY_END.get(name[-2:])) if name not in _WITH_16_BITS else None
    if name == "movq" and (prefix, code[1], rex & 8) not in _MOVQ:
        return f"this encoding of movq is not supported: {raw.hex(' ')}"
    if wanted is not None and (code[0] != 0x0F or prefix != wanted or (name == "movd" and rex & 8)):
        return f"this encoding of {name} is not supported: {raw.hex(' ')}"
    if wanted is None and name != "movq" and prefix and not (prefix == 0x66 and name in _WITH_16_BITS):
        return f"{name} with prefix {prefix:#x} is not supported"
    if name == "movsxd" and not rex & 8:
        return "movsxd without REX.W is not supported"
    return ""
