"""The course's notebook: its cells run in order without Jupyter, and its stored outputs are what they print."""
import json

import pytest
from conftest import ROOT
from notebook import as_text, executed, text_of

PATH = ROOT / "reference/course/sweep.ipynb"


@pytest.fixture(scope="module")
def notebook():
    return json.loads(PATH.read_text())


@pytest.fixture(scope="module")
def again(notebook):
    return executed(notebook)


def outputs(notebook):
    """(kind, text) of every stored output."""
    return [(o["output_type"], text_of(o["text"] if "text" in o else o["data"]["text/plain"]))
            for cell in notebook["cells"] if cell["cell_type"] == "code" for o in cell["outputs"]]


def test_the_stored_outputs_are_what_the_cells_print(notebook, again):
    found = outputs(again)
    assert found == outputs(notebook)
    assert len(found) >= 7 and sum(text.count("\n") for _, text in found) >= 23


def test_the_file_is_what_the_script_writes(again):
    assert PATH.read_text() == as_text(again)



def test_it_is_a_notebook_of_format_4_5(notebook):
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    cells = notebook["cells"]
    assert len({cell["id"] for cell in cells}) == len(cells) >= 14
    for cell in cells:
        keys = {"cell_type", "id", "metadata", "source"} | ({"execution_count", "outputs"} if cell["cell_type"] == "code" else set())
        assert set(cell) == keys
    assert sum(cell["cell_type"] == "code" for cell in cells) >= 7
