"""Tests that every example of reference/python.md and the notebooks runs and prints the output that is shown, and the shares
that reference/atlas.py counts."""
import ast
import contextlib
import io
import json
import re
import xml.etree.ElementTree

import atlas
import pytest
from conftest import ROOT
from page import difference, wildcards
from testing import blocks


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
    all_of, names, compared, wild = blocks((ROOT / "reference/python.md").read_text()), {}, 0, 0
    for block, following in zip(all_of, [*all_of[1:], None]):
        if block.language == "python":
            shown = following.text.splitlines() if block.is_followed and following.language == "text" else []
            found = [row.rstrip() for row in printed(block.text, names, "python.md", block.line + 1)[0].rstrip().splitlines()]
            assert difference(shown, found) is None, f"line {block.line}"
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


def test_the_1989_rule_is_wrong_in_small_units_of_length_and_neither_rule_in_the_unit_1():
    kernels = {"fortran": "fortran", "corrected": "corrected"}
    assert atlas.count(10, 1989, 1e-12, kernels)["fortran"] >= 5
    assert atlas.count(10, 1989, 1.0, kernels) == {"fortran": 0, "corrected": 0}


def test_the_table_in_divergences_md_has_the_shares_that_atlas_svg_shows():
    rows = [[float(part) for part in row] for row in re.findall(
        r"^\| (1e-?\d+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", (ROOT / "reference/DIVERGENCES.md").read_text(), re.M)]
    assert [row[0] for row in rows] == [10.0 ** decade for decade in atlas.DECADES]
    shares = {name: [row[column] for row in rows] for column, name in enumerate(atlas.COLOURS, 1)}
    drawn = (ROOT / "reference/atlas.svg").read_text()
    assert atlas.picture(shares, re.search("<title>(.*)</title>", drawn)[1]) == drawn
    assert xml.etree.ElementTree.fromstring(drawn).tag.endswith("svg")
