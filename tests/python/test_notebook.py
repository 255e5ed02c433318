"""The course's notebook: its cells run in order without Jupyter, and its stored outputs are what they print."""
import json

from conftest import ROOT
from notebook import as_text, executed


def test_the_stored_outputs_are_what_the_cells_print():
    written = (ROOT / "reference/course/sweep.ipynb").read_text()
    again = executed(json.loads(written))
    assert as_text(again) == written
    assert sum(len(cell["outputs"]) for cell in again["cells"] if cell["cell_type"] == "code") >= 7
