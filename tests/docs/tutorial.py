"""Runs the commands of docs/tutorial.md and compares what they print with what the page shows.

    tutorial.py SOURCE PROGRAMS   (the source tree, the folder of the built programs)

Blocks of the page: `sh` is run, `text` must be printed by the block before it, `toml` and `gmsh` stand in the files of
the scene. Numbers agree to the digits shown. Decimal numbers between the blocks are in a block, perhaps rounded.
Not run: ./dev, and gmsh where it is not installed.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source, programs = pathlib.Path(sys.argv[1]), sys.argv[2]
page = (source / "docs/tutorial.md").read_text()
blocks = re.findall(r"^```(\w+)\n(.*?)^```$", page, re.M | re.S)
number = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


def digits_shown(text):
    """What one unit of the last digit shown is worth."""
    mantissa, _, power = text.partition("e")
    return 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))


def rounds_to(value, text):
    return abs(float(value) - float(text)) <= 0.51 * digits_shown(text)


def agree(shown, printed):
    """The same words, and numbers that agree to the digits shown."""
    if number.sub("#", " ".join(shown.split())) != number.sub("#", " ".join(printed.split())):
        return False
    return all(rounds_to(b, a) for a, b in zip(number.findall(shown), number.findall(printed), strict=True))


def run(commands, folder):
    lines = [line for line in commands.splitlines() if not line.startswith("./dev")]
    if not shutil.which("gmsh"):
        lines = [line for line in lines if not line.startswith("gmsh")]
    environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}"}
    ended = subprocess.run(["bash", "-euc", "\n".join(lines)], cwd=folder, env=environment, capture_output=True,
                           text=True)
    if ended.returncode or ended.stderr:
        sys.exit(f"{commands}ends with {ended.returncode}\n{ended.stdout}{ended.stderr}")
    return ended.stdout


def expect_shown(text, output):
    printed = iter(output.splitlines())
    for line in text.splitlines():
        if not any(agree(line, candidate) for candidate in printed):
            sys.exit(f"the page shows\n{line}\nwhich is not in, or in another order than\n{output}")


def expect_in_scene(text, ending):
    held = [" ".join(line.split()) for line in (source / f"apps/scenes/lever.{ending}").read_text().splitlines()]
    for line in text.splitlines():
        if " ".join(line.split()) not in held:
            sys.exit(f"lever.{ending} has no line\n{line}")


with tempfile.TemporaryDirectory() as folder:
    os.makedirs(f"{folder}/apps/scenes")
    for file in source.glob("apps/scenes/lever.*"):
        shutil.copy(file, f"{folder}/apps/scenes")
    mesh = pathlib.Path(folder, "apps/scenes/lever.msh")
    kept, output = mesh.read_bytes(), ""
    for kind, text in blocks:
        if kind == "sh":
            output = run(text, folder)
            mesh.write_bytes(kept)  # the figures are those of this one
        elif kind == "text":
            expect_shown(text, output)
        else:
            expect_in_scene(text, {"toml": "toml", "gmsh": "geo"}[kind])

shown = number.findall(" ".join(text for _, text in blocks))
between = re.sub(r"^```.*?^```$|!?\[[^]]*\]\([^)]*\)|`[^`]*`|Gmsh [\d.]+", "", page, flags=re.M | re.S)
for figure in re.findall(r"\d+\.\d+", between):
    if figure != "0.7" and not any(rounds_to(value, figure) for value in shown):
        sys.exit(f"where does {figure} come from?")
ratio = [float(n) for n in re.findall(r"largest pressure (\d+\.\d+) MPa", page)]
if not rounds_to(ratio[1] / ratio[0], "0.7"):
    sys.exit(f"{ratio[1]} is not 0.7 times {ratio[0]}")
