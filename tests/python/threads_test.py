"""Other threads of Python run while the library works."""
import sys
import threading
import time

import numpy as np
import pytest
from conftest import membrane

import signorini


@pytest.fixture
def no_turns():
    """A thread gives the interpreter to others only where it waits, or in C."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(100)
    yield
    sys.setswitchinterval(before)


def test_a_thread_counts_while_another_solves(no_turns):
    problem = membrane(100)
    solver = signorini.Solver(problem.A)
    count, end = 0, threading.Event()

    def counting():
        nonlocal count
        while not end.is_set():
            count += 1
            time.sleep(0)

    thread = threading.Thread(target=counting)
    thread.start()
    cycles = counted = 0
    for _ in range(100):  # on a machine that is busy
        before = count
        cycles += solver.solve(problem.b, (problem.lower, None), tol=1e-12).nit
        counted += count - before
        if counted > 2 * cycles:  # were it only at the callbacks, it could be no more than once for each
            break
    end.set()
    thread.join()
    assert counted > 2 * cycles


def test_two_threads_are_within_two_problems_at_once(no_turns):
    """Each waits in its callback until the other one is in its own: one after the other they never would."""
    together = threading.Barrier(2, timeout=20)
    problems, results = [membrane(30), membrane(40)], [None, None]

    def solve(k):
        def meet(cycle):
            if cycle.nit == 1:
                together.wait()

        results[k] = signorini.solve_qp(problems[k].A, problems[k].b, (-0.03, None), callback=meet)

    threads = [threading.Thread(target=solve, args=(k,)) for k in (0, 1)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for problem, result in zip(problems, results):
        np.testing.assert_array_equal(result.x, signorini.solve_qp(problem.A, problem.b, (-0.03, None)).x)


def test_threads_take_turns_with_one_solver(problem):
    solver = signorini.Solver(problem.A)
    floors = [-0.01, -0.02, -0.03, -0.04]
    results = [None] * len(floors)

    def solve(k):
        results[k] = solver.solve(problem.b, (floors[k], None))

    threads = [threading.Thread(target=solve, args=(k,)) for k in range(len(floors))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for floor, result in zip(floors, results):
        assert result.x.min() == floor
        np.testing.assert_allclose(result.x, signorini.solve_qp(problem.A, problem.b, (floor, None)).x, atol=1e-9)
