"""adopt.py ROOT REPLAY [BARE]: runs the shell lines of each file in reference/adopt, as CI systems do. All lines must
end with 0 for a correct kernel, and one of them with 1 for a kernel with a fault. REPLAY: contct-replay.

With BARE, a folder with a bare Debian that contains ROOT and REPLAY, the lines run in this system, with the real git
and with the RUN lines of the Dockerfile.
"""
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from edits import edited  # noqa: E402
from testing import TESTS, run  # noqa: E402


def steps_of_action(text, adopt, replay):
    """Yields (line, environment) for each step of action.yml, with GitHub's values of ${{ .. }}."""
    values = {"github.action_path": adopt, "inputs.source": "mine.c", "inputs.replay": replay}
    for line, environment in re.findall(r"- run: (.*)\n(?:      (?!env).*\n)*      env: \{ (.*) \}", text):
        line = line[1:-1].replace('\\"', '"') if line.startswith('"') else line
        yield line, {name: values[key] for name, key in re.findall(r'(\w+): "\$\{\{ ([\w.]+) \}\}"', environment)}


def jobs(root, replay, bare):
    """Returns {file of reference/adopt: [(line, environment)]}."""
    adopt, repository = root / "reference/adopt", {"CONTCT_REPOSITORY": f"file://{root}"}
    text = {file.name: file.read_text() for file in (TESTS.parent / "reference/adopt").iterdir()}
    installs = re.findall(r"^RUN (.*)$", text["Dockerfile"], re.M) if bare else []
    copies = [(f"mkdir -p {Path(target).parent} && cp -r {root / source} {target}", {}) for source, target in re.findall(r"^COPY (\S+) /(\S+)$", text["Dockerfile"], re.M)]
    entry, = re.findall(r'^ENTRYPOINT \["sh", "/(.*)"\]$', text["Dockerfile"], re.M)
    return {
        "action.yml": list(steps_of_action(text["action.yml"], str(adopt), replay)),
        "gitlab-ci.yml": [(line, repository) for line in re.findall(r"^    - (.*)$", text["gitlab-ci.yml"], re.M)],
        "Jenkinsfile": [(line, repository) for line in re.findall(r"sh '(.*)'", text["Jenkinsfile"])],
        "Dockerfile": [(line, {}) for line in installs] + copies + [(f"sh {entry} mine.c", {})],
    }


def statuses(lines, kernel, bare):
    with tempfile.TemporaryDirectory(dir=bare) as folder:
        (Path(folder) / "mine.c").write_text(kernel)
        usual, enter = os.environ, ["sh", "-e", "-c"]
        if bare:
            usual = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND": "noninteractive"}
            enter = ["chroot", bare, "sh", "-e", "-c", f'cd /{Path(folder).name} && eval "$1"', "sh"]
        else:
            (Path(folder) / "git").write_text('#!/bin/sh\nexec ln -s "${5#file://}" "$6"\n')  # links the working copy as clone
            (Path(folder) / "git").chmod(0o755)
        path = usual["PATH"] if bare else f"{folder}:{usual['PATH']}"
        return [run(*enter, line, cwd=folder, env={**usual, "PATH": path, **environment}, timeout=300).returncode for line, environment in lines]


root, replay, bare = Path(sys.argv[1]).resolve(), str(Path(sys.argv[2]).resolve()), next(iter(sys.argv[3:]), None)
if not bare and not shutil.which("cc"):
    sys.exit(77)
good = (TESTS.parent / "reference/kernels/contct_kernel.c").read_text()
bad = edited(good, [("epsgap = 1e-10", "epsgap = 1e-9")])
for name, lines in jobs(root, replay, bare).items():
    found, faulty = statuses(lines, good, bare), statuses(lines, bad, bare)
    print(name, found, faulty)
    if len(lines) < 2 or any(found) or 1 not in faulty or set(faulty) - {0, 1}:
        sys.exit(f"{name}: found {found} for a kernel that is CONTCT, {faulty} for one that is not")
