"""Obstacles on a matrix of one's own: friction against a scene, energies against conditions of optimality."""
import numpy as np
import pytest
import scipy.sparse
from conftest import laplacian

import signorini


def block_of_triangles(cells, young=1.0, poisson=0.3):
    """Linear triangles of the block (0, 2) x (0, 1), plane strain, as those of the scene below."""
    across, up = 2 * cells, cells
    h = 1.0 / cells
    node = np.arange((across + 1) * (up + 1)).reshape(up + 1, across + 1)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]))
    where = np.stack(np.meshgrid(np.arange(across + 1) * h, np.arange(up + 1) * h), axis=-1).reshape(-1, 2)
    mu, bulk = young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))
    law = np.array([[bulk + 2 * mu, bulk, 0], [bulk, bulk + 2 * mu, 0], [0, 0, mu]])
    rows, columns, values = [], [], []
    for corners in (np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)):
        x = where[corners[0]]
        gradient = np.linalg.inv(np.column_stack([np.ones(3), x]))[1:]
        strain = np.zeros((3, 6))
        strain[0, 0::2], strain[1, 1::2] = gradient
        strain[2, 0::2], strain[2, 1::2] = gradient[1], gradient[0]
        local = h * h / 2 * strain.T @ law @ strain
        dofs = (2 * corners[:, :, None] + np.arange(2)).reshape(len(corners), 6)
        rows.append(np.repeat(dofs, 6, axis=1).ravel())
        columns.append(np.tile(dofs, (1, 6)).ravel())
        values.append(np.tile(local.ravel(), len(corners)))
    size = 2 * node.size
    A = scipy.sparse.coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                                shape=(size, size)).tocsr()
    return A, where, node[0], node[-1]


def moved_top(size, top, by):
    lower, upper = np.full(size, -np.inf), np.full(size, np.inf)
    for k in (0, 1):
        lower[2 * top + k] = upper[2 * top + k] = by[k]
    return lower, upper


@pytest.fixture(scope="module")
def block():
    A, where, bottom, top = block_of_triangles(8)
    return signorini.Solver(A, coordinates=where), A, bottom, top


SCENE = """
body = [{name="block", shape="rectangle", from=[0,0], to=[2,1], cells=[4,2], young=1.0, poisson=0.3, order=1}]
fix = [{body="block", on="top", value=[0.01,-0.03]}]
obstacle = [{type="coulomb", friction=0.3, body="block", on="bottom", shape="plane", point=[0,0], normal=[0,1]}]
refine.uniform = 2
solver.tolerance = 1e-12
"""


def test_friction_is_that_of_a_scene_on_the_same_triangles(block, tmp_path, program):
    solver, A, bottom, top = block
    solver.set_obstacles([signorini.Obstacle(bottom, [0, 1], lower=0, friction=0.3, name="floor")])
    result = solver.solve(np.zeros(A.shape[0]), moved_top(A.shape[0], top, (0.01, -0.03)), tol=1e-12)
    (tmp_path / "scene.toml").write_text(SCENE)
    scene = signorini.Scene(tmp_path / "scene.toml").solve()
    assert result.fun == pytest.approx(scene.energy, rel=1e-9)
    assert [result.multiplier[2 * bottom + k].sum() for k in (0, 1)] == pytest.approx(scene.forces[0], rel=1e-8)
    assert set(result.touching) <= set(bottom) and len(result.touching) > 0
    assert np.all(result.x[2 * bottom + 1] >= 0)


def test_friction_turns_round_on_the_way_back(block):
    solver, A, bottom, top = block
    solver.set_obstacles([signorini.Obstacle(bottom, [0, 1], lower=0, friction=0.05)])
    size = A.shape[0]

    def friction(way):
        r = solver.solve(np.zeros(size), moved_top(size, top, (way, -0.03))).multiplier
        return r[2 * bottom].sum() / r[2 * bottom + 1].sum()

    assert friction(0.05) == pytest.approx(-0.05, rel=1e-6)
    solver.next_step()
    assert friction(0.0) == pytest.approx(0.05, rel=1e-6)
    solver.set_obstacles([])
    assert solver.solve(np.zeros(size), moved_top(size, top, (0.01, -0.03))).touching.size == 0


