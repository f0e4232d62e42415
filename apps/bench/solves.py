"""Prints a table of docs/measured that is made of solves of scenes: solves.py TABLE   (the functions below)

What is solved are scenes of apps/scenes with other keys, and those made of the parts in tables.py.
"""
import json
import math
import sys

from tables import box, cycles, head, held, named, plane, program, row, solved


def off(value, exact, digits=2):
    """The relative error in per cent."""
    error = 100 * (value / exact - 1)
    return f"{error:+.{digits}g} %" if abs(error) > 1e-9 else "0"


# --- the tables


def lever():
    """The round nose of the lever against Hertz."""
    head("`refine.uniform`", "unknowns", "largest pressure off by", "with `geometry = \"facets\"`", "force, facets over smooth")
    for refinements in (0, 1, 2):
        keys = {"body.0.order": 1, "refine.uniform": refinements}
        reports = [solved("lever", keys), solved("lever", {**keys, "body.0.geometry": "facets"})]
        contacts = [report["contact"][0] for report in reports]
        hertz = [math.sqrt(c["force"][1] * 2800 / (1 - 0.35**2) / (math.pi * 10)) for c in contacts]
        row(refinements, reports[0]["unknowns"], *[off(c["max_pressure"], h) for c, h in zip(contacts, hertz)],
            off(contacts[1]["force"][1], contacts[0]["force"][1]))


def membrane():
    """Linear and quadratic elements for a membrane over a hemisphere; the head of the scene has the exact values."""
    a, A, B = 0.697965148223374, 0.680259411891719, 0.471519893402112
    head("unknowns", "`body.0.order`, `refine.uniform`", "cycles", "value at r = 1", "area", "force")
    for refinements in (4, 5, 6):
        for order in (1, 2):
            keys = {"body.0.order": order, "refine.uniform": refinements + 1 - order}
            report = solved("obstacle_radial_2d", keys)
            contact, value = report["contact"][0], report["probes"][0]["value"]
            row(report["unknowns"], f"{order}, {refinements + 1 - order}", cycles(report), f"{value / B - 1:+.1e}",
                off(contact["area"], math.pi * a * a), f"{contact['force'][0] / (2 * math.pi * A) - 1:+.1e}")


def ball_on_block():
    """Radius and largest pressure over those of Hertz for the force that was found."""
    head("`refine.uniform`", "unknowns", "cycles", "contact radius", "largest pressure")
    for refinements in (1, 2, 3):
        report = solved("ball_on_block", {"body.0.order": 1, "refine.uniform": refinements})
        contact = report["contact"][0]
        force, modulus = math.hypot(*contact["force"]), 1 / (2 * (1 - 0.3**2))
        radius = (3 * force / (4 * modulus)) ** (1 / 3)
        row(refinements, report["unknowns"], cycles(report), f"{contact['radius'] / radius:.3f}",
            f"{contact['max_pressure'] / (3 * force / (2 * math.pi * radius**2)):.3f}")


def incline():
    """A block that only friction holds, tan 20 degrees = 0.36397."""
    head("friction", "cycles", "nodes that slip", "nodes that stick")
    for friction in (0.3, 0.363, 0.3639, 0.364, 0.365, 0.37, 0.4, 0.6, 1, 2, 5):
        report = solved("block_on_incline_2d", {"body.0.order": 1, "refine.uniform": 2, "obstacle.0.friction": friction})
        contact = report.get("contact", [{}])[0]
        row(friction, cycles(report), contact.get("slip_nodes", ""), contact.get("stick_nodes", ""))


def given_friction():
    """Blocks with friction of a given bound, beside the same without."""
    head("", "`refine.uniform`", "unknowns", "cycles", "without friction", "`time.solve`, over that without friction")
    for dimension, all_refinements in (2, (3, 5, 7)), (3, (2, 3, 4)):
        for refinements in all_refinements:
            scene, keys = f"block_with_friction_{dimension}d", {"body.0.order": 1, "refine.uniform": refinements}
            runs = [(solved(scene, keys), solved(scene, {**keys, "obstacle.0.bound": 0})) for _ in range(3)]
            ratio = min(run[0]["time"]["solve"] for run in runs) / min(run[1]["time"]["solve"] for run in runs)
            row(f"{dimension}D", refinements, runs[0][0]["unknowns"], cycles(runs[0][0]), cycles(runs[0][1]), f"{ratio:.1f}")


