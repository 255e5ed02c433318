"""A validator for the part of JSON Schema (draft 2020-12) that the schemas in reference/ use.

A keyword that is not known here is an error, so that nothing in a schema goes unchecked.
"""
ANNOTATIONS = {"$schema", "$comment", "$defs", "title"}
TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}


def is_of(kind, value):
    number = isinstance(value, (int, float)) and not isinstance(value, bool)
    if kind == "number":
        return number
    if kind == "integer":
        return number and float(value).is_integer()
    return isinstance(value, TYPES[kind])


def listed(wanted):
    return wanted if isinstance(wanted, list) else [wanted]


class validator:
    """`others`: the schemas of other files that this one refers to, by the files' names."""
    def __init__(self, schema, others=None):
        self.root = schema
        self.others = others or {}

    def fault(self, value, schema=None, place="$"):
        """What is wrong with a value, in words with its place; None where it is as the schema says."""
        schema = self.root if schema is None else schema
        for keyword, wanted in schema.items():
            if keyword in ANNOTATIONS:
                continue
            check = getattr(self, "check_" + keyword.lstrip("$"), None)
            if check is None:
                raise ValueError(f"unknown keyword {keyword}")
            if found := check(value, wanted, schema, place):
                return found
        return None

    def check_ref(self, value, wanted, _, place):
        file, _, name = wanted.partition("#/$defs/")
        if file:
            other = self.others[file]
            return validator(other, self.others).fault(value, other["$defs"][name], place)
        return self.fault(value, self.root["$defs"][name], place)

    def check_type(self, value, wanted, _, place):
        return None if any(is_of(kind, value) for kind in listed(wanted)) else f"{place}: not of type {wanted}"

    def check_const(self, value, wanted, _, place):
        return None if value == wanted and type(value) is type(wanted) else f"{place}: not {wanted}"

    def check_enum(self, value, wanted, _, place):
        return None if value in wanted else f"{place}: found {value}, allowed: {wanted}"

    def check_minimum(self, value, wanted, _, place):
        return f"{place}: below {wanted}" if is_of("number", value) and value < wanted else None

    def check_maximum(self, value, wanted, _, place):
        return f"{place}: above {wanted}" if is_of("number", value) and value > wanted else None

    def check_required(self, value, wanted, _, place):
        missing = [key for key in wanted if isinstance(value, dict) and key not in value]
        return f"{place}: {missing[0]} is missing" if missing else None

    def check_properties(self, value, wanted, _, place):
        known = [key for key in value if key in wanted] if isinstance(value, dict) else []
        return next(filter(None, (self.fault(value[key], wanted[key], f"{place}.{key}") for key in known)), None)

    def check_additionalProperties(self, value, wanted, schema, place):
        if wanted is not False:
            raise ValueError("additionalProperties: only false is known")
        unknown = [key for key in value if key not in schema["properties"]] if isinstance(value, dict) else []
        return f"{place}: unknown key {unknown[0]}" if unknown else None

    def check_items(self, value, wanted, _, place):
        entries = enumerate(value) if isinstance(value, list) else []
        return next(filter(None, (self.fault(entry, wanted, f"{place}[{i}]") for i, entry in entries)), None)

    def check_minItems(self, value, wanted, _, place):
        return f"{place}: fewer than {wanted}" if isinstance(value, list) and len(value) < wanted else None

    def check_maxItems(self, value, wanted, _, place):
        return f"{place}: more than {wanted}" if isinstance(value, list) and len(value) > wanted else None

    def check_anyOf(self, value, wanted, _, place):
        faults = [self.fault(value, choice, place) for choice in wanted]
        return None if None in faults else faults[-1]

    def check_oneOf(self, value, wanted, _, place):
        fitting = [self.fault(value, choice, place) for choice in wanted].count(None)
        return None if fitting == 1 else f"{place}: {fitting} of the choices fit, allowed: one of {wanted}"
