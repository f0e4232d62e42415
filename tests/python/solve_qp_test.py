"""solve_qp(): solutions, kinds of matrices, and what is wrong with arguments."""
import subprocess

import numpy as np
import pytest
import scipy.io
import scipy.optimize
import scipy.sparse
from conftest import laplacian, membrane, optimality

import signorini
from signorini._rows import square_rows


def test_a_solution_meets_the_conditions_that_define_it(problem):
    result = signorini.solve_qp(problem.A, problem.b, (problem.lower, None), tol=1e-12)
    assert isinstance(result, scipy.optimize.OptimizeResult)
    assert result.success and result.status == 0 and "at most" in result.message
    assert optimality(problem, result) < 1e-11
    slope = problem.A @ result.x - problem.b
    at_floor = result.x == problem.lower
    assert 0 < at_floor.sum() < len(result.x)
    np.testing.assert_array_equal(result.active_mask, np.where(at_floor, -1, 0))
    np.testing.assert_allclose(result.multiplier, np.where(at_floor, slope, 0), atol=1e-15)
    assert result.fun == pytest.approx(result.x @ (problem.A @ result.x) / 2 - problem.b @ result.x, rel=1e-12)


def test_a_random_dense_problem_has_the_solution_of_lsq_linear():
    random = np.random.default_rng(3)
    G, c = random.normal(size=(30, 20)), random.normal(size=30)
    bounds = (-0.1, 0.05)
    expected = scipy.optimize.lsq_linear(G, c, bounds, method="bvls", tol=1e-14)
    result = signorini.solve_qp(G.T @ G, G.T @ c, bounds, tol=1e-13)
    np.testing.assert_allclose(result.x, expected.x, atol=1e-12)
    np.testing.assert_array_equal(result.active_mask, expected.active_mask)


def test_results_are_those_of_the_program_to_the_last_bit(problem, program, tmp_path):
    for name, values in (("A", problem.A), ("b", problem.b[:, None]), ("l", problem.lower[:, None])):
        scipy.io.mmwrite(tmp_path / f"{name}.mtx", values, precision=17, symmetry="general")
    subprocess.run([program, "qp", "A.mtx", "b.mtx", "--lower", "l.mtx", "--out", "x.mtx"], cwd=tmp_path, check=True,
                   stdout=subprocess.DEVNULL)
    result = signorini.solve_qp(problem.A, problem.b, (problem.lower, None))
    np.testing.assert_array_equal(result.x, scipy.io.mmread(tmp_path / "x.mtx")[:, 0])


def with_duplicates(A):
    """Each entry in two halves, in another order."""
    A = A.tocoo()
    order = np.random.default_rng(1).permutation(2 * A.nnz)
    row, column, value = np.tile(A.row, 2), np.tile(A.col, 2), np.tile(A.data / 2, 2)
    return scipy.sparse.coo_matrix((value[order], (row[order], column[order])), shape=A.shape)


def with_duplicates_in_rows(A):
    twice = scipy.sparse.csr_matrix(A)
    halves, columns = np.repeat(twice.data / 2, 2), np.repeat(twice.indices, 2)
    return scipy.sparse.csr_matrix((halves, columns, 2 * twice.indptr), A.shape)


def with_long_indices(A):
    A = scipy.sparse.csr_matrix(A)
    A.indices, A.indptr = A.indices.astype(np.int64), A.indptr.astype(np.int64)
    return A


def backwards(A):
    """Rows whose columns descend."""
    reverse = scipy.sparse.csr_matrix(A)
    for begin, end in zip(reverse.indptr[:-1], reverse.indptr[1:]):
        reverse.indices[begin:end] = reverse.indices[begin:end][::-1].copy()
        reverse.data[begin:end] = reverse.data[begin:end][::-1].copy()
    reverse.has_sorted_indices = reverse.has_canonical_format = False
    return reverse


