"""problem_file.py PROGRAM ROOT: tests that reference/problem-file.md documents the keys that the program accepts, and
that its examples run.

- Every table of a problem file gets an unknown key. The program's message lists the keys that are allowed in the table;
  the manual must document the same keys for the table and the structure.
- Every example is read and solved. Every example of a refusal, also in refusals.md, is refused with the shown message.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from manual import blocks, key_tables


UNKNOWN = "zzzzzzzz"
SECTIONS = 'section = [ { to = 2, E = 1, I = 1, %s } ]'
PIECES = 'EI = [ { to = 1, value = 1 }, { to = 2, value = 1, %s } ]'
BEAM = "[beam]\nlength = 2\nelements = 2\n%s\n"
PLATE = "[plate]\nsize = [1, 1]\nelements = [1, 1]\nD = 1\nnu = 0\n"
MATRIX = '[matrix]\nstiffness = "frame.mtx"\n'
STRUCTURES = {"beam": BEAM % "EI = 1", "plate": PLATE, "matrix": MATRIX}
# Sections of the page that have a table of keys: {section: (the structure that has these keys or None, problem file)}.
# The test replaces %s by an unknown key.
OWN_TABLES = {
    "Top level": (None, "%s\n[beam]\n"),
    "`[units]`": (None, "[units]\n%s\n[beam]\n"),
    "`[beam]`": ("beam", "[beam]\n%s\n"),
    "A piece of `EI`": ("beam", BEAM % PIECES),
    "A piece of `section`": ("beam", BEAM % SECTIONS),
    "`[[hinge]]`": ("beam", BEAM % "EI = 1" + "[[hinge]]\n%s\n"),
    "`[plate]`": ("plate", "[plate]\n%s\n"),
    "`[matrix]`": ("matrix", "[matrix]\n%s\n"),
    "`[calculix]`": ("matrix", "[calculix]\n%s\n"),
    "A `curvature`": ("beam", BEAM % "EI = 1" + "[[step]]\ncurvature = [ { %s } ]\n"),
    "`[[combination]]`": ("beam", BEAM % "EI = 1" + "[[combination]]\n%s\n"),
    "`[[train]]`": ("beam", BEAM % "EI = 1" + "[[train]]\n%s\n"),
    "An axle": ("beam", BEAM % "EI = 1" + "[[train]]\nname = \"T\"\naxles = [ { %s } ]\n"),
    "`face` of a `[[bed]]`": ("beam", BEAM % "EI = 1" + "[[bed]]\nmodulus = 1\nface = { %s }\n"),
}
STRUCTURES_TABLES = {
    "`[[support]]`": "[[support]]\n%s\n",
    "`spring` of a `[[support]]`": "[[support]]\nnode = 1\nspring = { %s }\n",
    "`[[contact]]`": "[[contact]]\n%s\n",
    "`[[bed]]`": "[[bed]]\n%s\n",
    "`[[step]]`": "[[step]]\n%s\n",
    "`[[case]]`": "[[case]]\nname = \"G\"\n%s\n[[combination]]\n",
    "A part of `uniform`": "[[step]]\nuniform = [ { %s } ]\n",
    "A `point` load": "[[step]]\npoint = [ { %s } ]\n",
    "A `settlement`": "[[step]]\nsettlement = [ { %s } ]\n",
    "A `move`": "[[step]]\nmove = [ { %s } ]\n",
}
NOT_WITH_A_MATRIX = {"`spring` of a `[[support]]`", "`[[bed]]`", "A part of `uniform`"}
SHARED = {"Places", "Degrees of freedom"}  # the keys of these tables are keys of other tables
LEAST_KEYS, LEAST_EXAMPLES, LEAST_REFUSALS = 150, 20, 12


def probes():
    """Yields (section, structure, problem file) for every table of every structure."""
    for heading, (structure, text) in OWN_TABLES.items():
        yield heading, structure, text
    for heading, text in STRUCTURES_TABLES.items():
        for structure, before in STRUCTURES.items():
            if structure != "matrix" or heading not in NOT_WITH_A_MATRIX:
                yield heading, structure, before + text


class contct:
    """Runs the program in a folder with the files that the examples name."""

    def __init__(self, program, root):
        self.program = Path(program).resolve()
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)
        structures = root / "reference/structures"
        for file in [*structures.iterdir(), *(structures / "calculix").iterdir()]:
            if file.is_file():
                shutil.copy(file, self.folder)

    def __call__(self, command, text):
        """Returns the exit status for a problem file with this text, and the text of standard error."""
        (self.folder / "beam.toml").write_text(text)
        finished = subprocess.run([self.program, command, "beam.toml", "--quiet"], cwd=self.folder, text=True,
                                  stdin=subprocess.DEVNULL, capture_output=True)
        return finished.returncode, finished.stderr


def accepted_keys(run, text):
    """Returns the keys that the program allows at the place of the unknown key in `text`."""
    status, said = run("check", text % f"{UNKNOWN} = 1")
    listed = re.search(rf"{UNKNOWN}: found an unknown key; allowed: (.*)$", said, re.M)
    if status != 2 or not listed:
        raise ValueError(f"exit status {status}, found {said.strip()}; allowed: the refusal of {UNKNOWN} in\n{text}")
    return set(listed.group(1).split(", "))


def first_difference(text, accepted):
    """Returns in words the first table whose documented keys are not the accepted keys, or None."""
    tables = key_tables(text)
    unprobed = set(tables.rows) - {heading for heading, _ in accepted} - SHARED
    if unprobed:
        return f"no table of a problem file is known for the section {min(unprobed)}"
    for (heading, structure), keys in accepted.items():
        if heading not in tables.rows:
            return f"{heading}: found no table of keys"
        documented = set(tables.keys(heading, structure))
        where = f"{heading}{f' of a {structure}' if structure else ''}"
        if keys - documented:
            return f"{where}: accepted, not documented: {min(keys - documented)}"
        if documented - keys:
            return f"{where}: documented, not accepted: {min(documented - keys)}"
    return None


def chunks(text):
    """Returns (name, text) of the tables of a TOML text; the text before the first table has an empty name."""
    found = [("", [])]
    for line in text.splitlines(keepends=True):
        header = re.match(r"\[+([\w.]+)\]+", line)
        if header:
            found.append((header.group(1), []))
        found[-1][1].append(line)
    return [(name, "".join(lines)) for name, lines in found]


def merged(whole, part):
    """Returns `whole` with the tables of `part`, which replace tables of the same names or are added at the end."""
    new = {name for name, _ in chunks(part)} - {""}
    out, placed = [], set()
    own = {name: "".join(text if text.endswith("\n\n") else text + "\n" for other, text in chunks(part) if other == name)
           for name in new}
    for name, text in chunks(whole):
        if name not in new:
            out.append(text)
        elif name not in placed:
            out.append(own[name])
            placed.add(name)
    return "".join(out) + "\n" + "\n".join(own[name] for name in sorted(new - placed))


def structure_of(text):
    return next((kind for kind in ("beam", "plate", "matrix", "calculix") if f"[{kind}]" in text), None)


def examples(text):
    """Yields (line, problem file, message or None) for every example of the page."""
    shown = blocks(text)
    whole = {}
    for b in shown:
        if b.language == "toml" and structure_of(b.text) and "[[step]]" in b.text:
            whole.setdefault(structure_of(b.text), b.text)
    for b, behind in zip(shown, [*shown[1:], None]):
        if b.language != "toml":
            continue
        is_whole = b.text in whole.values()
        base = whole[structure_of(b.text) or "beam"]
        if "[[case]]" in b.text:  # combinations replace the steps
            base = "".join(text for name, text in chunks(base) if name != "step")
        problem = b.text if is_whole else merged(base, b.text)
        yield b.line, problem, behind.text if behind and behind.language == "text" else None


def on_one_line(text):
    """Returns the text in one line, since the page breaks long messages into lines."""
    return " ".join(text.split())


def wrong_example(run, line, problem, message):
    """Returns what is wrong with an example in words, or None."""
    status, said = run("check", problem)
    if message is not None:
        if status != 2 or on_one_line(said) != on_one_line(message):
            return f"line {line}: found exit status {status} and\n{said}allowed: exit status 2 and\n{message}"
        return None
    if status == 0 and not said:
        status, said = run("run", problem)
    if "[plate]" in problem and ", under a point load: " in said:  # right for any plate with a point load
        said = ""
    if status or said:
        return f"line {line}: found exit status {status} and \"{said.strip()}\"; allowed: 0 and nothing\n{problem}"
    return None


def main(program, root):
    root = Path(root)
    page = root / "reference/problem-file.md"
    text = page.read_text()
    run = contct(program, root)
    accepted = {(heading, structure): accepted_keys(run, problem) for heading, structure, problem in probes()}
    if difference := first_difference(text, accepted):
        return difference
    compared = sum(map(len, accepted.values()))
    if compared < LEAST_KEYS:
        return f"found {compared} keys to compare, allowed: {LEAST_KEYS} or more"
    shown = list(examples(text + (Path(__file__).parent / "refusals.md").read_text()))
    for example in shown:
        if wrong := wrong_example(run, *example):
            return wrong
    good = [problem for _, problem, message in shown if message is None]
    if len(good) < LEAST_EXAMPLES or len(shown) - len(good) < LEAST_REFUSALS:
        return (f"found {len(good)} examples and {len(shown) - len(good)} refusals, "
                f"allowed: {LEAST_EXAMPLES} and {LEAST_REFUSALS} or more")
    print(f"{len(accepted)} tables, {compared} keys compared; {len(good)} examples run, "
          f"{len(shown) - len(good)} refusals compared")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
