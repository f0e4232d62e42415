"""Obstacles for a matrix of one's own: bounds along directions, Coulomb's friction, and energies written in Python."""
from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from ctypes import POINTER, c_double
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from . import _library
from ._arrays import FloatArray, real_array, refuse
from ._library import EnergyStruct, ObstacleStruct, SlotStruct

_pointer = POINTER(c_double)


class Slot:
    """What an energy sees of a block, all in local coordinates: component k is along direction k of the obstacle."""

    def __init__(self, address: int, numbers: int) -> None:
        self._struct, self._numbers = SlotStruct.from_address(address), numbers
        self.unknowns = self._struct.unknowns

    @property
    def lower(self) -> FloatArray:
        """Bounds of the components, infinite where there is none."""
        return _view(self._struct.lower, self.unknowns)

    @property
    def upper(self) -> FloatArray:
        """The same from above."""
        return _view(self._struct.upper, self.unknowns)

    @property
    def last(self) -> FloatArray:
        """Values after the last load step, zero in the first."""
        return _view(self._struct.last, self.unknowns)

    @property
    def number(self) -> FloatArray:
        """The energy's own numbers, of this block."""
        return _view(self._struct.number, self._numbers)

    @property
    def before(self) -> FloatArray:
        """`number` at the end of the last load step, zero in the first."""
        return _view(self._struct.before, self._numbers)

    @property
    def tangential(self) -> npt.NDArray[np.bool_]:
        """Which components are orthogonal to the obstacle's first direction."""
        return np.array([bool(self._struct.tangential >> k & 1) for k in range(self.unknowns)])


class Energy(Protocol):
    """An energy phi(v) that is added at each block: convex, and smooth but for kinks.

    It may have two functions more. renew(slot, M, r, x) returns new numbers from x and the residual r = b - Ax, before
    each cycle: phi then depends on the solution. scale(ratio, number) returns the numbers of a block that stands for
    `ratio` as much of the surface: without it starts from coarser levels leave phi out.
    """

    def change(self, slot: Slot, start: FloatArray, end: FloatArray) -> float:
        """phi(end) - phi(start), without cancellation."""

    def slope(self, slot: Slot, at: FloatArray, step: FloatArray) -> float:
        """The one-sided derivative of phi at `at` along `step`."""

    def minimise(self, slot: Slot, M: FloatArray, r: FloatArray, x: FloatArray) -> npt.ArrayLike:
        """The minimiser y of 1/2 (y-x)'M(y-x) - r'(y-x) + phi(y) within the bounds, which it meets exactly, like kinks."""

    def linearise(self, slot: Slot, x: FloatArray) -> tuple[npt.ArrayLike, npt.ArrayLike, npt.ArrayLike]:
        """Gradient, Hessian and which components are at a kink, of the piece of phi that x is on.

        At a kink, gradient and Hessian are zero.
        """


