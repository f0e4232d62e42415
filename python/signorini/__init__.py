"""Obstacle and contact problems, and quadratic programs with bounds, by monotone multigrid. See docs/python.md."""
from ._library import built as _built
from .errors import Infeasible, NoSolution, NotConverged, SignoriniError, Unbounded
from .obstacles import Energy, Obstacle, Slot
from .results import SceneResult, StepResult
from .scene import PluginError, Scene, SceneWarning
from .solver import Solver, solve_qp
from .vtu import Mesh, read_vtu

__version__ = _built().get("version", "0")

__all__ = ["Energy", "Infeasible", "Mesh", "NoSolution", "NotConverged", "Obstacle", "PluginError", "Scene",
           "SceneResult", "SceneWarning", "SignoriniError", "Slot", "Solver", "StepResult", "Unbounded", "read_vtu",
           "solve_qp"]
