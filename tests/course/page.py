"""The commands of a course page, and the outputs that the page shows.

A block fenced as `sh` is a command; the fenced block after it is the exact output, including standard error. <...>
stands for characters of one line that differ between machines. Every command has exit status 0; a command with another
status is followed by || echo "exit status $?".
"""
import re
import subprocess
import tempfile
from pathlib import Path

FENCE = re.compile(r"^```(\S*)\n(.*?)^```$", re.M | re.S)
WILD = "<...>"


def shown(text):
    """The commands of a page, each with the output lines that the page shows."""
    blocks = [(m.group(1), m.group(2), text.count("\n", 0, m.start()) + 1) for m in FENCE.finditer(text)]
    found = []
    for number, (kind, body, line) in enumerate(blocks):
        if kind != "sh":
            continue
        following, lines, _ = blocks[number + 1] if number + 1 < len(blocks) else ("nothing", "", 0)
        if following != "text" or not lines.strip():
            raise ValueError(f"line {line}: a command without output: a text block must follow, found {following}")
        found.append((body, lines.splitlines()))
    return found


def line_fits(pattern, line):
    return re.fullmatch(".*".join(re.escape(part) for part in pattern.split(WILD)), line) is not None


def difference(patterns, lines):
    """None if the lines fit the page; otherwise a description of the first difference."""
    for number in range(max(len(patterns), len(lines))):
        pattern = patterns[number] if number < len(patterns) else None
        found = lines[number] if number < len(lines) else None
        if pattern is None or found is None or not line_fits(pattern, found):
            ends = "nothing more"
            return f"output line {number + 1}:\n  shown {pattern or ends}\n  found {found if found is not None else ends}"
    return None


def wildcards(patterns):
    return sum(pattern.count(WILD) for pattern in patterns)


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
