"""reference/python.md: every example runs and prints what the page shows."""
import pytest
from blocks import blocks_of, printed
from conftest import ROOT
from page import difference, wildcards

PAGE = ROOT / "reference/python.md"


def first_difference(text, most_wild):
    """The first example that does not print what is shown, in words; None where all do. Raises where it shows too little."""
    names, compared, wild = {}, 0, 0
    for code, line, shown in blocks_of(text):
        found = printed(code, line, names, "python.md").splitlines()
        assert shown is not None or not found, f"line {line}: found output, and no text block behind the example"
        wrong = difference(shown.splitlines(), found) if shown is not None else None
        if wrong:
            return f"line {line}: {wrong}"
        compared += len(found)
        wild += wildcards(shown.splitlines()) if shown else 0
    assert compared >= 50 and wild <= most_wild
    return None


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "reference").symlink_to(ROOT / "reference")
    monkeypatch.chdir(tmp_path)


def test_every_example_prints_what_the_page_shows(folder):
    text = PAGE.read_text()
    assert len(list(blocks_of(text))) >= 14
    assert first_difference(text, 1) is None
