"""What is raised where there is no solution to return. Bad input is a ValueError."""
from __future__ import annotations

from typing import Any


class SignoriniError(Exception):
    """Of all that follow."""


class NoSolution(SignoriniError):
    """No solution exists: Infeasible or Unbounded says why."""


class Infeasible(NoSolution):
    """Nothing lies between the bounds."""


class Unbounded(NoSolution):
    """The energy has no minimum: nothing holds the unknowns against the loads."""


class NotConverged(SignoriniError):
    """The tolerance was not reached. `result` holds the last iterate, as a solve returns it."""

    def __init__(self, message: str, result: Any) -> None:
        super().__init__(message)
        self.result = result
