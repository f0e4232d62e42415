#include "core/scene/examples.hpp"

#include <algorithm>
#include <cassert>

namespace signorini {
namespace {

constexpr const char* body_details = R"(
**Axisymmetric bodies.** Half of the section is meshed, and stands for the body that it makes when it turns around the axis:

```
[[body]]
name = "ball"
shape = "half_disk"                # with its centre on the axis: the right half of it is meshed
center = [0, 0]
radius = 1
size = 0.1
plane = "axisymmetric"             # x is the radius r, y the axis z
young = 1
poisson = 0.3
```

- All of the section lies at r >= 0. A mesh that reaches beyond is refused. A `disk` or `half_disk` with its centre on the
  axis is cut there.
- The axis r = 0 is no boundary: no part has faces on it, and `on = "boundary"` leaves it out. The radial displacement is
  zero there by itself; `axis_nodes` of the report counts these nodes. A fix that prescribes another one is refused.
- Forces, areas, volumes and energies are those of the whole body. Loads are still given per area or volume.
- The first entry of a force is the integral of its radial part. It has no resultant: hoop stresses carry it, so that only
  the second entries of `balance` sum to zero.
- The only rigid motion is that along the axis. Moments are zero.
- Obstacles are the surfaces that their shapes sweep: a plane with `normal = [-1, 0]` is a bore, a tilted one a cone, a
  sphere with its centre off the axis a ring. All types work as in the plane, friction acts along the section.
- In the VTU `stress` has the radial stress as xx, the axial one as yy, and the hoop stress as zz.
)";

constexpr const char* selection = R"(
- One of `on` and `where` picks the faces, in this table and the next ones. Both together are an error.
- `where` is judged on the faces of the coarsest mesh. Finer ones inherit it. Where it cuts through faces of the coarsest
  mesh a warning says how much area is picked though `where` does not hold there, and how much is left out. (Facets
  that stand for a curved surface which a mesh file does not know are taken as picked rightly.)
)";

constexpr const char* load_details = R"(
- With `on` or `where` the load is a traction on these faces: a force per area. Without them it is a body force, per volume.
- For scalar bodies it is a flux, or a source.
)";

constexpr const char* obstacle_details = R"(
Every key not listed here belongs to the plugin; `signorini list obstacles` shows it. `scalar`, for instance, has `lower`
and `upper`.

**Which faces count.** `on` and `where` may pick more faces than come into contact. The contact area of a node, and its
pressure, count only those of the picked faces whose outer normal is within 60 degrees of the direction to the obstacle. (At
a tip that is sharper than that, all count.)

**Pressure.** `max_pressure` and `contact_pressure` of the VTU are recovered from the forces at the nodes
([pressures.md](pressures.md)). `nodal_pressure` of the VTU is a node's force over its area. `area` ends within faces, where
the recovered pressure does; `radius` is that of a disk with this area; in 2D half of the length, where it is one. Where too few nodes are inside the
contact to find pressures, `resolved` is false and a warning says so: pressure and area may be off by a third or more.

**Small displacements.** Contact is linearised about the undeformed body: distance and normal of a node are those before it
moves. After the solve the nodes of the deformed boundary are compared with the true obstacle:

| key of the report | says |
| --- | --- |
| `largest_penetration` | how far a node is inside the obstacle |
| `largest_penetration_between_nodes` | the same of points between nodes: conditions hold at nodes alone |
| `largest_opening` | how far one is off it though contact is claimed |
| `beyond_nodes` | of two bodies: nodes in contact that have come to where the other one is no longer in front of them |

A warning is given where a length is over 1 % of the displacements there, or of what displacements differ by in the body where
that is more (between nodes over 10 %: that is what elements leave), where over a tenth of the nodes in contact are beyond, where
a body turns by more than 0.1 as a whole, and where
strains are over 0.2 in a twentieth of a body: linear elasticity takes both for small ones. Where a twentieth of a body is
pressed through itself, as by displacements in other units than the body, or an obstacle on the wrong side would pull at
it, the scene is refused. An obstacle that is never touched is named, with the smallest distance that is left.

**Two bodies.** `elastic` and `elastic_coulomb` let two elastic bodies touch each other: `body` with `on` or `where`, and
`other` with `other_on` or `other_where`. Both may be parts of one body. What they do, and which of them is the slave, is in [bodies.md](bodies.md). Other
types take no `other`.

