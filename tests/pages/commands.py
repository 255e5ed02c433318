"""commands.py ROOT PROGRAMS NOT_RUN LEAST: runs every command that the pages outside the course show, and compares the
output with the output that the page shows.

Commands are in blocks fenced as `sh` (a `text` block after such a block is the output), in CI jobs fenced as `yaml` or
in files of reference/adopt, in indented lines, and in code spans. A code span that only names a command, as in "see
`contct run`", is not run. A command that a page has twice is run once, as is a job whose commands pages have too. FILE
and other names in capitals stand for the files in NAMES. Every command must end with exit status 0, unless the file
NOT_RUN has it: "PAGE: COMMAND -> reason" if it is not run, or "PAGE: COMMAND -> exit 1: reason" for another exit status.
PROGRAMS: the folder of the release build. Fails if fewer than LEAST commands ran.
"""
import os
import re
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "course"))
from page import difference, place  # noqa: E402
from testing import FENCE, PB07, blocks  # noqa: E402

PROGRAM = r"(?:[\w./]*/)?contct(?:[_-]\w+)?"
BEGINS = re.compile(rf"(?:{PROGRAM}|sh|python3|cmake|cc|g\+\+|gfortran|ccx|export|mkdir|git)\s")
INSTALLS = re.compile(r"sh contct/cpp/run\.sh|apt-get |git clone ")
READS_A_FILE = ("run", "check", "explain", "exact", "replay")
NAMES = {"FILE": PB07, "F": "f.out", "K.mtx": "frame.mtx", "RESULT.json": "result.json", "COMMAND": "run", "fortran,NAME": "fortran,cpp"}


def is_mention(command):
    """Returns True if a code span only names a command or an option, and is not to be run."""
    named = re.fullmatch(rf"{PROGRAM}(?: (\w+))?(.*)", command)
    if not named or (not named[1] and not named[2]):
        return command in ("sh -c",)
    if command.startswith("build/"):
        return False
    of_file = named[1] in READS_A_FILE and not re.search(r"\bFILE\b|\.\w+\b| -$", named[2])
    return of_file or not named[2].strip()


def job_commands(text):
    """Returns the commands of the CI job in a yaml block, except those that install or build this project. A matrix job
    is run once. The script of a GitLab job is one command, because its lines share variables."""
    script = [line for line in re.findall(r"^    - (.*)$", text, re.M) if not INSTALLS.match(line)]
    steps = [line.replace("${{ matrix.shard }}", "1") for line in re.findall(r"^ *- run: (.*)$", text, re.M) if not INSTALLS.match(line)]
    return ["; ".join(script)] if "  script:\n" in text else steps


def commands_of(text):
    """Returns (line, command, lines shown as its output or None) in the order of the page."""
    found, all_of = [], blocks(text)
    for block, following in zip(all_of, [*all_of[1:], None]):
        if block.language == "yaml":
            found += [(block.line, command, None) for command in job_commands(block.text)]
        elif block.language == "sh" and block.is_followed and following.language == "text":
            found.append((block.line + 1, block.text.strip(), tuple(following.text.splitlines())))
        elif block.language == "sh":
            found += [(block.line + 1, re.sub(r"\s+#.*", "", part), None) for part in block.text.replace("\\\n", " ").splitlines()]
    prose = FENCE.sub(lambda m: re.sub(r"[^\n]", " ", m.group(0)), text)
    for m in re.finditer(r"^    (\S.*)$|`([^`]+)`", prose, re.M):
        command = re.sub(r"\s{4,}.*", "", m[1]) if m[1] else " ".join(m[2].split())
        if BEGINS.match(command) and (m[1] or not is_mention(command)):
            found.append((text.count("\n", 0, m.start()) + 1, command, None))
    return sorted(dict.fromkeys(found), key=lambda entry: entry[0])


class work_place(place):
    """A working folder that also has a copy of reference/, the files of structures, and files for the CI jobs."""

    def __init__(self, root, programs):
        super().__init__(root, programs)
        (self.here / "reference").unlink()
        shutil.copytree(root / "reference", self.here / "reference")
        for file in (root / "reference/structures").iterdir():
            if file.is_file():
                shutil.copy(file, self.here)
        (self.here / "contct").symlink_to(".")
        shutil.copy(root / "reference/kernels/contct_kernel.c", self.here / "mine.c")
        self.environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "CALLS": "8000", "GITHUB_STEP_SUMMARY": "step_summary"}

    def run(self, command):
        with open(self.here / PB07) as problem:
            return super().run(command, stdin=problem, env=self.environment)


def wrong_in(here, command, shown, allowed):
    """Returns what is wrong with a command in words, or None."""
    words = [NAMES.get(word, word) for word in command.split(" ")]
    lines, status = here.run(" ".join(word.replace(PB07, "new.toml") if words[:2] == ["contct", "new"] else word for word in words))
    if status != allowed:
        return f"found exit status {status}, allowed: {allowed}\n" + "\n".join(lines[-5:])
    return difference(shown, lines) if shown else None


root, programs, not_run, least = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), Path(sys.argv[3]), int(sys.argv[4])
rows = [re.fullmatch(r"(\S+): (.*) -> (.*)", line) for line in not_run.read_text().splitlines() if line and line[0] != "#"]
excused, used, ran = {(row[1], row[2]): row[3] for row in rows}, set(), []
pages = [root / "README.md", *sorted((root / "reference").rglob("*.md")), *(root / "reference/adopt").glob("*.git???.yml")]
for page in (page for page in pages if page.parent.name != "course"):
    here, name, text = work_place(root, programs), str(page.resolve().relative_to(root)), page.read_text()
    found = commands_of(text if page.suffix == ".md" else f"```yaml\n{text}```\n")
    is_known = page.suffix != ".md" and {command for _, command, _ in found} <= set(ran)
    for line, command, shown in [] if is_known else found:
        reason = excused.get((name, command), "")
        ends = re.match(r"exit (\d): ", reason)
        if (name, command) not in used and (ends or not reason):
            print(f"{name}:{line}: {command}", flush=True)
            if wrong := wrong_in(here, command, shown, int(ends[1]) if ends else 0):
                sys.exit(f"{name}:{line}: {command}: {wrong}")
            ran.append(command)
        used.add((name, command))
if unused := sorted(excused.keys() - used):
    sys.exit(f"{not_run}: found {': '.join(unused[0])}; allowed: a command that this page shows")
print(f"{len(ran)} commands ran; {len(excused)} are not run, or end with another exit status than 0, for a reason")
sys.exit(0 if len(ran) >= least else f"found {len(ran)} commands, allowed: {least} or more")
