#include "core/scene/examples.hpp"

#include <algorithm>
#include <cassert>

namespace signorini {
namespace {

constexpr const char* body_details = R"(
**Axisymmetric bodies.** Half of the section is meshed. It stands for the body that it makes when it turns around the
axis:

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

- All of the section lies at r >= 0. A mesh that reaches beyond the axis is refused. A `disk` or `half_disk` with its
  centre on the axis is cut there.
- The axis r = 0 is no boundary. No part has faces on it, and `on = "boundary"` leaves it out.
- On the axis the radial displacement is zero by itself. A fix that prescribes another value there is refused.
  `axis_nodes` of the report counts the nodes on the axis.
- Forces, areas, volumes and energies are those of the whole body. Loads are given per area or volume, as elsewhere, or
  in total.
- The first entry of a force is the integral of its radial part. Radial forces of a body of revolution have no
  resultant: hoop stresses carry them. So only the second entries of `balance` sum to zero.
- The only rigid motion is the one along the axis. Moments are zero.
- Obstacles are the surfaces that their shapes sweep. A plane with `normal = [-1, 0]` is a bore. A tilted plane is a
  cone. A sphere with its centre off the axis is a ring. All types of obstacles work as in the plane. Friction acts
  along the section.
- In the VTU, `stress` has the radial stress as xx, the axial stress as yy, and the hoop stress as zz.
)";

constexpr const char* fix_details = R"(
- `on` or `where` picks the faces, in this table and the next ones. Both together are an error.
- `where` is evaluated on the faces of the coarsest mesh. Finer meshes inherit the choice. The border of `where` may cut
  through faces of the coarsest mesh. A warning then says how much area is picked although `where` does not hold there,
  and how much area is left out. (Facets of a curved surface that a mesh file does not know count as picked rightly.)
- `at` and a list of two parts pick a point and an edge, see [loads.md](loads.md#fixes-that-are-no-faces). Stresses are
  singular there.
- Components and tangents of each frame: [loads.md](loads.md#frames).
)";

constexpr const char* load_details = R"(
- With `on` or `where` the load is a traction on these faces: a force per area. Without them it is a body force, per
  volume.
- On scalar bodies the load is a flux, or a source.
- `force` and `torque` are totals: in space forces, in the plane forces per thickness, of an axisymmetric body those of
  the whole body of revolution. They are spread over the area of the faces on the mesh, curved faces included.
  The nodal forces add up to them, to rounding. With `[symmetry]` they act on both sides if the faces continue beyond
  the plane, see there.
- `force` and `torque` may stand together. `about` then makes them the force and the moment of the whole load about
  that point: `force = [0, 0, -5]` with `about = [3, 0, 0]` acts like a force at that point.
- [loads.md](loads.md) has examples.
)";

constexpr const char* spring_details = R"(
- The traction is -k u: it pulls and pushes alike. An obstacle only pushes.
- `stiffness` is per area (in the plane per length and thickness). `total` is divided by the area of the faces, of a body
  of revolution by that of the rings, with `[symmetry]` by that on both sides if the faces go on beyond the plane.
- `springs` of the report has the force of each. Their energy counts in `energy`.
)";

constexpr const char* rigid_details = R"(
A punch that a force pushes onto a block, and that does not tilt:

```
[[rigid]]
body = "punch"
on = "top"
displacement = [0, 0, "free"]
rotation = [0, 0, 0]
force = [0, 0, -10]
```

All nodes of the faces move as q + theta x (p - point). [joints.md](joints.md) has examples.
)";

constexpr const char* obstacle_details = R"(
Every key that is not listed here belongs to the plugin. `signorini list obstacles` shows these keys. `scalar`, for
instance, has `lower` and `upper`.

**Which faces count.** `on` and `where` may pick more faces than come into contact. Contact areas and pressures count
only faces whose outer normal is within 60 degrees of the direction to the obstacle. (At a tip that is sharper than
that, all faces count.)

**Results.** Pressures are recovered from the forces at the nodes: [pressures.md](pressures.md). `force` of the report
is the whole force of the obstacle. A fix may hold a node along the obstacle's normal. Then nothing determines how the
force divides between the fix and the obstacle. What presses counts as the obstacle's, and `undetermined_nodes` counts
such nodes. All keys are in [results.md](results.md).

