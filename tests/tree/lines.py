"""Fails when cpp or tests has more lines, or the pages have more words, than lines.txt allows, or so many fewer that
the limit no longer holds what was reached.
Usage: lines.py ROOT"""
import subprocess
import sys
from pathlib import Path

SLACK = 0.01  # a limit may be this share above what is found


def found_in(root):
    """Returns the lines of the files of cpp and tests that git tracks, and the words of README.md and reference/."""
    listed = subprocess.run(["git", "-C", root, "ls-files", "cpp", "tests", "reference", "README.md"], check=True,
                            capture_output=True, text=True).stdout.splitlines()
    found = dict.fromkeys(("lines of cpp", "lines of tests", "words of pages"), 0)
    for name in listed:
        content = (Path(root) / name).read_bytes()
        if name.startswith(("cpp/", "tests/")):
            found[f"lines of {name.split('/')[0]}"] += content.count(b"\n")
        elif name.endswith(".md"):
            found["words of pages"] += len(content.split())
    return found


def main(root):
    rows = (Path(__file__).with_name("lines.txt")).read_text().splitlines()
    limits = {what: int(most) for most, what in (row.split(" ", 1) for row in rows if row and row[0] != "#")}
    found = found_in(root)
    if limits.keys() != found.keys():
        sys.exit(f"lines.txt: found {sorted(limits)}; allowed: {sorted(found)}")
    wrong = 0
    for what, number in found.items():
        print(f"{number} {what}; allowed: {limits[what]} or fewer")
        if number > limits[what]:
            wrong += 1
            print(f"{what}: found {number}; allowed: {limits[what]}. Remove or share something, or use an issue's allowance")
        elif number < limits[what] * (1 - SLACK):
            wrong += 1
            print(f"{what}: found {number}; lower the limit of {limits[what]} in tests/tree/lines.txt to what was reached")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