**Friction.** `coulomb` is contact with a rigid obstacle, and friction whose tangential force at a node is at most the
coefficient `friction` times the force that presses there. `tresca` is the same with a given `bound` on the tangential
traction. Both are numbers or expressions. Where the traction is smaller the node sticks, else it slips against it. The bound of `tresca` holds on
all nodes that the obstacle acts on, whether they press or not: pick them by `on` or `where`. With `[steps]` friction opposes
the motion since the last step. An obstacle whose `point`, `center`,
`normal` or `axis` depends on `t` drags the body with it: what counts is the motion along the obstacle relative to it. (From
one step to the next it turns the shortest way. Before the first step it was where it is at t = 0. Obstacles of shape
`expression` and `surface` do not drag; where an `expression` moves a warning says so.) The report has `slip_nodes` and `stick_nodes` of the nodes in contact, `tangential_force`,
and `dissipated`, the work of friction since the first step. In `solution.vtu` the field `contact` is 2 where a node slips and
3 where it sticks. All keys of the report are in
[report.md](report.md), the columns of `steps.csv` in [solver.md](solver.md), "Steps". Some things
to know:

- The bound counts on all picked faces, the field `tangential_traction` goes by the area of those that face the obstacle. At the
  edge of what is picked it may be larger than the bound.
- What is negative by rounding alone counts as zero: `friction = "0.3 - 0.2 * x"` at x = 1.5.
- With quadratic elements friction holds for the coefficients of nodes. A midpoint that sticks keeps its coefficient, and moves by a
  tenth of what each end of its edge does ([solver.md](solver.md), "Quadratic elements").
- Nodes all of whose components are prescribed slip where they are led along the obstacle, with all of friction against
  that; others of them count in `nodes` alone.
- With `coulomb` a fix must not prescribe the displacement along the obstacle's normal, and no other obstacle may hold the
  body along another direction, where there is friction: the force that presses is not known there. Such scenes are refused.
- For large coefficients Coulomb's law may have no solution, or several. Where the iteration finds none it ends with exit
  status 3 and says so ([solver.md](solver.md), "Friction").
- `friction = 0` is contact without friction, to the last bit.
- At a vertex one obstacle has friction, and no other holds there along another direction. Two that meet at a vertex are
  refused: take one with an expression as its bound. A fix is along the obstacle's normal or across it, else it is refused.
- A body that nothing but very little friction holds along the surface (bounds below a thousandth of the modulus times the
  strain) takes many cycles, up to the iteration limit.

Where friction does not hold a body against the motion that the loads would take it without friction, there is no solution;
where it gives way to another motion alone, the solve ends at the iteration limit.

**Forces.** `force` of the report is the whole force of the obstacle. How it divides between the obstacle and a fix that
holds a node along the obstacle's normal is not determined. What presses there is counted as the obstacle's, and
`undetermined_nodes` counts such nodes.
)";

constexpr const char* material_details = R"(
A rubber pad in a part of steel, where the mesh file calls its tetrahedra `pad`:

```
[[body]]
name = "part"
mesh = "part.msh"
young = 210000
poisson = 0.3

[[material]]
body = "part"
volume = "pad"
young = 5
poisson = 0.4
```

