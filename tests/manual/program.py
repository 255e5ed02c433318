"""program.py CONTCT REPLAY BENCH ROOT: what the manuals say of the programs' options and exit statuses.

- No page shows an option that the program before it does not have, by the --help of each program and command.
- The exit statuses in running.md are those of the source; result_file.py has runs that end with them.
"""
import re
import subprocess
import sys
from pathlib import Path

LEAST_OPTIONS, LEAST_SHOWN = 70, 105
# Options of other programs that pages show: cmake, pkg-config, tests/run.sh and programs of the tests.
FOREIGN = {"--preset", "--build", "--target", "--install", "--prefix", "--cflags", "--libs", "--full", "--check", "--write", "--only",
           "--file", "--workflow", "--oversubscribe"}


def output(*line):
    return subprocess.run(line, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True).stdout


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
    enum = re.search(r"enum class exit_status \{(.*?)\};", (root / "cpp/contct/session/exit_status.hpp").read_text(), re.S).group(1)
    return set(re.findall(r"= (\d+)", enum))


def statuses_in_running(text):
    return set(re.findall(r"^\| (\d) \|", text.split("\n## Exit status")[1].split("\n## ")[0], re.M))


def main(contct, replay, bench, root):
    root = Path(root).resolve()
    options = options_by_command(contct, replay, bench)
    if different := statuses_in_source(root) ^ statuses_in_running((root / "reference/running.md").read_text()):
        return f"running.md and the source: exit status {min(different)}"
    shown = 0
    for page in [root / "README.md", *sorted((root / "reference").rglob("*.md"))]:
        for option, known in shown_options(page.read_text(), options):
            shown += 1
            if not known:
                return f"{page.relative_to(root)}: found {option}; allowed: an option of the program before it"
    count = sum(map(len, options.values()))
    if count < LEAST_OPTIONS or shown < LEAST_SHOWN:
        return f"found {count} options, and {shown} in pages; allowed: {LEAST_OPTIONS} and {LEAST_SHOWN} or more"
    print(f"{count} options, {shown} shown in pages")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
