"""The comparison of a manual with a JSON Schema, and of results with both.

The manual has a table of keys for each object of the schema, below a heading that is the object's title. Its cells say of which
type a key is, and when it is absent or null.
"""
import math
import re

from manual import anchor, key_tables

WORDS = {"object": "object", "array": "list", "string": "text", "boolean": "boolean", "number": "number",
         "integer": "whole number"}


def objects(schema):
    """The objects of the schema by their titles. The schema itself is one, or a choice of them."""
    return {o["title"]: o for o in [schema, *schema["$defs"].values()] if "title" in o}


def target(schema, wanted):
    """The object that a key's schema refers to, directly, as an entry of a list, or beside null; None where there is none."""
    choices = [wanted, wanted.get("items", {}), *wanted.get("anyOf", [])]
    names = [choice["$ref"].rpartition("/")[2] for choice in choices if choice.get("$ref", "").startswith("#")]
    return schema["$defs"][names[0]] if names else None


def types(schema, wanted):
    """The types of a key's value: {"object", "null"}."""
    if "$ref" in wanted:
        return {"object"}
    if "anyOf" in wanted:
        return set().union(*(types(schema, choice) for choice in wanted["anyOf"]))
    return {wanted["type"]} if isinstance(wanted["type"], str) else set(wanted["type"])


def cell_fault(schema, of, row):
    """What a row of the manual says of a key that the schema does not, in words; None where they agree."""
    key = row["key"].strip("`")
    wanted = of["properties"][key]
    there = types(schema, wanted)
    if ("absent" in row["absent or null"]) != (key not in of["required"]):
        return "when it is absent"
    if ("null" in row["absent or null"]) != ("null" in there):
        return "when it is null"
    named = {kind for kind in WORDS if any(part.strip().startswith(WORDS[kind]) for part in row["type"].split(" or "))}
    if named != there - {"null"}:
        return "its type"
    to, link = target(schema, wanted), re.search(r"\(#([\w-]+)\)", row["type"])
    if (to is not None or link is not None) and (not to or not link or link.group(1) != anchor(to["title"])):
        return "the object that it is"
    return None


def first_difference(text, schema):
    """The first difference between the manual and the schema, in words; None where there is none."""
    tables, known = key_tables(text), objects(schema)
    if set(tables.rows) != set(known):
        return f"an object that only one of the two has: {min(set(tables.rows) ^ set(known))}"
    for title, of in known.items():
        if of.get("additionalProperties") is not False:
            return f"{title}: the schema allows other keys"
        if different := tables.keys(title) ^ set(of["properties"]):
            return f"{title}: a key that only one of the two has: {min(different)}"
        for row in tables.rows[title]:
            if wrong := cell_fault(schema, of, row):
                return f"{title}: {row['key']}: {wrong}"
    return None


def seen_keys(schema, value, of, seen):
    """Add (title of the object, key) for every key in a valid value."""
    for key, inner in value.items():
        seen.add((of["title"], key))
        to = target(schema, of["properties"][key])
        for entry in inner if isinstance(inner, list) else [inner]:
            if to is not None and entry is not None:
                seen_keys(schema, entry, to, seen)


def same(shown, found):
    """Is a value of the manual, whose numbers are shortened, that of a result? Tiny numbers are rounding."""
    if isinstance(shown, dict):
        return list(shown) == list(found) and all(same(shown[key], found[key]) for key in shown)
    if isinstance(shown, list):
        return len(shown) == len(found) and all(map(same, shown, found))
    if isinstance(shown, float):
        return math.isclose(shown, found, rel_tol=1e-3, abs_tol=1e-9)
    return shown == found
