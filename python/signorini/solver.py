"""min 1/2 x'Ax - b'x over lower <= x <= upper for a sparse symmetric positive (semi)definite matrix A."""
from __future__ import annotations

import ctypes
import re
import threading
import weakref
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import OptimizeResult

from . import _library
from ._arrays import FloatArray, bounds_pair, columns, vector
from ._library import RowsStruct, Setup, Summary, library
from ._monitor import Callback, KeptInterrupt, Monitor
from ._rows import Rows, rows, square_rows
from .errors import Infeasible, NotConverged, Unbounded
from .obstacles import Handed, Obstacle

_cycle_type = np.dtype([(name, of) for name, of in (
    ("iteration", np.int32), ("finest", np.int32), ("contact", np.int32), ("changed", np.int32),
    ("residual", np.float64), ("algebraic_error", np.float64), ("energy", np.float64))])


def solve_qp(A: Any, b: npt.ArrayLike, bounds: Any = None, x0: npt.ArrayLike | None = None, tol: float = 1e-8,
             callback: Callback | None = None, **options: Any) -> OptimizeResult:
    """The minimiser of 1/2 x'Ax - b'x over lower <= x <= upper.

    A: symmetric positive (semi)definite; any sparse matrix or array of SciPy, or a dense one.
    bounds: (lower, upper), either of which may be None, a number or an array, or scipy.optimize.Bounds.
    x0: where to start; None: from coarser levels.
    tol: bound for the relative error in the energy norm, and for the natural residual.
    callback: called after every cycle with an OptimizeResult of nit, fun, residual, algebraic_error, contact, changed.
        Where it returns True or raises StopIteration, the solve ends and the last iterate is returned.
    options: as of Solver.

    Returns an OptimizeResult: x, success, status, message, nit, fun, multiplier (Ax - b where a bound holds, else 0),
    active_mask (-1 at the lower bound, 1 at the upper one, 0 between them), history (an array of cycles) and more.
    Raises ValueError, Infeasible, Unbounded or NotConverged.

    >>> import numpy as np, scipy.sparse, signorini
    >>> A = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(5, 5))
    >>> result = signorini.solve_qp(A, -np.ones(5), bounds=(-2.0, None))
    >>> result.x.round(6).tolist()
    [-1.5, -2.0, -2.0, -2.0, -1.5]
    >>> result.multiplier.round(6).tolist()
    [0.0, 0.5, 1.0, 0.5, 0.0]
    """
    return Solver(A, **options).solve(b, bounds, x0, tol, callback)


