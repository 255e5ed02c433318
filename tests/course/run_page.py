"""run_page.py ROOT PROGRAMS PAGE LEAST MOST: runs what a page of the course shows, and compares what comes out.

ROOT is the project, PROGRAMS its release build, PAGE is relative to ROOT. There must be LEAST commands or more, and MOST
wildcards or fewer.
"""
import re
import sys
from pathlib import Path

from page import WILD, difference, place, shown, wildcards


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


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
