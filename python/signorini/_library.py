"""libsignorini_c: its structs and functions as c/signorini.h has them, loaded on first use."""
from __future__ import annotations

import ctypes
import functools
import json
from ctypes import POINTER, c_char_p, c_double, c_int, c_int32, c_int64, c_size_t, c_uint, c_void_p
from pathlib import Path
from typing import Any

from . import _processor, _search

SOLVED, BAD_INPUT, ITERATION_LIMIT, NO_SOLUTION, FAILURE, INTERRUPTED = 0, 2, 3, 4, 6, 130


class RowsStruct(ctypes.Structure):
    """signorini_rows"""

    _fields_ = [("rows", c_int32), ("columns", c_int32), ("row", POINTER(c_int64)), ("column", POINTER(c_int32)),
                ("value", POINTER(c_double))]


class Setup(ctypes.Structure):
    """signorini_setup"""

    _fields_ = [("size", c_size_t), ("settings", POINTER(c_char_p)), ("coordinates", POINTER(c_double)),
                ("modes", c_int32), ("near_null", POINTER(c_double)), ("levels", c_int32),
                ("interpolations", POINTER(RowsStruct)), ("coarse_matrices", POINTER(RowsStruct)),
                ("one_triangle", c_int)]


class Summary(ctypes.Structure):
    """signorini_summary"""

    iterations: int
    levels: int
    residual: float
    algebraic_error: float
    energy: float
    rate: float
    rounding_error: float
    limited_by_rounding: int

    _fields_ = [("iterations", c_int), ("levels", c_int), ("residual", c_double), ("algebraic_error", c_double),
                ("energy", c_double), ("rate", c_double), ("rounding_error", c_double),
                ("limited_by_rounding", c_int32)]


class Cycle(ctypes.Structure):
    """signorini_cycle"""

    iteration: int
    finest: int
    contact: int
    changed: int
    residual: float
    algebraic_error: float
    energy: float

    _fields_ = [("iteration", c_int32), ("finest", c_int32), ("contact", c_int32), ("changed", c_int32),
                ("residual", c_double), ("algebraic_error", c_double), ("energy", c_double)]


class SlotStruct(ctypes.Structure):
    """signorini_slot"""

    unknowns: int
    lower: int
    upper: int
    number: int
    last: int
    before: int
    tangential: int

    _fields_ = [("unknowns", c_int32), ("lower", c_void_p), ("upper", c_void_p), ("number", c_void_p),
                ("last", c_void_p), ("before", c_void_p), ("tangential", c_uint)]


# Of an energy, called often: pointers arrive as addresses, which is fast.
_doubles, _at = POINTER(c_double), c_void_p
ChangeFunction = SlopeFunction = ctypes.CFUNCTYPE(c_double, _at, _at, _at, _at)
MinimiseFunction = RenewFunction = LineariseFunction = ctypes.CFUNCTYPE(None, _at, _at, _at, _at, _at, _at)
ScaleFunction = ctypes.CFUNCTYPE(None, c_double, _at, _at)


class EnergyStruct(ctypes.Structure):
    """signorini_energy"""

    _fields_ = [("size", c_size_t), ("change", ChangeFunction), ("slope", SlopeFunction),
                ("minimise", MinimiseFunction), ("linearise", LineariseFunction), ("renew", RenewFunction),
                ("scale", ScaleFunction), ("data", c_void_p)]


class ObstacleStruct(ctypes.Structure):
    """signorini_obstacle"""

    _fields_ = [("size", c_size_t), ("name", c_char_p), ("blocks", c_int32), ("block", POINTER(c_int32)),
                ("directions", c_int32), ("direction", _doubles), ("lower", _doubles), ("upper", _doubles),
                ("friction", _doubles), ("energy", POINTER(EnergyStruct)), ("numbers", c_int32),
                ("number", _doubles)]


MonitorFunction = ctypes.CFUNCTYPE(c_int, c_int, c_double, c_double, c_void_p)

_arguments = {
    "signorini_create_with": [POINTER(RowsStruct), c_int, POINTER(Setup), POINTER(c_void_p)],
    "signorini_solve": [c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_double, c_void_p, c_void_p,
                        POINTER(Summary)],
    "signorini_active": [c_void_p, c_void_p],
    "signorini_set_matrix": [c_void_p, POINTER(RowsStruct)],
    "signorini_set_monitor": [c_void_p, MonitorFunction, c_void_p],
    "signorini_current_cycle": [c_void_p, POINTER(Cycle)],
    "signorini_history": [c_void_p, c_int32, c_void_p, POINTER(c_int32)],
    "signorini_set_obstacles": [c_void_p, c_int32, POINTER(POINTER(ObstacleStruct))],
    "signorini_next_step": [c_void_p],
    "signorini_touching": [c_void_p, c_void_p],
}


@functools.cache
def library() -> ctypes.CDLL:
    """With the types of its functions. While one of them runs other threads of Python do, too."""
    path = _search.find_library()
    _require_processor(path)
    loaded = ctypes.CDLL(str(path))
    try:
        for name, arguments in _arguments.items():
            function = getattr(loaded, name)
            function.argtypes = arguments
            function.restype = c_int
        loaded.signorini_destroy.argtypes = [c_void_p]
        loaded.signorini_destroy.restype = None
        loaded.signorini_message.argtypes = []
        loaded.signorini_message.restype = c_char_p
    except AttributeError as error:
        raise ImportError(f"{path} is older than this package: {error}; expected the library that was built with it",
                          path=str(path)) from None
    return loaded


def _require_processor(path: Path) -> None:
    """Code for another processor would end Python without a word."""
    missing = set(built().get("instructions", [])) - _processor.instructions()
    if path.parent == Path(__file__).resolve().parent and missing:
        raise ImportError(f"{path} was compiled for a processor with {', '.join(sorted(missing))}, which this one does "
                          "not have; expected a wheel made here, or of a build with -DSIGNORINI_NATIVE=OFF",
                          path=str(path))


def message() -> str:
    """Why the last call in this thread returned what it did."""
    text: bytes = library().signorini_message()
    return text.decode(errors="replace")


@functools.cache
def built() -> dict[str, Any]:
    """What the wheel was made of; nothing in a source tree."""
    file = Path(__file__).with_name("_build.json")
    if not file.is_file():
        return {}
    found: dict[str, Any] = json.loads(file.read_text())
    return found
