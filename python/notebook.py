"""Executes a notebook in place, with the standard library alone: python3 python/notebook.py [--check] FILE.ipynb

What a cell prints, and the value of its last line, becomes its output. With --check nothing is written: exit status 1
where a cell now prints something else than the file shows, numbers apart.
"""
from __future__ import annotations

import ast
import contextlib
import io
import json
import re
import sys
from pathlib import Path
from typing import Any

_number = re.compile(r"-?\d+(\.\d+)?(e[+-]?\d+)?")


def run_cell(source: str, names: dict[str, Any]) -> tuple[str, str | None]:
    """What the cell prints, and the text of the value of its last line, if that has one."""
    body = ast.parse(source).body
    last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(ast.Module(body, []), "<cell>", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "<cell>", "eval"), names) if isinstance(last, ast.Expr) else None
    return printed.getvalue(), None if value is None else repr(value)


def outputs_of(printed: str, value: str | None, count: int) -> list[dict[str, Any]]:
    outputs: list[dict[str, Any]] = []
    if printed:
        outputs.append({"output_type": "stream", "name": "stdout", "text": printed.splitlines(keepends=True)})
    if value is not None:
        outputs.append({"output_type": "execute_result", "execution_count": count, "metadata": {},
                        "data": {"text/plain": value.splitlines(keepends=True)}})
    return outputs


def execute(notebook: dict[str, Any]) -> None:
    """Runs its cells of code one after the other, and puts in what they give."""
    names: dict[str, Any] = {"__name__": "__main__"}
    count = 0
    for cell in notebook["cells"]:
        if cell["cell_type"] != "code":
            continue
        count += 1
        cell["execution_count"] = count
        cell["outputs"] = outputs_of(*run_cell("".join(cell["source"]), names), count)


def shown(notebook: dict[str, Any]) -> list[str]:
    """Outputs as text, without their numbers, which differ between machines in their last digits."""
    texts = [json.dumps(cell["outputs"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    return [_number.sub("#", text) for text in texts]


def main() -> None:
    check, file = "--check" in sys.argv[1:], Path(sys.argv[-1])
    notebook: dict[str, Any] = json.loads(file.read_text())
    before = shown(notebook)
    execute(notebook)
    if not check:
        file.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n")
    for number, (old, new) in enumerate(zip(before, shown(notebook)), 1):
        if check and old != new:
            sys.exit(f"{file}: cell {number} shows {old}, and now gives {new}")


if __name__ == "__main__":
    main()
