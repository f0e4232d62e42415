"""Solvers for a matrix and bounds on an obstacle problem: python3 python/bench.py [--side N] [--seconds T] [NAME...]

A load presses a membrane onto a floor, N x N unknowns (200 x 200). Errors are relative, in the norm of A, against
active sets with direct solves. Each solver's tolerance is tightened tenfold, from 1e-6, until the error is at most
1e-8; one that misses it shows the last solve that ended within T seconds in all. The second table is what Python adds to
the C library in space, on 65 x 65 x 65 unknowns. Tables are in Markdown.
"""
from __future__ import annotations

import argparse
import contextlib
import math
import os
import platform
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.optimize
import scipy.sparse
import scipy.sparse.linalg
from numpy.typing import NDArray

import signorini

Vector = NDArray[np.float64]
target = 1e-8


class TooSlow(Exception):
    """A solver is asked to end."""


@dataclass
class Problem:
    """min 1/2 x'Ax - b'x over x >= lower, where A = D'D and b = D'c."""

    A: Any
    D: Any
    b: Vector
    c: Vector
    lower: Vector
    solution: Vector
    deadline: float = math.inf

    def error(self, x: Vector) -> float:
        off = x - self.solution
        return math.sqrt(off @ (self.A @ off)) / math.sqrt(self.solution @ (self.A @ self.solution))

    def energy(self, x: Vector) -> float:
        return float(x @ (self.A @ x) / 2 - self.b @ x)

    def check_time(self, *_: object, **__: object) -> None:
        if time.perf_counter() > self.deadline:
            raise TooSlow


def membrane(side: int) -> Problem:
    """The five-point stencil; D takes differences along the edges of the grid."""
    line = scipy.sparse.diags([1.0, -1.0], [0, -1], shape=(side + 1, side))
    one = scipy.sparse.identity(side)
    D = scipy.sparse.vstack([scipy.sparse.kron(line, one), scipy.sparse.kron(one, line)]).tocsr()
    A = (D.T @ D).tocsr()
    n = side * side
    b, lower = np.full(n, -1.0 / n), np.full(n, -0.03)
    c = D @ scipy.sparse.linalg.spsolve(A.tocsc(), b)
    return Problem(A, D, b, c, lower, active_sets(A, b, lower))


def active_sets(A: Any, b: Vector, lower: Vector) -> Vector:
    """Each set by a direct solve, until it stays: exact but for rounding."""
    active = np.zeros(len(b), dtype=bool)
    for _ in range(200):
        free = np.where(~active)[0]
        x = lower.copy()
        x[free] = scipy.sparse.linalg.spsolve(A[free][:, free].tocsc(), b[free] - A[free][:, active] @ lower[active])
        new = (A @ x - b) - (x - lower) > 0
        if np.array_equal(new, active):
            return x
        active = new
    raise RuntimeError("the active sets do not come to rest")


Run = tuple[Vector, int]
Solve = Callable[[Problem, float], Run]


def with_signorini(problem: Problem, tolerance: float) -> Run:
    result = signorini.solve_qp(problem.A, problem.b, (problem.lower, None), tol=tolerance)
    return result.x, result.nit


def with_l_bfgs_b(problem: Problem, tolerance: float) -> Run:
    bounds = scipy.optimize.Bounds(problem.lower, np.full_like(problem.lower, np.inf))
    scale = 1 / abs(problem.energy(problem.solution))  # its criteria are absolute
    result = scipy.optimize.minimize(
        lambda x: (scale * problem.energy(x), scale * (problem.A @ x - problem.b)), np.zeros_like(problem.b), jac=True,
        method="L-BFGS-B", bounds=bounds, callback=problem.check_time,
        options={"ftol": 0, "gtol": tolerance, "maxiter": 10**7, "maxfun": 10**7, "maxcor": 20})
    return result.x, result.nit


def with_lsq_linear(problem: Problem, tolerance: float) -> Run:
    def product(x: Vector) -> Any:
        problem.check_time()
        return problem.D @ x

    D = scipy.sparse.linalg.LinearOperator(problem.D.shape, matvec=product, rmatvec=lambda y: problem.D.T @ y)
    result = scipy.optimize.lsq_linear(D, problem.c, (problem.lower, np.inf), tol=tolerance, lsmr_tol="auto",
                                      max_iter=10**5)
    return result.x, result.nit


def with_tao(kind: str) -> Solve:
    def solve(problem: Problem, tolerance: float) -> Run:
        from petsc4py import PETSc

        A = PETSc.Mat().createAIJ(problem.A.shape, csr=(problem.A.indptr, problem.A.indices, problem.A.data))
        b, lower = PETSc.Vec().createWithArray(problem.b), PETSc.Vec().createWithArray(problem.lower)
        upper = b.duplicate()
        upper.set(PETSc.INFINITY)
        work = b.duplicate()

        def energy_and_slope(_: Any, x: Any, slope: Any) -> float:
            problem.check_time()
            A.mult(x, work)
            energy: float = 0.5 * x.dot(work) - b.dot(x)
            slope.waxpy(-1, b, work)
            return energy

        tao = PETSc.TAO().create()
        tao.setType(kind)
        x = b.duplicate()
        x.set(0)
        tao.setObjectiveGradient(energy_and_slope, work.duplicate())
        tao.setHessian(lambda *_: None, A)
        tao.setVariableBounds(lower, upper)
        tao.setMaximumIterations(10**6)
        tao.setMaximumFunctionEvaluations(10**7)
        tao.setTolerances(gatol=tolerance * b.norm(), grtol=0, gttol=0)
        tao.getKSP().setTolerances(rtol=1e-3, max_it=10**5)
        tao.getKSP().getPC().setType("icc")
        tao.setFromOptions()
        tao.solve(x)
        return x.getArray().copy(), int(tao.getIterationNumber())

    return solve


