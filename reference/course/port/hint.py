"""hint.py KERNEL: tests a kernel, pipe:COMMAND or plugin:PATH, in the golden calls, and prints a hint on its fault.
Exit status 0: all answers are right to the bit; 1: otherwise.

hints.toml has a sentence for each fault that was put into the kernels on purpose, with the number of right answers, the
first wrong value, and a digest of all answers; stages.toml has the digests of unfinished kernels. A kernel with the
same answers has the same fault, or a fault that no golden call distinguishes from it.
"""
import ctypes
import shlex
import struct
import subprocess
import sys
import tomllib
from pathlib import Path

from stages import STAGES

ROOT = Path(__file__).resolve().parents[3]
MARGIN = 4096  # NaN elements before and after DD and DTEST, for wrong indices
UNSET = -7.0  # SMIN and SS before a call
SECONDS = 10
WHERE = {"SS": "SS is the first quantity that is wrong: look at DO 10, lines 27 to 39 of the listing.",
         "SMIN": "Every SS of this call is right, but SMIN is not: look at lines 26 and 40.",
         "ISEP": "SS and SMIN of this call are right, but ISEP is not: look at line 42 and at DO 30, lines 50 to 58.",
         "no answer": "The kernel gave no answer to this call: it ended, or ran for too long, or wrote another line than the format has."}


def call_of(lines):
    """Returns the inputs of a call from its lines before `ask`."""
    words = [line.split() for line in lines if not line.startswith(("call", "note"))]
    return {"indof": int(words[0][1]), "ndofpn": int(words[0][3]), "ndof": int(words[0][5]),
            "dofs": [(int(w[1]), float.fromhex(w[3]), float.fromhex(w[5])) for w in words if w[0] == "dof"],
            "pairs": [(int(w[3]), int(w[5]), int(w[7]), float.fromhex(w[9])) for w in words if w[0] == "pair"]}


def golden_calls(root=ROOT):
    """Returns the golden calls in 8-byte REAL, in order: text of the call, inputs, and answer of the listing."""
    calls = []
    for file in sorted((root / "reference/traces").glob("*.trace")):
        header, *texts = file.read_text().split("\ncall ")
        for text in texts if "\nreal 4\n" not in header else []:
            asked, answer = text.split("\nask\n")
            number, *lines = asked.split("\n")
            call = call_of(lines)
            note = "".join(line[5:] for line in lines if line.startswith("note"))
            calls.append({"name": f"{file.stem} {number}", "note": note, **call, "text": f"call {asked}\nask\n", "answer": answer_in(answer.split("\n"), len(call["pairs"]))})
    return calls


def answer_in(lines, pairs):
    """Returns (SMIN, SS, ISEP) from the lines of an answer, or None if they do not answer a call with so many pairs."""
    try:
        (key, smin), *rest = [line.split() for line in lines if line and not line.startswith("|") and line != "end"]
        if key != "smin" or [w[:3:2] for w in rest] != [["pair", "ss"]] * pairs:
            return None
        return float.fromhex(smin), [float.fromhex(w[3]) for w in rest], [int(w[5]) for w in rest]
    except (ValueError, IndexError):
        return None


