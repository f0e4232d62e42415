"""The notebook shows what its cells give."""
import json
import os
import subprocess
import sys

from conftest import source

notebook = source / "python" / "membrane.ipynb"


def check(file, program):
    return subprocess.run([sys.executable, source / "python" / "notebook.py", "--check", file], cwd=source,
                          env=os.environ | {"SIGNORINI_PROGRAM": program}, capture_output=True, text=True)


def test_the_notebook_shows_what_it_gives(program):
    ended = check(notebook, program)
    assert ended.returncode == 0, ended.stderr


def test_what_a_cell_no_longer_gives_is_found(program, tmp_path):
    stale = json.loads(notebook.read_text())
    code = [cell for cell in stale["cells"] if cell["cell_type"] == "code"]
    assert all(cell["outputs"] for cell in code)
    code[1]["source"] = ["print('nothing of that')\n"]
    file = tmp_path / "stale.ipynb"
    file.write_text(json.dumps({**stale, "cells": code[:2]}))
    ended = check(file, program)
    assert ended.returncode == 1 and "cell 2 shows" in ended.stderr