def with_cvxopt(problem: Problem, tolerance: float) -> Run:
    import cvxopt
    import cvxopt.solvers

    A = problem.A.tocoo()
    n = len(problem.b)
    P = cvxopt.spmatrix(A.data.tolist(), A.row.tolist(), A.col.tolist(), (n, n))
    G = cvxopt.spmatrix(-1.0, range(n), range(n))
    options = {"show_progress": False, "abstol": 0, "reltol": tolerance, "feastol": tolerance, "maxiters": 200}
    result = cvxopt.solvers.qp(P, cvxopt.matrix(-problem.b), G, cvxopt.matrix(-problem.lower), options=options)
    return np.array(result["x"]).ravel(), int(result["iterations"])


solvers: dict[str, Solve] = {
    "signorini": with_signorini, "TAO tron": with_tao("tron"), "TAO bnls": with_tao("bnls"), "cvxopt": with_cvxopt,
    "L-BFGS-B": with_l_bfgs_b, "lsq_linear": with_lsq_linear}


@dataclass
class Row:
    seconds: float
    iterations: int
    error: float
    tolerance: float


def measure(problem: Problem, solve: Solve, seconds: float) -> Row | str:
    """The first tolerance, tightened tenfold each time, with which the error is small enough; else the last one."""
    last: Row | str = f"more than {seconds:g} s"
    problem.deadline = time.perf_counter() + seconds
    for exponent in range(6, 17):
        tolerance = 10.0**-exponent
        begin = time.perf_counter()
        try:
            x, iterations = solve(problem, tolerance)
        except TooSlow:
            return last
        except ImportError as error:
            return f"not there: {error}"
        except Exception as error:  # whatever a solver of others ends with stands in the table
            return f"{type(error).__name__}: {error}" if isinstance(last, str) else last
        last = Row(time.perf_counter() - begin, iterations, problem.error(x), tolerance)
        if last.error <= target or time.perf_counter() > problem.deadline:
            break
    return last


def best_of(problem: Problem, solve: Solve, row: Row) -> Row:
    """Times of short solves again, for what else the machine does."""
    for _ in range(4 if row.seconds < 2 else 0):
        begin = time.perf_counter()
        solve(problem, row.tolerance)
        row.seconds = min(row.seconds, time.perf_counter() - begin)
    return row


@contextlib.contextmanager
def timed_library(seconds: list[float]) -> Iterator[None]:
    """Adds to `seconds` what each call of the C library takes."""
    library = signorini._library.library()
    names = ("signorini_create_with", "signorini_solve", "signorini_active", "signorini_history", "signorini_destroy")
    kept = {name: getattr(library, name) for name in names}

    def timed(function: Any) -> Any:
        def call(*arguments: Any) -> Any:
            begin = time.perf_counter()
            status = function(*arguments)
            seconds.append(time.perf_counter() - begin)
            return status

        return call

    for name in names:
        setattr(library, name, timed(kept[name]))
    try:
        yield
    finally:
        for name in names:
            setattr(library, name, kept[name])


def print_overhead(side: int) -> None:
    line = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(side, side))
    A = scipy.sparse.kronsum(scipy.sparse.kronsum(line, line), line).tocsr()
    n = side**3
    b = np.full(n, -1.0 / side**2)
    print("\n## What Python adds\n")
    print("| unknowns | cycles | seconds | of these in the library | what Python adds |\n| --- | --- | --- | --- | --- |")
    best = (math.inf, 0.0, 0)
    for _ in range(3):
        inside: list[float] = []
        with timed_library(inside):
            begin = time.perf_counter()
            result = signorini.solve_qp(A, b, (-0.03, None))
            best = min(best, (time.perf_counter() - begin, sum(inside), result.nit))
    total, library, cycles = best
    print(f"| {n} | {cycles} | {total:.3g} | {library:.3g} | {100 * (total / library - 1):.2g} % |")


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--side", type=int, default=200)
    arguments.add_argument("--seconds", type=float, default=100)
    arguments.add_argument("--overhead-side", type=int, default=65)
    arguments.add_argument("names", nargs="*", default=list(solvers), metavar="NAME")
    given = arguments.parse_args()
    problem = membrane(given.side)
    n, on_floor = len(problem.b), int(np.count_nonzero(problem.solution == problem.lower))
    print("## Beside others\n")
    print(f"{n} unknowns, {on_floor} of them on the floor; {os.cpu_count()} processors, "
          f"Python {platform.python_version()}, NumPy {np.__version__}, SciPy {scipy.__version__}\n")
    print("| solver | its tolerance | iterations | error | seconds | times signorini |\n| --- | --- | --- | --- | --- | --- |")
    base = math.nan
    for name in given.names:
        row = measure(problem, solvers[name], given.seconds)
        if isinstance(row, str):
            print(f"| {name} | | | | {row} | |", flush=True)
            continue
        problem.deadline = math.inf
        row = best_of(problem, solvers[name], row)
        base = row.seconds if name == "signorini" else base
        missed = "" if row.error <= target else " (missed)"
        print(f"| {name} | {row.tolerance:.0e} | {row.iterations} | {row.error:.1e}{missed} | {row.seconds:.3g} | "
              f"{row.seconds / base:.3g} |", flush=True)
    if "signorini" in given.names:
        print_overhead(given.overhead_side)


if __name__ == "__main__":
    main()
