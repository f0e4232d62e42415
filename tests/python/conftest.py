"""Problems and places that the tests share. SIGNORINI_PROGRAM names the program."""
import os
import pathlib
from dataclasses import dataclass

import numpy as np
import pytest
import scipy.sparse

source = pathlib.Path(__file__).resolve().parents[2]


@dataclass
class Problem:
    A: scipy.sparse.csr_matrix
    b: np.ndarray
    lower: np.ndarray


def laplacian(side):
    """The five-point stencil on the inner nodes of a square grid."""
    line = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(side, side))
    one = scipy.sparse.identity(side)
    return (scipy.sparse.kron(line, one) + scipy.sparse.kron(one, line)).tocsr()


def membrane(side):
    """A load presses a membrane onto a floor."""
    return Problem(laplacian(side), np.full(side * side, -1.0 / side**2), np.full(side * side, -0.03))


def optimality(problem, result, upper=np.inf):
    """How far x is off the conditions of a solution, which know nothing of the solver."""
    slope = problem.A @ result.x - problem.b
    assert np.all(result.x >= problem.lower) and np.all(result.x <= upper)
    step = np.clip(result.x - slope / problem.A.diagonal(), problem.lower, upper) - result.x
    return np.max(np.abs(step)) / np.max(np.abs(result.x))


@pytest.fixture
def problem():
    return membrane(30)


@pytest.fixture(scope="session")
def scenes():
    return source / "apps" / "scenes"


@pytest.fixture(scope="session")
def program():
    return os.environ.get("SIGNORINI_PROGRAM", str(source / "build" / "release-assert" / "bin" / "signorini"))