def slender():
    """Cantilevers that come to rest on their tips or on a bed."""
    head("length", "cells", "`refine.uniform`", "unknowns", "tip, cycles", "bed, cycles")
    for length, *cells, refinements in (
            (10, 10, 1, 3), (10, 10, 1, 5), (30, 30, 1, 3), (100, 100, 1, 3), (100, 100, 1, 5), (100, 25, 4, 2),
            (300, 300, 1, 3), (300, 300, 1, 4), (1000, 1000, 1, 3), (1000, 250, 1, 3), (1000, 100, 4, 2),
            (10, 10, 1, 1, 2), (100, 100, 1, 1, 2), (300, 300, 1, 1, 2), (300, 150, 1, 1, 2), (1000, 1000, 1, 1, 1)):
        D = len(cells)
        zeros, up = [0] * D, [0] * (D - 1) + [1]
        reports = [solved(f"""
{box("beam", D, [length] + [1] * (D - 1), cells)}
{held("beam", "left", zeros)}
[[load]]
body = "beam"
on = "top"
value = {json.dumps([0] * (D - 1) + [f"-{bent} / (1.5 * {length}^4)"])}
{plane("beam", "bottom", [0] * (D - 1) + [-0.5], up)}
[refine]
uniform = {refinements}
""") for bent in (1, 50)]
        row(length, " × ".join(map(str, cells)), refinements, reports[0]["unknowns"], *map(cycles, reports))


def coarsening():
    """Classical levels and those by aggregation, on bodies without a hierarchy of meshes."""
    beam = f"""
{box("beam", 3, [10, 1, 1], [80, 8, 8])}
{held("beam", "left", [0, 0, 0])}
[[load]]
body = "beam"
value = [0, 0, -1e-4]
{plane("beam", "bottom", [0, 0, -0.5], [0, 0, 1])}"""
    strip = f"""
{box("strip", 2, [100, 1], [64, 64])}
{held("strip", "left", [0, 0])}
[[load]]
body = "strip"
value = [0, -1e-6]
{plane("strip", "bottom", [0, -0.5], [0, 1])}"""
    coarse = {"body.0.order": 1, "refine.uniform": 0}
    head("body", "unknowns", "classical: cycles", "rate", "aggregation: cycles", "rate")
    for name, scene, keys in (
            ("beam, 10 × 1 × 1 of 80 × 8 × 8 cells", beam, {}), ("strip, 100 × 1 of 64 × 64 cells", strip, {}),
            ("`cube_on_bump.toml`, 32 cells along an edge", "cube_on_bump", {**coarse, "body.0.cells": "[32,32,32]"}),
            ("`ball_on_plane.toml`, `size = 0.08`", "ball_on_plane", {**coarse, "body.0.size": 0.08})):
        reports = [solved(scene, {**keys, "solver.coarsening": way}) for way in ("classical", "aggregation")]
        row(name, reports[0]["unknowns"], *[cell for report in reports for cell in (
            cycles(report), f"{report['rate']:.2f}" if "(" not in cycles(report) else "")])


def stretched():
    """Cells a times as long as wide: levels of the coarser meshes, and those of `auto`."""
    head("body", "levels", *[f"a = {a}" for a in (1, 4, 16, 64, 128, 1000)])
    for name, elastic, sides, count in (
            ("membrane", False, "a1", 32), ("long box, scalar", False, "a11", 8), ("flat box, scalar", False, "aa1", 8),
            ("strip", True, "a1", 16), ("bar", True, "a11", 5), ("plate", True, "aa1", 5)):
        for levels in ("meshes", "auto"):
            counts = []
            for a in (1, 4, 16, 64, 128, 1000):
                D = len(sides)
                body = box("body", D, [a if side == "a" else 1 for side in sides], [count] * D)
                if elastic:
                    body += held("body", "top", [0] * D) + plane("body", "bottom", [0] * D, [0] * (D - 1) + [1])
                    load = [0] * (D - 1) + [-1e-4 / a**3]
                else:
                    body = body.replace("young = 1\npoisson = 0.3", 'equation = "diffusion"') + held("body", "boundary", [0])
                    body += f'[[obstacle]]\ntype = "scalar"\nbody = "body"\nlower = {-0.05 if D == 2 else -0.03}\n'
                    load = [-1]
                body += f'[[load]]\nbody = "body"\nvalue = {load}\n[refine]\nuniform = {3 if D == 2 else 2}\n'
                counts.append(cycles(solved(body, {"solver.hierarchy": levels})))
            row(name, f"`{levels}`", *counts)


