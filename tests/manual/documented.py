"""Compares a manual with a JSON Schema, and results with both.

The manual has a table of keys for each object of the schema, under the title of the object. Keys with a description in
the schema have no row. A row states the condition under which a key is present, and the meaning of null.
"""
import json
import math
import re
import subprocess

import jsonschema

from manual import key_tables


class validator:
    """Validates values by a schema. `others`: {file name: schema} of the files to which the schema refers."""
    def __init__(self, schema, others=None):
        store = {f"file:///{file}": other for file, other in (others or {}).items()}
        resolver = jsonschema.RefResolver("file:///", schema, store=store)
        self.known = jsonschema.Draft202012Validator(schema, resolver=resolver)

    def fault(self, value, schema=None):
        """Returns the first fault of a value with its place, or None. `schema`: the part of the schema that applies."""
        wrong = next((self.known if schema is None else self.known.evolve(schema=schema)).iter_errors(value), None)
        return wrong and f"{wrong.json_path}: {wrong.message[:300]}"


def written_by(line, folder, status, file):
    """Runs a command and returns the text of the file that it writes. Raises ValueError for another exit status."""
    finished = subprocess.run([str(word) for word in line], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if finished.returncode != status:
        raise ValueError(f"{line}: found exit status {finished.returncode}, allowed: {status}\n{finished.stderr}")
    return (folder / file).read_text()


def result_of(line, folder, status):
    return parsed(written_by(line, folder, status, "result.json"))


def parsed(text):
    return json.loads(text, parse_constant=lambda name: f"no JSON: {name}")


def objects(schema):
    """Returns {title: object} of the schema, which may include the schema itself."""
    return {o["title"]: o for o in [schema, *schema["$defs"].values()] if "title" in o}


def target(schema, wanted):
    """Returns the object to which a key's schema refers directly, as a list's entry or beside null; otherwise None."""
    choices = [wanted, wanted.get("items", {}), *wanted.get("anyOf", [])]
    names = [choice["$ref"].rpartition("/")[2] for choice in choices if choice.get("$ref", "").startswith("#")]
    return schema["$defs"][names[0]] if names else None


def is_null(wanted):
    """Returns True if a key's value, or an entry of the value, may be null."""
    inner = wanted.get("anyOf", []) + ([wanted["items"]] if "items" in wanted else [])
    return any(map(is_null, inner)) or "null" in wanted.get("type", "")


def row_fault(of, key, row):
    """Returns the difference between a row of the manual and the schema in words, or None."""
    absent, meaning = row["key"].endswith("?"), row["meaning"]
    if absent != (key not in of["required"]):
        return "whether it may be absent"
    if absent and ": " not in meaning:
        return "no condition, with a colon, on which it is there"
    if bool(re.search(r"\bnull\b", meaning)) != is_null(of["properties"][key]):
        return "whether it may be null"
    return None


def undescribed(of):
    return {key for key, wanted in of["properties"].items() if "description" not in wanted}


def first_difference(text, schema):
    """Returns the first difference between the manual and the schema in words, or None."""
    tables, known = key_tables(text), objects(schema)
    if different := (set(tables.rows) ^ {title for title, of in known.items() if undescribed(of)}) - tables.shared():
        return f"an object that only one of the two has: {min(different)}"
    for title, of in known.items():
        if of.get("additionalProperties") is not False:
            return f"{title}: the schema allows other keys"
        rows = tables.keys(title) if title in tables.rows else {}
        if different := set(rows) ^ undescribed(of):
            return f"{title}: a key that only one of the two has: {min(different)}"
        for key, row in rows.items():
            if wrong := row_fault(of, key, row):
                return f"{title}: {key}: {wrong}"
    return None


def seen_keys(schema, value, of, seen):
    """Adds (title of the object, key) to `seen` for every key in a valid value."""
    for key, inner in value.items():
        seen.add((of["title"], key))
        to = target(schema, of["properties"][key])
        for entry in inner if isinstance(inner, list) else [inner]:
            if to is not None and entry is not None:
                seen_keys(schema, entry, to, seen)


def same(shown, found):
    """Returns True if a value of the manual, with shortened numbers, is that of a result. Tiny numbers count as 0."""
    if isinstance(shown, dict):
        return list(shown) == list(found) and all(same(shown[key], found[key]) for key in shown)
    if isinstance(shown, list):
        return len(shown) == len(found) and all(map(same, shown, found))
    if isinstance(shown, float):
        return math.isclose(shown, found, rel_tol=1e-3, abs_tol=1e-9)
    return shown == found
