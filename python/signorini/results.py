"""What a solved scene gives, as arrays."""
from __future__ import annotations

import functools
import json
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from .vtu import Array, Mesh, read_vtu

FloatArray = npt.NDArray[np.float64]


class StepResult:
    """The end of a step. Fields are read from its file when first asked for.

    t: the step parameter; report: its part of report.json; dimension: 2 or 3.
    """

    def __init__(self, report: dict[str, Any], dimension: int, file: Path | None, kept: Any) -> None:
        self.report, self.dimension, self.file = report, dimension, file
        self.t = float(report.get("t", 1.0))
        self._kept = kept  # the folder of the file lasts as long as this

    @functools.cached_property
    def mesh(self) -> Mesh:
        """As in the file: points and vectors have three components."""
        if self.file is None:
            raise ValueError("no fields were written: output.vtu is false in the scene")
        return read_vtu(self.file)

    @property
    def fields(self) -> dict[str, Array]:
        """All values at points by their names in docs/results.md."""
        return self.mesh.point_data

    @property
    def points(self) -> FloatArray:
        """One row per node of the mesh before it is deformed."""
        return self._vectors(self.mesh.points)

    @property
    def displacement(self) -> FloatArray:
        """One row per node; of scalar bodies one value."""
        fields = self.fields
        return self._vectors(fields["displacement"]) if "displacement" in fields else np.asarray(fields["u"])

    @property
    def pressure(self) -> FloatArray:
        """The contact pressure at each node, 0 where there is no contact."""
        return np.asarray(self.fields.get("contact_pressure", np.zeros(len(self.mesh.points))))

    @property
    def forces(self) -> FloatArray:
        """What each obstacle exerts on its body: one row per obstacle."""
        return np.array([contact["force"] for contact in self.report["contact"]], dtype=float)

    @property
    def converged(self) -> bool:
        return bool(self.report["converged"])

    def to_pyvista(self) -> Any:
        """A pyvista.UnstructuredGrid with all fields."""
        import pyvista

        mesh = self.mesh
        grid = pyvista.UnstructuredGrid(_counted_cells(mesh), mesh.types, mesh.points)
        for name, values in mesh.point_data.items():
            grid.point_data[name] = values
        for name, values in mesh.cell_data.items():
            grid.cell_data[name] = values
        return grid

    def to_meshio(self) -> Any:
        """A meshio.Mesh with all fields."""
        import meshio

        mesh = self.mesh
        names = {5: "triangle", 10: "tetra", 22: "triangle6", 24: "tetra10"}
        cells, cell_data = [], {name: [] for name in mesh.cell_data}  # type: ignore[var-annotated]
        for kind in np.unique(mesh.types):
            of_kind = mesh.types == kind
            cells.append((names[int(kind)], _cells(mesh, of_kind)))
            for name, values in mesh.cell_data.items():
                cell_data[name].append(values[of_kind])
        return meshio.Mesh(mesh.points, cells, point_data=mesh.point_data, cell_data=cell_data)

    def _vectors(self, values: Array) -> FloatArray:
        return np.asarray(values[:, :self.dimension])


class SceneResult(StepResult):
    """The last step, and all of them as `steps`.

    report: report.json, see docs/report.md; folder: what the program wrote.
    """

    def __init__(self, folder: Path, kept: tempfile.TemporaryDirectory[str] | None) -> None:
        self.folder = folder
        report = json.loads((folder / "report.json").read_text())
        files = _files(folder)
        dimension = int(report["dimension"])
        super().__init__(report, dimension, files[-1] if files else None, kept)
        steps = report["steps"] or [report]
        if len(files) != len(steps):  # else there is no telling which is whose
            files = []
        self.steps = [StepResult(step, dimension, files[k] if files else None, kept) for k, step in enumerate(steps)]
        self.t = self.steps[-1].t

    @property
    def warnings(self) -> list[str]:
        return list(self.report["warnings"])

    @property
    def probes(self) -> dict[str, Any]:
        """Displacement, or value, at each probe by its name."""
        return {probe["name"]: probe.get("displacement", probe.get("value")) for probe in self.report["probes"]}

    @property
    def energy(self) -> float:
        return float(self.report["energy"])


def _files(folder: Path) -> list[Path]:
    """Of the steps, in their order."""
    collection = folder / "solution.pvd"
    if collection.is_file():
        root = ElementTree.parse(collection).getroot()
        return [folder / node.attrib["file"] for node in root.iter("DataSet")]
    single = folder / "solution.vtu"
    return [single] if single.is_file() else []


def _cells(mesh: Mesh, chosen: Array) -> Array:
    """The connectivity of cells of one type, a row each."""
    sizes = np.diff(mesh.offsets, prepend=0)
    size = int(sizes[chosen][0])
    starts = (mesh.offsets - sizes)[chosen]
    return np.asarray(mesh.connectivity[starts[:, np.newaxis] + np.arange(size)])


def _counted_cells(mesh: Mesh) -> Array:
    """Each cell after the number of its points, as VTK wants it."""
    sizes = np.diff(mesh.offsets, prepend=0)
    return np.insert(mesh.connectivity.astype(np.int64), (mesh.offsets - sizes).astype(np.int64), sizes)
