# The ball of apps/scenes/ball_on_plane.toml by GetFEM, on a mesh of quadratic tetrahedra in a Gmsh file:
#   getfem_ball.py FILE.msh
# Contact by Lagrange multipliers on the boundary, Newton's method on the augmented Lagrangian (Alart and Curnier), the
# linear systems by MUMPS. Prints Newton steps, force, largest pressure.
import sys

import getfem as gf

YOUNG, POISSON, APPROACH, GAP_AT_ZERO = 1.0, 0.3, 0.011, 1.0

gf.util_trace_level(0)
mesh = gf.Mesh("import", "gmsh", sys.argv[1])
FLAT, LOWER = 1, 2
mesh.set_region(FLAT, mesh.outer_faces_in_box([-9, -9, -1e-9], [9, 9, 1e-9]))
mesh.set_region(LOWER, mesh.outer_faces_in_box([-9, -9, -9], [9, 9, -0.9]))  # far more than what touches

displacements = gf.MeshFem(mesh, 3)
displacements.set_fem(gf.Fem("FEM_PK(3,2)"))
pressures = gf.MeshFem(mesh, 1)
pressures.set_fem(gf.Fem("FEM_PK(3,1)"))
values = gf.MeshFem(mesh, 1)
values.set_fem(gf.Fem("FEM_PK(3,2)"))
rule = gf.MeshIm(mesh, gf.Integ("IM_TETRAHEDRON(6)"))

model = gf.Model("real")
model.add_fem_variable("u", displacements)
model.add_initialized_data("lambda", [YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))])
model.add_initialized_data("mu", [YOUNG / (2 * (1 + POISSON))])
model.add_isotropic_linearized_elasticity_brick(rule, "u", "lambda", "mu")
model.add_initialized_data("moved", [0, 0, -APPROACH])
model.add_Dirichlet_condition_with_simplification("u", FLAT, "moved")
model.add_filtered_fem_variable("pressure", pressures, LOWER)
model.add_initialized_fem_data("distance", values, values.eval("z + %g" % GAP_AT_ZERO))
model.add_initialized_data("r", [10.0 * YOUNG])
model.add_integral_contact_with_rigid_obstacle_brick(rule, "u", "pressure", "distance", "r", LOWER, 1)

steps, converged = model.solve("max_res", 1e-9, "max_iter", 60, "lsolver", "mumps")
if not converged:
    sys.exit("not converged")
pressure = -model.variable("pressure")
force = gf.asm_generic(rule, 0, "-pressure", LOWER, model)
print(steps, force, pressure.max())
