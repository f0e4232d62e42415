"""Reads the VTU files that `signorini solve` writes: one piece, arrays ascii, or packed by zlib and appended or in
base64."""
from __future__ import annotations

import base64
import re
import xml.etree.ElementTree as ElementTree
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

_types = {"Float64": "f8", "Float32": "f4", "Int64": "i8", "Int32": "i4", "Int16": "i2", "Int8": "i1", "UInt64": "u8",
          "UInt32": "u4", "UInt16": "u2", "UInt8": "u1"}


@dataclass(frozen=True)
class Mesh:
    """Points (three coordinates each), cells as VTK has them, and values."""

    points: Array
    connectivity: Array
    offsets: Array
    types: Array
    point_data: dict[str, Array]
    cell_data: dict[str, Array]


def read_vtu(file: str | Path) -> Mesh:
    """Raises ValueError where the file is no such VTU file."""
    try:
        return _File(Path(file).read_bytes()).mesh()
    except (ElementTree.ParseError, zlib.error, KeyError, IndexError, ValueError) as error:
        raise ValueError(f"{file}: is no VTU file that can be read here: {error!r}") from error


class _File:
    def __init__(self, content: bytes) -> None:
        begin = re.search(rb"<AppendedData[^>]*>\s*_", content)
        self._appended, self._raw = memoryview(b""), True
        if begin:  # numbers are no XML
            end = content.rindex(b"</AppendedData>")
            self._appended = memoryview(content)[begin.end():end]
            self._raw = b"base64" not in begin.group()
            content = content[:begin.start()] + content[end + len(b"</AppendedData>"):]
        self._root = ElementTree.fromstring(content)
        self._order = "<" if self._root.get("byte_order") == "LittleEndian" else ">"
        self._header = np.dtype(self._order + _types[self._root.get("header_type", "UInt32")])
        self._packed = self._root.get("compressor") is not None

    def mesh(self) -> Mesh:
        pieces = self._root.findall("./UnstructuredGrid/Piece")
        if len(pieces) != 1:
            raise ValueError(f"found {len(pieces)} pieces, expected 1")
        cells = self._arrays(pieces[0], "Cells")
        return Mesh(points=self._arrays(pieces[0], "Points")["Points"], connectivity=cells["connectivity"],
                    offsets=cells["offsets"], types=cells["types"], point_data=self._arrays(pieces[0], "PointData"),
                    cell_data=self._arrays(pieces[0], "CellData"))

    def _arrays(self, piece: ElementTree.Element, group: str) -> dict[str, Array]:
        return {node.get("Name", ""): self._array(node) for node in piece.findall(f"{group}/DataArray")}

    def _array(self, node: ElementTree.Element) -> Array:
        of = np.dtype(self._order + _types[node.attrib["type"]])
        text = (node.text or "").strip()
        if node.get("format") == "ascii":
            values: Array = np.array(text.split(), dtype=of)
        elif node.get("format") == "appended":
            values = np.frombuffer(self._numbers(self._appended[int(node.attrib["offset"]):], self._raw), dtype=of)
        else:
            values = np.frombuffer(self._numbers(text.encode(), raw=False), dtype=of)
        components = int(node.get("NumberOfComponents", "1"))
        return values.astype(of.newbyteorder("="), copy=False).reshape((-1, components) if components > 1 else -1)

    def _numbers(self, source: bytes | memoryview, raw: bool) -> bytes | memoryview:
        """The bytes of an array that begins where `source` does."""
        size = self._header.itemsize
        if not self._packed:
            data = source if raw else _decoded(source)
            length = int(np.frombuffer(data[:size], self._header)[0])
            return data[size:size + length]
        if raw:
            count = int(np.frombuffer(source[:size], self._header)[0])
            header = np.frombuffer(source[:(3 + count) * size], self._header)
            data = source[header.nbytes:]
        else:  # header and blocks are encoded each by themselves
            count = int(np.frombuffer(base64.b64decode(source[:_encoded(size)])[:size], self._header)[0])
            end = _encoded((3 + count) * size)
            header = np.frombuffer(base64.b64decode(source[:end])[:(3 + count) * size], self._header)
            data = _decoded(source[end:])
        ends = np.cumsum(header[3:].astype(np.int64)).tolist()
        return b"".join(zlib.decompress(data[begin:end]) for begin, end in zip([0, *ends], ends))


def _encoded(size: int) -> int:
    """How long so many bytes are in base64, up to the padding."""
    return (size + 2) // 3 * 4


def _decoded(text: bytes | memoryview) -> bytes:
    """Of the base64 that `text` begins with."""
    found = re.match(rb"[A-Za-z0-9+/\s]*={0,2}", text)
    return base64.b64decode(found.group() if found else b"")
