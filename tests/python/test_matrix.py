"""Tests contct.certify: proofs about another program's displacements of a structure with a matrix in memory."""
import pickle

import contct
import pytest
from conftest import refusal


class Coo:
    """A sparse matrix as SciPy's `tocoo` returns it, without SciPy."""

    def __init__(self, size, entries, columns=None):
        self.shape = (size, columns or size)
        self.row, self.col, self.data = (Column(part) for part in zip(*entries))

    def tocoo(self):
        return self


class Column(list):
    def tolist(self):
        return list(self)


# A chain of three springs of 1000 from a wall, with entries of both triangles, one of them in two parts. A stop of 1000
# is 0.002 below its end. Under a load of 3, 1000 / 3 u + 1000 (u + 0.002) = -3 gives u = -0.00375, and the stop presses
# with 1.75. Without the stop the end is at -0.009.
CHAIN = Coo(3, [(0, 0, 1500.0), (0, 0, 500.0), (0, 1, -1000.0), (1, 0, -1000.0), (1, 1, 2000.0), (1, 2, -1000.0),
                (2, 1, -1000.0), (2, 2, 1000.0)])
FREE = Coo(3, [*zip(CHAIN.row, CHAIN.col, CHAIN.data)][1:] + [(0, 0, 500.0)])  # the chain without its wall
STOP = [(2, "below", -0.002, 1000.0)]
LOADS = [0.0, 0.0, -3.0]
RIGHT = [-0.00125, -0.0025, -0.00375]


def certified(state=RIGHT, matrix=CHAIN, **changed):
    return contct.certify(matrix, state, **{"pairs": STOP, "loads": LOADS, **changed})


def test_contct_certify_certifies_the_right_state_of_a_matrix():
    found = certified()
    assert found.certified and found.exit == 0 and found.messages == []
    assert found.steps[0].error.w < 1e-15
    assert found.steps[0].pairs[0].state == "contact" and found.steps[0].pairs[0].force == pytest.approx(1.75, rel=1e-12)


def test_a_state_beyond_its_stop_is_not_certified_and_contct_certify_gives_the_right_state():
    found = certified([-0.003, -0.006, -0.009], closed=[])
    assert not found.certified and found.exit == 3
    assert found.steps[0].certificate.penetration == pytest.approx(0.007 / 0.009, rel=1e-9)
    assert found.steps[0].error.w >= 0.00525  # the error of the free end
    assert found.answer.certified and list(found.answer.steps[0].displacement) == pytest.approx(RIGHT, rel=1e-12)


def test_if_a_given_state_has_a_pulling_pair_the_message_names_this_pair():
    found = certified([0.00025, 0.0005, 0.00075], loads=[0.0, 0.0, 3.0], closed=[1])  # 1000 / 3 u + 1000 (u + 0.002) = 3
    assert not found.certified and "pair 1 (dof 2, below) pulls with 2.75" in found.messages[0]
    assert found.answer.steps[0].displacement[2] == pytest.approx(0.009, rel=1e-12)


def test_the_error_bound_of_a_given_state_is_at_most_ten_times_the_error():
    found = certified([u * (1 + 1e-9) for u in RIGHT])
    assert found.certified and 3.75e-12 <= found.steps[0].error.w <= 3.75e-11


def test_dofs_of_a_matrix_are_rows_counted_from_0_or_labels_and_its_supports_are_fixed_dofs_or_springs():
    by_label = certified(pairs=[("c", "below", -0.002, 1000.0)], loads={"c": -3.0}, labels=["a", "b", "c"])
    assert by_label.certified and by_label.steps[0].pairs[0].dof == "c"
    assert certified(loads={2: -3.0}).certified
    assert certified(matrix=FREE, supports={0: 1000.0}).certified
    u = -5 / 1500  # fixed: 500 u + 1000 (u + 0.002) = -3
    assert certified([0.0, u / 2, u], FREE, supports=[0]).certified


@pytest.mark.parametrize("wrong, words", [
    ({"pairs": [(3, "below", 0.0, 1.0)]}, "pair 1: found dof 3; allowed: a row of the matrix, from 0 to 2, or a label"),
    ({"pairs": [(2, "below", 0.0)]}, "pairs: found (2, 'below', 0.0) as pair 1; allowed: (dof, surface, face, stiffness)"),
    ({"pairs": ["abcd"]}, "pairs: found 'abcd' as pair 1"),
    ({"pairs": (2, "below", 0.0, 1.0)}, "pairs: found 2 as pair 1"),
    ({"pairs": [(0.5, "below", 0.0, 1.0)]}, "pair 1: found dof 0.5; allowed: a row of the matrix"),
    ({"loads": [[0.0], [0.0], [-3.0]]}, "allowed: 3 numbers, one for each dof, or a dict of numbers"),
    ({"pairs": [(2, "beside", 0.0, 1.0)]}, 'contact[1].surface: found "beside"; allowed: "below" or "above"'),
    ({"pairs": [("x", "below", 0.0, 1.0)]}, 'contact[1].dof: found "x"'),
    ({"loads": [1.0]}, "loads: found 1 number; allowed: 3, one for each dof, or a dict"),
    ({"loads": None}, "loads: found 0 numbers; allowed: 3"),
    ({"labels": ["a"]}, "labels: found 1 label; allowed: 3, one for each dof"),
    ({"supports": [-1]}, "supports: found dof -1"),
    ({"closed": [2]}, "closed: found 2; allowed: pairs from 1 to 1"),
])
def test_wrong_pairs_loads_labels_or_supports_of_a_matrix_are_refused(wrong, words):
    assert words in str(refusal(RIGHT, certified, **wrong))


