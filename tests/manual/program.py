"""program.py CONTCT REPLAY BENCH ROOT: what the manuals say of the programs' options and exit statuses.

- No page shows an option that the program before it does not have, by the --help of each program and command.
- The exit statuses are those of the source: in running.md all of them, in result-file.md each under the `status` of a result that
  gives it. A run for each ends with it, and writes that `status`.
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from result_file import MECHANISM

LEAST_OPTIONS, LEAST_SHOWN = 70, 105
# Options of other programs that pages show: cmake, pkg-config, tests/run.sh and programs of the tests.
FOREIGN = {"--preset", "--build", "--target", "--install", "--prefix", "--cflags", "--libs", "--full", "--check", "--write", "--only",
           "--file", "--workflow", "--oversubscribe"}
PB07, NEAR_TIE = "problems/pb07-three-gap-supports", "problems/divergences/near-tie"
RUNS = [(0, "solved", [PB07]), (1, "kernels-disagree", [PB07, "--free-run", "--kernels", "corrected,fortran"]),
        (2, None, ["problems/no-such-problem"]), (3, "solved", [NEAR_TIE, "--strict"]),
        (4, "mechanism", [MECHANISM]), (5, "path-ended", ["problems/divergences/locked-in-forces"]),
        (5, "iteration-limit", [PB07, "--max-increments", "1"])]


def output(*line, status=0):
    finished = subprocess.run(line, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if finished.returncode != status:
        raise ValueError(f"{line}: found exit status {finished.returncode}, allowed: {status}\n{finished.stderr}")
    return finished.stdout


def options_in(help_text):
    return set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", help_text, re.M))


def options_by_command(contct, replay, bench):
    """What --help has: the options of each command, of contct itself under "", of the other programs under their names."""
    commands = re.findall(r"^  (\w+)  ", output(contct, "--help").split("Subcommands:")[1].split("Examples:")[0], re.M)
    found = {name: options_in(output(contct, name, "--help")) for name in commands}
    return found | {"": options_in(output(contct, "--help")), "contct-replay": options_in(output(replay, "--help")),
                    "contct_bench": options_in(output(bench, "--help"))}


def shown_options(text, options):
    """(option, whether the program before it has it) for each option in a page's code, links left out."""
    known = set().union(*options.values()) | FOREIGN
    for code in re.findall(r"```.*?```|^    .*$|`[^`]+`", text, re.M | re.S):
        for part in re.split(r"[|;\n]|&&", code.replace("\\\n", " ")):
            named = re.search(r"\b(contct_bench|contct-replay|contct)(?: (\w+))?(?= |$|`)", part)
            command = "" if not named else named[1] if named[1] != "contct" else named[2] or ""
            for option in re.finditer(r"(?<![\w-])--[a-z][\w-]*", part):
                is_its = command in options and command and option.start() > named.start()
                yield option[0], option[0] in (options[command] if is_its else known)


def statuses_in_source(root):
    enum = re.search(r"enum class exit_status \{(.*?)\};", (root / "cpp/contct/write/exit_status.hpp").read_text(), re.S).group(1)
    return {int(value) for value in re.findall(r"= (\d+)", enum)}


def statuses_in_running(text):
    return {int(s) for s in re.findall(r"^\| (\d) \|", text.split("\n## Exit status")[1].split("\n## ")[0], re.M)}


def statuses_in_result_file(text):
    """(exit status, a `status` that gives it); None where there is no file."""
    rows = re.findall(r'^\| (?:`"([\w-]+)"`|no file) \| (.*) \|$', text.split("\n## Exit status")[1].split("\n## ")[0], re.M)
    return {(int(number), status or None) for status, cell in rows for number in re.findall(r"\d", cell)}


def wrong_statuses(root, running, result_file):
    allowed = statuses_in_source(root)
    if allowed != {status for status, _, _ in RUNS}:
        return f"found the exit statuses {allowed} in the source, allowed: those of RUNS"
    for where, found in (("running.md", statuses_in_running(running)),
                         ("result-file.md", {status for status, _ in statuses_in_result_file(result_file)})):
        if different := allowed ^ found:
            return f"{where} and the source: exit status {min(different)}"
    if different := {(status, name) for status, name, _ in RUNS} ^ statuses_in_result_file(result_file):
        return f"result-file.md and the runs: {sorted(different, key=str)[0]}"
    return None


def run_each(contct, root):
    """Every exit status comes from a run, whose result has the `status`."""
    with tempfile.TemporaryDirectory() as folder:
        for status, name, (problem, *options) in RUNS:
            file = Path(folder) / f"{name}.json"
            path = Path(folder) / "p.toml" if "\n" in problem else root / f"reference/{problem}.toml"
            if "\n" in problem:
                path.write_text(problem)
            output(contct, "run", str(path), "--quiet", "--json", str(file), *options, status=status)
            found = json.loads(file.read_text())["status"] if file.exists() else None
            if found != name:
                raise ValueError(f"exit status {status}: found the status {found}, allowed: {name}")


def main(contct, replay, bench, root):
    root = Path(root).resolve()
    options = options_by_command(contct, replay, bench)
    running, result_file = ((root / f"reference/{name}.md").read_text() for name in ("running", "result-file"))
    if wrong := wrong_statuses(root, running, result_file):
        return wrong
    shown = 0
    for page in [root / "README.md", *sorted((root / "reference").rglob("*.md"))]:
        for option, known in shown_options(page.read_text(), options):
            shown += 1
            if not known:
                return f"{page.relative_to(root)}: found {option}; allowed: an option of the program before it"
    count = sum(map(len, options.values()))
    if count < LEAST_OPTIONS or shown < LEAST_SHOWN:
        return f"found {count} options, and {shown} in pages; allowed: {LEAST_OPTIONS} and {LEAST_SHOWN} or more"
    try:
        run_each(contct, root)
    except ValueError as wrong:
        return str(wrong)
    print(f"{count} options, {shown} shown in pages, {len(RUNS)} exit statuses")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
