"""A program that uses all of contct.py, for which mypy --strict must report no error."""
from fractions import Fraction
from pathlib import Path
from typing import Any, Optional

import contct

problem: dict[str, Any] = contct.read("beam.toml")
result: contct.Result = contct.run(problem, kernels="corrected", strict=True)
again: contct.Result = contct.run(Path("beam.toml"), kernels=("fortran", "cpp"), engine=None, envelope=True, max_increments=9)
loaded: contct.Result = contct.load("result.json")
forces: list[float] = [pair.force for pair in result.steps[-1].pairs]
events: list[tuple[float, str]] = [(i.fraction, event.change) for i in result.steps[0].increments for event in i.events]
proved: bool = result.certified
axes: Any = result.plot("moment", step=0)
texts: list[str] = [result.page, result.log, result.trace, result.proof, contct.to_toml(problem), *result.messages]

exact: contct.Exact = contct.exact("beam.toml", rule="1989", kernels=["fortran"])
shares: list[Fraction] = [i.fraction for step in exact.steps for i in step.increments]
deflections: list[list[Fraction]] = [step.w for step in exact.steps]

kind: str = contct.check(problem).kind
winner: Any = contct.explain(problem, step=1, increment=1).increments[0].winner
bounds: contct.Result = contct.certify(problem, [[0.0, 0.0]], closed=[[1]])
stiffness: Any = None
of_matrix: contct.Result = contct.certify(stiffness, [0.0], pairs=[(0, "below", 0.0, 1.0)], loads={0: -1.0}, supports=[1], labels=["u"])
right: bool = of_matrix.answer.certified
ss, smin, isep, text = contct.call("fortran", [0.0], [1.0], [0.5], [1], [1], [1])


def kernel(call: contct.Inputs) -> tuple[list[float], float, list[int]]:
    return [call.cc[i] - call.dd[dof] for i, dof in enumerate(call.dofs)], 1.0, call.isep


judgement: contct.Judgement = contct.judge(kernel, calls=1000, problems=1, seed=1)
verdict: tuple[bool, str, list[str]] = (judgement.equal, judgement.level, judgement.findings)
proofs: dict[str, str] = contct.prove("mine.so", symbol="my_kernel")
calls: int = contct.replay(result.trace, kernel="cpp").calls
try:
    contct.run(problem)
except contct.InputError as error:
    place: tuple[Optional[str], Optional[int], Optional[int]] = (error.file, error.line, error.column)
except contct.NotSolved as end:
    exit: int = end.exit
