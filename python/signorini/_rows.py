"""Matrices of any kind as the compressed rows that the library reads."""
from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
import numpy.typing as npt
import scipy.sparse

from ._arrays import FloatArray, real_array
from ._library import RowsStruct

_largest_index = 2**31 - 1


class Rows:
    """Compressed rows, and the arrays that they point to."""

    def __init__(self, shape: tuple[int, int], row: npt.NDArray[np.int64], column: npt.NDArray[np.int32],
                 value: FloatArray) -> None:
        self.shape = shape
        self.row, self.column, self.value = row, column, value
        self.struct = RowsStruct(*shape, _pointer(row, ctypes.c_int64), _pointer(column, ctypes.c_int32),
                                 _pointer(value, ctypes.c_double))


def _pointer(array: npt.NDArray[Any], of: type[Any]) -> Any:
    return ctypes.cast(array.ctypes.data, ctypes.POINTER(of))


def square_rows(matrix: Any, name: str) -> Rows:
    """Of a symmetric matrix, or of one of its triangles. Its columns are as good as its rows."""
    sparse = _sparse(matrix, name, "a square matrix")
    if sparse.shape[0] != sparse.shape[1] or sparse.shape[0] == 0:
        raise ValueError(f"{name}: found shape {sparse.shape}, expected a square matrix of one row at least")
    return _compressed(sparse.T if sparse.format == "csc" else sparse, name)


def rows(matrix: Any, name: str) -> Rows:
    return _compressed(_sparse(matrix, name, "a matrix"), name)


def _sparse(matrix: Any, name: str, expected: str) -> Any:
    if not scipy.sparse.issparse(matrix):
        array = real_array(matrix, name, f"{expected}, sparse or dense, of real numbers")
        if array.ndim != 2:
            raise ValueError(f"{name}: found an array of {np.ndim(matrix)} dimensions, expected {expected}")
        matrix = scipy.sparse.csr_matrix(array)
    if matrix.dtype.kind not in "biuf":
        raise ValueError(f"{name}: found entries of type {matrix.dtype}, expected {expected} of real numbers")
    if len(matrix.shape) != 2:
        raise ValueError(f"{name}: found an array of {len(matrix.shape)} dimensions, expected {expected}")
    return matrix


def _compressed(matrix: Any, name: str) -> Rows:
    if max(matrix.shape) > _largest_index:
        raise ValueError(f"{name}: found shape {matrix.shape}, expected no more than {_largest_index} rows and columns")
    matrix = matrix.tocsr()
    _check_lengths(matrix, name)
    if not matrix.has_canonical_format:  # entries that stand twice count as their sum
        matrix = matrix.copy()
        matrix.sum_duplicates()
    entries = int(matrix.indptr[-1])
    column, value = matrix.indices[:entries], matrix.data[:entries]
    _check_values(matrix, column, value, name)
    return Rows(matrix.shape, np.ascontiguousarray(matrix.indptr, dtype=np.int64),
                np.ascontiguousarray(column, dtype=np.int32), np.ascontiguousarray(value, dtype=np.float64))


def _check_lengths(matrix: Any, name: str) -> None:
    """What SciPy leaves unchecked where arrays were changed in place, and what reading depends on."""
    pointers = matrix.indptr
    if pointers[0] != 0 or (np.diff(pointers) < 0).any():
        raise ValueError(f"{name}: indptr does not ascend from 0, expected compressed rows")
    if min(len(matrix.indices), len(matrix.data)) < pointers[-1]:
        raise ValueError(f"{name}: found {min(len(matrix.indices), len(matrix.data))} entries, expected "
                         f"indptr[-1] = {pointers[-1]}")


def _check_values(matrix: Any, column: npt.NDArray[Any], value: npt.NDArray[Any], name: str) -> None:
    if len(column) and (column.min() < 0 or column.max() >= matrix.shape[1]):
        raise ValueError(f"{name}: found column {column.min() if column.min() < 0 else column.max()}, expected 0 to "
                         f"{matrix.shape[1] - 1}")
    wrong = ~np.isfinite(value)
    if wrong.any():
        k = int(np.argmax(wrong))
        row = int(np.searchsorted(matrix.indptr, k, side="right")) - 1
        raise ValueError(f"{name}: found {value[k]} in row {row}, column {column[k]} (from 0), expected finite numbers")