def threads():
    """The cycles of one thread over those of two: medians of the cycles, the best of three runs in turns."""
    head("scene", "unknowns", "speed-up of two threads")
    for scene, keys in (("obstacle_radial_2d", {"refine.uniform": 8}), ("obstacle_cube_3d", {"refine.uniform": 4}),
                        ("cube_on_bump", {"body.0.order": 1, "refine.uniform": 3})):
        best = {}
        for _ in range(3):
            for count in (1, 2):
                report = solved(scene, {**keys, "solver.threads": count})
                spent = sorted(sum(level["seconds"] for level in cycle["levels"]) for cycle in report["history"])
                best[count] = min(best.get(count, math.inf), spent[len(spent) // 2])
        row(named(scene, keys), report["unknowns"], f"{best[1] / best[2]:.1f}")


def shares():
    """What a run without output spends where."""
    head("scene", "unknowns", "mesh", "assembly", "set-up", "solve")
    for scene, keys in (("obstacle_radial_2d", {"refine.uniform": 7}),
                        ("signorini_elastic_2d", {"body.0.order": 1, "refine.uniform": 7}),
                        ("ball_on_plane", {"body.0.order": 1, "refine.uniform": 3})):
        report = solved(scene, keys)
        parts = [report["time"][part] for part in ("mesh", "assemble", "setup", "solve")]
        row(named(scene, keys), report["unknowns"], *[f"{100 * part / sum(parts):.0f} %" for part in parts])


def output():
    """Processor time with the file, the pictures or both, beside that without either: the least of five runs in turns."""
    head("scene", "unknowns", "without output", "`solution.vtu`", "pictures", "output over the whole run")
    for scene, keys in (("obstacle_radial_2d", {"refine.uniform": 3}), ("obstacle_radial_2d", {"refine.uniform": 5}),
                        ("obstacle_radial_2d", {"refine.uniform": 4, "body.0.cells": "[20,20]"}),
                        ("obstacle_radial_2d", {"refine.uniform": 7}),
                        ("signorini_elastic_2d", {"body.0.order": 1, "refine.uniform": 7}),
                        ("signorini_elastic_2d", {"refine.uniform": 6}),
                        ("cube_on_bump", {"body.0.order": 1, "refine.uniform": 3}), ("cube_on_bump", {"refine.uniform": 2}),
                        ("ball_on_plane", {"body.0.order": 1, "refine.uniform": 3}), ("ball_on_plane", {"refine.uniform": 2})):
        written = [{}, {"output.vtu": "true"}, {"output.pictures": "true"}, {"output.vtu": "true", "output.pictures": "true"}]
        runs = [[solved(scene, {**keys, **files}) for files in written] for _ in range(5)]
        without, vtu, pictures, both = [min(run[k]["seconds"] for run in runs) for k in range(4)]
        row(named(scene, keys), runs[0][0]["unknowns"], f"{without:.2f} s", f"{vtu - without:.2f} s",
            f"{pictures - without:.2f} s", f"{1 - without / both:.2f}")


def memory():
    """Largest resident size per free unknown of the finest mesh."""
    head("problem", "scene", "unknowns", "MB", "B per unknown", "without files and pictures")
    for name, scene, keys in (("S2", "obstacle_radial_2d", {"refine.uniform": 8}),
                              ("S3", "obstacle_cube_3d", {"refine.uniform": 5}),
                              ("E3", "cube_on_bump", {"body.0.order": 1, "refine.uniform": 4})):
        bare = solved(scene, keys)
        whole = solved(scene, {**keys, "output.vtu": "true", "output.pictures": "true"})
        size = [2**20 * report["peak_memory_mb"] for report in (whole, bare)]
        each = [f"{bytes / bare['unknowns']:.0f}" for bytes in size]
        row(name, named(scene, keys), bare["unknowns"], f"{size[0] / 1e6:.0f}", *each)


tables = [lever, membrane, ball_on_block, incline, given_friction, slender, coarsening, stretched, threads, shares, output,
          memory]
chosen = [table for table in tables if table.__name__ in sys.argv[1:]]
if len(sys.argv) != 2 or not chosen:
    sys.exit(f"{__doc__}\nTABLE: {', '.join(table.__name__ for table in tables)}")
if not program:
    sys.exit("solves.py: the program is not built")
chosen[0]()
