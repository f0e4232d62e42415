"""Prints what signorini_peers finds on larger sizes as one table: larger_peers.py"""
import pathlib
import re
import subprocess
import sys

source = pathlib.Path(__file__).resolve().parents[2]
runs = ["--problem S2 --nodes 513 1025 2049 --limit 90 --repeat 2", "--problem S3 --nodes 65 129 --limit 60 --repeat 3",
        "--problem S3 --nodes 193 --limit 60 --repeat 1", "--problem E3 E3w --nodes 33 49 65 --limit 90 --repeat 2"]
columns = {"PETSc SNESVI, grid sequencing": "PETSc SNESVI, grid sequencing, multigrid",
           "linear: PETSc CG": "PETSc CG, multigrid", "linear: own CG": "signorini multigrid-CG",
           "black box": "signorini black box"}


def rows(text):
    """Per problem and size: seconds and iterations by solver."""
    for heading, body in re.findall(r"^## (.*)\n((?:(?!## ).*\n?)*)", text, re.M):
        problem, nodes, unknowns = re.match(r"(\w+), (\d+) nodes along an edge: (\d+) unknowns", heading).groups()
        cells = [[cell.strip() for cell in line.split("|")[1:-1]] for line in body.splitlines() if line.startswith("|")]
        found = {cell[0]: (cell[2], cell[4]) for cell in cells[2:] if re.fullmatch(r"[\d.]+", cell[2])}
        own = found["signorini"]
        over = [f"{float(found[name][0]) / float(own[0]):.2f}" if name in found else "" for name in columns.values()]
        yield [problem, nodes, unknowns, own[0], own[1], *over]


def main():
    program = source / "build/peers/bin/signorini_peers"
    if not program.exists():
        return print("larger_peers.py: signorini_peers is not built", file=sys.stderr)
    table = [["problem", "nodes", "unknowns", "signorini, s", "cycles", *columns], ["---"] * (5 + len(columns))]
    for arguments in runs:
        ended = subprocess.run([program, *arguments.split(), "--solver", "multigrid"], stdout=subprocess.PIPE, text=True,
                               check=True)
        table += rows(ended.stdout)
    for line in table:
        print("| " + " | ".join(line) + " |")


if __name__ == "__main__":
    main()
