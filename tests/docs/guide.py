"""Runs the commands of a page of docs/ and compares what they print with what the page shows.

    guide.py SOURCE PROGRAMS PAGE [KIND...]   (the source tree, the folder of the programs, such as tutorial.md)

Blocks of the page: `sh` is run, `text` must be printed by the block before it, `toml` and `gmsh` stand in a file of
apps/scenes, in one that the page has written, or in one of tests/docs/scenes, which is solved; comments do not count. `cpp`, where it is asked for, stands in a file of tests/docs/plugin. Numbers agree to the digits shown. Decimal
numbers between the blocks are in a block, perhaps rounded, or in a page of docs/measured or docs/theory that the page
links to. With KIND only blocks of that kind count, and no figures. Not run: ./dev, and gmsh and VTK's Python where
these are not installed. Where the environment names a folder GUIDE_BUILD, it is the folder build of the page.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source, programs, name, *kinds = pathlib.Path(sys.argv[1]), *sys.argv[2:]
page = (source / "docs" / name).read_text()
blocks = re.findall(r"^```(" + ("|".join(kinds) or r"\w+") + r")\n(.*?)^```$", page, re.M | re.S)
number = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
has_vtk = not subprocess.run(["/usr/bin/python3", "-c", "import vtkmodules.vtkIOXML"], capture_output=True).returncode


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
    """What is printed; None where something that the commands need is not installed."""
    if "vtkmodules" in commands and not has_vtk:
        return None
    lines = [line for line in commands.splitlines() if not line.startswith("./dev")]
    if "GUIDE_BUILD" in os.environ:  # it is built
        lines = [line for line in lines if not line.startswith("cmake")]
    if not shutil.which("gmsh"):
        lines = [line for line in lines if not line.startswith("gmsh")]
    environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}"}
    ended = subprocess.run(["bash", "-euc", "\n".join(lines)], cwd=folder, env=environment, capture_output=True,
                           text=True)
    if ended.returncode:
        sys.exit(f"{commands}ends with {ended.returncode}\n{ended.stdout}{ended.stderr}")
    for warning in ended.stderr.splitlines():
        if warning.endswith(" s so far"):  # on a machine that is busy
            continue
        if "](warnings.md" not in page and not any(agree(line, warning) for line in page.splitlines()):
            sys.exit(f"{commands}warns, and the page neither shows it nor says where warnings are explained:\n{warning}")
    return ended.stdout + ended.stderr


def expect_shown(text, output):
    printed = iter(output.splitlines())
    for line in text.splitlines():
        if not any(agree(line, candidate) for candidate in printed):
            sys.exit(f"the page shows\n{line}\nwhich is not in, or in another order than\n{output}")


def bare(text):
    """The lines without comments and blanks."""
    return [line for line in (" ".join(re.sub(r"(#|//)\s.*", "", line).split()) for line in text.splitlines()) if line]


def expect_in_a_file(text, folder, ending):
    files = [*folder.glob(f"*.{ending}"), *folder.glob(f"apps/scenes/*.{ending}")]
    if any(set(bare(text)) <= set(bare(file.read_text())) for file in files):
        return
    for file in folder.glob(f"parts/*.{ending}"):
        if set(bare(text)) <= set(bare(file.read_text())):
            run(f"signorini solve parts/{file.name}\n", folder)
            return
    if any(set(bare(text)) <= set(bare(file.read_text())) for file in source.glob(f"tests/docs/plugin/*.{ending}")):
        return
    sys.exit(f"no *.{ending} has all the lines of\n{text}")


with tempfile.TemporaryDirectory() as made:
    folder, output = pathlib.Path(made), ""
    shutil.copytree(source / "apps/scenes", folder / "apps/scenes", ignore=shutil.ignore_patterns("pictures"))
    shutil.copytree(source / "tests/docs/scenes", folder / "parts")
    if built := os.environ.get("GUIDE_BUILD"):
        (folder / "build").symlink_to(built)
    mesh = folder / "apps/scenes/lever.msh"
    kept = mesh.read_bytes()
    for kind, text in blocks:
        if kind == "sh":
            output = run(text, folder)
            mesh.write_bytes(kept)  # the figures are those of this one
        elif kind == "text" and output is not None:
            expect_shown(text, output)
        elif kind in ("toml", "gmsh") or (kind == "cpp" and kind in kinds):
            expect_in_a_file(text, folder, {"gmsh": "geo"}.get(kind, kind))

if kinds:
    sys.exit()
known = " ".join(text for _, text in blocks)
for link in re.findall(r"\]\(((?:measured|theory)/\w+\.md)", page):
    known += (source / "docs" / link).read_text() if (source / "docs" / link).exists() else ""
known = [value.lstrip("-") for value in number.findall(known)]
between = re.sub(r"^```.*?^```$|!?\[[^]]*\]\([^)]*\)|`[^`]*`|Gmsh [\d.]+", "", page, flags=re.M | re.S)
for figure in re.findall(r"\d+\.\d+", between):
    if not any(rounds_to(value, figure) for value in known):
        sys.exit(f"where does {figure} come from?")