def answers_of(kernel, calls):
    """Returns the answers of a kernel, None for a missing one. The kernel is restarted after a failure, but not after a
    timeout."""
    kind, _, what = kernel.partition(":")
    command = what if kind == "pipe" else f"{sys.executable} {__file__} --serve {shlex.quote(what)}"
    answers = []
    while len(answers) < len(calls):
        process = subprocess.Popen(["sh", "-c", f"exec {command}"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        try:
            said, _ = process.communicate("".join(call["text"] for call in calls[len(answers):]), SECONDS)
        except subprocess.TimeoutExpired as stopped:
            process.kill()
            process.wait()
            return answers + [None] * (len(calls) - len(answers))
        blocks = said.split("end\n")
        new = [answer_in(block.split("\n"), len(call["pairs"])) for block, call in zip(blocks[:-1], calls[len(answers):])]
        answers += new if len(answers) + len(new) >= len(calls) else new + [None]
    return answers


def bits(x):
    return struct.pack(">d", x).hex() if x == x else "7ff8000000000000"


def digest(answers):
    """Returns a 32-bit hash of all values of all answers, the same as in port.js."""
    h = 2166136261
    for answer in answers:
        smin, ss, isep = answer or (UNSET, [], [])
        for word in [w for x in (smin, *ss) for w in (int(bits(x)[:8], 16), int(bits(x)[8:], 16))] + [i & 0xffffffff for i in isep]:
            h = ((h ^ word) * 16777619) & 0xffffffff
            h ^= h >> 15
    return f"{h:08x}"


def first_difference(answer, right):
    """Returns the first difference: (quantity, pair from 1 or 0, value, right value); None if all bits are equal."""
    if answer is None:
        return "no answer", 0, "", ""
    (smin, ss, isep), (right_smin, right_ss, right_isep) = answer, right
    for i, (s, expected) in enumerate(zip(ss, right_ss), start=1):
        if bits(s) != bits(expected):
            return "SS", i, bits(s), bits(expected)
    if bits(smin) != bits(right_smin):
        return "SMIN", 0, bits(smin), bits(right_smin)
    changed = [i for i, (a, b) in enumerate(zip(isep, right_isep), start=1) if a != b]
    return ("ISEP", changed[0], str(isep[changed[0] - 1]), str(right_isep[changed[0] - 1])) if changed else None


def findings(calls, answers):
    """Returns the entries of hints.toml for these answers, and (call, difference) of the first wrong answer or None."""
    wrong = [(call, difference) for call, a in zip(calls, answers) if (difference := first_difference(a, call["answer"]))]
    first = "" if not wrong else f"{wrong[0][0]['name']} {wrong[0][1][0]} {wrong[0][1][1]} {wrong[0][1][2]}"
    return {"right": len(calls) - len(wrong), "first": first, "digest": digest(answers)}, wrong[0] if wrong else None


def hints(found, quantity, table):
    """Returns a heading that says how certain the hints are, and the hints."""
    same = [t["says"] for t in table.values() if t["digest"] == found["digest"]]
    if same:
        return "All answers are those of a kernel with this fault:", same
    after = [stage["adds"] for before, stage in zip(STAGES, STAGES[1:]) if found["digest"] in before["digests"]]
    if after:
        return "No fault: the answers match an unfinished port. Next:", after
    alike = [t["says"] for t in table.values() if t["first"] == found["first"] and found["right"] > 0]
    if alike:
        return "The first wrong answer is also that of these faults, but others are not:", alike[:3]
    return "No known fault gives these answers.", [WHERE[quantity]]


def read_table(file=ROOT / "reference/course/hints.toml"):
    return tomllib.loads(file.read_text())


def in_words(difference):
    quantity, pair, value, right = difference
    shown = (lambda x: x) if quantity == "ISEP" else (lambda x: repr(struct.unpack(">d", bytes.fromhex(x))[0]))
    return quantity if value == "" else f"{quantity}{f'({pair})' if pair else ''} is {shown(value)}; right: {shown(right)}"


def main(kernel):
    calls = golden_calls()
    found, first = findings(calls, answers_of(kernel, calls))
    print(f"{found['right']} of {len(calls)} golden calls are right to the bit")
    if first is None:
        return 0
    call, difference = first
    print(f"first wrong: {call['name']}{': ' + call['note'] if call['note'] else ''}\n  {in_words(difference)}")
    worth, sentences = hints(found, difference[0], read_table())
    print("\n".join([worth, *(f"  {s}" for s in sentences)]))
    return 1


# ---- a shared library, as a command ----

def call_library(library, indof, ndofpn, ndof, dofs, pairs):
    room = ctypes.c_double * (ndof + 2 * MARGIN)
    dd, dtest = (room(*[float("nan")] * (ndof + 2 * MARGIN)) for _ in range(2))
    for n, d, d_star in dofs:
        dd[MARGIN + n - 1], dtest[MARGIN + n - 1] = d, d_star
    whole, real = ctypes.c_int * max(1, len(pairs)), ctypes.c_double * max(1, len(pairs))
    ident, isep, isurf = (whole(*[p[k] for p in pairs]) for k in range(3))
    cc, ss, smin = real(*[p[3] for p in pairs]), real(*[UNSET] * len(pairs)), ctypes.c_double(UNSET)
    inside = ctypes.sizeof(ctypes.c_double) * MARGIN
    arrays = [ctypes.byref(dd, inside), ctypes.byref(dtest, inside), cc, ss, ctypes.byref(smin), ident, isep, isurf]
    if hasattr(library, "contct_kernel"):
        library.contct_kernel(*arrays, len(pairs), indof, ndofpn, ndof)
    else:  # the listing's own interface
        (ctypes.c_int * 2).in_dll(library, "dof_")[:] = [indof, ndofpn]
        library.contct_(*arrays, ctypes.byref(ctypes.c_int(len(pairs))))
    return smin.value, ss[:len(pairs)], isep[:len(pairs)]


def serve(path):
    library, lines = ctypes.CDLL(str(Path(path).resolve())), []
    for line in sys.stdin:
        if line != "ask\n":
            lines.append(line)
            continue
        smin, ss, isep = call_library(library, **call_of(lines))
        lines.clear()
        print("\n".join([f"smin {smin.hex()}", *(f"pair {i} ss {s.hex()} isep {k}" for i, (s, k) in enumerate(zip(ss, isep), 1)), "end"]), flush=True)


if __name__ == "__main__":
    sys.exit(serve(sys.argv[2]) if sys.argv[1] == "--serve" else main(sys.argv[1]))
