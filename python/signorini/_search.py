"""Where the compiled library and the program are. Used when the wheel is built, too: the standard library alone."""
from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

LIBRARY = "libsignorini_c.so.2"
COMPANION = "libsignorini_cholmod.so"  # for methods with a factorisation; the library loads it from its own folder
PROGRAM = "signorini"

_build_trees = ("release", "release-assert")


def _prefixes() -> Iterator[Path]:
    yield Path(__file__).resolve().parents[4]  # of share/signorini/python/signorini
    yield Path(sys.prefix)
    yield Path("/usr/local")
    yield Path("/usr")


def _library_folders(project: Path | None) -> Iterator[Path]:
    if project:
        for tree in _build_trees:
            yield project / "build" / tree / "lib"
    for prefix in _prefixes():
        for folder in ("lib", "lib/x86_64-linux-gnu", "lib64"):
            yield prefix / folder


def project_folder() -> Path | None:
    """The source tree that this file is in, if it is in one."""
    folder = Path(__file__).resolve().parents[2]
    return folder if (folder / "c" / "signorini.h").is_file() else None


def find_library() -> Path:
    """The file of SIGNORINI_LIBRARY; else the one of the wheel, a build tree or a prefix, whichever is there first.

    Raises FileNotFoundError, which names all that was searched.
    """
    chosen = os.environ.get("SIGNORINI_LIBRARY")
    if chosen:
        path = Path(chosen)
        if path.is_dir():
            path /= LIBRARY
        if path.is_file():
            return path.resolve()
        raise FileNotFoundError(f"SIGNORINI_LIBRARY: there is no file {path}; expected a {LIBRARY} or its folder")
    folders = [Path(__file__).resolve().parent, *_library_folders(project_folder())]
    for folder in folders:
        if (folder / LIBRARY).is_file():
            return (folder / LIBRARY).resolve()
    searched = "\n".join(f"  {folder / LIBRARY}" for folder in dict.fromkeys(folders))
    raise FileNotFoundError(
        f"{LIBRARY} is not there. Build it (./dev build release signorini_c), install it (./dev install PREFIX), or "
        f"name it by the environment variable SIGNORINI_LIBRARY. Searched:\n{searched}")


def find_program(built_beside: str | None) -> Path:
    """The file of SIGNORINI_PROGRAM; else the one on PATH, in a prefix, or of the build that the wheel was made of.

    Raises FileNotFoundError, which names all that was searched.
    """
    chosen = os.environ.get("SIGNORINI_PROGRAM")
    if chosen:
        if os.access(chosen, os.X_OK) and Path(chosen).is_file():
            return Path(chosen).resolve()
        raise FileNotFoundError(f"SIGNORINI_PROGRAM: {chosen} is no program")
    folders = [Path(folder) for folder in os.environ.get("PATH", "").split(os.pathsep) if folder]
    folders += [prefix / "bin" for prefix in _prefixes()]
    if built_beside:
        folders += [parent / "bin" for parent in list(Path(built_beside).parents)[:2]]
    project = project_folder()
    if project:
        folders += [project / "build" / tree / "bin" for tree in _build_trees]
    for folder in folders:
        file = folder / PROGRAM
        if file.is_file() and os.access(file, os.X_OK):
            return file.resolve()
    searched = "\n".join(f"  {folder / PROGRAM}" for folder in dict.fromkeys(folders))
    raise FileNotFoundError(
        f"the program {PROGRAM}, which solves scenes, is not there. Build it (./dev build), install it (./dev install "
        f"PREFIX), or name it by the environment variable SIGNORINI_PROGRAM. Searched:\n{searched}")
