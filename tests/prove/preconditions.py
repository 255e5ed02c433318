"""preconditions.py BUILD: which proofs fail when a precondition is left out. A precondition that no proof needs is stated
because the language leaves the result open."""

import sys
from pathlib import Path

build = Path(sys.argv[1])
sys.path.insert(0, str(build))
from contct_prove.specification import PRECONDITIONS
from contct_prove.verdict import KERNELS, Outcome, judge

NEEDED = {"pairs", "subscripts"}
for left_out in PRECONDITIONS:
    verdicts = [judge(str(build / "contct"), kernel, left_out) for kernel in (KERNELS[0], KERNELS[2])]
    needed = any(v.outcome != Outcome.PROVED for v in verdicts)
    print(f"without {PRECONDITIONS[left_out]}:", *(f"\n  {v.kernel.words}: {v.words}" for v in verdicts), flush=True)
    assert needed == (left_out in NEEDED), left_out
