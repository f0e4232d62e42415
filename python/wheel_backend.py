"""Builds the wheel (PEP 517): the package and the compiled library, with nothing but the standard library.

    python3 -m pip install ./python                          # in a source tree with a build
    python3 -m pip install PREFIX/share/signorini/python     # of what is installed
"""
from __future__ import annotations

import base64
import hashlib
import json
import os
import re
import runpy
import tomllib
import zipfile
from pathlib import Path
from typing import Any

_here = Path(__file__).resolve().parent
_tag = "py3-none-linux_x86_64"
_mode = 0o644 << 16
_written = (1980, 1, 1, 0, 0, 0)  # the same files make the same wheel


class UnsupportedOperation(Exception):
    """What pip expects of backends that make no source distribution."""


def _project() -> dict[str, Any]:
    with open(_here / "pyproject.toml", "rb") as file:
        project: dict[str, Any] = tomllib.load(file)["project"]
    return project


def _version() -> str:
    installed, source = _here / "VERSION", _here.parent / "CMakeLists.txt"
    if installed.is_file():
        return installed.read_text().strip()
    found = re.search(r"^project\(signorini VERSION ([\d.]+)", source.read_text(), re.M)
    if not found:
        raise RuntimeError(f"{source}: there is no line project(signorini VERSION ...")
    return found.group(1)


def _licence_text() -> bytes:
    installed = _here / "LICENSE"
    return (installed if installed.is_file() else _here.parent / "LICENSE").read_bytes()


def _metadata() -> str:
    project = _project()
    licence = project["license"]["text"]
    if len(_libraries()) > 1:  # linked with CHOLMOD and UMFPACK
        licence += " AND GPL-2.0-or-later"
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {_version()}",
             f"Summary: {project['description']}", f"License: {licence}",
             f"Requires-Python: {project['requires-python']}"]
    return "\n".join(lines + [f"Requires-Dist: {name}" for name in project["dependencies"]]) + "\n"


def _wheel() -> str:
    return f"Wheel-Version: 1.0\nGenerator: signorini\nRoot-Is-Purelib: false\nTag: {_tag}\n"


def _record(files: dict[str, bytes], name: str) -> str:
    lines = []
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        lines.append(f"{path},sha256={digest},{len(content)}")
    return "\n".join([*lines, f"{name},,"]) + "\n"


def _module(name: str) -> dict[str, Any]:
    """Of the package, without the package itself, which needs NumPy."""
    return runpy.run_path(str(_here / "signorini" / f"{name}.py"))


def _libraries() -> list[Path]:
    """The library, and the one beside it that it may load."""
    search = _module("_search")
    library: Path = search["find_library"]()
    companion = library.parent / search["COMPANION"]
    return [library, companion] if companion.is_file() else [library]


def _files() -> dict[str, bytes]:
    libraries = _libraries()
    package = {file.name: file.read_bytes() for file in sorted((_here / "signorini").iterdir())
               if file.suffix == ".py" or file.name == "py.typed"}
    for name, library in zip((_module("_search")["LIBRARY"], _module("_search")["COMPANION"]), libraries):
        package[name] = library.read_bytes()
    built = {"version": _version(), "library_folder": str(libraries[0].parent),
             "instructions": _module("_processor")["needed_by"](libraries[0])}
    package["_build.json"] = json.dumps(built).encode()
    return {f"signorini/{name}": content for name, content in package.items()}


def _information() -> str:
    return f"signorini-{_version()}.dist-info"


def get_requires_for_build_wheel(config_settings: dict[str, Any] | None = None) -> list[str]:
    return []


def prepare_metadata_for_build_wheel(metadata_directory: str, config_settings: dict[str, Any] | None = None) -> str:
    folder = Path(metadata_directory) / _information()
    folder.mkdir()
    (folder / "METADATA").write_text(_metadata())
    (folder / "WHEEL").write_text(_wheel())
    return folder.name


def build_wheel(wheel_directory: str, config_settings: dict[str, Any] | None = None,
                metadata_directory: str | None = None) -> str:
    files = _files()
    information = _information()
    files[f"{information}/METADATA"] = _metadata().encode()
    files[f"{information}/WHEEL"] = _wheel().encode()
    files[f"{information}/LICENSE"] = _licence_text()
    record = f"{information}/RECORD"
    files[record] = _record(files, record).encode()
    name = f"signorini-{_version()}-{_tag}.whl"
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path, _written)
            entry.external_attr = _mode
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return name


def build_sdist(sdist_directory: str, config_settings: dict[str, Any] | None = None) -> str:
    raise UnsupportedOperation("there is no source distribution: the wheel holds a library that CMake builds")