@pytest.mark.parametrize("kind", [
    scipy.sparse.csc_matrix, scipy.sparse.coo_matrix, scipy.sparse.csr_array, scipy.sparse.lil_matrix,
    scipy.sparse.dia_matrix, scipy.sparse.bsr_matrix, scipy.sparse.dok_matrix, with_duplicates, with_duplicates_in_rows,
    with_long_indices, backwards, lambda A: A.astype(np.float32), lambda A: A.astype(np.int8), lambda A: A.toarray(),
    lambda A: np.asfortranarray(A.toarray()), lambda A: A.todense(), lambda A: A.toarray().tolist()])
def test_every_kind_of_matrix_gives_the_same(kind):
    problem = membrane(8)
    expected = signorini.solve_qp(problem.A, problem.b, (problem.lower, None))
    given = kind(problem.A.copy())
    result = signorini.solve_qp(given, problem.b, (problem.lower, None))
    np.testing.assert_array_equal(result.x, expected.x)
    np.testing.assert_array_equal(result.multiplier, expected.multiplier)


def test_nothing_is_copied_that_fits_and_nothing_changed_that_is_given():
    A = laplacian(8)
    found = square_rows(A, "A")
    assert np.shares_memory(found.value, A.data) and np.shares_memory(found.column, A.indices)
    csc = A.tocsc()
    assert np.shares_memory(square_rows(csc, "A").value, csc.data)
    twice = with_duplicates_in_rows(A)
    before = twice.data.copy(), twice.indices.copy(), twice.indptr.copy()
    signorini.solve_qp(twice, np.ones(64))
    for old, now in zip(before, (twice.data, twice.indices, twice.indptr)):
        np.testing.assert_array_equal(old, now)


def test_bounds_are_given_in_several_ways(problem):
    expected = signorini.solve_qp(problem.A, problem.b, (problem.lower, None)).x
    size = len(expected)
    for bounds in ((-0.03, None), (-0.03, np.inf), [problem.lower.tolist(), np.full(size, np.inf)],
                   scipy.optimize.Bounds(-0.03, np.inf), scipy.optimize.Bounds(problem.lower, np.full(size, np.inf))):
        np.testing.assert_array_equal(signorini.solve_qp(problem.A, problem.b, bounds).x, expected)
    free = signorini.solve_qp(problem.A, problem.b)
    assert not free.active_mask.any() and free.x.min() < -0.03
    upper = signorini.solve_qp(problem.A, -problem.b, (None, 0.03))
    np.testing.assert_allclose(upper.x, -expected, atol=1e-9)
    assert upper.active_mask.max() == 1 and upper.multiplier.min() < 0


def test_options_are_those_of_the_solver(problem):
    result = signorini.solve_qp(problem.A, problem.b, (-0.03, None), method="tnnmg", reassemble=False, relaxation=1,
                                pre=3)
    assert result.success
    np.testing.assert_allclose(result.x, signorini.solve_qp(problem.A, problem.b, (-0.03, None)).x, atol=1e-9)


