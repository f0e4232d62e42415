"""Solves the scenes of this folder, and renews what README.md says of them: pictures, unknowns and seconds.

    python3 apps/scenes/overview.py PROGRAM [SCENE...]   (the built signorini; by default all scenes)

Pictures are result.png of the program, at half the size. Seconds are processor time of `signorini solve`, files
included.
"""
import json
import pathlib
import re
import resource
import struct
import subprocess
import sys
import tempfile
import zlib

folder = pathlib.Path(__file__).parent


def unfilter(kind, row, above):
    """A row of an RGB picture as PNG stores it."""
    for i in range(len(row)):
        left, up = row[i - 3] if i > 2 else 0, above[i]
        corner = above[i - 3] if i > 2 else 0
        near = [left, up, corner]
        paeth = min(near, key=lambda v: abs(left + up - corner - v))
        row[i] = row[i] + (0, left, up, (left + up) // 2, paeth)[kind] & 255
    return row


def read_png(data):
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height = struct.unpack_from(">II", data, at + 8)
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += size + 12
    raw, rows, length = zlib.decompress(packed), [bytearray(3 * width)], 3 * width + 1
    for start in range(0, height * length, length):
        rows.append(unfilter(raw[start], bytearray(raw[start + 1:start + length]), rows[-1]))
    return rows[1:]


def halved(rows):
    """The means of 2 by 2 pixels, rounded to eighths of a byte's bits: that packs well."""
    for y in range(0, len(rows) - 1, 2):
        yield bytes(min(255, (rows[y][i] + rows[y][i + 3] + rows[y + 1][i] + rows[y + 1][i + 3] + 16) // 32 * 8)
                    for x in range(0, len(rows[y]) - 5, 6) for i in range(x, x + 3))


def write_png(path, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    head = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    above, body = bytes(len(rows[0])), bytearray()
    for row in rows:  # as differences to the row above
        body += b"\2" + bytes(a - b & 255 for a, b in zip(row, above))
        above = row
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(bytes(body), 9)) +
                     chunk(b"IEND", b""))


def seconds(value):
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}"


def processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


page = folder / "README.md"
text = page.read_text()
for scene in sorted(folder.glob("*.toml")):
    if len(sys.argv) > 2 and scene.stem not in sys.argv[2:]:
        continue
    row = re.compile(rf"^(\|.*\({scene.name}\).*\|)[^|]*\|[^|]*\|$", re.M)
    if not row.search(text):
        sys.exit(f"{page} has no row for {scene.name}")
    with tempfile.TemporaryDirectory() as out:
        before = processor_time()
        subprocess.run([sys.argv[1], "solve", scene, "--out", out, "--quiet"], check=True, stderr=subprocess.DEVNULL)
        took = processor_time() - before
        report = json.loads(pathlib.Path(out, "report.json").read_text())
        rows = read_png(pathlib.Path(out, "result.png").read_bytes())
    write_png(folder / "pictures" / f"{scene.stem}.png", list(halved(rows)))
    text = row.sub(rf"\1 {report['unknowns']} | {seconds(took)} |", text)
    page.write_text(text)
