#!/usr/bin/env python3
"""Writes the meshes of the cases that no shape of a scene makes: parts of rings. They are coarse; scenes refine them."""
import math
import pathlib

here = pathlib.Path(__file__).resolve().parent


def ring(name, radii, angles, across, along, closed=False):
    """Triangles between two radii and two angles in degrees; parts: inner, outer, start, end."""
    (r0, r1), (a0, a1) = radii, [math.radians(a) for a in angles]
    columns = along if closed else along + 1
    points = [(r * math.cos(a), r * math.sin(a))
              for k in range(columns) for a in [a0 + (a1 - a0) * k / along]
              for r in [r0 * (r1 / r0) ** (j / across) if r0 > 0 else r1 * j / across for j in range(across + 1)]]
    def node(k, j):
        return k % columns * (across + 1) + j + 1
    lines = [(1, node(k, 0), node(k + 1, 0)) for k in range(along)] + [
        (2, node(k, across), node(k + 1, across)) for k in range(along)]
    if not closed:
        lines += [(3, node(0, j), node(0, j + 1)) for j in range(across)]
        lines += [(4, node(along, j), node(along, j + 1)) for j in range(across)]
    faces = []
    for k in range(along):
        for j in range(across):
            a, b, c, d = node(k, j), node(k, j + 1), node(k + 1, j + 1), node(k + 1, j)
            faces += [(a, b, c), (a, c, d)] if (k + j) % 2 else [(a, b, d), (b, c, d)]
    parts = ["inner", "outer"] + ([] if closed else ["start", "end"])
    text = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(parts) + 1)]
    text += [f'1 {k + 1} "{part}"' for k, part in enumerate(parts)] + ['2 9 "inside"', "$EndPhysicalNames", "$Nodes"]
    text += [str(len(points))] + [f"{k + 1} {x:.16g} {y:.16g} 0" for k, (x, y) in enumerate(points)]
    text += ["$EndNodes", "$Elements", str(len(lines) + len(faces))]
    text += [f"{k + 1} 1 2 {part} {part} {a} {b}" for k, (part, a, b) in enumerate(lines)]
    text += [f"{len(lines) + k + 1} 2 2 9 9 {a} {b} {c}" for k, (a, b, c) in enumerate(faces)]
    (here / f"{name}.msh").write_text("\n".join(text + ["$EndElements", ""]))


ring("belt", (1, 1.02), (0, 180), 1, 90)
ring("plate_with_hole", (1, 20), (0, 360), 12, 48, closed=True)
ring("pin", (0.2, 0.999), (0, 360), 6, 48, closed=True)
ring("pin_that_fits", (0.2, 1), (0, 360), 6, 40, closed=True)
ring("half_ring", (0.975, 1.025), (-90, 90), 1, 24)
ring("inner_shell", (20, 30), (0, 90), 2, 6)
ring("outer_shell", (30, 40), (0, 90), 2, 8)


def ball(name, levels, height):
    """A sphere of radius 1 in triangles, its centre at a height: an icosahedron whose edges are halved."""
    g = (1 + 5 ** 0.5) / 2
    points = [(x, y, 0) for y in (-g, g) for x in (-1, 1)]
    points = [(a, b, c) for a, b, c in points] + [(c, a, b) for a, b, c in points] + [(b, c, a) for a, b, c in points]
    def unit(p):
        return tuple(x / math.hypot(*p) for x in p)
    points = [unit(p) for p in points]
    near = 1.01 * min(math.dist(points[0], p) for p in points[1:])
    def outward(a, b, c):
        u, v, w = points[a], points[b], points[c]
        turned = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                  + u[2] * (v[0] * w[1] - v[1] * w[0]))
        return (a, b, c) if turned > 0 else (a, c, b)
    faces = [outward(a, b, c) for a in range(12) for b in range(a) for c in range(b)
             if max(math.dist(points[p], points[q]) for p, q in ((a, b), (b, c), (a, c))) < near]
    for _ in range(levels):
        middles, finer = {}, []
        def middle(a, b):
            key = min(a, b), max(a, b)
            if key not in middles:
                middles[key] = len(points)
                points.append(unit([x + y for x, y in zip(points[a], points[b])]))
            return middles[key]
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    text = ["OFF", f"{len(points)} {len(faces)} 0"] + [f"{x:.9g} {y:.9g} {z + height:.9g}" for x, y, z in points]
    (here / f"{name}.off").write_text("\n".join(text + [f"3 {a} {b} {c}" for a, b, c in faces] + [""]))


ball("ball_above", 3, 1)
