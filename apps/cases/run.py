#!/usr/bin/env python3
"""Solves contact and obstacle problems whose answers are published, and compares.

    run.py [--quick] [--program FILE] [NAME...]   (names of cases, or the beginning of names; default: all)

cases.toml lists the cases: scenes of this folder, what is read from their results, the target, the difference that the
source or the case explains, the source. Prints a table; ends with 1 where a value lies outside. With --quick cases that
are marked as slow are left out.

Values and targets are expressions of Python in what `names_of` lists: tables of the report and of the scene by their
keys, fields of the nodes in contact, and the functions of the module math.
"""
import argparse
import json
import math
import os
import pathlib
import re
import resource
import struct
import subprocess
import sys
import tempfile
import tomllib
import zlib

here = pathlib.Path(__file__).resolve().parent
source = here.parents[1]


class Table(dict):
    """A table whose keys are attributes; tables below it are, too."""

    def __getattr__(self, key):
        try:
            return wrapped(self[key])
        except KeyError:
            raise AttributeError(f"there is no '{key}' beside {', '.join(self)}") from None


def wrapped(value):
    if isinstance(value, dict):
        return Table(value)
    return [wrapped(item) for item in value] if isinstance(value, list) else value


def with_changes(scene, changes):
    """The scene with what --set changes."""
    for change in changes:
        path, text = change.split("=", 1)
        *way, last = path.split(".")
        at = scene
        for key in way:
            at = at[int(key)] if isinstance(at, list) else at.setdefault(key, {})
        at[int(last) if isinstance(at, list) else last] = tomllib.loads(f"value = {text}")["value"]
    return scene


# --- fields of the VTU file


def arrays_of(file):
    """The arrays of a VTU file with appended data, packed by zlib or not."""
    data = file.read_bytes()
    head, tail = data.split(b'<AppendedData encoding="raw">', 1)
    tail = tail[tail.index(b"_") + 1:]
    packed = b"vtkZLibDataCompressor" in head
    kinds = {"Float64": "d", "Int32": "i", "UInt8": "B", "Int64": "q"}
    found = {}
    for kind, name, components, offset in re.findall(
            r'<DataArray type="(\w+)" Name="([^"]+)" NumberOfComponents="(\d+)" format="appended" offset="(\d+)"',
            head.decode()):
        block = tail[int(offset):]
        if packed:
            count, = struct.unpack_from("<Q", block)
            sizes = struct.unpack_from(f"<{count + 2}Q", block, 8)[2:]
            at, parts = 8 * (3 + count), []
            for size in sizes:
                parts.append(zlib.decompress(block[at:at + size]))
                at += size
            raw = b"".join(parts)
        else:
            size, = struct.unpack_from("<Q", block)
            raw = block[8:8 + size]
        numbers = struct.unpack(f"<{len(raw) // struct.calcsize(kinds[kind])}{kinds[kind]}", raw)
        n = int(components)
        found[name] = list(zip(*[iter(numbers)] * n)) if n > 1 else list(numbers)
    return found


