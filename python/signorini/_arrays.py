"""What users hand in, as arrays of the types that the library reads. What fits already is not copied."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import Bounds

FloatArray = npt.NDArray[np.float64]


def real_array(values: Any, name: str, expected: str) -> FloatArray:
    """Doubles, one after the other."""
    try:
        array = np.asarray(values)
    except ValueError:  # lists of different lengths
        raise ValueError(f"{name}: is no array of numbers, expected {expected}") from None
    if array.dtype.kind == "c":
        raise ValueError(f"{name}: found complex numbers, expected {expected}")
    if array.dtype.kind not in "biufO":
        raise ValueError(f"{name}: found values of type {array.dtype}, expected {expected}")
    try:
        return np.asarray(array, dtype=np.float64, order="C")
    except (TypeError, ValueError):
        raise ValueError(f"{name}: is no array of numbers, expected {expected}") from None


def refuse(array: FloatArray, wrong: npt.NDArray[np.bool_], name: str, expected: str) -> None:
    """A ValueError that names the first entry that is wrong."""
    if wrong.any():
        place = tuple(int(i) for i in np.unravel_index(int(np.argmax(wrong)), array.shape))
        shown = place[0] if len(place) == 1 else place
        raise ValueError(f"{name}: found {array[place]} at index {shown}, expected {expected}")


def vector(values: Any, name: str, size: int) -> FloatArray:
    """One finite number per row of the matrix."""
    expected = f"{size} finite numbers, one per row of A"
    array = real_array(values, name, expected)
    if array.shape != (size,):
        raise ValueError(f"{name}: found shape {array.shape}, expected ({size},): one number per row of A")
    refuse(array, ~np.isfinite(array), name, "finite numbers")
    return array


def _bound(values: Any, name: str, size: int) -> FloatArray | None:
    if values is None:
        return None
    array = real_array(values, name, f"a number, or {size} numbers, one per row of A")
    if array.ndim == 0:
        array = np.full(size, array)
    if array.shape != (size,):
        raise ValueError(f"{name}: found shape {array.shape}, expected a number, or shape ({size},): one number per "
                         "row of A")
    refuse(array, np.isnan(array), name, "numbers, -inf or inf")
    return array


def bounds_pair(bounds: Any, size: int) -> tuple[FloatArray | None, FloatArray | None]:
    """Of (lower, upper), either of which may be None or a single number, or of scipy.optimize.Bounds."""
    if bounds is None:
        return None, None
    if isinstance(bounds, Bounds):
        bounds = (bounds.lb, bounds.ub)
        if all(np.ndim(bound) == 1 and np.size(bound) == 1 for bound in bounds):  # as SciPy keeps single numbers
            bounds = tuple(np.reshape(bound, ()) for bound in bounds)
    try:
        lower, upper = bounds
    except (TypeError, ValueError):
        raise ValueError("bounds: expected a pair (lower, upper) of arrays, numbers or None, or scipy.optimize.Bounds"
                         ) from None
    return _bound(lower, "bounds[0]", size), _bound(upper, "bounds[1]", size)


def columns(values: Any, name: str, rows: int, expected: str) -> FloatArray:
    """A table of finite numbers with so many rows; a vector is a table of one column."""
    array = real_array(values, name, expected)
    if array.ndim == 1:
        array = array.reshape(-1, 1)
    if array.ndim != 2 or array.shape[0] != rows:
        raise ValueError(f"{name}: found shape {np.shape(values)}, expected {expected}")
    refuse(array, ~np.isfinite(array), name, "finite numbers")
    return array
