"""Scenes, solved by the program `signorini`."""
from __future__ import annotations

import json
import os
import signal
import subprocess
import tempfile
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from . import _library
from ._search import find_program
from .errors import Infeasible, NotConverged, SignoriniError, Unbounded
from .results import SceneResult


class SceneWarning(UserWarning):
    """What the program warns of."""


class PluginError(SignoriniError):
    """A plugin could not be loaded, or failed."""


class Scene:
    """A scene: a TOML file, and values that take the place of some in it.

    path: the file.
    overrides: by dotted paths as of `signorini solve --set`, such as {"refine.uniform": 3, "obstacle.0.friction": 0.5}.
    program: the program; None: of SIGNORINI_PROGRAM, or found on PATH and where this package was built.

    >>> import signorini
    >>> scene = signorini.Scene("ball.toml", {"refine.uniform": 1})
    >>> scene.arguments
    ['ball.toml', '--set', 'refine.uniform=1']
    """

    def __init__(self, path: str | os.PathLike[str], overrides: Mapping[str, Any] | None = None, *,
                 program: str | os.PathLike[str] | None = None) -> None:
        self.path = Path(path)
        self.overrides = dict(overrides or {})
        self._program = program
        self.arguments = [str(self.path)]
        for key, value in self.overrides.items():
            self.arguments += ["--set", f"{key}={_toml(value, key)}"]

    def solve(self, out: str | os.PathLike[str] | None = None, progress: bool = False) -> SceneResult:
        """Solves it in a process of its own.

        out: folder for the files that the program writes; None: they are deleted with the result.
        progress: whether the program prints what it does.

        Raises ValueError for what is wrong with the scene, Infeasible, Unbounded, NotConverged or PluginError.
        """
        program = Path(self._program) if self._program else find_program(_library.built().get("library_folder"))
        temporary = None if out is not None else tempfile.TemporaryDirectory(prefix="signorini-")
        folder = Path(temporary.name) / "out" if temporary else Path(os.fspath(out or ""))
        command = [str(program), "solve", *self.arguments, "--out", str(folder), *([] if progress else ["--quiet"])]
        if temporary:
            command += [] if "output.pictures" in self.overrides else ["--set", "output.pictures=false"]
        status, errors = _run(command, progress)
        if status in (0, 3):
            result = SceneResult(folder, temporary)
            for text in result.warnings:
                warnings.warn(text, SceneWarning, stacklevel=2)
            if status == 3:
                raise NotConverged(str(result.report["reason"]), result)
            return result
        _fail(status, errors)
        raise AssertionError


def _run(command: list[str], progress: bool) -> tuple[int, str]:
    """The exit status, and what is printed as errors. Ctrl-C ends the program, too."""
    output = None if progress else subprocess.DEVNULL
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE, text=True,
                          errors="replace", start_new_session=True) as process:
        try:
            _, errors = process.communicate()
        except BaseException:
            process.send_signal(signal.SIGINT)
            process.wait()
            raise
    return process.returncode, errors


def _fail(status: int, errors: str) -> None:
    lines = [line.removeprefix("signorini: error: ") for line in errors.splitlines()
             if not line.startswith("signorini: warning")]
    message = "\n".join(lines) or f"the program ended with status {status}"
    if status in (1, 2):
        raise ValueError(message)
    if status == 4:
        falls = "unbounded" in message or "friction does not hold" in message
        raise Unbounded(message) if falls else Infeasible(message)
    if status == 5:
        raise PluginError(message)
    if status == 130:
        raise KeyboardInterrupt(message)
    raise RuntimeError(message)


def _toml(value: Any, key: str) -> str:
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml(entry, key) for entry in value) + "]"
    raise ValueError(f"overrides: found {value!r} for {key}, expected a number, a text, True, False or a list of these")
