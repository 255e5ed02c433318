"""Tests that every example of reference/python.md and the notebooks runs and prints the output that is shown."""
import ast
import contextlib
import io
import json

import pytest
from conftest import ROOT
from page import FENCE, difference, wildcards


def printed(code, names, title, line=1):
    """Runs Python code with the variables `names`. Returns its output, and the repr of its last expression or None."""
    tree = ast.parse("\n" * (line - 1) + code)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    out, value = io.StringIO(), None
    with contextlib.redirect_stdout(out):
        exec(compile(tree, title, "exec"), names)
        if last is not None:
            value = eval(compile(ast.Expression(last.value), title, "eval"), names)
    return out.getvalue(), None if value is None else repr(value)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "reference").symlink_to(ROOT / "reference")
    monkeypatch.chdir(tmp_path)


def test_every_example_prints_what_the_page_shows(folder):
    """Runs the `python` blocks in order; a `text` block after a `python` block is its output."""
    text = (ROOT / "reference/python.md").read_text()
    blocks, names, compared, wild = list(FENCE.finditer(text)), {}, 0, 0
    for block, following in zip(blocks, [*blocks[1:], None]):
        if block[1] != "python":
            continue
        line = text.count("\n", 0, block.start()) + 2
        behind = following and following[1] == "text" and not text[block.end():following.start()].strip()
        shown = following[2].splitlines() if behind else []
        found = [row.rstrip() for row in printed(block[2], names, "python.md", line)[0].rstrip().splitlines()]
        assert difference(shown, found) is None, f"line {line}"
        compared, wild = compared + len(found), wild + wildcards(shown)
    assert compared >= 25 and wild <= 1


@pytest.mark.parametrize("notebook, needs, least", [("course/sweep", [], 7), ("certify", ["scipy", "getfem"], 5)])
def test_the_stored_outputs_of_a_notebook_are_what_its_cells_print(notebook, needs, least):
    for module in needs:
        pytest.importorskip(module)
    names, compared = {"__name__": "__main__"}, 0
    for cell in json.loads((ROOT / f"reference/{notebook}.ipynb").read_text())["cells"]:
        if cell["cell_type"] == "code":
            stored = [("".join(out.get("text", "")), "".join(out.get("data", {}).get("text/plain", ""))) for out in cell["outputs"]]
            out, value = printed("".join(cell["source"]), names, notebook)
            assert ("".join(text for text, _ in stored), "".join(plain for _, plain in stored) or None) == (out, value)
            compared += len(stored)
    assert compared >= least
