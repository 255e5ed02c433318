"""errata.py FORTRAN: undoes every erratum of reference/errata.toml in turn in a copy of the listing. The effect must be
the one that the file states. Fails if an erratum has no effect, or if the table of ERRATA.md differs.
"""
import resource
import sys
import tempfile
import tomllib
from collections import Counter, namedtuple
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from battery import BATTERY  # noqa: E402
from edits import edited  # noqa: E402
from testing import ROOT, TESTS, run  # noqa: E402

FORTRAN, LISTING = sys.argv[1], (ROOT / "fortran/contct.f").read_text()
OUTCOMES = {"does-not-compile", "aborts-under-bounds-check", "dies", "other-numbers", "other-text", "source-only"}
LEAST_ERRATA, LEAST_UNDOS, LEAST_CALLS = 22, 80, 50


# The behaviour of a copy: (call, field, value) of the calls that returned, and the text of unit 26.
Behaviour = namedtuple("Behaviour", "compiles ends_well answers text complaint", defaults=(False, (), "", ""))


def try_out(source, options):
    """Compiles a copy of the listing, makes the calls of the battery, and returns the behaviour."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "copy.f").write_text(source)
        # The linker requires a definition of CONTCT, so that a subroutine of another name fails.
        compiled = run(FORTRAN, "-shared", "-fPIC", "-fdefault-real-8", "-ffp-contract=off", "-std=legacy", "-ffixed-form",
                       "-Wl,--require-defined=contct_", *options, "copy.f", "-o", "copy.so", cwd=folder)
        if compiled.returncode < 0 or "internal compiler error" in compiled.stderr or "terminated program" in compiled.stderr:
            raise ValueError(f"the compiler broke down: {compiled.stderr}")
        if compiled.returncode != 0:
            return Behaviour(False, complaint=compiled.stderr)
        ran = run(sys.executable, TESTS / "listing/battery.py", "./copy.so", cwd=folder, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (2, 2)))
        answers = tuple(tuple(line.split("|")) for line in ran.stdout.splitlines())
        unit_26 = Path(folder, "fort.26")
        return Behaviour(True, ran.returncode == 0, answers, unit_26.read_text() if unit_26.exists() else "", ran.stderr)


def checksum_refuses(source):
    with tempfile.NamedTemporaryFile("w") as copy:
        copy.write(source)
        copy.flush()
        return "The listing has been edited" in run(sys.executable, TESTS / "tree/tree.py", ROOT, "listing", copy.name, status=1).stderr


def outcome(listing, copy, source):
    """Returns the first difference of a copy from the listing as (what, call, field)."""
    if not copy.compiles:
        return "does-not-compile", "", ""
    if not copy.ends_well:
        answered = {call for call, _, _ in copy.answers}
        at_bounds = "Fortran runtime error: Index" in copy.complaint and " bound of " in copy.complaint
        return "aborts-under-bounds-check" if at_bounds else "dies", next((c for c in BATTERY if c not in answered), ""), ""
    for theirs, ours in zip(copy.answers, listing.answers):
        if theirs != ours:
            return "other-numbers", *theirs[:2]
    if copy.text != listing.text:
        return "other-text", "", ""
    return "source-only" if checksum_refuses(source) else "unnoticed", "", ""


in_one_line = lambda text: " ".join(text.split())  # as in the OCR


def check_undos(erratum, untouched):
    """Tries every undo of an erratum, and checks the outcome."""
    undone = []
    for undo in erratum["undo"]:
        where = f"erratum {erratum['number']}, undo {undo['name']}"
        options = tuple(undo.get("compile", ()))
        if options not in untouched:
            untouched[options] = try_out(LISTING, options)
        assert untouched[options].ends_well, f"{where}: these options spoil the listing itself: {untouched[options].complaint}"
        copy = edited(LISTING, [(r["from"], r["to"]) for r in undo["replace"]])
        seen = outcome(untouched[options], try_out(copy, options), copy)
        expected = undo["expect"], undo.get("call", ""), undo.get("field", "")
        assert seen == expected, f"{where}: found {seen}, allowed: {expected}"
        undone.append(in_one_line(copy))
    return undone


def row(erratum):
    """Returns the row of an erratum in the first table of ERRATA.md: outcomes in order, with their counts."""
    ocr, compiled = (", ".join(f"`{text}`" for text in erratum[key]) for key in ("ocr", "compiled"))
    seen = Counter(undo["expect"] for undo in erratum["undo"])
    outcomes = ", ".join(what + (f" ({n})" if n > 1 else "") for what, n in seen.items())
    doubt = "" if erratum["confidence"] == "certain" else f" ({erratum['confidence']})"
    return f"| {erratum['number']} | {ocr} | {compiled}{doubt} | {outcomes} |"


errata = tomllib.loads((ROOT / "reference/errata.toml").read_text())["erratum"]
listing = try_out(LISTING, ())
# The battery has enough calls, and they reach every WRITE of the listing.
assert listing.ends_well and {call for call, _, _ in listing.answers} == set(BATTERY) and len(BATTERY) >= LEAST_CALLS, listing
for text in ("NO EVENTS", "MAKING CONTACT", "BREAKING CONTACT", "CONTACT PAIR:", "NODE: ***"):
    assert text in listing.text, f"no call writes {text}"
assert listing == try_out(LISTING, ()), "the listing differs from itself"
untouched, outcomes = {(): listing}, Counter()
for number, erratum in enumerate(errata, 1):
    where, undone = f"erratum {number}", check_undos(erratum, untouched)
    expected = [undo["expect"] for undo in erratum["undo"]]
    assert erratum["class"] == "cosmetic" or set(expected) != {"source-only"}, f"{where} hides from everything but the checksum"
    for part in erratum["compiled"]:
        assert part in in_one_line(LISTING), f"{where}: {part} is not in the listing"
    for part in erratum["ocr"]:
        assert any(part in copy for copy in undone), f"{where}: {part} is in no undone copy"
    outcomes.update(expected)
assert set(outcomes) == OUTCOMES, outcomes
assert len(errata) >= LEAST_ERRATA and outcomes.total() >= LEAST_UNDOS, f"found {len(errata)} errata, {outcomes.total()} undos"
page = (ROOT / "reference/ERRATA.md").read_text()
rows = [line for line in page.splitlines() if line.startswith("| ") and line[2].isdigit()]
for wanted, found in zip(map(row, errata), rows, strict=True):
    assert wanted == found, f"ERRATA.md: found {found}, allowed: {wanted}"
assert len(errata[5]["undo"]) == 8, "erratum 6: seven places, and all of them together"
for undo in errata[5]["undo"]:
    wanted = f"| {undo['name']} | {undo['call']} | `{undo['field']}` |\n"
    assert wanted in page, f"ERRATA.md has no row {wanted}"
print(f"{len(errata)} errata, {outcomes.total()} undos, {len(BATTERY)} calls")
