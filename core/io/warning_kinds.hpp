#pragma once
#include <algorithm>

#include "core/io/warning.hpp"

namespace signorini {

/// All that is warned of, in the order of docs/warnings.md. Reports give the ids: none is given another meaning.
inline constexpr WarningKind warning_kinds[] = {
    {WarningKind::About::scene, "cut-faces",
     "{}: '{}' cuts through faces of the coarsest mesh, which are picked as a whole: {} of {:.4g} are picked{}; a "
     "smaller 'size' or more 'cells' follow it more closely{}",
     "`where` is judged on faces of the coarsest mesh, as a whole. The message says how much area is picked too much, "
     "or left out",
     "a smaller `size` or more `cells`; or let the cut run along edges of the mesh"},
    {WarningKind::About::scene, "conflicting-fixes",
     "{}: prescribes other values than {} at {} {}, where they meet; the later one holds",
     "two fixes disagree at common nodes", "mostly harmless; else pick faces apart"},
    {WarningKind::About::scene, "unknown-drag",
     "{}: 'distance' depends on t and tells how the obstacle moves across its surface, not along it: friction takes it "
     "to be at rest along it; a plane, sphere or cylinder that moves drags the body with it",
     "friction takes an obstacle of shape `expression` to be at rest along its surface",
     "a plane, sphere or cylinder that moves drags the body"},
    {WarningKind::About::scene, "starts-inside",
     "{}: the body starts {}inside the obstacle: it reaches {:.3g} deep, and is {:.3g} thick along the obstacle's "
     "normal "
     "there; is that normal reversed?",
     "by more than a tenth of the body's thickness there, or completely", "is the normal reversed?"},
    {WarningKind::About::scene, "not-facing",
     "{}: no face of one body is in front of the other one's, opposite to it: these bodies never touch; is another "
     "side "
     "meant?",
     "these two never touch", "check `on` and `other_on`"},
    {WarningKind::About::scene, "prescribed-slave",
     "{}: the displacement of {} of {} nodes of the slave on the coarsest mesh is prescribed along the {}; expected "
     "free "
     "nodes, or the other side as the slave ('slave')",
     "along the normal: nothing keeps the master off these nodes. Along the surface: no friction acts at them along "
     "what is prescribed",
     "free them, or set `slave`"},
    {WarningKind::About::scene, "locking", "poisson = {}: {} nearly incompressible material, {}",
     "linear elements are too stiff there: they lock. Quadratic ones of displacements alone lose accuracy",
     "remove `order` and `pressure`: the defaults do not lock ([rubber.md](rubber.md))"},
    {WarningKind::About::scene, "linear-elements",
     "{}: elements are linear, for quadratic ones do not fit: {}. Linear elements bend too little: a coarser mesh of "
     "quadratic ones is likely to be more accurate",
     "there is too little memory", "a coarser mesh of quadratic ones is likely to be more accurate"},

    {WarningKind::About::mesh, "hinge", "{}: elements hang together only by the {}{}: the body has a hinge there",
     "the body has a hinge at that vertex or edge", "mend the mesh, if it is not meant"},
    {WarningKind::About::mesh, "torn",
     "{}: the vertex at {} lies inside the {} of an element that it is no vertex of{}: the body is torn there",
     "a vertex lies inside an edge or a face", "mend the mesh"},
    {WarningKind::About::mesh, "group-inside",
     "{}: {} of the {} {} of the physical group '{}' are not on the boundary: they are left out of the part of that "
     "name",
     "the part is smaller than the group", "mostly harmless"},
    {WarningKind::About::mesh, "chord-volume",
     "{}: the mesh has {:.2g} % {} volume than the surface in the file: its faces are flat between vertices on that "
     "surface, which curves there, and stay so however often they are refined; expected a smaller 'size'",
     "a `solid` has flat faces where the surface curves: refinement does not bring that back", "a smaller `size`"},
    {WarningKind::About::mesh, "straight-edges",
     "{}: {} midpoints of edges stay off the curved surface they belong to, or elements would be turned inside out "
     "there; a finer mesh follows it",
     "elements would be turned inside out there", "a finer mesh follows it"},
    {WarningKind::About::mesh, "flat-faces",
     "{}: if the flat faces of the {} stand for a curved surface where they touch, they are up to {:.3g} off it, where "
     "{}displacements are up to {:.3g}: the gap is off by up to {:.2g} % of what closes it, refinement brings out the "
     "edges between faces, and the largest pressure gets worse with it; geometry = 'smooth' of that {}{} puts a smooth "
     "surface through the vertices, but where single faces between edges tell nothing round",
     "pressures get worse with refinement",
     "`geometry = \"smooth\"`, or a second-order mesh: [geometry.md](geometry.md#warnings)"},
    {WarningKind::About::mesh, "smoothed-edges",
     "{}: where they touch, the {} is taken for a smooth surface over faces that meet at up to {:.3g} degrees, and is "
     "{:.3g} off these, where {}displacements are up to {:.3g}: such a surface is as good as its vertices; expected "
     "smaller faces, or, where an edge is meant, a smaller 'crease'",
     "that surface is only as good as its vertices", "smaller faces, or a smaller `crease` where an edge is meant"},

    {WarningKind::About::result, "too-curved",
     "{}: the deformed body is up to {:.3g} {}, where displacements are up to {:.3g}{}: contact is linearised about "
     "the "
     "undeformed body, and {}",
     "it reaches into the obstacle, or contact is claimed where it is off it: displacements are too large for this "
     "curvature, or take the body over an edge of the obstacle, or elements are too large for this contact",
     "smaller displacements; a finer mesh; between bodies, more `[steps]`"},
    {WarningKind::About::result, "between-nodes",
     "{}: between its nodes the deformed body is up to {:.3g} inside the obstacle, {}{}: conditions hold at nodes "
     "alone; "
     "expected smaller elements there",
     "the obstacle is small beside the elements", "smaller elements there"},
    {WarningKind::About::result, "unresolved-contact",
     "{}: {} in contact, too few inside it to find its pressures: the largest pressure and the size of the contact may "
     "be off by a third or more, or depend on the mesh where an edge or a corner touches; expected smaller elements "
     "there",
     "largest pressure and area may be off by a third or more",
     "smaller elements there: [pressures.md](pressures.md#is-it-fine-enough)"},
    {WarningKind::About::result, "peak-at-edge",
     "{}: the largest pressure is where an edge or a corner touches: there it grows with smaller elements, and is not "
     "to "
     "be relied on",
     "the exact pressure is infinite there", "use the force, not this pressure"},
    {WarningKind::About::result, "never-touch",
     "{}: '{}' {} never touch; at the end a distance of {:.3g} is left between them",
     "the message says which distance is left", "is the right side picked? Is the load large enough?"},
    {WarningKind::About::result, "slid-past",
     "{}: {} of {} nodes in contact have come to where the other body is no longer in front of them{}: pairs are those "
     "of the start of a step; expected smaller steps ([steps])",
     "bodies slid far within a step", "smaller steps"},
    {WarningKind::About::result, "slides-on",
     "{}: in a step bodies slide past each other by more than part of an element, however often they are paired anew: "
     "take shorter steps",
     "what they are paired with changes at every try", "shorter steps"},
    {WarningKind::About::result, "friction-turned",
     "step {}: at t = {} friction has turned round: {}; expected shorter steps ([steps])",
     "nodes that have just come into contact carry most of it", "shorter steps"},
    {WarningKind::About::result, "step-cut", "step {}: from t = {} to {} {}, and it was cut in two: {}",
     "it had no solution in one piece", "nothing, if the run ends with 0"},
    {WarningKind::About::result, "undetermined-force",
     "{}: {} of {} nodes in contact are held along the obstacle's normal by a fix, or pressed on by other obstacles as "
     "well, along directions that depend on each other{}: how the force there divides is not determined; what presses, "
     "{:.3g}, is counted as the obstacle's",
     "how the force there divides between fix and obstacle has no answer", "let the fix end before the contact does"},
    {WarningKind::About::result, "undetermined-motion",
     "{}: neither loads nor fixes nor obstacles determine these motions: {}; the solution moves least along them",
     "the result is right up to this motion. Of all solutions the one that moves least is given",
     "a fix, if the place matters"},
    {WarningKind::About::result, "unbalanced", "body '{}': forces balance up to {:.2g}, where {}",
     "forces are not known better than that; or the loads are so small that what they do is not known",
     "a smaller tolerance, if the message says so, else that is what the machine's precision leaves; larger loads, or "
     "less prescribed displacement"},
    {WarningKind::About::result, "large-turn",
     "{}: {} turns by {:.2g} degrees: linear elasticity and contact take rotations for small ones, and see strains of "
     "{:.1g} in this one that are not there",
     "linear elasticity sees strains that are not there", "smaller displacements, or turn the model instead"},
    {WarningKind::About::result, "large-strain",
     "{}: strains are up to {}, and beyond {:g} in {:.3g} % of the body: linear elasticity and contact take strains "
     "for "
     "small ones{}",
     "over `0.2` in a twentieth of a body", "smaller loads; take results as proportional to them"},
    {WarningKind::About::result, "accuracy-not-reached",
     "{}: the upper bound of the energy error is {:.3g} of the energy, not {:g}, which is asked for: {}",
     "an adaptive run ended before it was as accurate as `refine.tolerance` says",
     "more `refine.max_unknowns`, `max_steps` or `max_seconds`, or a larger `tolerance`"},
    {WarningKind::About::result, "no-pictures", "no pictures were drawn: {}", "the library for pictures does not load",
     "all other results are there"},
    {WarningKind::About::result, "missing-picture", "a picture is missing: {}", "mostly too little memory",
     "all other results are there"},
    {WarningKind::About::result, "interrupted",
     "interrupted: these results are those of the last iterate, which is no solution",
     "the solve was interrupted before it had a solution", "let it come to its end"},
    {WarningKind::About::result, "no-output",
     "standard output: cannot be written: is the disk full, or its reader gone? The results are in their files.",
     "only printed: the report is written by then", "look into the report"},
};

/// The id of a kind, as a parameter of templates.
template <std::size_t N>
struct WarningId {
  char text[N];
  consteval WarningId(const char (&given)[N]) { std::ranges::copy(given, text); }  // NOLINT: it is a text
};

/// Does not compile for an id that the table does not have.
consteval const WarningKind& warning_kind(std::string_view id) {
  for (const WarningKind& kind : warning_kinds)
    if (id == kind.id) return kind;
  throw "the table has no such kind";
}

/// warning<"no-pictures">(reason): its text with the values put in.
template <WarningId id, class... Values>
Warning warning(Values&&... values) {
  constexpr const WarningKind& kind = warning_kind(id.text);
  return {kind.id, fmt::format(fmt::format_string<Values...>(kind.text), std::forward<Values>(values)...)};
}

}  // namespace signorini