class Obstacle:
    """lower <= direction . v <= upper for the unknowns v of some blocks, and what else acts there.

    blocks: their numbers from 0, ascending; block p is rows p * B to p * B + B - 1 of the matrix.
    directions: unit vectors, such as the outer normals of what is in the way: shape (B,) for all blocks, (n, B), or
        (n, k, B) for k directions at each; None: the first coordinate axis.
    lower, upper: a number, or shape (n,) or (n, k); None: there is none. A gap is a lower bound -gap.
    friction: the coefficient of Coulomb's friction, a number or one per block, along one direction.
    energy: in place of it an Energy; numbers: of that, up to 8 per block, shape (n,) or (n, m).
    name: what messages call it.
    """

    def __init__(self, blocks: npt.ArrayLike, directions: npt.ArrayLike | None = None, *,
                 lower: npt.ArrayLike | None = None, upper: npt.ArrayLike | None = None,
                 friction: npt.ArrayLike | None = None, energy: Energy | None = None,
                 numbers: npt.ArrayLike | None = None, name: str = "obstacle") -> None:
        self.name, self.energy = name, energy
        self.blocks = self._whole(blocks)
        n = len(self.blocks)
        self.directions = None if directions is None else self._directions(directions, n)
        k = 1 if self.directions is None else self.directions.shape[1]
        self.lower, self.upper = (None if given is None else self._table(given, which, n, k)
                                  for given, which in ((lower, "lower"), (upper, "upper")))
        self.friction = None if friction is None else self._table(friction, "friction", n, 1)
        if energy is not None and friction is not None:
            raise ValueError(f"{name}: friction beside an energy, expected one of them")
        if energy is None and numbers is not None:
            raise ValueError(f"{name}: numbers without the energy that they belong to")
        self.numbers = np.zeros((n, 0)) if numbers is None else self._table(numbers, "numbers", n, None)

    def _whole(self, blocks: npt.ArrayLike) -> npt.NDArray[np.int32]:
        array = np.asarray(blocks)
        if array.ndim != 1 or (array.size and array.dtype.kind not in "iu"):
            raise ValueError(f"{self.name}: blocks: expected a list of whole numbers")
        return np.ascontiguousarray(array, dtype=np.int32)

    def _directions(self, given: npt.ArrayLike, n: int) -> FloatArray:
        expected = f"shape (B,), ({n}, B) or ({n}, k, B): unit vectors of the {n} blocks"
        array = real_array(given, f"{self.name}: directions", expected)
        if array.ndim == 1:
            array = np.tile(array, (n, 1))
        if array.ndim == 2:
            array = array[:, np.newaxis, :]
        if array.ndim != 3 or array.shape[0] != n:
            raise ValueError(f"{self.name}: directions: found shape {np.shape(given)}, expected {expected}")
        return np.ascontiguousarray(array)

    def _table(self, given: npt.ArrayLike, which: str, n: int, columns: int | None) -> FloatArray:
        """One row per block."""
        name = f"{self.name}: {which}"
        shape = f"({n},)" if columns == 1 else f"({n}, {columns or 'm'})"
        array = real_array(given, name, f"a number, or shape {shape}")
        if array.ndim == 0:
            array = np.full((n, columns or 1), array)
        if array.ndim == 1 and (columns in (1, None)):
            array = array[:, np.newaxis]
        if array.ndim != 2 or array.shape[0] != n or array.shape[1] != (columns or array.shape[1]):
            raise ValueError(f"{name}: found shape {np.shape(given)}, expected a number, or shape {shape}")
        refuse(array, np.isnan(array), name, "numbers")
        return np.ascontiguousarray(array)


