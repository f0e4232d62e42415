"""Prints a table of docs/measured/stability.md: stability.py TABLE [--map FILE]   (the functions below)

What a solve meets gets harder from row to row, and the mesh finer from column to column: cycles, or the way it failed.
With --map the table becomes a picture as well, an SVG file: colours are cycles.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy
import scipy.io
import scipy.sparse

from tables import box, cycles, head, held, plane, program, row, solved

limit = 60  # seconds of a solve
pictures = []


def sweep(parameter, values, sizes, scene, keys=lambda size: {"refine.uniform": size}, others=("pdas",)):
    """A row per value. `scene` makes the text of one; the last columns are other methods on the last size but one."""
    middle = sizes[max(len(sizes) - 2, 0)]
    counts, names = [], []
    for value in values:
        reports = [solved(scene(value), keys(size), limit) for size in sizes]
        if not names:
            names = [f"{report.get('unknowns', size)} unknowns" for report, size in zip(reports, sizes)]
            head(parameter, *names, *(f"`{method}`, {names[sizes.index(middle)]}" for method in others))
        beside = [solved(scene(value), {**keys(middle), "solver.method": method}, limit) for method in others]
        row(f"{value:g}" if isinstance(value, (int, float)) else value,
            *map(outcome, reports), *map(steps, beside))
        counts.append([None if report["exit"] else report["iterations"] for report in reports])
    pictures.append((parameter, values, names, counts))


def outcome(report):
    return cycles(report) if "stages" in report or not report["exit"] else f"exit {report['exit']}"


def steps(report):
    """Of a method that was asked for."""
    return f"exit {report['exit']}" if report["exit"] else report["iterations"]


def membrane(cells, load, lower, more=""):
    return (box("m", 2, [1, 1], cells).replace("young = 1\npoisson = 0.3\n", 'equation = "diffusion"\n' + more)
            + held("m", "boundary", [0]) + f'[[load]]\nbody = "m"\nvalue = [{load}]\n'
            + f'[[obstacle]]\ntype = "scalar"\nbody = "m"\nlower = "{lower}"\n')


# --- the tables


def poisson():
    """A block of rubber pressed on a plane, quadratic elements."""
    def scene(nu):
        text = box("b", 2, [2, 1], [8, 4]).replace("poisson = 0.3", f"poisson = {nu}").replace("order = 1", "order = 2")
        return text + held("b", "top", [0, -0.02]) + plane("b", "bottom", [0, 0], [0, 1])
    sweep("Poisson's ratio", [0.3, 0.45, 0.49, 0.499, 0.4999, 0.49999], [0, 1, 2, 3], scene, others=("newton",))


def jumps():
    """A membrane of strips, the second, fourth... stiffer by this factor."""
    sweep("factor", [1, 1e2, 1e4, 1e6, 1e8, 1e10], [1, 2, 3, 4],
          lambda by: membrane([8, 8], -8, "-0.1", f'diffusion = "abs(sin(4 * 3.141592653589793 * x)) == 2 ? 1 : '
                              f'(sin(8 * 3.141592653589793 * x) > 0 ? 1 : {by:g})"\n'), others=("monotone", "pdas"))


def stretched():
    """A membrane whose cells are longer than wide by this factor."""
    def scene(by):
        text = membrane([8, 8], -8, "-0.1")
        return text.replace("to = [1, 1]", f"to = [{by:g}, 1]")
    sweep("length over width", [1, 10, 100, 1e3, 1e4, 1e5], [1, 2, 3, 4], scene)


def stretched_block():
    """An elastic block, likewise, pressed on a plane in the middle of its top."""
    def scene(by):
        text = box("b", 2, [by, 1], [16, 4]) + held("b", "left", [0, 0]).replace("[0, 0]", '[0, "free"]')
        text += f'[[load]]\nbody = "b"\non = "top"\nvalue = [0, "-0.001 * (abs(x - {by / 2:g}) < {by / 8:g})"]\n'
        return text + plane("b", "bottom", [0, 0], [0, 1])
    sweep("length over width", [1, 10, 100, 1e3], [0, 1, 2, 3], scene)


def friction():
    """A block pressed down and drawn sideways, with this coefficient of Coulomb friction."""
    def scene(mu):
        text = box("b", 2, [2, 1], [8, 4]) + held("b", "top", [0.01, -0.02]) + plane("b", "bottom", [0, 0], [0, 1])
        return text.replace('type = "contact"', f'type = "coulomb"\nfriction = {mu}')
    sweep("coefficient", [0, 0.1, 0.3, 0.6, 1, 2, 5], [1, 2, 3, 4], scene, others=("newton",))


def two_bodies():
    """A block on another one that is stiffer by this factor."""
    def scene(by):
        upper = box("upper", 2, [1, 1], [6, 6]).replace("from = [0, 0]", "from = [0, 0]")
        lower = box("lower", 2, [1.5, 0], [10, 5]).replace("from = [0, 0]", "from = [-0.5, -1]")
        lower = lower.replace("young = 1", f"young = {by:g}")
        pair = '[[obstacle]]\ntype = "elastic"\nbody = "upper"\non = "bottom"\nother = "lower"\nother_on = "top"\n'
        return upper + lower + held("upper", "top", [0, -0.01]) + held("lower", "bottom", [0, 0]) + pair
    sweep("factor", [1e-10, 1e-5, 1e-2, 1, 1e2, 1e5, 1e10], [0, 1, 2, 3], scene)


def biactive():
    """A membrane that rests without a force on this part of what it could."""
    psi = "-(1 - x^2) * (1 - y^2)"
    def scene(part):
        text = membrane([4, 4], f'"-2 * (2 - x^2 - y^2) * (1 + ({part} - 1) * (x > 0))"', psi)
        return text.replace("from = [0, 0]", "from = [-1, -1]")
    sweep("part of the load where x > 0", [0, 0.5, 0.9, 0.999, 1, 1.001], [3, 4, 5, 6], scene)


def patches():
    """A membrane on an obstacle with so many hills in each direction."""
    sweep("hills", [1, 4, 16, 32, 64], [2, 3, 4, 5],
          lambda n: membrane([8, 8], -40, f"-0.05 + 0.02 * sin({n} * 3.141592653589793 * x)"
                             f" * sin({n} * 3.141592653589793 * y)"))


def spike():
    """A membrane on a needle of this width."""
    sweep("width", [0.3, 0.1, 0.03, 0.01, 0.001], [2, 3, 4, 5],
          lambda w: membrane([8, 8], -4, f"-0.3 + 0.5 * exp(-((x - 0.5)^2 + (y - 0.5)^2) / {w}^2)"))


def step():
    """A membrane on an obstacle that jumps by this height."""
    sweep("height", [0.01, 0.1, 1, 10, 1000], [2, 3, 4, 5],
          lambda h: membrane([8, 8], -4, f"x < 0.4 ? -0.1 : -0.1 - {h}"))


def narrow():
    """A membrane between two obstacles that are so far apart; in the last row they cross."""
    sweep("distance", [1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 0, -1e-3], [2, 3, 4, 5],
          lambda d: membrane([8, 8], -4, "-0.1 * sin(3.141592653589793 * x) * sin(3.141592653589793 * y)")
          + f'upper = "-0.1 * sin(3.141592653589793 * x) * sin(3.141592653589793 * y) + {d}"\n', others=("pdas",))


def loose():
    """A block that nothing holds but the plane under it and this part of its weight sideways, against a wall."""
    def scene(part):
        text = box("b", 2, [1, 1], [4, 4]) + f'[[load]]\nbody = "b"\nvalue = [{-0.01 * part:g}, -0.01]\n'
        return text + plane("b", "bottom", [0, 0], [0, 1]) + plane("b", "left", [-0.001, 0], [1, 0])
    sweep("part", [1, 1e-2, 1e-4, 1e-6, 0], [1, 2, 3, 4], scene, others=())


# --- matrices


def qp(matrix, load, lower, keys={}):
    """The report of a solve without a mesh."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        scipy.io.mmwrite(path / "A.mtx", scipy.sparse.coo_matrix(matrix), symmetry="general", precision=17)
        for name, vector in (("b", load), ("l", lower)):
            scipy.io.mmwrite(path / f"{name}.mtx", numpy.asarray(vector).reshape(-1, 1), precision=17)
        settings = [part for key, value in keys.items() for part in ("--set", f"{key}={value}")]
        try:
            ended = subprocess.run([program, "qp", path / "A.mtx", path / "b.mtx", "--lower", path / "l.mtx", "--report",
                                    path / "report.json", *settings], capture_output=True, text=True, timeout=limit)
        except subprocess.TimeoutExpired:
            return {"exit": f"none after {limit} s"}
        file = path / "report.json"
        return (json.loads(file.read_text()) if file.exists() else {}) | {"exit": ended.returncode}


