"""problem_file.py PROGRAM ROOT: tests that reference/problem-file.md documents the keys that the program accepts, and
that its examples run.

- Every table of a problem file gets an unknown key. The program's message lists the keys that are allowed in the table;
  the manual must document the same keys for the table and the structure.
- Every key of every example gets a date, which no key allows. The program's message says what is allowed; the manual must
  say the same. Without a key that the manual calls required, an example is refused.
- Every example is read and solved. Every example of a refusal is refused with the shown message.
"""
import json
import re
import shutil
import sys
import tempfile
import tomllib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
import testing  # noqa: E402
from manual import key_tables  # noqa: E402

UNKNOWN = "zzzzzzzz"
BEAM = "[beam]\nlength = 2\nelements = 2\n%s\n"
PLATE = "[plate]\nsize = [1, 1]\nelements = [1, 1]\nD = 1\nnu = 0\n"
MATRIX = '[matrix]\nstiffness = "frame.mtx"\n'
STRUCTURES = {"beam": BEAM % "EI = 1", "plate": PLATE, "matrix": MATRIX}
# Tables of a problem file of any structure, with %s for a key, and their sections of the page. Examples have the others.
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
PARTS = {"EI": "A piece of `EI`", "modulus": "A piece of `modulus`", "section": "A piece of `section`", "spring": "`spring` of a `[[support]]`", "face": "`face` of a `[[bed]]`",
         "uniform": "A part of `uniform`", "point": "A `point` load", "axles": "An axle"}
# How a value begins in the manual: what a message says that is allowed.
ALLOWED = {"number": " number", "> 0": " number", "at most": " number", "integer": "whole number", "list of integers": "list of whole numbers",
           "list of tables": "array of at least one table", "tables": "array of at least one table", "list": "array of at least",
           "2 numbers": "array of at least 2", "2 integers": "two whole numbers", "table": "a table", "text or": "a label", "label": "a label",
           "text": "text", "dof or": "one of "}
LEAST = 150, 130, 20, 1  # keys, values, examples, refusals


def probes(text):
    """Yields (section, structure, problem file with an unknown key) for every table of every structure."""
    for heading, table in STRUCTURES_TABLES.items():
        for structure, before in STRUCTURES.items():
            if structure != "matrix" or heading not in NOT_WITH_A_MATRIX:
                yield heading, structure, (before + table) % f"{UNKNOWN} = 1"
    for _, heading, structure, table, problem in example_tables(text):
        table[UNKNOWN] = 1
        if "section" not in heading:
            yield heading, structure, problem()
        del table[UNKNOWN]
    yield "A piece of `section`", "beam", BEAM % f"section = [ {{ to = 2, E = 1, I = 1, {UNKNOWN} = 1 }} ]"


def contct(program, root):
    """Returns a function that runs a command of the program on a text, in a folder with the files that the examples
    name, and returns the exit status and the text of standard error."""
    scratch = tempfile.TemporaryDirectory()
    for file in [*(root / "reference/structures").iterdir(), *(root / "reference/structures/calculix").iterdir()]:
        if file.is_file():
            shutil.copy(file, scratch.name)

    def ask(command, text):
        Path(scratch.name, "beam.toml").write_text(text)
        done = testing.run(Path(program).resolve(), command, "beam.toml", "--quiet", cwd=scratch.name)
        return done.returncode, done.stderr
    return ask


def accepted_keys(run, text):
    """Returns the keys that the program allows at the place of the unknown key in `text`."""
    status, said = run("check", text)
    listed = re.search(rf"{UNKNOWN}: found an unknown key; allowed: (.*)$", said, re.M)
    if status != 2 or not listed:
        raise ValueError(f"exit status {status}, found {said.strip()}; allowed: the refusal of {UNKNOWN} in\n{text}")
    return set(listed.group(1).split(", "))


def first_difference(text, accepted):
    """Returns in words the first table whose documented keys are not the accepted keys, or None."""
    tables = key_tables(text)
    if unprobed := set(tables.rows) - {heading for heading, _ in accepted} - SHARED:
        return f"no table of a problem file is known for the section {min(unprobed)}"
    for (heading, structure), keys in accepted.items():
        documented = set(tables.keys(heading, structure)) if heading in tables.rows else set()
        if keys != documented:
            return f"{heading} of {structure}: accepted, not documented: {sorted(keys - documented)}; documented, not accepted: {sorted(documented - keys)}"
    return None


def chunks(text):
    """Returns (name, text) of the tables of a TOML text; the text before the first table has an empty name."""
    header = re.compile(r"\[+([\w.]+)\]+")
    return [((header.match(part) or [0, ""])[1], part) for part in re.split(r"(?m)^(?=\[+[\w.]+\])", text)]


def merged(whole, part):
    """Returns `whole` with the tables of `part`, which replace tables of the same names or are added at the end."""
    own = {}
    for name, text in chunks(part):
        if name:
            own[name] = own.get(name, "") + (text if text.endswith("\n\n") else text + "\n")
    new = set(own)
    kept = "".join(own.pop(name, "") if name in new else text for name, text in chunks(whole))
    return kept + "\n" + "\n".join(own[name] for name in sorted(own))


