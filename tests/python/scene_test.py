"""Scene: results of the program as arrays."""
import json
import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import signorini


@pytest.fixture
def ball(scenes, program):
    def scene(**overrides):
        return signorini.Scene(scenes / "ball_axisymmetric.toml",
                               {"refine.uniform": 1} | {key.replace("__", "."): v for key, v in overrides.items()},
                               program=program)

    return scene


def test_results_are_arrays(ball):
    result = ball().solve()
    assert result.converged and result.t == 1 and len(result.steps) == 1
    nodes = len(result.points)
    assert result.points.shape == result.displacement.shape == (nodes, 2) and result.pressure.shape == (nodes,)
    assert set(result.fields) >= {"displacement", "stress", "von_mises", "gap", "contact_pressure", "contact"}
    assert result.forces.shape == (1, 2)
    np.testing.assert_array_equal(result.forces[0], result.report["contact"][0]["force"])
    held = sum(reaction["force"][1] for reaction in result.report["reactions"])
    assert result.forces[0, 1] == pytest.approx(-held, rel=1e-6) and result.forces[0, 1] > 0
    assert result.pressure.max() == pytest.approx(result.report["contact"][0]["max_pressure"])
    top = np.isclose(result.points[:, 1], 0)  # the flat side, which is moved down
    np.testing.assert_allclose(result.displacement[top, 1], -0.011)
    pole = np.argmin(np.linalg.norm(result.points - [0, -1], axis=1))
    np.testing.assert_allclose(result.displacement[pole], result.probes["pole"], atol=1e-15)


def test_they_are_those_of_the_program(ball, scenes, program, tmp_path):
    out = tmp_path / "out"
    subprocess.run([program, "solve", scenes / "ball_axisymmetric.toml", "--set", "refine.uniform=1", "--out", out,
                    "--quiet"], check=True)
    report = json.loads((out / "report.json").read_text())
    result = ball().solve()
    assert result.energy == report["energy"]
    np.testing.assert_array_equal(result.displacement,
                                  signorini.read_vtu(out / "solution.vtu").point_data["displacement"][:, :2])


@pytest.mark.filterwarnings("ignore::signorini.SceneWarning")
def test_steps_have_fields_and_forces_of_their_own(scenes, program, tmp_path):
    scene = signorini.Scene(scenes / "disk_in_bed_steps.toml", {"refine.uniform": 0}, program=program)
    result = scene.solve(out=tmp_path / "out")
    assert [step.t for step in result.steps] == [0.25, 0.5, 0.75, 1]
    pressed = [np.linalg.norm(step.forces[0]) for step in result.steps]
    assert np.all(np.diff(pressed) > 0)
    assert all(step.pressure.max() == pytest.approx(step.report["contact"][0]["max_pressure"]) for step in result.steps)
    np.testing.assert_array_equal(result.displacement, result.steps[-1].displacement)
    assert np.abs(result.steps[0].displacement).max() < np.abs(result.displacement).max()
    assert (tmp_path / "out" / "report.json").is_file()


def test_scalar_bodies_have_one_value_per_node(scenes, program):
    result = signorini.Scene(scenes / "obstacle_radial_2d.toml", {"refine.uniform": 1}, program=program).solve()
    assert result.displacement.shape == result.pressure.shape == (len(result.points),)
    assert result.forces.shape == (1, 1)


def test_overrides_are_written_as_toml():
    scene = signorini.Scene("s.toml", {"title": 'a "b"', "output.vtu": True, "fix.0.value": np.array([0, -0.5]),
                                       "refine.uniform": np.int64(2), "solver.tolerance": 1e-6, "steps.at": (0.5, 1)})
    assert scene.arguments[2::2] == ['title="a \\"b\\""', "output.vtu=true", "fix.0.value=[0.0, -0.5]",
                                     "refine.uniform=2", "solver.tolerance=1e-06", "steps.at=[0.5, 1]"]
    with pytest.raises(ValueError, match="overrides: found None for title"):
        signorini.Scene("s.toml", {"title": None})