@pytest.mark.parametrize("change, message", [
    ({"A": np.ones(4)}, "A: found an array of 1 dimensions, expected a square matrix"),
    ({"A": np.ones((4, 3))}, r"A: found shape \(4, 3\), expected a square matrix"),
    ({"A": np.zeros((0, 0))}, "expected a square matrix of one row at least"),
    ({"A": np.eye(4) * 1j}, "A: found complex numbers"),
    ({"A": scipy.sparse.identity(4) * 1j}, "A: found entries of type complex128"),
    ({"A": "matrix"}, "A: found values of type <U6"),
    ({"A": [[1, 2], [3]]}, "A: is no array of numbers"),
    ({"A": [[2, None], [None, 2]]}, r"A: found nan in row 0, column 1 \(from 0\)"),
    ({"A": scipy.sparse.linalg.aslinearoperator(np.eye(4))}, "A: is no array of numbers"),
    ({"A": [[2, 1, 0, 0], [0, 2, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}, "not symmetric.*counted from 1"),
    ({"A": -np.eye(4)}, "row 1"),
    ({"b": np.ones(3)}, r"b: found shape \(3,\), expected \(4,\): one number per row of A"),
    ({"b": np.ones((4, 1))}, r"b: found shape \(4, 1\), expected \(4,\)"),
    ({"b": [0, 1, np.nan, 0]}, "b: found nan at index 2, expected finite numbers"),
    ({"b": [0, 1, np.inf, 0]}, "b: found inf at index 2"),
    ({"b": 1.0}, r"b: found shape \(\), expected"),
    ({"b": ["a", "b", "c", "d"]}, "b: found values of type <U1"),
    ({"bounds": 3}, "bounds: expected a pair"),
    ({"bounds": [(0, 1)] * 4}, "bounds: expected a pair"),
    ({"bounds": (np.ones(3), None)}, r"bounds\[0\]: found shape \(3,\), expected a number, or shape \(4,\)"),
    ({"bounds": (None, [1, 1, 1, np.nan])}, r"bounds\[1\]: found nan at index 3, expected numbers, -inf or inf"),
    ({"bounds": (np.nan, None)}, r"bounds\[0\]: found nan"),
    ({"x0": np.ones(5)}, r"x0: found shape \(5,\)"),
    ({"x0": [np.inf, 0, 0, 0]}, "x0: found inf at index 0"),
    ({"tol": 0}, r"tol: found 0, expected a number in \(0, 1\)"),
    ({"tol": np.nan}, "tol: found nan"),
    ({"callback": 7}, "callback: found 7, expected a function"),
    ({"tolerance": 1e-3}, "tolerance: is given to solve, as tol"),
    ({"metod": "tnnmg"}, "solver.metod.*method"),
    ({"method": "magic"}, "magic"),
    ({"block": 4}, "block: found 4"),
    ({"coordinates": np.ones((4, 1))}, r"coordinates: found shape \(4, 1\)"),
    ({"coordinates": [[0, 0], [1, np.nan]]}, r"coordinates: found nan at index \(1, 1\)"),
    ({"near_null_space": np.ones((3, 2))}, r"near_null_space: found shape \(3, 2\), expected 4 rows"),
    ({"near_null_space": np.ones(4), "coordinates": np.ones((2, 2))}, "near_null_space: given with coordinates"),
    ({"interpolations": [np.ones((3, 1))]}, "interpolation 1 of 1"),
    ({"coarse_matrices": [np.eye(1)]}, "coarse_matrices: given without interpolations"),
])
def test_what_is_wrong_is_named(change, message):
    arguments = {"A": np.eye(4), "b": np.ones(4)} | change
    with pytest.raises(ValueError, match=message):
        signorini.solve_qp(**arguments)


def test_rows_that_were_broken_in_place_are_refused():
    for name, value in (("indices", 4), ("indices", -1), ("indptr", 100), ("indptr", -1)):
        A = scipy.sparse.csr_matrix(np.eye(4))
        getattr(A, name)[-1] = value
        with pytest.raises(ValueError, match="A: "):
            square_rows(A, "A")


def test_problems_without_solution_say_why(problem):
    with pytest.raises(signorini.Infeasible, match="infeasible bounds"):
        signorini.solve_qp(problem.A, problem.b, (1.0, -1.0))
    with pytest.raises(signorini.Infeasible):
        signorini.solve_qp(problem.A, problem.b, (np.inf, None))
    graph = np.array([[1.0, -1.0], [-1.0, 1.0]])
    with pytest.raises(signorini.Unbounded, match="unbounded below"):
        signorini.solve_qp(graph, [1.0, 1.0])
    with pytest.raises(signorini.Unbounded):
        signorini.solve_qp(np.diag([1.0, 0.0]), [0.0, 1.0])
    assert issubclass(signorini.Infeasible, signorini.NoSolution)
    assert issubclass(signorini.Unbounded, signorini.NoSolution)


def test_the_last_iterate_comes_with_the_error(problem):
    with pytest.raises(signorini.NotConverged, match="iteration limit 1") as raised:
        signorini.solve_qp(problem.A, problem.b, (-0.03, None), max_iterations=1)
    result = raised.value.result
    assert not result.success and result.status == 3 and result.nit == 1
    assert result.x.shape == problem.b.shape and result.algebraic_error > 1e-8
