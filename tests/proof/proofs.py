"""What the tests of check_proof.py share: the program's proofs, the checker's verdicts, and how a test fails."""
import contextlib
import io
import json
import subprocess
import sys
from pathlib import Path

program, reference = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(reference))
import check_proof  # noqa: E402

failed = 0


def fail(words):
    global failed
    failed += 1
    print(f"FAILED: {words}")


def end():
    print("FAILED" if failed else "passed")
    sys.exit(1 if failed else 0)


def run(problem, folder, *options):
    """The proof and the result of a run, parsed; none where the run has no end."""
    proof, result = Path(folder) / "proof.json", Path(folder) / "result.json"
    ended = subprocess.run([program, "run", problem, "--quiet", "--proof", proof, "--json", result, *options], capture_output=True, text=True)
    if ended.returncode not in (0, 3):
        return None, ended.stderr
    return json.loads(proof.read_text()), json.loads(result.read_text())


def proof_of(problem, folder, *options):
    return run(problem, folder, *options)[0]


def verdict(problem, proof, folder):
    """What the checker ends with, and what it says. `proof`: a value, or the text itself."""
    file = Path(folder) / "checked.json"
    file.write_text(proof if isinstance(proof, str) else json.dumps(proof))
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        code = check_proof.main(str(problem), str(file))
    return code, said.getvalue()