A volume belongs to one material. Stresses in the VTU are recovered at the nodes ([how](pressures.md#stresses)), for each
material by itself. Where materials meet the VTU has the mean of them. A body without a mesh file takes an expression:
`young = "x < 1 ? 5 : 210000"`.
)";

constexpr const char* symmetry_details = R"(
A quarter of a ball that is pressed on a plane, reported as the whole ball:

```
[symmetry]
x = 0
y = 0
```

**What is meshed.** Planes hold for all bodies.

- A shape that lies on both sides of a plane is cut there. The side of the larger coordinates is meshed.
- The plane is in the middle of each shape: it holds the centre of round ones, and polygons must be symmetric. Of an odd
  number of `cells` across it the larger half is taken, for half the body.
- A `solid`, and a body from a mesh file, is what lies on one side already, with faces on the plane. So is any other shape
  that lies on one side.

**On the plane** an elastic body moves along it only. A scalar one has no flux through it. The faces there are no boundary:
no part has faces on it, and `on = "boundary"` leaves it out.

**Fixes, loads and obstacles** hold on both sides.

- One that picks faces at the plane, or of the whole boundary, must be symmetric, values and selection alike. This is checked
  at the vertices of the body and their mirror images, and refused where it is not so.
- One whose faces are on one side, as `on = "right"` of a box that is cut across x, holds there, and mirrored on the other
  side.
- Parts that are cut off have no faces and cannot be picked.

**What is of the whole body.**

- Energies, and the sums in `balance`.
- `applied`, `reactions`, and force, moment, area and dissipation of an obstacle: of all the faces that the condition stands
  for in the scene as it is written. Those of a load on `right` are of the whole right side, not of the left one.
- Forces across a plane cancel and are zero.
- A `probe` may lie on either side.

**What is of the part that is meshed.** Numbers of unknowns, nodes and faces, the VTU and the pictures. `symmetry` of an entry
of `bodies` in the report lists the planes, `copies` how many such parts the body has: 2, 4 or 8.

A solution that is not symmetric, such as that of a body that buckles, is not found. Bodies that touch each other may have
planes of symmetry, too, where all of them lie on each plane. `apps/scenes/quarter_ball_on_plane.toml` is a scene.
)";

constexpr const char* steps_details = R"(
Steps may be uneven. This one has three:

```
[steps]
at = [0.1, 0.5, 1]
```

At `t = 0` nothing has happened yet: friction in the first step counts from the undeformed body.

**Steps that fail.** A step of a body with friction that ends without a solution (exit status 3) is cut in two at the
middle of its `t`, and each part again where it fails, `halvings` times at most. What a failed attempt computed is
forgotten: parts start from the last step that was solved. The report lists the parts among its `steps`, and what failed
under `failed_steps`; a warning says it. Where the smallest part fails, too, the run ends there with exit status 3. The
steps before it are kept.

A step that is solved is cut, too, where friction of an obstacle acts against what it was in the last step, and most of it
at nodes that have come into contact since: what these moved before they touched counts in a step, as where a blade rolls
onto a drum. Where it may not be cut any more a warning says so.

Steps are not cut where nothing of the body depends on `t`, nor where no obstacle of it has friction or another energy of its own. Such a body
remembers nothing of its way: a step of it is the same problem, however it is reached. It goes on after a step that failed.
)";

constexpr TableText texts[] = {
    {"", R"(title = "A block pressed on a ball")", ""},
    {"body", R"([[body]]
name = "block"
shape = "box"
from = [0, 0, 0]
to = [2, 1, 1]
cells = [8, 4, 4]
young = 210000
poisson = 0.3)",
     body_details},
    {"material", "", material_details},
    {"fix", R"([[fix]]
body = "block"
on = "top"
value = [0, 0, "-0.01*t"]          # moved down step by step; "free" leaves a component free)",
     selection},
    {"load", R"([[load]]
body = "block"
where = "x == 2"
value = [-10, 0, 0]                # a pressure of 10 on the face at x = 2)",
     load_details},
    {"obstacle", R"([[obstacle]]
type = "contact"
body = "block"
on = "bottom"
shape = "sphere"
center = [1, 0.5, -3]
radius = 3)",
     obstacle_details},
    {"solver", R"([solver]
tolerance = 1e-10)",
     "\nNone of these has to be given. They are explained in [solver.md](solver.md).\n"},
    {"refine", R"([refine]
uniform = 1                        # halves all edges once)",
     ""},
    {"symmetry", R"([symmetry]
y = 0.5                            # half of the block is meshed: y >= 0.5)",
     symmetry_details},
    {"steps", R"([steps]
count = 4                          # t is 0.25, 0.5, 0.75 and 1)",
     steps_details},
    {"probe", R"([[probe]]
name = "middle of the bottom"
body = "block"
at = [1, 0.5, 0])",
     ""},
    {"plugins", R"([plugins]
path = ["."]                       # the folder of the scene)",
     ""},
    {"output", R"([output]
pictures = false)",
     ""},
};

}  // namespace

const TableText& table_text(std::string_view table) {
  const auto* found = std::ranges::find(texts, table, &TableText::table);
  assert(found != std::end(texts));
  return *found;
}

}  // namespace signorini