def test_what_is_wrong_is_said_as_the_program_does(ball, program, tmp_path):
    with pytest.raises(ValueError, match="there is no file"):
        signorini.Scene(tmp_path / "none.toml", program=program).solve()
    with pytest.raises(ValueError, match="refine.unifrom.*uniform"):
        ball(refine__unifrom=2).solve()
    with pytest.raises(signorini.NotConverged, match="iteration limit 1") as raised:
        ball(solver__max_iterations=1).solve()
    assert raised.value.result.displacement.shape == raised.value.result.points.shape
    with pytest.raises(signorini.PluginError, match="contakt"):
        ball(obstacle__0__type="contakt").solve()
    with pytest.raises(ValueError, match="no fields were written"):
        ball(output__vtu=False).solve().points  # noqa: B018


def test_scenes_without_solution_say_why(program, tmp_path):
    body = ('[[body]]\nname = "b"\nshape = "rectangle"\nfrom = [0, 0]\nto = [1, 1]\ncells = [2, 2]\n'
            'equation = "diffusion"\n')
    (tmp_path / "falls.toml").write_text(
        body + '[[load]]\nbody = "b"\nvalue = 1\n[[obstacle]]\ntype = "scalar"\nbody = "b"\nlower = 0\n')
    with pytest.raises(signorini.Unbounded):
        signorini.Scene(tmp_path / "falls.toml", program=program).solve()
    (tmp_path / "empty.toml").write_text(
        body + '[[fix]]\nbody = "b"\nwhere = "x < 2"\nvalue = 0\n'
        '[[obstacle]]\ntype = "scalar"\nbody = "b"\nlower = 1\n')
    with pytest.raises(signorini.Infeasible):
        signorini.Scene(tmp_path / "empty.toml", program=program).solve()


def test_warnings_of_the_program_are_warnings(ball):
    with pytest.warns(signorini.SceneWarning, match="never touched|not touched|touch"):
        ball(fix__0__value=[0, 0.1]).solve()


def test_interrupts_end_the_program(ball):
    main = threading.get_ident()

    def interrupt():
        time.sleep(0.3)
        signal.pthread_kill(main, signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    started = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        ball(refine__uniform=7).solve()
    thread.join()
    assert time.monotonic() - started < 10


def test_meshes_go_to_meshio(ball):
    pytest.importorskip("meshio")
    result = ball().solve()
    mesh = result.to_meshio()
    assert mesh.cells[0].type == "triangle6" and len(mesh.cells[0].data) == len(result.mesh.types)
    corners, middle = mesh.cells[0].data[:, :2], mesh.cells[0].data[:, 3]
    on_edges = np.linalg.norm(mesh.points[corners].mean(axis=1) - mesh.points[middle], axis=1)
    assert np.median(on_edges) < 1e-12 and set(mesh.point_data) == set(result.fields)


def test_vtk_reads_the_same(ball, tmp_path):
    xml = pytest.importorskip("vtkmodules.vtkIOXML")
    from vtkmodules.util.numpy_support import vtk_to_numpy

    result = ball().solve(out=tmp_path / "out")
    reader = xml.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(result.file))
    reader.Update()
    grid = reader.GetOutput()
    np.testing.assert_array_equal(result.mesh.points, vtk_to_numpy(grid.GetPoints().GetData()))
    np.testing.assert_array_equal(result.mesh.connectivity, vtk_to_numpy(grid.GetCells().GetConnectivityArray()))
    np.testing.assert_array_equal(result.mesh.types, vtk_to_numpy(grid.GetCellTypesArray()))
    assert grid.GetPointData().GetNumberOfArrays() == len(result.fields)
    for name, values in result.fields.items():
        np.testing.assert_array_equal(values, vtk_to_numpy(grid.GetPointData().GetArray(name)))


def test_meshes_go_to_pyvista(ball):
    pytest.importorskip("pyvista")
    result = ball().solve()
    grid = result.to_pyvista()
    assert grid.n_cells == len(result.mesh.types) and "von_mises" in grid.point_data
