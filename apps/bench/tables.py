"""Solves of scenes, and tables in Markdown: what the scripts of this folder share."""
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

source = pathlib.Path(__file__).resolve().parents[2]
folders = [source / "build/release/bin", source / "build/release-assert/bin"]
program = os.environ.get("SIGNORINI") or next((f / "signorini" for f in folders if (f / "signorini").exists()), None)
no_files = {"output.vtu": "false", "output.pictures": "false"}
scratch = tempfile.TemporaryDirectory()


def scene_file(scene):
    """A scene of apps/scenes by its name, or the text of one."""
    if "\n" not in scene:
        return source / f"apps/scenes/{scene}.toml"
    file = pathlib.Path(scratch.name) / "scene.toml"
    file.write_text(scene)
    return file


def solved(scene, keys={}, limit=None):
    """The report; `exit` and `seconds`, those of the processor, are of the whole program. Where that has not come to an
    end after the limit, in seconds, `exit` says so."""
    out = pathlib.Path(scratch.name) / "out"
    settings = [part for key, value in {**no_files, **keys}.items() for part in ("--set", f"{key}={value}")]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        ended = subprocess.run([program, "solve", scene_file(scene), "--quiet", "--out", out, *settings],
                               stderr=subprocess.PIPE, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return {"exit": f"none after {limit} s"}
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if ended.returncode not in (0, 3, 4):
        sys.exit(f"{scene} {settings}: {ended.stderr}")
    report = json.loads((out / "report.json").read_text()) if ended.returncode != 4 else {}
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return report | {"exit": ended.returncode, "seconds": seconds}


def cycles(report):
    """Cycles; in brackets the method that went on where they were given up; else the exit status."""
    if report["exit"]:
        return f"exit {report['exit']}"
    cyclic = [stage for stage in report["stages"] if any(name in stage["method"] for name in ("monotone", "tnnmg", "pgs"))]
    others = [stage["method"] for stage in report["stages"] if stage not in cyclic]
    count = sum(stage["iterations"] for stage in cyclic)
    return f"{count} ({others[0]})" if others else str(report["iterations"])


def row(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def head(*cells):
    row(*cells)
    row(*["---"] * len(cells))


def named(scene, keys):
    return ", ".join([f"`{scene}`"] + [f"`{key}={value}`" for key, value in keys.items()])


# --- parts of scenes


def box(name, dimension, to, cells):
    return f"""[[body]]
name = "{name}"
shape = "{"rectangle" if dimension == 2 else "box"}"
from = {[0] * dimension}
to = {to}
cells = {cells}
order = 1
young = 1
poisson = 0.3
"""


def held(body, part, value):
    return f'[[fix]]\nbody = "{body}"\non = "{part}"\nvalue = {value}\n'


def plane(body, part, point, normal):
    return f"""[[obstacle]]
type = "contact"
body = "{body}"
on = "{part}"
shape = "plane"
point = {point}
normal = {normal}
"""