class Absolute:
    """phi(v) = w |v|, with w the number of the block."""

    def change(self, slot, start, end):
        return slot.number[0] * (abs(end[0]) - abs(start[0]))

    def slope(self, slot, at, step):
        return slot.number[0] * (np.sign(at[0]) * step[0] if at[0] != 0 else abs(step[0]))

    def minimise(self, slot, M, r, x):
        target, w = M[0, 0] * x[0] + r[0], slot.number[0]
        y = np.sign(target) * max(abs(target) - w, 0) / M[0, 0]
        return np.clip(y, slot.lower[0], slot.upper[0])

    def linearise(self, slot, x):
        return slot.number[0] * np.sign(x[0]), 0.0, x[0] == 0

    def scale(self, ratio, number):
        return ratio * number


def test_an_energy_in_python_meets_the_conditions_of_optimality():
    side = 15
    A = laplacian(side)
    b = 0.3 * np.sin(np.arange(side * side))
    w = np.linspace(0.02, 0.2, side * side)
    solver = signorini.Solver(A, block=1)
    solver.set_obstacles([signorini.Obstacle(np.arange(side * side), energy=Absolute(), numbers=w)])
    result = solver.solve(b, tol=1e-10)
    r = b - A @ result.x
    at_kink = result.x == 0
    assert 0 < np.count_nonzero(at_kink) < side * side
    assert np.all(np.abs(r[at_kink]) <= w[at_kink] * (1 + 1e-8))
    assert r[~at_kink] == pytest.approx((w * np.sign(result.x))[~at_kink], abs=1e-8)
    assert result.fun == pytest.approx(0.5 * result.x @ (A @ result.x) - b @ result.x + w @ np.abs(result.x), rel=1e-8)


def test_what_an_energy_raises_is_raised_again():
    class Fails(Absolute):
        calls = 0

        def minimise(self, slot, M, r, x):
            Fails.calls += 1
            if Fails.calls > 10:
                raise KeyError("no such law")
            return super().minimise(slot, M, r, x)

    solver = signorini.Solver(laplacian(5), block=1)
    solver.set_obstacles([signorini.Obstacle([3, 7], energy=Fails(), numbers=[0.1, 0.1])])
    with pytest.raises(KeyError, match="no such law"):
        solver.solve(np.ones(25))
    solver.set_obstacles([])
    assert solver.solve(np.ones(25)).success


@pytest.mark.parametrize("given, message", [
    (dict(blocks=[0.5]), "floor: blocks: expected a list of whole numbers"),
    (dict(blocks=[1, 2], directions=np.eye(3)), r"floor: directions: found shape \(3, 3\), expected shape"),
    (dict(blocks=[1, 2], lower=[1, 2, 3]), r"floor: lower: found shape \(3,\), expected a number, or shape \(2,\)"),
    (dict(blocks=[1], lower=np.nan), "floor: lower: found nan"),
    (dict(blocks=[1], friction=0.1, energy=Absolute()), "floor: friction beside an energy"),
    (dict(blocks=[1], numbers=[1]), "floor: numbers without the energy"),
])
def test_what_is_wrong_is_named(given, message):
    with pytest.raises(ValueError, match=message):
        signorini.Obstacle(name="floor", **given)


def test_what_the_matrix_does_not_have_is_named():
    solver = signorini.Solver(laplacian(4), block=1)
    with pytest.raises(ValueError, match="floor: .*block 17"):
        solver.set_obstacles([signorini.Obstacle([17], lower=0, name="floor")])
    with pytest.raises(ValueError, match="floor: directions: found 2 components, expected 1"):
        solver.set_obstacles([signorini.Obstacle([1], [0, 1], lower=0, name="floor")])
    with pytest.raises(ValueError, match=r"expected Solver\(A, block=...\)"):
        signorini.Solver(laplacian(4)).set_obstacles([signorini.Obstacle([1], lower=0)])
