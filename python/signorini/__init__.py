"""Obstacle and contact problems, and quadratic programs with bounds, by monotone multigrid. See docs/python.md."""
from ._library import built as _built
from .errors import Infeasible, NoSolution, NotConverged, SignoriniError, Unbounded
from .results import SceneResult, StepResult
from .scene import PluginError, Scene, SceneWarning
from .solver import Solver, solve_qp
from .vtu import Mesh, read_vtu

__version__ = _built().get("version", "0")

__all__ = ["Infeasible", "Mesh", "NoSolution", "NotConverged", "PluginError", "Scene", "SceneResult", "SceneWarning",
           "SignoriniError", "Solver", "StepResult", "Unbounded", "read_vtu", "solve_qp"]