@pytest.mark.parametrize("matrix, words", [
    (Coo(2, [(0, 0, 1.0), (1, 0, -1.0), (1, 1, 1.0)]), "matrix: found -1.0 in row 1, column 0, but 0.0 in row 0, column 1; allowed: a symm"),
    (Coo(2, [(0, 0, float("nan")), (1, 1, 1.0)]), "allowed: a symmetric matrix of finite numbers"),
    (Coo(2, [(0, 0, 1.0)], columns=3), "matrix: found 2 rows and 3 columns; allowed: a square matrix"),
    (Coo(2, [(0, 0, -1.0), (1, 1, 1.0)]), "a stiffness matrix is positive semidefinite"),
])
def test_a_matrix_that_is_not_a_stiffness_matrix_is_refused(matrix, words):
    refused = str(refusal([0.0, 0.0], certified, matrix=matrix, pairs=[(0, "below", 0.0, 1.0)], loads=[0.0, -1.0]))
    assert words in refused and "/" not in refused


def test_a_matrix_inside_a_problem_is_refused_and_the_function_that_writes_the_file_is_named():
    for problem in {"matrix": {"stiffness": CHAIN}}, {"matrix": CHAIN}:
        with pytest.raises((contct.InputError, TypeError), match="found a matrix; allowed: .*scipy.io.mmwrite"):
            contct.run(problem)


def test_contct_certify_takes_the_number_of_rigid_body_motions_that_rounded_entries_hide():
    third = 0.33333  # the matrix is slightly indefinite
    rod = Coo(3, [(i, j, 0.66665 if i == j else -third) for i in range(3) for j in range(3)])
    assert "1 motion is nearly free: set free_motions = 1" in str(refusal([-0.005] * 3, certified, matrix=rod))
    found = certified([-0.005] * 3, rod, free_motions=1)
    assert found.answer.certified and found.answer.steps[0].pairs[0].force == pytest.approx(3.0, rel=1e-4)


def test_contct_certify_of_a_problem_also_gives_the_right_state_and_refuses_loads_of_a_matrix(beam):
    found = contct.certify(beam, [0.0] * 6)
    assert found.answer.certified and found.answer.steps[0].w[2] == pytest.approx(-10 * 8 / 3e4, rel=1e-12)
    with pytest.raises(contct.InputError, match="contct.certify"):
        contct.run(beam).answer
    with pytest.raises(contct.InputError, match="with a problem, which has its own"):
        contct.certify(beam, [0.0] * 6, loads=[0.0] * 6)


def test_contct_run_solves_a_matrix_in_memory_with_pairs_as_tuples_or_dicts():
    for pairs in (STOP, [{"dof": 2, "surface": "below", "face": -0.002, "stiffness": 1000.0}]):
        found = contct.run(CHAIN, pairs=pairs, loads=LOADS)
        assert found.certified and list(found.steps[0].displacement) == pytest.approx(RIGHT, rel=1e-12)
        assert [len(i.events) for i in found.steps[0].increments] == [1, 0]
    assert pickle.loads(pickle.dumps(found)) == found
    assert found.log.count("MAKING CONTACT") == 1  # the run is repeated, so the files must still exist
    assert contct.run(CHAIN, loads={"c": -3.0}, labels=["a", "b", "c"]).steps[0].w[2] == pytest.approx(-0.009, rel=1e-12)


ROWS = [[2000.0, -1000.0, 0.0], [-1000.0, 2000.0, -1000.0], [0.0, -1000.0, 1000.0]]


def test_a_list_of_rows_is_a_matrix():
    assert list(contct.run(ROWS, pairs=STOP, loads=LOADS).steps[0].displacement) == pytest.approx(RIGHT, rel=1e-12)
    for wrong in (ROWS[:2], [ROWS[0], ROWS[1], ROWS[2][:2]]):
        assert "allowed: a square matrix" in str(refusal(wrong, contct.run, pairs=STOP, loads=LOADS))


def test_a_square_array_is_a_matrix():
    numpy = pytest.importorskip("numpy")
    assert list(contct.run(numpy.array(ROWS), pairs=STOP, loads=LOADS).steps[0].displacement) == pytest.approx(RIGHT, rel=1e-12)


@pytest.mark.parametrize("changed, words", [
    ({"pairs": [{"surface": "below"}]}, "pairs: found pair 1 without dof"), ({"pairs": [(0, "below")]}, "pairs: found (0, 'below') as pair 1"),
    ({"pairs": [(7, "below", 0.0, 1.0)]}, "pair 1: found dof 7"), ({"pairs": [{"dof": 2, "surface": "below", "face": 0.0}]}, "stiffness"),
    ({"loads": [1.0]}, "loads: found 1 number")])
def test_errors_of_a_matrix_name_the_argument(changed, words):
    error = refusal(CHAIN, contct.run, **{"pairs": STOP, "loads": LOADS, **changed})
    assert words in str(error) and "/" not in str(error.file)


def test_a_problem_has_no_arguments_of_a_matrix():
    assert "allowed: these only with a matrix" in str(refusal({"beam": {}}, contct.run, loads=[1.0]))
