"""Compares a manual with a JSON Schema, and results with both.

The manual has a table of keys for each object of the schema, under the title of the object. Keys with a description in
the schema have no row. A row states the condition under which a key is present, and the meaning of null.
"""
import json
import math
import re

import jsonschema

from manual import key_tables


def target(schema, wanted):
    """Returns the object to which a key's schema refers directly, as a list's entry or beside null; otherwise None."""
    choices = [wanted, wanted.get("items", {}), *wanted.get("anyOf", [])]
    names = [choice["$ref"].rpartition("/")[2] for choice in choices if choice.get("$ref", "").startswith("#")]
    return schema["$defs"][names[0]] if names else None


def is_null(wanted):
    """Returns True if a key's value, or an entry of the value, may be null."""
    inner = wanted.get("anyOf", []) + ([wanted["items"]] if "items" in wanted else [])
    return any(map(is_null, inner)) or "null" in wanted.get("type", "")


undescribed = lambda of: {key for key, wanted in of["properties"].items() if "description" not in wanted}


class documented:
    """A page of reference/ with its schema, which must have the same keys. `others`: schemas to which the schema refers.
    Raises ValueError for a difference."""

    def __init__(self, root, page, schema, *others):
        read = lambda name: json.loads((root / f"reference/{name}.schema.json").read_text())
        self.text, self.schema, self.seen = (root / "reference" / page).read_text(), read(schema), set()
        self.objects = {o["title"]: o for o in [self.schema, *self.schema["$defs"].values()] if "title" in o}
        self.keys = {(title, key) for title, of in self.objects.items() for key in of["properties"]}
        store = {f"file:///{name}.schema.json": read(name) for name in others}
        self.known = jsonschema.Draft202012Validator(self.schema, resolver=jsonschema.RefResolver("file:///", self.schema, store=store))
        tables = key_tables(self.text)
        if different := (set(tables.rows) ^ {title for title, of in self.objects.items() if undescribed(of)}) - tables.shared():
            raise ValueError(f"{page}: an object that only one of page and schema has: {min(different)}")
        for title, of in self.objects.items():
            rows = tables.keys(title) if title in tables.rows else {}
            if different := set(rows) ^ undescribed(of):
                raise ValueError(f"{page}: {title}: a key that only one of page and schema has: {min(different)}")
            for wrong, what in ((of.get("additionalProperties") is not False, "the schema allows other keys"),
                                *(fault for key, row in rows.items() for fault in self.faults_of_row(of, key, row))):
                if wrong:
                    raise ValueError(f"{page}: {title}: {what}")

    @staticmethod
    def faults_of_row(of, key, row):
        absent, meaning = row["key"].endswith("?"), row["meaning"]
        return ((absent != (key not in of["required"]), f"{key}: whether it may be absent"),
                (absent and ": " not in meaning, f"{key}: no condition, with a colon, on which it is there"),
                (bool(re.search(r"\bnull\b", meaning)) != is_null(of["properties"][key]), f"{key}: whether it may be null"))

    def add(self, where, result, of=None):
        """Adds the keys of a result of the schema, and of the object `of` in the schema. Raises ValueError for an invalid one."""
        of = of or self.schema
        for known in [self.known] + ([self.known.evolve(schema=of)] if of is not self.schema else []):
            for wrong in known.iter_errors(result):
                raise ValueError(f"{where}: {wrong.json_path}: {wrong.message[:300]}")
        self.see(result, of)

    def see(self, value, of):
        for key, inner in value.items():
            self.seen.add((of["title"], key))
            named = of["properties"][key].get("additionalProperties")  # of an object with any keys
            to = target(self.schema, named or of["properties"][key])
            for entry in inner if isinstance(inner, list) else inner.values() if named else [inner]:
                if to is not None and entry is not None:
                    self.see(entry, to)

    def need_every_key(self):
        if missing := self.keys - self.seen:
            raise ValueError(f"no result has this key: {min(missing)}")


def same(shown, found):
    """Returns True if a value of the manual, with shortened numbers, is that of a result. Tiny numbers count as 0."""
    if isinstance(shown, dict):
        return list(shown) == list(found) and all(same(shown[key], found[key]) for key in shown)
    if isinstance(shown, list):
        return len(shown) == len(found) and all(map(same, shown, found))
    if isinstance(shown, float):
        return math.isclose(shown, found, rel_tol=1e-3, abs_tol=1e-9)
    return shown == found
