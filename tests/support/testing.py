"""Helpers of the tests in Python: they run programs, count and report checks, and read the code blocks of pages."""
import json
import re
import subprocess
import sys
from collections import Counter, namedtuple
from pathlib import Path

sys.dont_write_bytecode = True
TESTS = Path(__file__).absolute().parents[1]  # not resolve(): in a copy, this folder may be a link
ROOT = TESTS.parent
PB07 = "reference/problems/pb07-three-gap-supports.toml"
FENCE = re.compile(r"^```(\S*)\n(.*?)^```$", re.M | re.S)
# A code block: its language, its text, the line of the page on which the block begins, and whether the next block follows
# without words between them.
block = namedtuple("block", "language text line is_followed")


def blocks(page):
    found = list(FENCE.finditer(page))
    return [block(m[1], m[2], page.count("\n", 0, m.start()) + 1, bool(after) and not page[m.end():after.start()].strip())
            for m, after in zip(found, [*found[1:], None])]


def run(*command, status=None, **more):
    """Returns the finished process of a command, with its output as text. `status`: the allowed exit status or a tuple of
    them; None: any. Raises ValueError for another one."""
    words = [str(word) for word in command]
    done = subprocess.run(words, **{"capture_output": True, "text": True, "errors": "replace", "check": False,
                                    **({} if "input" in more else {"stdin": subprocess.DEVNULL}), **more})
    if status is not None and done.returncode not in (status if isinstance(status, tuple) else (status,)):
        raise ValueError(f"{' '.join(words)}: found exit status {done.returncode}; allowed: {status}\n{done.stdout}{done.stderr}")
    return done


def result_of(*command, status=0, cwd="."):
    """Returns the JSON that a command of contct writes."""
    run(*command, "--json", "result.json", status=status, cwd=cwd)
    return parsed(Path(cwd, "result.json").read_text(encoding="utf-8"))


def parsed(text):
    """Returns the value of a JSON text, in which NaN and infinities become texts that no schema allows."""
    return json.loads(text, parse_constant=lambda name: f"no JSON: {name}")


class Checks:
    """Counts the checks and the failed checks, and other numbers in `counted`."""

    def __init__(self):
        self.made, self.failed, self.counted = 0, 0, Counter()

    def __call__(self, holds, what):
        self.made += 1
        if not holds:
            self.failed += 1
            print(f"   FAILED: {what}", flush=True)
        return bool(holds)

    def all(self, rows):
        """Makes the checks of a table: (holds, what)."""
        for row in rows:
            self(*row)

    def end(self, least_checks=1, **least):
        """Ends the program: with exit status 1 if a check failed, or if a number in `counted` is below its `least`."""
        for name, number in least.items():
            self(self.counted[name] >= number, f"found {self.counted[name]} {name}; allowed: {number} or more")
        self(self.made >= least_checks, f"found {self.made} checks; allowed: {least_checks} or more")
        print("".join(f"   {number} {name}\n" for name, number in self.counted.items()) + f"   {self.made} checks, {self.failed} failed")
        sys.exit(1 if self.failed else 0)