class Handed:
    """Obstacles as the library has them, which calls their functions until it gets others."""

    def __init__(self, obstacles: Sequence[Obstacle], block: int) -> None:
        self.error: BaseException | None = None
        self._kept: list[Any] = []
        structs = [self._struct(obstacle, block) for obstacle in obstacles]
        self.count = len(structs)
        self.energies = any(obstacle.energy is not None for obstacle in obstacles)
        self.pointers = (POINTER(ObstacleStruct) * len(structs))(*(ctypes.pointer(struct) for struct in structs))

    def failed(self) -> bool:
        """Whether one of their functions has raised an exception."""
        return self.error is not None

    def raise_error(self) -> None:
        """Raises it once more."""
        error, self.error = self.error, None
        if error is not None:
            raise error

    def _struct(self, obstacle: Obstacle, block: int) -> ObstacleStruct:
        directions = obstacle.directions
        if directions is not None and directions.shape[2] != block:
            raise ValueError(f"{obstacle.name}: directions: found {directions.shape[2]} components, expected {block}, one "
                             "for each unknown of a block")
        energy = None if obstacle.energy is None else self._energy(obstacle.energy, obstacle.numbers.shape[1])
        struct = ObstacleStruct(
            size=ctypes.sizeof(ObstacleStruct), name=obstacle.name.encode(), blocks=len(obstacle.blocks),
            block=obstacle.blocks.ctypes.data_as(POINTER(ctypes.c_int32)),
            directions=1 if directions is None else directions.shape[1], direction=_address(directions),
            lower=_address(obstacle.lower), upper=_address(obstacle.upper), friction=_address(obstacle.friction),
            energy=None if energy is None else ctypes.pointer(energy), numbers=obstacle.numbers.shape[1],
            number=_address(obstacle.numbers))
        self._kept += [obstacle, struct]
        return struct

    def _energy(self, energy: Energy, numbers: int) -> EnergyStruct:
        def slot(at: int) -> Slot:
            return Slot(at, numbers)

        def change(at: Any, start: Any, end: Any, _: Any) -> float:
            here = slot(at)
            return float(energy.change(here, _view(start, here.unknowns), _view(end, here.unknowns)))

        def slope(at: Any, point: Any, step: Any, _: Any) -> float:
            here = slot(at)
            return float(energy.slope(here, _view(point, here.unknowns), _view(step, here.unknowns)))

        def minimise(at: Any, M: Any, r: Any, x: Any, y: Any, _: Any) -> None:
            here = slot(at)
            n = here.unknowns
            _view(y, n)[:] = energy.minimise(here, _view(M, n * n).reshape(n, n), _view(r, n), _view(x, n))

        def linearise(at: Any, x: Any, gradient: Any, hessian: Any, critical: Any, _: Any) -> None:
            here = slot(at)
            n = here.unknowns
            g, H, kinks = energy.linearise(here, _view(x, n))
            _view(gradient, n)[:], _view(hessian, n * n).reshape(n, n)[:] = g, H
            bits = ctypes.c_uint.from_address(critical)
            for k, kink in enumerate(np.broadcast_to(np.asarray(kinks, dtype=bool), n)):
                bits.value |= int(kink) << k

        def renew(at: Any, M: Any, r: Any, x: Any, number: Any, _: Any) -> None:
            here = slot(at)
            n = here.unknowns
            _view(number, numbers)[:] = energy.renew(  # type: ignore[attr-defined]
                here, _view(M, n * n).reshape(n, n), _view(r, n), _view(x, n))

        def scale(ratio: float, number: Any, _: Any) -> None:
            _view(number, numbers)[:] = energy.scale(ratio, _view(number, numbers))  # type: ignore[attr-defined]

        def stay(at: Any, M: Any, r: Any, x: Any, y: Any, _: Any) -> None:
            n = slot(at).unknowns
            _view(y, n)[:] = _view(x, n)

        struct = EnergyStruct(size=ctypes.sizeof(EnergyStruct))
        of_functions: list[tuple[str, Any, Callable[..., Any], Callable[..., Any]]] = [
            ("change", _library.ChangeFunction, change, _zero), ("slope", _library.SlopeFunction, slope, _zero),
            ("minimise", _library.MinimiseFunction, minimise, stay),
            ("linearise", _library.LineariseFunction, linearise, _nothing),
            ("renew", _library.RenewFunction, renew, _nothing), ("scale", _library.ScaleFunction, scale, _nothing)]
        for name, of, function, otherwise in of_functions:
            if hasattr(energy, name):
                setattr(struct, name, of(self._guarded(function, otherwise)))
        self._kept.append(struct)
        return struct

    def _guarded(self, function: Callable[..., Any], otherwise: Callable[..., Any]) -> Callable[..., Any]:
        """No exception passes through C: the first one is kept, and the solve ends soon, without the energy."""

        def call(*arguments: Any) -> Any:
            try:
                return otherwise(*arguments) if self.error is not None else function(*arguments)
            except BaseException as error:
                self.error = error
                return otherwise(*arguments)

        return call


def _zero(*_: Any) -> float:
    return 0.0


def _nothing(*_: Any) -> None:
    pass


def _address(array: FloatArray | None) -> Any:
    return None if array is None else array.ctypes.data_as(_pointer)


_arrays = [c_double * size for size in range(10)]


def _view(address: int, size: int) -> FloatArray:
    """Of what the library lends for the time of a call."""
    if size == 0:
        return np.empty(0)
    memory: Any = _arrays[size].from_address(address)
    view: FloatArray = np.frombuffer(memory)
    return view
