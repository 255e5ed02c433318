"""Every keyword that the validator knows, with values that it must take and others that it must refuse."""
import sys

from schema import validator

CASES = [  # (schema, valid values, others)
    ({"type": "integer"}, [1, 0, -3, 2.0], [1.5, "1", True, None, []]),
    ({"type": "number"}, [1, 1.5, -0.0], ["1", False, None, {}]),
    ({"type": "boolean"}, [True, False], [0, 1, "true", None]),
    ({"type": ["string", "null"]}, ["", None], [0, [], {}]),
    ({"const": True}, [True], [1, False, "true"]),
    ({"enum": ["a", "b"]}, ["a", "b"], ["c", "", None]),
    ({"type": "number", "minimum": 0, "maximum": 1}, [0, 1, 0.5], [-1e-9, 1.1]),
    ({"type": "array", "items": {"type": "integer"}, "minItems": 1, "maxItems": 2}, [[1], [1, 2]], [[], [1, 2, 3], [1, "2"], {}]),
    ({"type": "object", "properties": {"a": {"type": "string"}, "b": {}}, "required": ["a"], "additionalProperties": False},
     [{"a": ""}, {"a": "", "b": 1}], [{}, {"b": 1}, {"a": 1}, {"a": "", "c": 1}, []]),
    ({"anyOf": [{"type": "null"}, {"$ref": "#/$defs/x"}], "$defs": {"x": {"type": "object", "required": ["a"]}}},
     [None, {"a": 1}], [{}, 1]),
    ({"oneOf": [{"required": ["a"]}, {"required": ["b"]}]}, [{"a": 1}, {"b": 1}], [{}, {"a": 1, "b": 1}]),
]


def main():
    count = 0
    for schema, valid, others in CASES:
        check = validator(schema)
        for value, right in [(v, True) for v in valid] + [(v, False) for v in others]:
            count += 1
            if (check.fault(value) is None) != right:
                return f"{schema}: {value} is {'refused' if right else 'taken'}"
    other = {"$defs": {"x": {"type": "integer"}}}
    for value, right in ((1, True), ("1", False)):
        count += 1
        if (validator({"$ref": "other.json#/$defs/x"}, {"other.json": other}).fault(value) is None) != right:
            return f"a schema of another file: {value} is {'refused' if right else 'taken'}"
    for schema in ({"pattern": "a"}, {"additionalProperties": True}):
        try:
            validator(schema).fault({"a": 1})
            return f"{schema}: found no error, allowed: that the keyword is not known"
        except ValueError:
            count += 1
    print(f"{count} values")
    return 0


if __name__ == "__main__":
    sys.exit(main())