def matrices(parameter, values, sizes, problem, others=("pdas",)):
    head(parameter, *(f"{size} unknowns" for size in sizes), *(f"`{method}`, {sizes[-1]} unknowns" for method in others))
    counts = []
    for value in values:
        reports = [qp(*problem(value, size)) for size in sizes]
        beside = [qp(*problem(value, sizes[-1]), {"solver.method": method}) for method in others]
        row(f"{value:g}" if isinstance(value, (int, float)) else value, *map(outcome, reports), *map(steps, beside))
        counts.append([None if report["exit"] else report["iterations"] for report in reports])
    pictures.append((parameter, values, [f"{size} unknowns" for size in sizes], counts))


def conditions():
    """Dense matrices with random eigenvectors, and eigenvalues from 1 to this condition, evenly in their logarithms."""
    def problem(condition, size):
        random = numpy.random.default_rng(size)
        Q, _ = numpy.linalg.qr(random.standard_normal((size, size)))
        A = Q * numpy.logspace(0, math.log10(condition), size) @ Q.T
        return (A + A.T) / 2, random.standard_normal(size), numpy.zeros(size)
    matrices("condition", [1e2, 1e4, 1e6, 1e8, 1e10, 1e12], [100, 300], problem)


def cutest():
    """Bound-constrained problems of CUTEst by their formulas."""
    def chain(size, diagonals):
        return scipy.sparse.diags([value * numpy.ones(size - abs(k)) for k, value in diagonals.items()],
                                  list(diagonals))
    def problem(name, size):
        if name == "PENTDI":
            load = numpy.zeros(size)
            load[0], load[size // 2 - 1], load[size // 2], load[-1] = -3, 1, -1, 3
            return chain(size, {-2: 1, -1: -4, 0: 11, 1: -4, 2: 1}), load, numpy.zeros(size)
        if name == "BIGGSB1":
            A = scipy.sparse.lil_matrix(chain(size, {-1: -2, 0: 4, 1: -2}))
            load = numpy.zeros(size)
            load[0] = 2
            return A, load, numpy.zeros(size)
        A = scipy.sparse.lil_matrix(chain(size, {-2: 1, -1: -4, 0: 6, 1: -4, 2: 1}))  # a beam held at both ends
        return A, -numpy.ones(size) / size**4, -5e-4 * numpy.ones(size)
    matrices("problem", ["PENTDI", "BIGGSB1", "beam on a plane"], [100, 1000, 5000], problem)


def plates():
    """A clamped plate over a plane, the stencil of 13 points, with this distance of the plane (parts of what it sags)."""
    def problem(part, size):
        n = math.isqrt(size)
        T = scipy.sparse.diags([-numpy.ones(n - 1), 2 * numpy.ones(n), -numpy.ones(n - 1)], [-1, 0, 1])
        I = scipy.sparse.identity(n)
        L = scipy.sparse.kron(T, I) + scipy.sparse.kron(I, T)
        A = (L @ L).tolil()
        h = 1 / (n + 1)
        return A.tocsr(), -numpy.full(n * n, h**4), numpy.full(n * n, -0.0041 * part)
    matrices("distance", [0.1, 0.5, 0.9], [32**2, 64**2, 128**2], problem)


def draw(file):
    """The map: a column of squares per size, a row per value."""
    parameter, values, sizes, counts = pictures[0]
    side, left, top = 60, 150, 40
    parts = []
    for r, line in enumerate(counts):
        parts.append(f'<text x="{left - 8}" y="{top + side * (r + 0.6)}" text-anchor="end">{values[r]}</text>')
        for c, count in enumerate(line):
            shade = "#444" if count is None else f"hsl({max(0, 130 - 1.3 * min(count, 100)):.0f}, 60%, 60%)"
            x, y = left + side * c, top + side * r
            parts.append(f'<rect x="{x}" y="{y}" width="{side}" height="{side}" fill="{shade}" stroke="white"/>')
            parts.append(f'<text x="{x + side / 2}" y="{y + 0.6 * side}" text-anchor="middle">{count or "-"}</text>')
    for c, name in enumerate(sizes):
        parts.append(f'<text x="{left + side * (c + 0.5)}" y="{top - 8}" text-anchor="middle" font-size="10">{name.split()[0]}</text>')
    width, height = left + side * len(sizes) + 10, top + side * len(values) + 10
    pathlib.Path(file).write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
                                  'font-family="sans-serif" font-size="14">'
                                  f'<text x="8" y="{top - 8}">{parameter}</text>' + "".join(parts) + "</svg>\n")


def main(arguments):
    tables = [poisson, jumps, stretched, stretched_block, friction, two_bodies, biactive, patches, spike, step, narrow, loose,
              conditions, cutest, plates]
    chosen = [table for table in tables if table.__name__ == (arguments or [""])[0]]
    if not chosen or len(arguments) not in (1, 3) or (len(arguments) == 3 and arguments[1] != "--map"):
        sys.exit(f"{__doc__}\nTABLE: {', '.join(table.__name__ for table in tables)}")
    if not program:
        sys.exit("stability.py: the program is not built")
    chosen[0]()
    if len(arguments) == 3:
        draw(arguments[2])


main(sys.argv[1:])
