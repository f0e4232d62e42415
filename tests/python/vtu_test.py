"""read_vtu(): the encodings of VTU files."""
import base64
import zlib

import numpy as np
import pytest

import signorini
from signorini.results import StepResult, _counted_cells

points = np.arange(12, dtype=float).reshape(4, 3) / 7
cells = {"connectivity": np.array([0, 1, 2, 1, 2, 3], dtype=np.int32), "offsets": np.array([3, 6], dtype=np.int32),
         "types": np.array([5, 5], dtype=np.uint8)}
names = {"f8": "Float64", "i4": "Int32", "u1": "UInt8"}


def packed(array, compressed, text):
    """As VTK writes an array: header and blocks, perhaps in base64."""
    data = array.tobytes()
    if not compressed:
        both = np.uint64(len(data)).tobytes() + data
        return base64.b64encode(both) if text else both
    blocks = [data[k:k + 16] for k in range(0, len(data), 16)]
    small = [zlib.compress(block) for block in blocks]
    header = np.array([len(blocks), 16, len(data) % 16, *map(len, small)], dtype=np.uint64).tobytes()
    return base64.b64encode(header) + base64.b64encode(b"".join(small)) if text else header + b"".join(small)


def file_of(kind, compressed):
    appended, text = b"", kind != "raw"

    def array(name, values):
        nonlocal appended
        head = (f'<DataArray type="{names[values.dtype.str[1:]]}" Name="{name}" '
                f'NumberOfComponents="{values.shape[1] if values.ndim > 1 else 1}" format="')
        if kind == "ascii":
            return head + 'ascii">' + " ".join(map(repr, values.ravel().tolist())) + "</DataArray>"
        data = packed(values, compressed, text)
        if kind == "binary":
            return head + 'binary">\n  ' + data.decode() + "\n</DataArray>"
        offset, appended = len(appended), appended + data
        return head + f'appended" offset="{offset}"/>'

    compressor = ' compressor="vtkZLibDataCompressor"' if compressed else ""
    body = (f'<VTKFile type="UnstructuredGrid" byte_order="LittleEndian" header_type="UInt64"{compressor}>'
            f'<UnstructuredGrid><Piece><PointData>{array("u", points[:, 0].copy())}</PointData><CellData/>'
            f'<Points>{array("Points", points)}</Points>'
            f'<Cells>{"".join(array(*cell) for cell in cells.items())}</Cells></Piece>'
            "</UnstructuredGrid>").encode()
    if kind in ("raw", "base64"):
        body += f'<AppendedData encoding="{kind}">\n_'.encode() + appended + b"\n</AppendedData>"
    return body + b"</VTKFile>"


@pytest.mark.parametrize("compressed", [True, False])
@pytest.mark.parametrize("kind", ["raw", "base64", "binary", "ascii"])
def test_every_encoding_is_read(kind, compressed, tmp_path):
    file = tmp_path / "a.vtu"
    file.write_bytes(file_of(kind, compressed))
    mesh = signorini.read_vtu(file)
    np.testing.assert_array_equal(mesh.points, points)
    np.testing.assert_array_equal(mesh.point_data["u"], points[:, 0])
    for name, values in cells.items():
        np.testing.assert_array_equal(getattr(mesh, name), values)
    assert _counted_cells(mesh).tolist() == [3, 0, 1, 2, 3, 1, 2, 3]
    assert StepResult({"contact": []}, 2, file, None).points.shape == (4, 2)


def test_other_files_are_refused(tmp_path):
    whole = file_of("raw", True)
    for content in (b"", b"no xml", b"<VTKFile/>", whole[:-60], whole.replace(b"Int32", b"Str")):
        (tmp_path / "a.vtu").write_bytes(content)
        with pytest.raises(ValueError, match="a.vtu: is no VTU file"):
            signorini.read_vtu(tmp_path / "a.vtu")
