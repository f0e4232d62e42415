#include "core/scene/specs.hpp"

#include <algorithm>

#include "core/scene/solver_keys.hpp"

namespace signorini {
namespace {

using enum KeyType;

constexpr KeySpec top[] = {{"title", text, "\"\"", "", "", "what the scene shows; appears in the report"}};

constexpr KeySpec body[] = {
    {"name", text, nullptr, "", "", "what other tables call the body"},
    {"shape", text, "", "", "", "one of the shapes below; either this or `mesh`"},
    {"mesh", file, "", "", "",
     "Gmsh MSH 1, 2 or 4 (ASCII or binary) or VTU, of first or second order; physical groups become named parts"},
    {"equation", text, "elasticity", "elasticity | diffusion", "", "diffusion: one scalar unknown"},
    {"young", field, "", "(0, inf)", "", "Young's modulus; required for elasticity, or `orthotropic`"},
    {"poisson", field, "", "(-1, 0.5)", "", "Poisson's ratio; required for elasticity, or `orthotropic`"},
    {"orthotropic", point, "", "", "",
     "in place of both nine constants of an orthotropic material: E1, E2, E3, nu12, nu13, nu23, G12, G13, G23. See "
     "docs/orthotropic.md"},
    {"material_axes", points, "", "", "",
     "its directions 1 and 2, in 2D 1 alone, of any length; by default x and y. Direction 3 is orthogonal to both"},
    {"material_center", point, "", "", "",
     "in place of these a point of an axis: direction 1 is away from it, 2 around it, 3 along it"},
    {"material_axis", point, "", "", "", "in 3D the direction of that axis, of any length"},
    {"temperature", field, "0", "", "",
     "change of temperature from where the body fits without stress; with `expansion`. See docs/thermal.md"},
    {"expansion", field, "", "", "", "coefficient of thermal expansion: strain per change of temperature"},
    {"plane", text, "strain", "strain | stress | axisymmetric", "",
     "what holds across the plane, 2D only; axisymmetric: x is the radius and y the axis, scalar bodies too"},
    {"diffusion", field, "1", "(0, inf)", "", "coefficient of a diffusion equation"},
    {"order", choice, "auto", "auto | 1 | 2", "",
     "1: linear elements; 2: quadratic ones, with nodes on vertices and edges: the unknowns of one refinement more. "
     "auto: 2 for elastic bodies, 1 for scalar ones; see docs/theory/quadratic_elements.md"},
    {"pressure", text, "auto", "auto | linear | constant | none", "",
     "of quadratic elements where `poisson` is above 0.4, but in plane stress: pressures as unknowns of their own, so "
     "that these do not lock. linear: continuous, the default; constant: one per element; none: displacements alone. "
     "See docs/rubber.md"},
    {"geometry", text, "auto", "auto | smooth | fit | facets", "",
     "of a body from a mesh, what its boundary faces stand for. smooth: a smooth surface through the vertices; fit: "
     "planes, cylinders, cones, spheres, tori (2D: lines, circles), else facets; auto: shapes that fit up to rounding, "
     "else the mesh's own curved elements, else smooth"},
    {"crease", number, "35", "(0, 180)", "",
     "beside `geometry`: faces that meet at more degrees meet at an edge in any case"},
    {"size", field, "", "(0, inf)", "",
     "target edge length of the coarsest mesh; required for every shape but rectangle and box"},
};

constexpr KeySpec block_keys[] = {
    {"from", point, nullptr, "", "", "the corner with the smallest coordinates"},
    {"to", point, nullptr, "", "", "the opposite corner"},
    {"cells", integers, nullptr, "[1, 1000000]", "", "number of cells of the coarsest mesh in each direction"},
};
constexpr KeySpec round[] = {
    {"center", point, nullptr, "", "", "centre"},
    {"radius", number, nullptr, "(0, inf)", "", "radius"},
};
constexpr KeySpec polygon_keys[] = {{"points", points, nullptr, "", "", "corners, in order"}};
constexpr KeySpec cylinder[] = {
    {"center", point, nullptr, "", "", "centre, half way up"},
    {"radius", number, nullptr, "(0, inf)", "", "radius"},
    {"height", number, nullptr, "(0, inf)", "", "extent along z"},
};
constexpr KeySpec solid[] = {
    {"file", file, nullptr, "", "", "a closed surface in OFF, OBJ, STL or PLY, filled with tetrahedra"}};

constexpr ShapeSpec shapes[] = {
    {"rectangle", 2, "structured; parts `left`, `right`, `bottom`, `top`", block_keys},
    {"disk", 2, "part `boundary`", round},
    {"half_disk", 2, "the lower half of a disk; parts `flat`, `curved`", round},
    {"polygon", 2, "parts `edge0`, `edge1` and so on", polygon_keys},
    {"box", 3, "structured; parts `left`, `right`, `front`, `back`, `bottom`, `top` for x-, x+, y-, y+, z-, z+",
     block_keys},
    {"ball", 3, "part `boundary`", round},
    {"half_ball", 3, "the lower half of a ball; parts `flat`, `curved`", round},
    {"cylinder", 3, "along z; parts `bottom`, `top`, `side`", cylinder},
    {"solid", 3, "part `boundary`", solid},
};

constexpr KeySpec material[] = {
    {"body", text, nullptr, "", "", "name of a body that is read from a mesh file"},
    {"volume", text, nullptr, "", "", "a physical group of its tetrahedra (2D: triangles)"},
    {"young", field, "", "(0, inf)", "", "Young's modulus there; required for elasticity"},
    {"poisson", field, "", "(-1, 0.5)", "", "Poisson's ratio there; required for elasticity"},
    {"expansion", field, "", "", "", "coefficient of thermal expansion there; required where the body has one"},
    {"diffusion", field, "", "(0, inf)", "", "coefficient there; required for diffusion equations"},
};

constexpr const char* on_help = "a named part or a physical group of the mesh; \"boundary\" is all of it";
constexpr const char* on_or_edge_help =
    "a named part or a physical group of the mesh; \"boundary\" is all of it. A list of two parts: the edge (2D: the "
    "points) that they have in common";
constexpr const char* at_help = "a point, in place of both: the nearest vertex of the mesh is picked";
constexpr const char* where_help =
    "picks the boundary faces all of whose vertices satisfy the expression; this is decided on the coarsest mesh, and "
    "finer meshes inherit it";

constexpr const char* frame_help =
    "normal: components along the outer normal and the tangents, for symmetry planes; cylindrical: away from an axis, "
    "around it and along it";
constexpr KeySpec center_key = {"center", point, "", "", "", "a point of the axis of a cylindrical frame"};
constexpr KeySpec axis_key = {"axis", point, "", "", "", "in 3D the direction of that axis, of any length"};

constexpr KeySpec fix[] = {
    {"body", text, nullptr, "", "", "name of a body"},
    {"on", texts, "", "", "", on_or_edge_help},
    {"where", condition, "", "", "", where_help},
    {"at", point, "", "", "", at_help},
    {"value", values, nullptr, "", "", "per component the displacement (scalar bodies: the value), or \"free\""},
    {"frame", text, "global", "global | normal | cylindrical", "", frame_help},
    center_key,
    axis_key,
};

constexpr KeySpec load[] = {
    {"body", text, nullptr, "", "", "name of a body"},
    {"on", texts, "", "", "", on_or_edge_help},
    {"where", condition, "", "", "", where_help},
    {"at", point, "", "", "", at_help},
    {"value", values, "", "", "",
     "on faces a traction (scalar bodies: a flux), along an edge a force per length, at a point a force, else a body "
     "force "
     "(a source); either this, `pressure`, or what the load is in total"},
    {"pressure", field, "", "", "", "with `on` or `where`: a traction against the outer normal"},
    {"where_open", boolean, "false", "", "",
     "`pressure` acts only where the faces touch neither obstacles nor other bodies, as far as that is found to go, "
     "and "
     "on the other body in front of them too. See docs/seals.md"},
    {"from", text, "", "", "",
     "with `where_open`: a part of the body that meets these faces. The pressure comes from there, and acts on what is "
     "open in connection with it; by default on all that is open"},
    {"force", totals, "", "", "",
     "in total (scalar bodies: a flux or a source), spread evenly over what the load acts on: area, length or volume"},
    {"torque", moment, "", "", "",
     "in total: about the axes through `about`, in 2D about z; spread like the displacement of a small turn"},
    {"about", point, "", "", "",
     "a point about which the whole load, `force` included, has the moment `torque` (or zero); default: the centroid "
     "of the place where the load acts"},
    {"frame", text, "global", "global | normal | cylindrical", "", frame_help},
    center_key,
    axis_key,
};

constexpr KeySpec spring[] = {
    {"body", text, nullptr, "", "", "name of a body"},
    {"on", text, "", "", "", on_help},
    {"where", condition, "", "", "", where_help},
    {"stiffness", components, "", "[0, inf)", "",
     "force per area and displacement, for all directions or per component: an elastic foundation; either this or "
     "`total`"},
    {"total", components, "", "[0, inf)", "",
     "force per displacement of a spring as a whole, spread evenly over the area; numbers or expressions in t"},
    {"frame", text, "global", "global | normal | cylindrical", "", frame_help},
    center_key,
    axis_key,
};

constexpr KeySpec rigid[] = {
    {"body", text, nullptr, "", "", "name of a body"},
    {"on", text, "", "", "", on_help},
    {"where", condition, "", "", "", where_help},
    {"point", point, "", "", "",
     "the point that is displaced, and about which the part turns; by default the centroid of the faces of the "
     "coarsest mesh. "
     "Axisymmetric bodies need none"},
    {"displacement", values, "", "", "",
     "displacement of the point, per component, or \"free\"; by default all of it is free"},
    {"rotation", values, "", "", "",
     "in radians, or \"free\": about z in 2D, else about the three axes; by default all of it is free"},
    {"force", values, "", "", "", "on the point, per component, where the displacement is free; by default none"},
    {"torque", values, "", "", "", "about the point, where the rotation is free; as many numbers as rotations"},
};

constexpr KeySpec pairing_key = {"pairing",
                                 text,
                                 "normal",
                                 "normal | closest",
                                 "",
                                 "how distances between two bodies are measured: along the slave's normal (where that "
                                 "is bent and the master flat, along the master's), or to the master's closest point"};
constexpr KeySpec resolve_key = {
    "resolve", boolean, "false",
    "",        "",      "two bodies may overlap at the start by more than an element, and are pressed apart"};
constexpr KeySpec renew_key = {
    "renew",
    boolean,
    "true",
    "",
    "",
    "bodies that slide or come from afar are looked at where they come to, as a rigid obstacle is; false: contact is "
    "linear about the bodies as they are drawn"};

constexpr KeySpec obstacle[] = {
    {"type", text, nullptr, "", "", "id of an obstacle plugin, such as \"contact\""},
    {"body", text, nullptr, "", "", "name of a body"},
    {"on", text, "", "", "", on_help},
    {"where", condition, "", "", "", where_help},
    {"shape", text, "", "", "", "one of the obstacle shapes below, for plugins that want a rigid obstacle"},
    {"other", text, "", "", "", "name of the second body, for types that act between two elastic bodies"},
    {"other_on", text, "", "", "", "part of the second body; by default all of its boundary"},
    {"other_where", condition, "", "", "", "the same by an expression, as `where`"},
    {"slave", text, "auto", "auto | body | other", "",
     "which of the two has the contact's unknowns: `body`, `other`, or the one that the program chooses"},
    pairing_key,
    resolve_key,
    renew_key,
    {"pretension", field, "", "(0, inf)", "",
     "of type \"tied\", across the shank of a bolt: the force in total that pulls the two sides into each other, a "
     "number or an expression in t"},
    {"lock_at", number, "", "(0, 1]", "",
     "beside `pretension`: after the last step up to this t the bolt keeps its length, and no force is given any more. "
     "By default after the first of several steps"},
};

constexpr KeySpec contact[] = {
    {"between", texts, nullptr, "", "",
     "\"all\": all elastic bodies; or a list of bodies. Those two of them touch each other whose surfaces are within "
     "reach, unless an `[[obstacle]]` is between them"},
    {"friction", field, "0", "[0, inf)", "", "coefficient of friction of all pairs, a number or an expression"},
    {"reach", number, "", "[0, inf)", "",
     "surfaces no farther apart at the start are a pair; by default the longest edge of the faces of both bodies, on "
     "the coarsest mesh"},
    {"adjust", number, "0", "[0, inf)", "",
     "gaps and overlaps at the start of up to this count as none: the surfaces touch there, without any strain"},
    pairing_key,
    resolve_key,
    renew_key,
};

constexpr const char* along_help =
    "a plugin's own option `normal`, where `normal` is the shape's: `along = \"body\"` of `contact`, `coulomb` and "
    "`tresca` is along the body's outer normals";

constexpr KeySpec plane_obstacle[] = {
    {"point", fields, nullptr, "", "", "a point of the plane"},
    {"normal", fields, nullptr, "", "", "points from the obstacle towards the body; of any length"},
    {"along", text, "", "", "", along_help},
};
constexpr KeySpec sphere_obstacle[] = {
    {"center", fields, nullptr, "", "", "centre"},
    {"radius", field, nullptr, "(0, inf)", "", "radius"},
    {"inside", boolean, "false", "", "", "the body lies inside"},
};
constexpr KeySpec cylinder_obstacle[] = {
    {"center", fields, nullptr, "", "", "a point of the axis"},
    {"axis", fields, nullptr, "", "", "direction of the axis; of any length"},
    {"radius", field, nullptr, "(0, inf)", "", "radius"},
};
constexpr KeySpec surface_obstacle[] = {
    {"file", file, nullptr, "", "", "a triangle surface in OFF, OBJ, STL or PLY"},
    {"geometry", text, "smooth", "smooth | facets", "", "smooth: a smooth surface through the vertices"},
    {"crease", number, "35", "(0, 180)", "",
     "triangles that meet at more degrees meet at an edge of the obstacle in any case"},
};
constexpr KeySpec expression_obstacle[] = {
    {"distance", field, nullptr, "", "", "positive outside the obstacle, zero on its surface; need be no distance"},
    {"normal", fields, "", "", "",
     "points from the obstacle towards the body, and is what distances are measured along; by default towards the "
     "nearest point"},
    {"along", text, "", "", "", along_help},
};

constexpr ShapeSpec rigid_shapes[] = {
    {"plane", 0, "a half space (2D: a half plane)", plane_obstacle},
    {"sphere", 0, "in 2D a disk", sphere_obstacle},
    {"cylinder", 3, "infinitely long", cylinder_obstacle},
    {"surface", 3, "a triangle mesh", surface_obstacle},
    {"expression", 0, "given by a function", expression_obstacle},
};

constexpr KeySpec refine[] = {
    {"uniform", integer, "0", "[0, 30]", "", "uniform refinements of the coarsest mesh"},
    {"adaptive", boolean, "false", "", "",
     "solve, estimate the error, cut the elements that have most of it, and solve again, until one of the next four "
     "keys ends that: one body, or some that may touch each other; one step"},
    {"tolerance", number, "0.01", "(0, 1)", "",
     "adaptive runs end where the upper bound of the energy error, or an estimate where there are no bounds, is at "
     "most "
     "this part of the energy"},
    {"max_unknowns", integer, "1000000", "[1, 2000000000]", "", "or where the next mesh would have more unknowns"},
    {"max_steps", integer, "30", "[0, 1000]", "", "or after so many refinements"},
    {"max_seconds", number, "3600", "(0, inf)", "", "or where this time is over"},
    {"goal", text, "energy", "energy | force | peak_pressure | ...", "",
     "what meshes are refined for, and what `tolerance` is a part of. energy: all of the solution; force: the largest "
     "normal force of an obstacle; peak_pressure: the largest pressure of contact; \"probe NAME\": how far a probe "
     "moves, or its value. These three are estimated, with no bounds"},
};

constexpr KeySpec symmetry[] = {
    {"x", number, "", "", "", "bodies are cut where x has this value, and the side of the greater x is kept"},
    {"y", number, "", "", "", "the same across y"},
    {"z", number, "", "", "", "the same across z"},
};

constexpr KeySpec steps[] = {
    {"count", integer, "1", "[1, 1000000]", "", "number of equal steps, `t` running from 1/count to 1"},
    {"at", ascending, "", "(0, 1]", "", "in place of `count` the values of `t`, the last one 1"},
    {"halvings", integer, "4", "[0, 20]", "", "how often a step that fails is cut in two; 0: never"},
};

constexpr KeySpec probe[] = {
    {"name", text, nullptr, "", "", "what the report calls it"},
    {"body", text, nullptr, "", "", "name of a body"},
    {"at", point, nullptr, "", "", "where the displacement (scalar bodies: the value) is reported"},
};

constexpr KeySpec plugins[] = {
    {"path", texts, "[]", "", "",
     "folders searched first; then those of `SIGNORINI_PLUGIN_PATH`, then the installed folder"}};

constexpr KeySpec output[] = {
    {"vtu", boolean, "true", "", "",
     "write the solution for ParaView, packed where it pays; `gap` is NaN where no obstacle can be reached"},
    {"pictures", boolean, "true", "", "", "draw the convergence history and the result, and forces over several steps"},
    {"convergence", boolean, "true", "", "", "write the tables: of convergence and, with several steps, `steps.csv`"},
};

const std::vector<TableSpec>& tables() {
  static const std::vector<TableSpec> all = {
      {"body", true,
       "The body to be deformed, or the domain of a scalar equation. There may be several, in one report. They are "
       "solved one after the other; bodies that may touch each other are solved together.",
       body},
      {"material", true, "What a part of a body is made of that the mesh file names; elsewhere the body's own holds.",
       material},
      {"fix", true, "A Dirichlet condition: what is prescribed at the nodes of the faces picked by `on` or `where`.",
       fix},
      {"load", true, "A force that pulls or pushes.", load},
      {"spring", true,
       "Springs, or an elastic foundation: a traction that is proportional to the displacement, and against it.",
       spring},
      {"rigid", true,
       "Faces of an elastic body that move as a rigid body does: each component of its displacement and its rotation "
       "is "
       "prescribed, or free and moved by a force, a torque. See docs/joints.md.",
       rigid},
      {"obstacle", true, "What the body may not penetrate.", obstacle},
      {"contact", false,
       "Obstacles between elastic bodies that need not be listed: pairs of them are found by their distance. See "
       "docs/pairs.md.",
       contact},
      {"solver", false, "How the algebraic problem is solved.", solver_keys()},
      {"refine", false, "How the mesh is refined.", refine},
      {"symmetry", false,
       "Planes of symmetry of the whole scene: a half, a quarter or an eighth of every body is meshed, and the report "
       "is that of the whole.",
       symmetry},
      {"steps", false,
       "Quasi-static loading: several solves, one after the other. Numbers may depend on the step by `t`.", steps},
      {"probe", true, "A point whose result is reported.", probe},
      {"plugins", false, "Where obstacle plugins are found.", plugins},
      {"output", false, "Which files are written beside the report.", output},
  };
  return all;
}

template <class Spec>
const Spec* find(std::span<const Spec> specs, std::string_view name) {
  const auto found = std::find_if(specs.begin(), specs.end(), [&](const Spec& s) { return name == s.name; });
  return found == specs.end() ? nullptr : &*found;
}

template <class Spec>
std::vector<std::string> names(std::span<const Spec> specs) {
  std::vector<std::string> all;
  for (const Spec& spec : specs) all.push_back(spec.name);
  return all;
}

}  // namespace

std::span<const KeySpec> top_keys() { return top; }
std::span<const TableSpec> table_specs() { return tables(); }
std::span<const ShapeSpec> body_shapes() { return shapes; }
std::span<const ShapeSpec> obstacle_shapes() { return rigid_shapes; }

const TableSpec* find_table(std::string_view name) { return find<TableSpec>(tables(), name); }
const KeySpec* find_key(std::span<const KeySpec> keys, std::string_view name) { return find(keys, name); }
const ShapeSpec* find_shape(std::span<const ShapeSpec> all, std::string_view name) { return find(all, name); }
std::vector<std::string> names_of(std::span<const KeySpec> keys) { return names(keys); }
std::vector<std::string> names_of(std::span<const ShapeSpec> all) { return names(all); }

std::span<const ShapeSpec> shapes_of(const TableSpec& table) {
  if (std::string_view(table.name) == "body") return body_shapes();
  if (std::string_view(table.name) == "obstacle") return obstacle_shapes();
  return {};
}

std::vector<std::string> all_names(const TableSpec& table) {
  std::vector<std::string> all = names_of(table.keys);
  for (const ShapeSpec& shape : shapes_of(table))
    for (const KeySpec& key : shape.keys) all.push_back(key.name);
  return all;
}

}  // namespace signorini
