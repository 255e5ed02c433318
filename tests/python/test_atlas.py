"""Tests the shares that reference/atlas.py counts, and its picture and table in reference/DIVERGENCES.md."""
import re
import sys
import xml.etree.ElementTree

from conftest import ROOT

sys.path.append(str(ROOT / "reference"))
import atlas  # noqa: E402


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
