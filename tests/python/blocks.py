"""The examples of a page: blocks fenced as `python`, run one after the other in one namespace; the `text` block behind one is what
it prints; <...> stands for characters that differ from machine to machine. `python3 blocks.py ROOT BUILD PAGE` writes what they
print into the page, for whoever changes it."""
import contextlib
import io
import os
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "course"))
from page import FENCE, difference  # noqa: E402


def blocks_of(text):
    """(code, line, shown): shown is None where no text block follows at once."""
    blocks = list(FENCE.finditer(text))
    for number, block in enumerate(blocks):
        if block[1] == "python":
            following = blocks[number + 1] if number + 1 < len(blocks) else None
            behind = following and following[1] == "text" and not text[block.end():following.start()].strip()
            yield block[2], text.count("\n", 0, block.start()) + 2, following[2] if behind else None


def printed(code, line, names, file):
    """What a block prints; it changes `names`."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile("\n" * (line - 1) + code, file, "exec"), names)
    return "".join(row.rstrip() + "\n" for row in out.getvalue().rstrip().splitlines())


def write(root, build, page):
    sys.path.insert(0, build)
    path = Path(root).resolve() / page
    text = path.read_text()
    os.chdir(root)
    names, written, end, out = {}, [], 0, None
    for block in FENCE.finditer(text):
        written.append(text[end:block.start()])
        end, body = block.end(), block[2]
        if block[1] == "text" and out is not None and difference(body.splitlines(), out.splitlines()):
            body = out
        out = printed(body, text.count("\n", 0, block.start()) + 2, names, page) if block[1] == "python" else None
        written.append(f"```{block[1]}\n{body}```")
    path.write_text("".join(written) + text[end:])


if __name__ == "__main__":
    write(*sys.argv[1:])
