"""What is wrong with a value under a JSON Schema of reference/, by Debian's jsonschema."""
import jsonschema


class validator:
    """`others`: the schemas of other files that this one refers to, by the files' names."""
    def __init__(self, schema, others=None):
        store = {f"file:///{file}": other for file, other in (others or {}).items()}
        resolver = jsonschema.RefResolver("file:///", schema, store=store)
        self.known = jsonschema.Draft202012Validator(schema, resolver=resolver)

    def fault(self, value, schema=None):
        """In words with its place; None where it is as the schema, or a part of it, says."""
        validator = self.known if schema is None else self.known.evolve(schema=schema)
        wrong = next(validator.iter_errors(value), None)
        return wrong and f"{wrong.json_path}: {wrong.message[:300]}"
