#!/usr/bin/env python3
"""implementations.py [--check]: writes the table of ../implementations.md from reports/*.json; with --check, compares
the existing table instead. reports/NAME.json is the output of `contct replay --report` for the golden set."""
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAGE = HERE.parent / "implementations.md"
BEGIN, END = "| implementation |", "\n\nEach row"
WORDS = {"bits": "equal to the bit", "ulps": "same events, numbers within 64 ULP", "events": "same events", "none": "not equal"}


def row(path):
    r = json.loads(path.read_text())
    assert r["format"] == "contct-report-1", path
    kernel = r["kernel"]
    compiler = f"{kernel['language']}, {kernel['compiler']}" if kernel["compiler"] else kernel["language"]
    return f"| {path.stem} | {compiler} | {kernel['real']} | {r['vectors']} | {r['calls']} | {r['mismatches']} | {WORDS[r['rung']]} |"


def table():
    head = "| implementation | language | REAL | vectors | calls | values that differ | result |\n| --- | --- | --- | --- | --- | --- | --- |\n"
    return head + "\n".join(row(path) for path in sorted((HERE / "reports").glob("*.json")))


def main(option=None):
    page = PAGE.read_text()
    begin, end = page.index(BEGIN), page.index(END)
    made = page[:begin] + table() + page[end:]
    if option != "--check":
        PAGE.write_text(made)
    elif made != page:
        return f"{PAGE.name}: its table is not that of the reports; run reference/vectors/implementations.py"
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
