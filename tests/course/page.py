"""The commands of a course page, and the outputs that the page shows.

A block fenced as `sh` is a command; the fenced block after it is the exact output, including standard error. <...>
stands for characters of one line that differ between machines. Every command has exit status 0; a command with another
status is followed by || echo "exit status $?".
"""
import itertools
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import blocks  # noqa: E402

WILD = "<...>"


def shown(text):
    """The commands of a page, each with the output lines that the page shows."""
    all_of, found = blocks(text), []
    for block, following in zip(all_of, [*all_of[1:], None]):
        if block.language == "sh":
            if not following or following.language != "text" or not following.text.strip():
                raise ValueError(f"line {block.line}: a command without output: a text block must follow, found {following}")
            found.append((block.text, following.text.splitlines()))
    return found


def difference(patterns, lines):
    """None if the lines fit the page; otherwise a description of the first difference."""
    for number, (pattern, found) in enumerate(itertools.zip_longest(patterns, lines), 1):
        if None in (pattern, found) or not re.fullmatch(".*".join(re.escape(part) for part in pattern.split(WILD)), found):
            shown, found = ("nothing more" if line is None else line for line in (pattern, found))
            return f"output line {number}:\n  shown {shown}\n  found {found}"
    return None


wildcards = lambda patterns: sum(pattern.count(WILD) for pattern in patterns)


class place:
    """A folder like the project's root after the release build, in which commands may leave files."""

    def __init__(self, root, programs):
        self.folder = tempfile.TemporaryDirectory()
        self.here = Path(self.folder.name)
        for entry in Path(root).resolve().iterdir():
            if entry.name != "build" and not entry.name.startswith("."):
                (self.here / entry.name).symlink_to(entry)
        (self.here / "build").mkdir()
        (self.here / "build/release").symlink_to(Path(programs).resolve())

    def run(self, command, **more):
        """The lines that a command prints, and its exit status."""
        finished = subprocess.run(["sh", "-euc", command], cwd=self.here, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  **{"stdin": subprocess.DEVNULL, **more})
        return [line.rstrip() for line in finished.stdout.splitlines()], finished.returncode
