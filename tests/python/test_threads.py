"""Functions may be called from several threads at once, and every answer is right."""
from concurrent.futures import ThreadPoolExecutor

import contct
from conftest import PROBLEMS

NAMES = ("pb01-cantilever-tip-stop", "pb07-three-gap-supports", "pb06-settled-middle-support", "divergences/near-tie")


def tasks():
    for name in NAMES:
        path = PROBLEMS / f"{name}.toml"
        yield lambda path=path: contct.run(path).to_dict()
        yield lambda path=path: contct.run(path, kernels="corrected").to_dict()
        yield lambda path=path: contct.run(path).log
        yield lambda path=path: contct.exact(path).to_dict()
        yield lambda path=path: contct.check(path).to_dict()
        yield lambda path=path: contct.explain(path).to_dict()
    yield lambda: contct.call("fortran", [0, 0], [2, 1], [0.5, 0.75], [1, 2], [1, 1], [1, 1]).text
    yield lambda: contct.call("fortran", [0, 9, 0], [1, 0, 2], [0.5, 0.75], [1, 2], [1, 1], [1, 1], 1, 2).text


def test_eight_threads_get_the_answers_of_one():
    work = list(tasks())
    expected = [task() for task in work]
    rounds = 12
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda i: work[i % len(work)](), range(rounds * len(work))))
    assert len(found) >= 300
    assert found == expected * rounds


def test_a_judgement_and_runs_at_once(beam):
    from test_kernels import listing
    expected = contct.run(beam)
    with ThreadPoolExecutor(3) as pool:
        judged = [pool.submit(contct.judge, listing, calls=1000, problems=1) for _ in range(2)]
        runs = [pool.submit(contct.run, beam) for _ in range(20)]
        assert all(j.result().equal for j in judged) and all(r.result() == expected for r in runs)
