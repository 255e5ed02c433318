"""errata.py FORTRAN CMAKE ROOT: undoes every erratum of reference/errata.toml in turn in a copy of the listing. The
effect must be the one that the file states. Fails if an erratum has no effect, or if the table of ERRATA.md differs.
"""
import resource
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from battery import BATTERY

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "support"))
from edits import edited  # noqa: E402

FORTRAN, CMAKE, ROOT = sys.argv[1], sys.argv[2], Path(sys.argv[3])
LISTING = (ROOT / "fortran/contct.f").read_text()
OUTCOMES = {"does-not-compile", "aborts-under-bounds-check", "dies", "other-numbers", "other-text", "source-only"}
LEAST_ERRATA, LEAST_UNDOS, LEAST_CALLS = 22, 80, 50


@dataclass
class Behaviour:
    """The behaviour of a copy: (call, field, value) of the calls that returned, and the text of unit 26."""
    compiles: bool
    ends_well: bool = False
    answers: tuple = ()
    text: str = ""
    complaint: str = ""


def try_out(source, options):
    """Compiles a copy of the listing, makes the calls of the battery, and returns the behaviour."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "copy.f").write_text(source)
        # The linker requires a definition of CONTCT, so that a subroutine of another name fails.
        compiled = subprocess.run([FORTRAN, "-shared", "-fPIC", "-fdefault-real-8", "-ffp-contract=off", "-std=legacy", "-ffixed-form",
                                   "-Wl,--require-defined=contct_", *options, "copy.f", "-o", "copy.so"],
                                  cwd=folder, capture_output=True, text=True, timeout=60, check=False)
        if compiled.returncode < 0 or "internal compiler error" in compiled.stderr or "terminated program" in compiled.stderr:
            raise ValueError(f"the compiler broke down: {compiled.stderr}")
        if compiled.returncode != 0:
            return Behaviour(False, complaint=compiled.stderr)
        ran = subprocess.run([sys.executable, HERE / "battery.py", "./copy.so"], cwd=folder, capture_output=True, text=True, timeout=60,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (2, 2)), check=False)
        answers = tuple(tuple(line.split("|")) for line in ran.stdout.splitlines())
        unit_26 = Path(folder, "fort.26")
        return Behaviour(True, ran.returncode == 0, answers, unit_26.read_text() if unit_26.exists() else "", ran.stderr)


def checksum_refuses(source):
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "copy.f").write_text(source)
        check = subprocess.run([CMAKE, "-DLISTING=copy.f", f"-DCHECKSUM={ROOT / 'reference/contct.f.sha256'}", "-P",
                                HERE / "checksum.cmake"], cwd=folder, capture_output=True, text=True, check=False)
    return check.returncode != 0 and "The listing has been edited" in check.stderr


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


def in_one_line(text):
    """Returns the text with every run of blanks and line ends replaced by one blank, as in the OCR."""
    return " ".join(text.split())


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


def check_page(errata):
    page = (ROOT / "reference/ERRATA.md").read_text()
    rows = [line for line in page.splitlines() if line.startswith("| ") and line[2].isdigit()]
    for wanted, found in zip(map(row, errata), rows, strict=True):
        assert wanted == found, f"ERRATA.md: found {found}, allowed: {wanted}"
    assert len(errata[5]["undo"]) == 8, "erratum 6: seven places, and all of them together"
    for undo in errata[5]["undo"]:
        wanted = f"| {undo['name']} | {undo['call']} | `{undo['field']}` |\n"
        assert wanted in page, f"ERRATA.md has no row {wanted}"


def check_battery(listing):
    """Checks that the battery has enough calls, and that they reach every WRITE of the listing."""
    assert listing.ends_well and {call for call, _, _ in listing.answers} == set(BATTERY) and len(BATTERY) >= LEAST_CALLS, listing
    for text in ("NO EVENTS", "MAKING CONTACT", "BREAKING CONTACT", "CONTACT PAIR:", "NODE: ***"):
        assert text in listing.text, f"no call writes {text}"


def main():
    errata = tomllib.loads((ROOT / "reference/errata.toml").read_text())["erratum"]
    untouched = {(): try_out(LISTING, ())}
    check_battery(untouched[()])
    assert outcome(untouched[()], try_out(LISTING, ()), LISTING)[0] == "unnoticed", "the listing differs from itself"
    outcomes = Counter()
    for number, erratum in enumerate(errata, 1):
        where = f"erratum {number}"
        undone = check_undos(erratum, untouched)
        expected = [undo["expect"] for undo in erratum["undo"]]
        assert erratum["class"] == "cosmetic" or set(expected) != {"source-only"}, f"{where} hides from everything but the checksum"
        for part in erratum["compiled"]:
            assert part in in_one_line(LISTING), f"{where}: {part} is not in the listing"
        for part in erratum["ocr"]:
            assert any(part in copy for copy in undone), f"{where}: {part} is in no undone copy"
        outcomes.update(expected)
    assert set(outcomes) == OUTCOMES, outcomes
    assert len(errata) >= LEAST_ERRATA and outcomes.total() >= LEAST_UNDOS, f"found {len(errata)} errata, {outcomes.total()} undos"
    check_page(errata)
    print(f"{len(errata)} errata, {outcomes.total()} undos, {len(BATTERY)} calls")


if __name__ == "__main__":
    main()
