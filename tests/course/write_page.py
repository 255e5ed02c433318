"""write_page.py ROOT PROGRAMS PAGE: puts what the commands of a page print behind them, for whoever changes a page.

Text blocks that have wildcards and still fit are left as they are. Read what it wrote before you believe it.
"""
import sys
from pathlib import Path

from page import FENCE, difference, place


def main(root, programs, name):
    path = Path(root) / name
    text = path.read_text()
    here = place(root, programs)
    written, end, lines = [], 0, None
    for block in FENCE.finditer(text):
        written.append(text[end:block.start()])
        end = block.end()
        kind, body = block.groups()
        if lines is not None and kind == "text" and difference(body.splitlines(), lines) is not None:
            body = "\n".join(lines) + "\n"
        lines = here.run(body)[0] if kind == "sh" else None
        written.append(f"```{kind}\n{body}```")
    path.write_text("".join(written) + text[end:])


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