**Small displacements.** Contact is linear in the displacements: distance and normal of a node are those before it moves.
A body may slide along a curved obstacle, or come to it from afar. Then the program looks at it where the solution has
taken it, and solves again. It is shifted for that by the mean motion of the nodes that touch, and not turned. The program
does so where it would have to warn of too large a length, see below; in the second of `[steps]` and later where a fifth
of a percent of `depth` is wrong. With friction it does so in the second step and later only. With `renew = false` it never
does. After the solve the nodes of the deformed boundary are compared with the true obstacle:

| key of the report | says |
| --- | --- |
| `largest_penetration` | how far a node is inside the obstacle |
| `largest_penetration_between_nodes` | the same for points between nodes, because conditions hold at nodes alone |
| `largest_opening` | how far a node that counts as in contact is off the obstacle |
| `depth` | by how much more some nodes in contact have come along the obstacle's normal than others |
| `beyond_nodes` | of two bodies: nodes in contact that no longer have the other body in front of them |

The program warns ([warnings.md](warnings.md#about-the-result)) in these cases:

- One of these lengths is too large: more than 1 % at nodes, or more than 10 % between nodes, which is what elements
  leave. It is compared with the displacements there. If displacements within the body differ by more than that, it is
  compared with their difference. At nodes it is too large as well if it is more than 5 % of `depth`, which is what
  contact flattens, or of what deforms the faces that may touch: then the largest pressure is wrong by about as much.
- More than a tenth of the nodes in contact are beyond.
- A body turns by more than 0.1 as a whole, or a twentieth of it has strains above 0.2. Linear elasticity assumes that
  both are small.
- An obstacle is never touched. The warning gives the smallest distance that is left.

A scene is refused in three cases. A twentieth of a body would be pressed through itself, for example because
displacements have other units than the body. Or a body would turn by more than half a turn. Or an obstacle is on
the wrong side, so that it would pull at the body.

**Two bodies.** With `elastic`, `elastic_tresca` and `elastic_coulomb` two elastic bodies touch each other. `body` goes with `on` or
`where`, `other` with `other_on` or `other_where`. Both may be parts of one body. [bodies.md](bodies.md) has examples.
With `tied` they are glued together ([joints.md](joints.md)), and may be the halves of a bolt that is tightened
([bolts.md](bolts.md)). Other types take no `other`.

**Friction.** `coulomb` is contact with a rigid obstacle and friction. The tangential force at a node is at most the
coefficient `friction` times the force that presses there. `tresca` is the same with a given `bound` on the tangential
traction. Both are numbers or expressions. [friction.md](friction.md) has examples. It also says what friction means in
steps, and when there is no solution. In detail:

- The bound of `tresca` holds at all nodes of the picked faces, whether they press or not. The field
  `tangential_traction` divides by the area of the faces that face the obstacle. So at the edge of what is picked it may
  be larger than the bound.
- A coefficient or bound that is negative by rounding alone counts as zero: `friction = "0.3 - 0.2 * x"` at x = 1.5.
- An obstacle whose `point`, `center`, `normal` or `axis` depends on `t` drags the body with it. From one step to the
  next it turns the shortest way. Before the first step it was where it is at t = 0. Obstacles of shape `expression` and
  `surface` do not drag.
- A node whose displacement is prescribed in all components may be led along the obstacle. It then slips, with all of
  friction against it. If it is not led along the obstacle, it counts in `nodes` alone.
- With `coulomb` a fix must not prescribe the displacement along the obstacle's normal where there is friction. The
  force that presses is not known there. A fix that is oblique to the normal is refused, too.
- Only one obstacle at a node has friction, and no other obstacle holds that node along another direction. Otherwise the
  scene is refused. Use one obstacle with an expression as its coefficient or bound.
- Friction may be so small that it hardly holds a body along the surface: bounds below a thousandth of the modulus times
  the strain. If nothing else holds it, the solve takes many cycles, up to the iteration limit.
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

A volume belongs to one material. Stresses in the VTU are recovered at the nodes ([how](theory/pressures.md#stresses)),
for each material by itself. Where materials meet, the VTU has the mean of their stresses. A body without a mesh file
takes an expression: `young = "x < 1 ? 5 : 210000"`.
)";

constexpr const char* symmetry_details = R"(
A quarter of a ball that is pressed on a plane, reported as the whole ball:

```
[symmetry]
x = 0
y = 0
```

**What is meshed.** The planes hold for all bodies.

- A shape that lies on both sides of a plane is cut there. The side with the larger coordinates is meshed.
- The plane is in the middle of each shape that it cuts. It holds the centre of round shapes, and polygons must be
  symmetric.
- Of an odd number of `cells` across the plane the larger half is taken, for half the body.
- A shape may lie on one side of the plane. Then it is taken as half of the body, with faces on the plane. A `solid` and
  a body from a mesh file always do.

**On the plane** an elastic body moves along the plane only. A scalar body has no flux through it. The faces there are
no boundary: no part has them, and `on = "boundary"` leaves them out.

**Fixes, loads and obstacles** hold on both sides.

- Some pick faces at the plane, or of the whole boundary. These must be symmetric, in their values and in their faces.
  The program checks this at the vertices of the body and their mirror images, and refuses what is not symmetric.
- Others pick faces on one side, such as `on = "right"` of a box that is cut across x. These hold there, and mirrored on
  the other side.
- Parts that are cut off have no faces and cannot be picked.

**These results are of the whole body:**

- Energies, and the sums in `balance`.
- `applied`, `reactions`, and force, moment, area and dissipation of an obstacle. They are those of all faces for which
  the condition stands in the scene as it is written. A load on `right` is summed over the whole right side, and not
  over the left. The same holds for what a `[[load]]` gives in total, by `force` or `torque`: it is the sum that
  `applied` shows.
- Forces across a plane cancel and are zero.
- A `probe` may lie on either side.

**These are of the part that is meshed:** numbers of unknowns, nodes and faces, the VTU and the pictures. In each entry
of `bodies` in the report, `symmetry` lists the planes, and `copies` says how many such parts the body has: 2, 4 or 8.

A solution without this symmetry is not found, for example that of a body that buckles. Bodies that touch each other may
have planes of symmetry, too, if every body lies on every plane. `apps/scenes/quarter_ball_on_plane.toml` is a scene.
)";

constexpr const char* steps_details = R"(
Steps may be uneven. This one has three:

```
[steps]
at = [0.1, 0.5, 1]
```

At `t = 0` nothing has happened yet: friction in the first step counts from the undeformed body.

**Steps that fail.** A step with friction may end without a solution (exit status 3). It is then cut in two at the
middle of its `t`. Each part that fails is cut again, at most `halvings` times. The results of a failed attempt are
dropped: a part starts from the last step that was solved. The report lists the parts among its `steps`, and what
failed under `failed_steps`. A warning says so. If the smallest part fails, too, the run ends with exit status 3, and
the steps before it are kept.

**Steps that are too long.** A step that is solved may be cut, too: if friction acts against its direction in the last
step, and most of it at nodes that have come into contact since. In a long step the slip of these nodes includes
their motion before they touched, for example where a blade rolls onto a drum. A step in which bodies come from apart
along the surface is cut where they touch. If the step may not be cut any more, a warning says so.

**Steps that are not cut.** Steps are not cut if nothing of the body depends on `t`, or if no obstacle has friction or
another energy of its own. Such a body has no memory: its step is the same problem, whatever
happened before it. The run goes on after a step that failed.
)";

constexpr const char* contact_details = R"(
All bodies that are in front of each other may touch, with friction:

```
[contact]
between = "all"
friction = 0.3
```

Each two bodies become an obstacle of type `elastic`, or `elastic_coulomb` with friction, whose sides are the faces that
are in front of the other body. They follow those of `[[obstacle]]` in the report, and `signorini check` lists them.
[pairs.md](pairs.md) has an example.
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
     fix_details},
    {"load", R"([[load]]
body = "block"
where = "x == 2"
value = [-10, 0, 0]                # a pressure of 10 on the face at x = 2)",
     load_details},
    {"spring", R"([[spring]]
body = "block"
on = "left"
stiffness = 50                     # a soft pad: per area, in all directions)",
     spring_details},
    {"rigid", "", rigid_details},
    {"obstacle", R"([[obstacle]]
type = "contact"
body = "block"
on = "bottom"
shape = "sphere"
center = [1, 0.5, -3]
radius = 3)",
     obstacle_details},
    {"contact", "", contact_details},
    {"solver", R"([solver]
tolerance = 1e-10)",
     "\nNone of these has to be given. They are explained in [solver_options.md](solver_options.md).\n"},
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