class Solver:
    """Levels for a matrix, which serve any number of right-hand sides and bounds.

    block: 1, 2 or 3 consecutive unknowns that belong together, such as the displacement of a node; 0: as the matrix, or
        what else is given, looks like.
    coordinates: of an elastic body, one row per node: its rigid motions have little energy.
    near_null_space: in place of these, directions of little energy, one column each (up to 32).
    interpolations: those of another multigrid code, coarsest first; None: levels are chosen by the matrix.
    coarse_matrices: the Galerkin products that go with them; None: they are computed.
    one_triangle: A has only its lower or its upper triangle.
    options: the keys of docs/solver_options.md, such as method="tnnmg" or max_iterations=50.
    """

    def __init__(self, A: Any, *, block: int = 0, coordinates: npt.ArrayLike | None = None,
                 near_null_space: npt.ArrayLike | None = None, interpolations: Sequence[Any] | None = None,
                 coarse_matrices: Sequence[Any] | None = None, one_triangle: bool = False, **options: Any) -> None:
        matrix = square_rows(A, "A")
        self._size = matrix.shape[0]
        self._lock = threading.Lock()
        self._owner: int | None = None
        setup = _Setup(matrix, block)
        setup.set_options(options)
        setup.set_directions(coordinates, near_null_space)
        setup.set_levels(interpolations, coarse_matrices)
        setup.struct.one_triangle = int(one_triangle)
        handle = ctypes.c_void_p()
        status = library().signorini_create_with(ctypes.byref(matrix.struct), setup.block, ctypes.byref(setup.struct),
                                                 ctypes.byref(handle))
        if status != _library.SOLVED:
            _fail(status)
        self._handle = handle
        self._block = setup.block
        self._obstacles = Handed([], self._block)
        weakref.finalize(self, library().signorini_destroy, handle)

    @property
    def shape(self) -> tuple[int, int]:
        """Of the matrix."""
        return self._size, self._size

    def solve(self, b: npt.ArrayLike, bounds: Any = None, x0: npt.ArrayLike | None = None, tol: float = 1e-8,
              callback: Callback | None = None) -> OptimizeResult:
        """As solve_qp(). From the solution of a similar problem, x0=result.x, it takes fewer cycles."""
        load = vector(b, "b", self._size)
        lower, upper = bounds_pair(bounds, self._size)
        start = None if x0 is None else vector(x0, "x0", self._size)
        if not 0 < tol < 1:
            raise ValueError(f"tol: found {tol}, expected a number in (0, 1)")
        if callback is not None and not callable(callback):
            raise ValueError(f"callback: found {callback!r}, expected a function")
        x, multiplier, summary = np.empty(self._size), np.empty(self._size), Summary()
        with _Alone(self), KeptInterrupt() as interrupt:
            with Monitor(self._handle, callback, interrupt, self._obstacles.failed if self._obstacles.energies else None):
                status = library().signorini_solve(
                    self._handle, _address(load), _address(lower), _address(upper), _address(start), float(tol),
                    _address(x), _address(multiplier), ctypes.byref(summary))
                message = _library.message()
            self._obstacles.raise_error()
            if status not in (_library.SOLVED, _library.ITERATION_LIMIT, _library.INTERRUPTED):
                _fail(status, message, lower, upper)
            result = self._result(status, message, summary, x, multiplier)
        if status == _library.ITERATION_LIMIT:
            raise NotConverged(message, result)
        return result

    def update(self, A: Any) -> None:
        """Another matrix of the same size for the solves from now on; interpolations between the levels stay."""
        matrix = square_rows(A, "A")
        if matrix.shape[0] != self._size:
            raise ValueError(f"A: found shape {matrix.shape}, expected {self.shape} as before")
        with _Alone(self):
            status = library().signorini_set_matrix(self._handle, ctypes.byref(matrix.struct))
            if status != _library.SOLVED:
                _fail(status)

    def set_obstacles(self, obstacles: Sequence[Obstacle]) -> None:
        """For the solves from now on, in place of those before, which also forget the last load step.

        They act together with the bounds of solve(). `multiplier` is then all of Ax - b at their blocks, and `touching`
        of the result lists the blocks that they hold.
        """
        if obstacles and not self._block:
            raise ValueError("obstacles: act on blocks of unknowns, expected Solver(A, block=...) or coordinates")
        handed = Handed(obstacles, self._block)
        with _Alone(self):
            status = library().signorini_set_obstacles(self._handle, handed.count, handed.pointers)
            if status != _library.SOLVED:
                _fail(status)
            self._obstacles = handed

    def next_step(self) -> None:
        """A load step ends with the last solution with obstacles: friction counts slip from there."""
        with _Alone(self):
            status = library().signorini_next_step(self._handle)
            if status != _library.SOLVED:
                _fail(status)

    def _result(self, status: int, message: str, summary: Summary, x: FloatArray,
                multiplier: FloatArray) -> OptimizeResult:
        active = np.empty(self._size, dtype=np.int8)
        library().signorini_active(self._handle, _address(active))
        count = ctypes.c_int32()
        library().signorini_history(self._handle, 0, None, ctypes.byref(count))
        history = np.empty(count.value, dtype=_cycle_type)
        library().signorini_history(self._handle, count.value, _address(history), ctypes.byref(count))
        touching = np.zeros(self._size // max(self._block, 1), dtype=np.int8)
        if self._obstacles.count:
            library().signorini_touching(self._handle, _address(touching))
        return OptimizeResult(
            x=x, success=status == _library.SOLVED, status=status, message=message, nit=summary.iterations,
            fun=summary.energy, multiplier=multiplier, active_mask=active, history=history, residual=summary.residual,
            algebraic_error=summary.algebraic_error, rate=summary.rate, rounding_error=summary.rounding_error,
            limited_by_rounding=bool(summary.limited_by_rounding), levels=summary.levels,
            touching=np.flatnonzero(touching))


class _Alone:
    """One thread at a time uses a solver; others wait. Its own callback may not use it."""

    def __init__(self, solver: Solver) -> None:
        self._solver = solver

    def __enter__(self) -> None:
        if self._solver._owner == threading.get_ident():
            raise RuntimeError("this solver is at work: its callback cannot use it")
        self._solver._lock.acquire()
        self._solver._owner = threading.get_ident()

    def __exit__(self, *_: object) -> None:
        self._solver._owner = None
        self._solver._lock.release()


class _Setup:
    """A signorini_setup, and what it points to."""

    def __init__(self, matrix: Rows, block: int) -> None:
        if block not in (0, 1, 2, 3):
            raise ValueError(f"block: found {block}, expected 1, 2 or 3 unknowns, or 0")
        self.struct = Setup(size=ctypes.sizeof(Setup))
        self.block = block
        self._size = matrix.shape[0]
        self._kept: list[Any] = []

    def set_options(self, options: dict[str, Any]) -> None:
        if "tolerance" in options:
            raise ValueError("tolerance: is given to solve, as tol")
        texts = [f"{key}={_text(value)}".encode() for key, value in options.items()]
        self.struct.settings = (ctypes.c_char_p * (len(texts) + 1))(*texts, None)

    def set_directions(self, coordinates: npt.ArrayLike | None, near_null_space: npt.ArrayLike | None) -> None:
        if coordinates is not None and near_null_space is not None:
            raise ValueError("near_null_space: given with coordinates, expected one of them")
        if coordinates is not None:
            dimension = np.shape(coordinates)[1] if np.ndim(coordinates) == 2 else 0
            if dimension not in (2, 3) or self._size % dimension or self.block not in (0, dimension):
                raise ValueError(f"coordinates: found shape {np.shape(coordinates)}, expected one row per node, of 2 or "
                                 f"3 numbers as A, with {self._size} rows, has rows per node")
            nodes = self._size // dimension
            self.block = dimension
            table = columns(coordinates, "coordinates", nodes, f"shape ({nodes}, {dimension}): one row per node")
            self.struct.coordinates = self._doubles(table)
        if near_null_space is not None:
            table = columns(near_null_space, "near_null_space", self._size,
                            f"{self._size} rows as A, and a column for each direction")
            self.struct.modes = table.shape[1]
            self.struct.near_null = self._doubles(table)

    def set_levels(self, interpolations: Sequence[Any] | None, coarse_matrices: Sequence[Any] | None) -> None:
        if interpolations is None:
            if coarse_matrices is not None:
                raise ValueError("coarse_matrices: given without interpolations")
            return
        if coarse_matrices is not None and len(coarse_matrices) != len(interpolations):
            raise ValueError(f"coarse_matrices: found {len(coarse_matrices)}, expected {len(interpolations)}, one for "
                             "each interpolation")
        levels = [rows(P, f"interpolations[{k}]") for k, P in enumerate(interpolations)]
        if self.block == 0:
            vectors = levels[-1].shape[0] if levels else self._size
            self.block = self._size // vectors if vectors and self._size // vectors in (1, 2, 3) else 1
        self.struct.levels = len(levels)
        self.struct.interpolations = self._array(levels)
        if coarse_matrices is not None:
            self.struct.coarse_matrices = self._array(
                [rows(C, f"coarse_matrices[{k}]") for k, C in enumerate(coarse_matrices)])

    def _doubles(self, table: FloatArray) -> Any:
        self._kept.append(table)
        return ctypes.cast(table.ctypes.data, ctypes.POINTER(ctypes.c_double))

    def _array(self, matrices: list[Rows]) -> Any:
        self._kept.append(matrices)
        return (RowsStruct * len(matrices))(*(matrix.struct for matrix in matrices))


def _text(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    return repr(float(value)) if isinstance(value, (float, np.floating)) else str(value)


def _address(array: npt.NDArray[Any] | None) -> int | None:
    return None if array is None else array.ctypes.data


def _fail(status: int, message: str | None = None, lower: FloatArray | None = None,
          upper: FloatArray | None = None) -> None:
    """Raises what a status stands for that comes without results."""
    message = _library.message() if message is None else message
    if re.search(r"\b(row|column)s? \d", message):
        message += " (rows and columns are counted from 1)"
    if status == _library.BAD_INPUT:
        raise ValueError(message)
    if status == _library.NO_SOLUTION:
        raise Infeasible(message) if _is_empty(lower, upper) else Unbounded(message)
    if message == "out of memory":
        raise MemoryError(message)
    raise RuntimeError(message)


def _is_empty(lower: FloatArray | None, upper: FloatArray | None) -> bool:
    low, high = np.asarray(-np.inf if lower is None else lower), np.asarray(np.inf if upper is None else upper)
    return bool(np.any((low > high) | (low == np.inf) | (high == -np.inf)))