class Fields:
    """What the solution says at nodes, along the first coordinate of what is in contact."""

    def __init__(self, file):
        self.arrays = arrays_of(file)

    def touching(self):
        return [k for k, phase in enumerate(self.arrays["contact"]) if phase > 0]

    def pressure(self, x):
        """Contact pressure at x, linear between nodes of a contact in the plane."""
        points = self.arrays["Points"]
        known = sorted((points[k][0], self.arrays["contact_pressure"][k]) for k in self.touching())
        if not known or not known[0][0] <= x <= known[-1][0]:
            return 0.0
        for (x0, p0), (x1, p1) in zip(known, known[1:]):
            if x0 <= x <= x1 and x1 > x0:
                return p0 + (p1 - p0) * (x - x0) / (x1 - x0)
        return known[0][1]

    def stress(self, *place):
        """Stress at the node that is next to a place: nine components."""
        points = self.arrays["Points"]
        nearest = min(range(len(points)), key=lambda k: math.dist(points[k][:len(place)], place))
        return self.arrays["stress"][nearest]

    def stuck(self):
        """Half the width of what sticks, or its radius: to half way between the last node of it and the next that slips."""
        points, phases = self.arrays["Points"], self.arrays["contact"]
        ends = []
        for side in (-1, 1):
            stick = max((side * points[k][0] for k in self.touching() if phases[k] == 3), default=0.0)
            slip = min((side * points[k][0] for k in self.touching() if phases[k] == 2 and side * points[k][0] > stick),
                       default=stick)
            ends.append((stick + slip) / 2)
        return sum(ends) / 2 if ends[0] > 0 else ends[1]

    def largest_shear(self):
        """The largest half difference of two principal stresses at nodes, in the plane or with the stress across it."""
        most = 0.0
        for s in self.arrays["stress"]:
            middle, radius = (s[0] + s[4]) / 2, math.hypot((s[0] - s[4]) / 2, s[1])
            most = max(most, radius, *(abs(middle + sign * radius - s[8]) / 2 for sign in (-1, 1)))
        return most


# --- functions for targets


def elliptic_k(m):
    """The complete elliptic integral of the first kind of the parameter m = k^2."""
    a, b = 1.0, math.sqrt(1 - m)
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / (2 * a)


def elliptic_e(m):
    """The complete elliptic integral of the second kind of the parameter m = k^2."""
    a, b, c, power, total = 1.0, math.sqrt(1 - m), math.sqrt(m), 0.5, 0.5 * m
    while abs(c) > 1e-15:
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        power *= 2
        total += power * c * c
    return math.pi / (2 * a) * (1 - total)


def root(function, low, high):
    """Where a function changes its sign, by bisection."""
    positive = function(low) > 0
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if (function(middle) > 0) == positive else (low, middle)
    return (low + high) / 2


def integral(function, low, high, count=2000):
    """By Gauss's rule of two points on `count` parts."""
    step = (high - low) / count
    points = [(k + 0.5 + s * 0.5 / math.sqrt(3)) * step + low for k in range(count) for s in (-1, 1)]
    return math.fsum(map(function, points)) * step / 2


def ellipse(A, B, force, modulus):
    """Semi-axes a >= b of Hertz's contact of surfaces at the distance A x^2 + B y^2, A <= B."""
    # Johnson, Contact Mechanics, eq. 4.26: of k = b/a with e^2 = 1 - k^2.
    def ratio(k):
        e = 1 - k * k
        return ((elliptic_e(e) / (k * k) - elliptic_k(e)) / (elliptic_k(e) - elliptic_e(e))) - B / A
    k = root(ratio, 1e-3, 1 - 1e-6) if B > 1.0001 * A else 1.0
    # A x^2 term: A = p0 b (K - E) / (E* a^2 e^2), p0 = 3 F / (2 pi a b).
    e = 1 - k * k
    shape = (elliptic_k(e) - elliptic_e(e)) / e if e > 1e-9 else math.pi / 4
    a = (3 * force * shape / (2 * math.pi * modulus * A)) ** (1 / 3)
    return a, k * a


def names_of(case, scene, report, fields):
    """All that expressions may use."""
    names = {key: value for key, value in vars(math).items() if not key.startswith("_")}
    names |= {"abs": abs, "min": min, "max": max, "sum": sum, "range": range, "K": elliptic_k, "root": root,
              "integral": integral, "ellipse": ellipse}
    names |= {"scene": Table(scene), "report": Table(report), "contact": wrapped(report["contact"]),
              "body": wrapped(scene["body"]), "step": wrapped(report["steps"])}
    probes = {probe["name"]: probe.get("displacement", probe.get("value")) for probe in report["probes"]}
    names["probe"] = probes.__getitem__
    names["reaction"] = [entry["force"] for entry in report["reactions"]]
    names["applied"] = [entry["force"] for entry in report["applied"]]
    if fields:
        names |= {"pressure": fields.pressure, "stuck": fields.stuck, "stress": fields.stress,
                  "largest_shear": fields.largest_shear}
    for name, text in case.get("let", {}).items():
        names[name] = eval(text, names) if isinstance(text, str) else text
    return names


