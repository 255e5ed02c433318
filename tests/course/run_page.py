"""run_page.py ROOT PROGRAMS PAGE LEAST MOST: runs what a page of the course shows, and compares what comes out.

ROOT is the project, PROGRAMS its release build, PAGE is relative to ROOT. There must be LEAST commands or more, and MOST
wildcards or fewer. Then the comparison is put to the test: in every block each line is left out, doubled, and changed in
its last letter or digit, and every one of these must be noticed.
"""
import sys
from pathlib import Path

from page import WILD, broken_link, difference, place, shown, wildcards


def with_another_letter(pattern):
    """The same line with its last letter or digit, outside wildcards, changed; None where it has none."""
    parts = pattern.split(WILD)
    for part in reversed(range(len(parts))):
        letters = [at for at, letter in enumerate(parts[part]) if letter.isalnum()]
        if letters:
            last = letters[-1]
            other = "3" if parts[part][last] == "7" else "7"
            parts[part] = parts[part][:last] + other + parts[part][last + 1:]
            return WILD.join(parts)
    return None


def doctored(patterns):
    """The same lines with one fault in one line, every such fault."""
    for number, pattern in enumerate(patterns):
        before, behind = patterns[:number], patterns[number + 1:]
        yield before + behind
        yield before + [pattern, pattern] + behind
        changed = with_another_letter(pattern)
        if changed is not None:
            yield before + [changed] + behind


def main(root, programs, name, least, most):
    text = (Path(root) / name).read_text()
    broken = broken_link(Path(root) / name, text)
    if broken:
        return f"{name}: a link leads nowhere: {broken}"
    commands = shown(text)
    if len(commands) < int(least):
        return f"{name}: found {len(commands)} commands, allowed: {least} or more"
    wild = sum(wildcards(patterns) for _, patterns in commands)
    if wild > int(most):
        return f"{name}: found {wild} wildcards, allowed: {most} or fewer"
    silent = [line for _, patterns in commands for line in patterns if WILD in line and with_another_letter(line) is None]
    if silent:
        return f"{name}: a line says nothing beside its wildcard: {silent[0]}"
    here = place(root, programs)
    compared = faults = 0
    for command, patterns in commands:
        lines, status = here.run(command)
        print("$ " + command + "\n".join(lines), flush=True)
        wrong = difference(patterns, lines) or (f"exit status: found {status}, allowed: 0" if status else None)
        if wrong:
            return f"{name}: {command}{wrong}"
        compared += len(patterns)
        for fault in doctored(patterns):
            faults += 1
            if difference(fault, lines) is None:
                return f"{name}: a fault in this output is not noticed:\n" + "\n".join(fault)
    print(f"{name}: {len(commands)} commands, {compared} lines compared, {wild} wildcards, {faults} faults noticed")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
