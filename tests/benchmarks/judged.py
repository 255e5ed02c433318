"""judged.py ROOT: judge.py judges results of PB1 and PB2 by hand, right ones, each kind of wrong one, and invalid files."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
from testing import Checks, run  # noqa: E402

JUDGE = Path(sys.argv[1]) / "reference/benchmarks/judge.py"
RIGHT = [{"step": 2, "quantity": "w", "node": 3, "value": -0.00483720930}, {"step": 2, "quantity": "force", "pair": 1, "value": 41.8604651},
         {"step": 2, "quantity": "event", "pair": 1, "change": "make", "value": 0.1}]
ON_BED = {"name": "pb03a-point-load-on-bed-l4", "tolerance": 0.1}
CONTACTS, STATE = {"step": 1, "quantity": "contacts"}, {"step": 1, "quantity": "state", "pair": 36}
check = Checks()


def judged(status, words, entries=(), least=1, tolerance=1e-6, name="pb01-cantilever-tip-stop", **top):
    """Asks for the exit status, and for `words` in what is printed."""
    given = {"format": "contct-answers-1", "program": "By hand", "version": "1", "tolerance": tolerance, "problems": {name: list(entries)}} | top
    done = run(sys.executable, JUDGE, "-", "--least", least, input=json.dumps(given))
    check(done.returncode == status and words in done.stdout + done.stderr, f"found {done.returncode}, {done.stdout}{done.stderr}; allowed: {status}, {words}")


changed = lambda number, value: [entry | ({"value": value} if i == number else {}) for i, entry in enumerate(RIGHT)]
judged(0, "3 numbers of 1 problems, 0 outside 1e-06", RIGHT, least=3)
judged(0, "0 outside 0.001", changed(0, -0.0048372 * 1.0009), tolerance=1e-3)  # of the largest w, 0.0053
judged(1, "force, pair 1: found 41.8614651; exact value 1800/43; error", changed(1, 41.8614651))
judged(1, "event", changed(2, 0.1001), tolerance=5e-5)  # the error of a share is absolute
judged(1, "contacts: found 30; exact value 31; error inf", [CONTACTS | {"value": 30}], **ON_BED)
judged(1, "w, node 3: found nan", changed(0, float("nan")))
judged(0, "2 numbers", [STATE | {"value": "contact"}, CONTACTS | {"value": 31}], **ON_BED)
judged(1, "state, pair 36: found separated; exact value contact", [STATE | {"value": "separated"}], **ON_BED)
judged(2, "found 3 numbers; allowed: 4 or more", RIGHT, least=4)
judged(2, "twice; allowed: each number once", [RIGHT[0], RIGHT[0]])
judged(2, "allowed: a number", changed(0, "0"))
judged(2, "found ['nod']", [RIGHT[0] | {"nod": 1}])
judged(2, "'node': 77", [RIGHT[0] | {"node": 77}])
judged(2, "found nowhere; allowed: pb01", RIGHT, name="nowhere")
judged(2, "tolerance: found 0.2; allowed: a number from 0 to 0.1", RIGHT, tolerance=0.2)
judged(2, "format: found contct-answers-2", RIGHT, format="contct-answers-2")
check.end()