# --- running


def solve(case, program, folder):
    """The exit status, the report and the processor time."""
    changes = [*case.get("set", []), "output.pictures=false", "output.convergence=false",
               f"output.vtu={'true' if case.get('fields') else 'false'}"]
    command = [str(program), "solve", str(here / f"{case['scene']}.toml"), "--out", str(folder), "--quiet"]
    for change in changes:
        command += ["--set", change]
    one_thread = os.environ | {"OMP_NUM_THREADS": "1"}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ended = subprocess.run(command, env=one_thread, capture_output=True, text=True, timeout=600)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
    return ended, seconds


def short(value):
    return f"{value:.6g}" if isinstance(value, (int, float)) else str(value)


def difference(value, target):
    return value - target if target == 0 else value / target - 1


def compared(check, names):
    """What a row says of one value: itself, target, difference, what is allowed; and whether it is within."""
    value, target, within = (eval(str(check[key]), names) for key in ("value", "target", "within"))
    off = difference(value, target)
    good = abs(off) <= within
    percent = f"{off:+.1e}" if target == 0 or abs(off) < 1e-5 else f"{100 * off:+.2g} %"
    allowed = f"{within:.0e}" if target == 0 or within < 1e-4 else f"{100 * within:.2g} %"
    return [check["what"], short(value), short(target), percent + ("" if good else " **outside**"), allowed], good


def rows_of(case, program):
    """Rows of the table, and whether all is within."""
    with tempfile.TemporaryDirectory() as made:
        folder = pathlib.Path(made)
        ended, seconds = solve(case, program, folder)
        wanted = case.get("exit", 0)
        if ended.returncode or wanted:
            good = ended.returncode == wanted
            if not good:
                print(f"{case['name']}: {ended.stderr.strip()}", file=sys.stderr)
            found = [(["exit status", ended.returncode, wanted, "" if good else "**outside**", ""], good)]
        else:
            report = json.loads((folder / "report.json").read_text())
            scene = with_changes(tomllib.loads((here / f"{case['scene']}.toml").read_text()), case.get("set", []))
            fields = Fields(max(folder.glob("solution*.vtu"))) if case.get("fields") else None
            names = names_of(case, scene, report, fields)
            found = [compared(check, names) for check in case["check"]]
    rows = [["", *row, "", ""] for row, good in found]
    rows[0] = [case["name"], *found[0][0], f"{seconds:.1f}", case["source"]]
    return rows, all(good for row, good in found)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="leave out cases that are marked as slow")
    parser.add_argument("--program", type=pathlib.Path, default=source / "build/release/bin/signorini")
    parser.add_argument("names", nargs="*", help="cases, or the beginning of their names")
    chosen = parser.parse_args()
    cases = tomllib.loads((here / "cases.toml").read_text())["case"]
    for case in cases:
        case.setdefault("name", case["scene"])
    for name in chosen.names:
        if not any(case["name"].startswith(name) for case in cases):
            sys.exit(f"cases: no case begins with '{name}'; there are {', '.join(case['name'] for case in cases)}")
    print("| case | what | value | target | difference | allowed | seconds | source |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    outside, notes = [], []
    for case in cases:
        if chosen.names and not case["name"].startswith(tuple(chosen.names)) or chosen.quick and case.get("slow"):
            continue
        try:
            rows, good = rows_of(case, chosen.program)
        except Exception as error:
            rows, good = [[case["name"], f"{type(error).__name__}: {error}", *[""] * 5, case["source"]]], False
        for row in rows:
            print("| " + " | ".join(map(str, row)) + " |", flush=True)
        if not good:
            outside.append(case["name"])
        if "note" in case:
            notes.append(f"- {case['name']}: {case['note']}")
    if notes:
        print("\n" + "\n".join(notes))
    if outside:
        sys.exit(f"cases: outside of what is allowed: {', '.join(outside)}")


if __name__ == "__main__":
    main()
