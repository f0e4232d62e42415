"""Solver: one set-up for many solves."""
import numpy as np
import pytest
import scipy.sparse
from conftest import laplacian, membrane, optimality

import signorini


def elastic_square(side):
    """Springs along and across the edges of a grid that is held below: rotations have little energy."""
    nodes = side * side
    where = np.array([(i % side, i // side) for i in range(nodes)], dtype=float)
    index = np.arange(nodes).reshape(side, side)
    pairs = np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in (
        (index[:, :-1], index[:, 1:]), (index[:-1], index[1:]), (index[:-1, :-1], index[1:, 1:]),
        (index[:-1, 1:], index[1:, :-1]))])
    along = where[pairs[:, 1]] - where[pairs[:, 0]]
    along /= np.linalg.norm(along, axis=1)[:, None]
    springs = np.arange(len(pairs))
    D = scipy.sparse.coo_matrix((np.concatenate([-along[:, 0], -along[:, 1], along[:, 0], along[:, 1]]), (
        np.tile(springs, 4), np.concatenate([2 * pairs[:, 0], 2 * pairs[:, 0] + 1, 2 * pairs[:, 1],
                                             2 * pairs[:, 1] + 1]))), shape=(len(pairs), 2 * nodes)).tocsr()
    held = np.where(where[:, 1] == 0)[0]
    lower, upper = np.full(2 * nodes, -np.inf), np.full(2 * nodes, np.inf)
    for k in (0, 1):
        lower[2 * held + k] = upper[2 * held + k] = 0
    return (D.T @ D).tocsr(), where, (lower, upper)


def rigid_motions(where):
    motions = np.zeros((2 * len(where), 3))
    motions[0::2, 0] = motions[1::2, 1] = 1
    motions[0::2, 2], motions[1::2, 2] = -where[:, 1], where[:, 0]
    return motions


def test_one_set_up_serves_many_loads_and_bounds(problem):
    solver = signorini.Solver(problem.A)
    assert solver.shape == problem.A.shape
    for floor in (-0.01, -0.03, -0.06):
        result = solver.solve(problem.b, (floor, None))
        expected = signorini.solve_qp(problem.A, problem.b, (floor, None))
        np.testing.assert_array_equal(result.x, expected.x)


def test_a_start_near_the_solution_saves_cycles():
    problem = membrane(60)
    solver = signorini.Solver(problem.A)
    first = solver.solve(problem.b, (problem.lower, None))
    load = 1.0001 * problem.b
    warm = solver.solve(load, (problem.lower, None), x0=first.x)
    cold = solver.solve(load, (problem.lower, None))
    assert warm.nit < cold.nit
    np.testing.assert_allclose(warm.x, cold.x, atol=1e-8)


def test_another_matrix_takes_the_place_of_the_first(problem):
    solver = signorini.Solver(problem.A)
    other = problem.A + scipy.sparse.identity(900)
    solver.update(other)
    result = solver.solve(problem.b, (problem.lower, None), tol=1e-11)
    problem.A = other
    assert optimality(problem, result) < 1e-10
    with pytest.raises(ValueError, match=r"A: found shape \(64, 64\), expected \(900, 900\) as before"):
        solver.update(laplacian(8))
    with pytest.raises(ValueError, match="A: found nan in row 0"):
        solver.update(other * np.nan)
    np.testing.assert_array_equal(solver.solve(problem.b, (problem.lower, None), tol=1e-11).x, result.x)


def test_coordinates_are_the_rigid_motions_and_save_cycles():
    A, where, bounds = elastic_square(40)
    b = np.tile([1e-3, -1e-3], len(where))
    plain = signorini.solve_qp(A, b, bounds, block=2)
    turning = signorini.Solver(A, coordinates=where).solve(b, bounds)
    assert turning.nit < plain.nit
    same = signorini.Solver(A, block=2, near_null_space=rigid_motions(where)).solve(b, bounds)
    assert same.nit == turning.nit
    for result in (plain, turning, same):
        np.testing.assert_allclose(A @ result.x - b, np.where(result.active_mask != 0, result.multiplier, 0), atol=1e-6)


def test_interpolations_of_another_code_make_the_levels():
    size = 63
    A = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(size, size)).tocsr()
    coarse, fine = [], size
    while fine > 3:
        P = np.zeros((fine, fine // 2))
        for i in range(fine // 2):
            P[2 * i, i] = P[2 * i + 2, i] = 0.5
            P[2 * i + 1, i] = 1
        coarse.insert(0, scipy.sparse.csc_matrix(P))
        fine //= 2
    matrices, finer = [], A
    for P in reversed(coarse):
        finer = (P.T @ finer @ P).tocsr()
        matrices.insert(0, finer)
    b = np.full(size, -1e-3)
    expected = signorini.solve_qp(A, b, (-0.1, None), tol=1e-12)
    for arguments in ({}, {"coarse_matrices": matrices}):
        result = signorini.Solver(A, interpolations=coarse, **arguments).solve(b, (-0.1, None), tol=1e-12)
        assert result.levels == len(coarse) + 1
        np.testing.assert_allclose(result.x, expected.x, atol=1e-11)


@pytest.mark.parametrize("triangle", [scipy.sparse.tril, scipy.sparse.triu])
def test_one_triangle_stands_for_the_matrix(problem, triangle):
    result = signorini.solve_qp(triangle(problem.A), problem.b, (-0.03, None), one_triangle=True)
    np.testing.assert_allclose(result.x, signorini.solve_qp(problem.A, problem.b, (-0.03, None)).x, atol=1e-12)


def test_many_solves_leave_nothing_behind():
    import gc
    import resource
    import tracemalloc

    problem = membrane(6)

    def solve(times):
        for _ in range(times):
            signorini.solve_qp(problem.A, problem.b, (problem.lower, None), callback=lambda _: None)

    def resident():  # kilobytes, at most up to now
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    solve(100)
    before = resident()
    solve(1000)
    assert resident() - before < 2000  # the library's copy of the matrix, kept each time, would be 2600
    tracemalloc.start()
    solve(1)
    before = tracemalloc.get_traced_memory()[0]
    solve(200)
    gc.collect()
    grown = tracemalloc.get_traced_memory()[0] - before
    tracemalloc.stop()
    assert grown < 20_000  # bytes: a vector kept each time would be 57 600
