"""What the callback is told, how it ends a solve, and how Ctrl-C does."""
import signal
import threading
import time

import numpy as np
import pytest
from conftest import membrane

import signorini


def test_the_callback_sees_the_history(problem):
    seen = []
    result = signorini.solve_qp(problem.A, problem.b, (problem.lower, None), callback=seen.append)
    assert [cycle.nit for cycle in seen] == list(range(1, result.nit + 1))
    assert [cycle.nit for cycle in seen] == result.history["iteration"].tolist()
    assert [cycle.residual for cycle in seen] == result.history["residual"].tolist()
    assert np.all(np.diff(result.history["energy"]) <= 1e-14 * abs(result.fun))  # it falls in every cycle
    assert result.history["energy"][-1] == pytest.approx(result.fun)
    assert result.history["algebraic_error"][-1] <= 1e-8
    assert result.history["contact"][-1] == np.count_nonzero(result.active_mask)


def stop_by_true(cycle):
    return cycle.nit == 2


def stop_by_exception(cycle):
    if cycle.nit == 2:
        raise StopIteration


@pytest.mark.parametrize("stop", [stop_by_true, stop_by_exception])
def test_the_callback_ends_the_solve(problem, stop):
    result = signorini.solve_qp(problem.A, problem.b, (problem.lower, None), callback=stop)
    assert not result.success and result.status == 130 and result.nit == 2
    assert result.x.min() < 0


def test_what_the_callback_raises_is_raised(problem):
    solver = signorini.Solver(problem.A)

    def fail(_):
        raise KeyError("mine")

    def solve_again(_):
        solver.solve(problem.b)

    with pytest.raises(KeyError, match="mine"):
        solver.solve(problem.b, callback=fail)
    with pytest.raises(RuntimeError, match="its callback cannot use it"):
        solver.solve(problem.b, callback=solve_again)
    assert solver.solve(problem.b).success  # as if nothing had been


def test_interrupts_end_the_solve_within_a_cycle(problem):
    before = signal.getsignal(signal.SIGINT)
    seen = []

    def interrupt(cycle):
        seen.append(cycle.nit)
        signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        signorini.solve_qp(problem.A, problem.b, (problem.lower, None), callback=interrupt)
    assert seen == [1]
    assert signal.getsignal(signal.SIGINT) is before
    assert signorini.solve_qp(problem.A, problem.b, (problem.lower, None)).success


def test_interrupts_are_heard_without_a_callback():
    problem = membrane(100)
    solver = signorini.Solver(problem.A, method="pgs", max_iterations=1_000_000)
    main = threading.get_ident()
    solving = threading.Event()

    def interrupt():
        solving.wait()
        while solver._owner is None:
            time.sleep(0)
        time.sleep(0.02)
        signal.pthread_kill(main, signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        solving.set()
        solver.solve(problem.b, (problem.lower, None), tol=1e-13)  # would take some minutes
    thread.join()
