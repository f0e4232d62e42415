"""What happens after every cycle: the caller's function is called, and Ctrl-C ends the solve."""
from __future__ import annotations

import ctypes
import signal
import threading
from collections.abc import Callable
from types import FrameType, TracebackType
from typing import Any

from scipy.optimize import OptimizeResult

from ._library import Cycle, MonitorFunction, library

Callback = Callable[[OptimizeResult], object]


class KeptInterrupt:
    """Keeps SIGINT until the end of a `with`, for Python would raise its KeyboardInterrupt where C cannot pass it on.

    Signals arrive in the main thread alone; elsewhere this does nothing.
    """

    def __init__(self) -> None:
        self.arrived: FrameType | None | bool = False
        self._handler: Any = None

    @property
    def listens(self) -> bool:
        return callable(self._handler)

    def __enter__(self) -> KeptInterrupt:
        if threading.current_thread() is threading.main_thread():
            handler = signal.getsignal(signal.SIGINT)
            if callable(handler):
                self._handler = handler
                signal.signal(signal.SIGINT, self._keep)
        return self

    def _keep(self, _number: int, frame: FrameType | None) -> None:
        self.arrived = frame or True

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        if not self.listens:
            return
        signal.signal(signal.SIGINT, self._handler)
        if self.arrived is not False:
            self._handler(signal.SIGINT, self.arrived if isinstance(self.arrived, FrameType) else None)


class Monitor:
    """Set while a solve runs. What the callback raises is raised again once the library has returned."""

    def __init__(self, solver: ctypes.c_void_p, callback: Callback | None, interrupt: KeptInterrupt,
                 failed: Callable[[], bool] | None = None) -> None:
        self._solver, self._callback, self._interrupt, self._failed = solver, callback, interrupt, failed
        self._error: BaseException | None = None
        self._function: Any = MonitorFunction(self._after_cycle)

    def __enter__(self) -> Monitor:
        if self._callback or self._interrupt.listens or self._failed:
            library().signorini_set_monitor(self._solver, self._function, None)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None,
                 trace: TracebackType | None) -> None:
        library().signorini_set_monitor(self._solver, ctypes.cast(0, MonitorFunction), None)
        self._function = None  # which holds this object
        raised, self._error = self._error, None
        if raised and not isinstance(raised, StopIteration):
            raise raised

    def _after_cycle(self, _iteration: int, _residual: float, _error: float, _data: int | None) -> int:
        try:
            return 1 if (self._failed and self._failed()) or self._interrupt.arrived is not False or (self._callback and self._call()) else 0
        except BaseException as error:  # whatever it is, it cannot pass through C
            self._error = error
            return 1

    def _call(self) -> bool:
        cycle = Cycle()
        library().signorini_current_cycle(self._solver, ctypes.byref(cycle))
        if not cycle.finest or not self._callback:
            return False
        return bool(self._callback(OptimizeResult(
            nit=cycle.iteration, fun=cycle.energy, residual=cycle.residual, algebraic_error=cycle.algebraic_error,
            contact=cycle.contact, changed=cycle.changed)))
