"""A notebook without Jupyter: its code cells run in order, and what they print and show is compared, or written into it.
`python3 notebook.py BUILD NOTEBOOK` writes; the same notebook gives the same file."""
import ast
import contextlib
import io
import json
import sys
from pathlib import Path


def text_of(lines):
    return lines if isinstance(lines, str) else "".join(lines)


def lines_of(text):
    return text.splitlines(keepends=True)


def run_cell(source, names, title):
    """(what it prints, repr of its last expression or None)."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    out, value = io.StringIO(), None
    with contextlib.redirect_stdout(out):
        exec(compile(tree, title, "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), title, "eval"), names)
    return out.getvalue(), None if value is None else repr(value)


def outputs_of(source, names, number):
    """The outputs of a code cell as a notebook stores them: text alone."""
    printed, value = run_cell(source, names, f"cell {number}")
    outputs = []
    if printed:
        outputs.append({"name": "stdout", "output_type": "stream", "text": lines_of(printed)})
    if value is not None:
        outputs.append({"data": {"text/plain": lines_of(value)}, "execution_count": number, "metadata": {}, "output_type": "execute_result"})
    return outputs


def executed(notebook):
    """The same notebook with the outputs of its code cells."""
    names, number, cells = {"__name__": "__main__"}, 0, []
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            number += 1
            cell = {**cell, "execution_count": number, "outputs": outputs_of(text_of(cell["source"]), names, number)}
        cells.append(cell)
    return {**notebook, "cells": cells}


def as_text(notebook):
    return json.dumps(notebook, indent=1, ensure_ascii=False, sort_keys=True) + "\n"


if __name__ == "__main__":
    sys.path.insert(0, sys.argv[1])
    path = Path(sys.argv[2])
    path.write_text(as_text(executed(json.loads(path.read_text()))))