def structure_of(text):
    return next((kind for kind in ("beam", "plate", "matrix", "calculix") if f"[{kind}]" in text), None)


def examples(text):
    """Yields (line, problem file, message or None) for every example of the page."""
    shown, whole = testing.blocks(text), {}
    for b in shown:
        if b.language == "toml" and structure_of(b.text) and "[[step]]" in b.text:
            whole.setdefault(structure_of(b.text), b.text)
    for b, behind in zip(shown, [*shown[1:], None]):
        if b.language == "toml":
            base = whole[structure_of(b.text) or "beam"]
            if "[[case]]" in b.text:  # combinations replace the steps
                base = "".join(text for name, text in chunks(base) if name != "step")
            problem = b.text if b.text in whole.values() else merged(base, b.text)
            yield b.line, problem, behind.text if behind and behind.language == "text" else None


def wrong_example(run, line, problem, message):
    """Returns what is wrong with an example in words, or None. The page breaks long messages into lines."""
    status, said = run("check", problem)
    if message is not None:
        if status != 2 or said.split() != message.split():
            return f"line {line}: found exit status {status} and\n{said}allowed: exit status 2 and\n{message}"
        return None
    if status == 0 and not said:
        status, said = run("run", problem)
    if "[plate]" in problem and ", under a point load: " in said:  # right for any plate with a point load
        said = ""
    if status or said:
        return f"line {line}: found exit status {status} and \"{said.strip()}\"; allowed: 0 and nothing\n{problem}"
    return None


def tables_in(value, name=""):
    """Yields (name, table) for every table whose keys the manual documents."""
    if isinstance(value, dict) and name != "terms":
        yield name, value
        for key, inner in value.items():
            yield from tables_in(inner, key)
    for inner in value if isinstance(value, list) else []:
        yield from tables_in(inner, name)


def is_allowed(value, allowed):
    """Returns True if the program's message allows what the manual describes as the value of a key."""
    said = re.findall("`([^`]+)`", value.partition(";")[0])
    if not value.startswith("`"):
        said = [ALLOWED[max(filter(value.startswith, ALLOWED), key=len, default="table")]]
    return value.startswith("as in") or all(word in allowed for word in said) and ("> 0" in value) == ("greater than 0" in allowed)


def example_tables(text):
    """Yields (line, section, structure, table, problem) for every table of every example that is accepted; problem() returns
    the example with the present contents of the table."""
    documented = key_tables(text).rows
    for line, whole, kind in ((line, tomllib.loads(problem), structure_of(problem)) for line, problem, message in examples(text) if not message):
        def problem():
            rows = (f"{name} = " + re.sub('("[^"]*"): ', r"\1 = ", json.dumps(value)) for name, value in whole.items())
            return "\n".join(rows).replace('"DATE"', "1989-08-28")
        for name, table in tables_in(whole):
            forms = PARTS.get(name), f"`[{name}]`", f"`[[{name}]]`", f"A `{name}`"
            yield line, next((form for form in forms if form in documented), "Top level"), kind.replace("calculix", "matrix"), table, problem


def compared_values(run, text):
    """Returns the number of values of examples that the manual describes as the program does. Raises ValueError for others."""
    documented, seen = key_tables(text), set()
    for line, heading, kind, table, problem in example_tables(text):
        rows = documented.keys(heading, kind)
        for key in [key for key in table if (heading, kind, key) not in seen]:
            seen.add((heading, kind, key))
            dof = "number > 0" if "spring" in heading else "number"
            value = next((rows[key][column] for column in rows[key] if column.startswith("value")), dof)
            right, table[key] = table[key], "DATE"
            said = run("check", problem())[1].partition(f"{key}: found a date or time; allowed: ")[2].strip()
            if not is_allowed(value, said):
                raise ValueError(f"line {line}: {heading}: {key}: documented: {value}; the program allows: {said}")
            del table[key]
            if re.search(r"\brequired\b", value) and run("check", problem())[0] != 2:
                raise ValueError(f"line {line}: {heading}: {key}: documented as required, but accepted without it")
            table[key] = right
    return len(seen)


def main(program, root):
    text = (Path(root) / "reference/problem-file.md").read_text()
    run = contct(program, Path(root))
    accepted = {(heading, structure): accepted_keys(run, problem) for heading, structure, problem in probes(text)}
    if difference := first_difference(text, accepted):
        return difference
    shown = list(examples(text))
    if wrong := next(filter(None, (wrong_example(run, *example) for example in shown)), None):
        return wrong
    good = sum(message is None for *_, message in shown)
    found = sum(map(len, accepted.values())), compared_values(run, text), good, len(shown) - good
    if any(number < least for number, least in zip(found, LEAST)):
        return f"found {found} keys, values, examples and refusals; allowed: {LEAST} or more"
    print(f"{len(accepted)} tables, {found[0]} keys and {found[1]} values compared; {found[2]} examples run, {found[3]} refusals compared")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
