"""run_page.py ROOT PROGRAMS PAGE LEAST MOST: runs the commands of a course page, and compares their outputs.
run_page.py ROOT PROGRAMS PAGE: writes the outputs of the commands to the page. Check what it wrote.

ROOT is the project, PROGRAMS its release build, PAGE is relative to ROOT. There must be LEAST commands or more, and MOST
wildcards or fewer. Text blocks that fit the outputs are not changed.
"""
import re
import sys
from pathlib import Path

from page import WILD, difference, place, shown, wildcards
from testing import FENCE


def main(root, programs, name, least, most):
    text = (Path(root) / name).read_text()
    commands = shown(text)
    if len(commands) < int(least):
        return f"{name}: found {len(commands)} commands, allowed: {least} or more"
    wild = sum(wildcards(patterns) for _, patterns in commands)
    if wild > int(most):
        return f"{name}: found {wild} wildcards, allowed: {most} or fewer"
    silent = [line for _, patterns in commands for line in patterns if WILD in line and not re.search(r"\w", line.replace(WILD, ""))]
    if silent:
        return f"{name}: a line says nothing beside its wildcard: {silent[0]}"
    here = place(root, programs)
    compared = 0
    for command, patterns in commands:
        lines, status = here.run(command)
        print("$ " + command + "\n".join(lines), flush=True)
        wrong = difference(patterns, lines) or (f"exit status: found {status}, allowed: 0" if status else None)
        if wrong:
            return f"{name}: {command}{wrong}"
        compared += len(patterns)
    print(f"{name}: {len(commands)} commands, {compared} lines compared, {wild} wildcards")
    return 0


def write(root, programs, name):
    path, here, lines = Path(root) / name, place(root, programs), None

    def anew(block):
        nonlocal lines
        kind, body = block.groups()
        if lines is not None and kind == "text" and difference(body.splitlines(), lines) is not None:
            body = "\n".join(lines) + "\n"
        lines = here.run(body)[0] if kind == "sh" else None
        return f"```{kind}\n{body}```"

    path.write_text(FENCE.sub(anew, path.read_text()))
    return 0


if __name__ == "__main__":
    sys.exit((write if len(sys.argv) == 4 else main)(*sys.argv[1:]))
