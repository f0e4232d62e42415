#pragma once
#include <algorithm>

#include "core/io/warning.hpp"

namespace signorini {

/// All that is warned of, in the order of docs/warnings.md. Reports give the ids: none is given another meaning.
inline constexpr WarningKind warning_kinds[] = {
    {WarningKind::About::scene, "cut-faces",
     "{}: '{}' cuts through faces of the coarsest mesh, and a face is picked as a whole or not at all: {} that "
     "measure {:.4g} in all are picked{}; a smaller 'size' or more 'cells' follow the cut more closely{}",
     "a face of the coarsest mesh is picked where the expression holds at all of its vertices. The message says how "
     "much area is picked too much, and how much is left out",
     "a smaller `size` or more `cells`; or let the cut run along edges of the mesh"},
    {WarningKind::About::scene, "conflicting-fixes",
     "{}: prescribes other values than {} at {} {} that both of them pick; the values of the later one hold",
     "two fixes prescribe different values at the same nodes",
     "usually nothing. If the values matter there, pick faces that do not meet"},
    {WarningKind::About::scene, "singular",
     "{}: {} {}: where it bears a force, stresses there grow without end as elements become smaller{}; expected "
     "faces, which may be small, where these numbers matter",
     "a force or a support at a point or along an edge. Its reaction is right, and so are results far away. Stresses "
     "next to it depend on the mesh alone. At a point the displacement does so, too",
     "nothing, if the support only stops the body from drifting; otherwise pick a small part of the boundary"},
    {WarningKind::About::scene, "off-vertex",
     "{}: the point ({}) is no vertex of the mesh: the nearest one is taken, ({}), which is {:.3g} away",
     "points are vertices of the mesh", "a vertex there, by `cells` or in the mesh file"},
    {WarningKind::About::scene, "unknown-drag",
     "{}: 'distance' depends on t. It says how the obstacle moves across its surface, but not how it moves along it: "
     "friction takes the obstacle to be at rest along its surface. A plane, sphere or cylinder that moves drags the "
     "body with it",
     "`distance` of an obstacle of shape `expression` does not say how the surface moves along itself. Friction "
     "takes it to be at rest there",
     "a plane, sphere or cylinder that moves drags the body"},
    {WarningKind::About::scene, "starts-inside",
     "{}: the body starts {}inside the obstacle: it reaches {:.3g} deep, and is {:.3g} thick along the obstacle's "
     "normal there; is the obstacle on the wrong side ('normal', 'inside')?",
     "before anything moves, the body is inside the obstacle: by more than a tenth of its thickness there, or "
     "completely",
     "turn `normal` around, if it points away from the body; set `inside`, if the body is meant to lie inside the "
     "shape; "
     "nothing, if the obstacle is meant to press from the start"},
    {WarningKind::About::scene, "not-facing",
     "{}: no face of one body is in front of the other one's and turned towards it: these bodies do not touch, unless "
     "steps move them; is "
     "another side meant?",
     "the faces that are picked on the two bodies do not face each other", "check `on` and `other_on`"},
    {WarningKind::About::scene, "tied-apart",
     "{}: the bodies do not touch exactly: they are up to {:.3g} apart, or overlap by as much. They are tied as they "
     "are: the tie carries forces across this distance as if it were zero",
     "`adjust` admits that tied bodies do not touch. Displacements are tied across the gap. A force across "
     "a gap has a moment of force times width, and the tie leaves this moment out",
     "let the faces lie on each other"},
    {WarningKind::About::scene, "prescribed-slave",
     "{}: the displacement of {} of {} nodes of the slave on the coarsest mesh is prescribed along the {}; expected "
     "free nodes there, or the other side as the slave ('slave')",
     "if prescribed along the normal, nothing keeps the master off these nodes. If prescribed along the surface, no "
     "friction acts at these nodes in the prescribed direction",
     "free the nodes, or set `slave`"},
    {WarningKind::About::scene, "locking", "poisson = {}: {} nearly incompressible material, {}",
     "linear elements are too stiff there: they lock. Quadratic elements without a pressure of their own lose "
     "accuracy",
     "remove `order` and `pressure`: the defaults do not lock ([rubber.md](rubber.md))"},
    {WarningKind::About::scene, "linear-elements",
     "{}: elements are linear, because quadratic ones do not fit: {}. Linear elements bend too little: a coarser "
     "mesh of quadratic ones is likely to be more accurate",
     "there is too little memory for quadratic elements",
     "a coarser mesh of quadratic elements, which is likely to be more accurate"},

    {WarningKind::About::mesh, "hinge", "{}: elements hang together only by the {}{}: the body has a hinge there",
     "the elements on both sides have only that vertex or edge in common", "correct the mesh, unless you want a hinge"},
    {WarningKind::About::mesh, "torn",
     "{}: the vertex at {} lies inside the {} of an element, and is no vertex of that element{}: the body is torn "
     "there",
     "a vertex lies inside an edge or a face of another element: the two are not connected there", "correct the mesh"},
    {WarningKind::About::mesh, "group-inside",
     "{}: {} of the {} {} of the physical group '{}' are not on the boundary: they are left out of the part of that "
     "name",
     "the part is smaller than the group", "usually nothing: look whether the part has the faces you want"},
    {WarningKind::About::mesh, "chord-volume",
     "{}: the mesh has {:.2g} % {} volume than the surface in the file. Faces of the mesh are flat where that "
     "surface is curved, and refinement does not change this; expected a smaller 'size'",
     "a `solid` has flat faces where the surface is curved. Refinement does not correct this", "a smaller `size`"},
    {WarningKind::About::mesh, "straight-edges",
     "{}: {} midpoints of edges are not moved onto the curved surface to which they belong: there they would turn "
     "elements inside out, at ({}){}; a finer mesh follows the surface",
     "edges stay straight at these midpoints, though the surface is curved", "a finer mesh, which follows the surface"},
    {WarningKind::About::mesh, "flat-faces",
     "{}: if the flat faces of the {} stand for a curved surface where they touch, they are up to {:.3g} off it, where "
     "{}displacements are up to {:.3g}. The gap is then wrong by up to {:.2g} % of the motion that closes it. "
     "Refinement resolves the edges between the faces, and so makes the largest pressure worse. geometry = 'smooth' of "
     "that {}{} puts a "
     "smooth surface through the vertices, but a single row of faces between two edges keeps these edges",
     "the flat faces seem to stand for a curved surface. Pressures then get worse with refinement",
     "`geometry = \"smooth\"`, or a second-order mesh: [geometry.md](geometry.md#warnings)"},
    {WarningKind::About::mesh, "smoothed-edges",
     "{}: where they touch, the {} is taken for a smooth surface over faces that meet at up to {:.3g} degrees. It is "
     "{:.3g} off these faces, where {}displacements are up to {:.3g}. Such a surface is only as good as its "
     "vertices; expected smaller faces, or, where an edge is meant, a smaller 'crease'",
     "the smooth surface is only as good as its vertices",
     "smaller faces, or a smaller `crease` where an edge is meant"},

    {WarningKind::About::result, "too-curved",
     "{}: the deformed body is up to {:.3g} {}, where {}displacements are up to {:.3g}{}: contact is linear in the "
     "displacements, and {}",
     "the deformed body reaches into the obstacle, or does not reach it at nodes that count as in contact. "
     "Displacements are too large for this curvature, or move the body over an edge of the obstacle, or elements are "
     "too large for this contact",
     "smaller displacements; a finer mesh; several `[steps]`, where parts of the body come from different places"},
    {WarningKind::About::result, "between-nodes",
     "{}: between its nodes the deformed body is up to {:.3g} inside the obstacle, {}{}: the condition of contact "
     "holds at nodes only; expected smaller elements there",
     "the obstacle is small in comparison with the elements", "smaller elements there"},
    {WarningKind::About::result, "unresolved-contact",
     "{}: {} in contact, and too few of them have contact all around to find pressures: the largest pressure and the "
     "size of the contact may be wrong by a third or more, or depend on the mesh where an edge or a corner touches; "
     "expected smaller elements there",
     "the largest pressure and the area may be wrong by a third or more",
     "smaller elements there: [pressures.md](pressures.md#is-it-fine-enough)"},
    {WarningKind::About::result, "peak-at-edge",
     "{}: the largest pressure is where an edge or a corner touches: there it grows as elements become smaller: do "
     "not rely on it",
     "the exact pressure is infinite there", "use the force, not this pressure"},
    {WarningKind::About::result, "never-touch", "{}: '{}' {} never touch; at the end {}",
     "the message says which distance is left",
     "check that the right side is picked, and that the load is large enough"},
    {WarningKind::About::result, "unheld-overlap",
     "bodies '{}' and '{}' have moved into each other, by {:.3g} at ({:.3g}), and no [[obstacle]] keeps them apart",
     "[contact] finds pairs of bodies that are near each other at the start. Bodies that come near each other later "
     "need a larger `reach`, or an `[[obstacle]]`",
     "an `[[obstacle]]` between these bodies, or a larger `reach` of `[contact]`"},
    {WarningKind::About::result, "slid-past",
     "{}: {} of {} nodes in contact have moved to where the other body is no longer in front of them{}. Which "
     "parts face each other is decided at the start of a step only; expected shorter steps ([steps])",
     "bodies slid far within a step", "shorter steps"},
    {WarningKind::About::result, "slides-on",
     "{}: within a step the bodies slide past each other by more than part of an element, and after each "
     "new pairing they do so again: take shorter steps",
     "each time the faces of the bodies are paired anew, the bodies slide on to other faces", "shorter steps"},
    {WarningKind::About::result, "pressed-shut",
     "{}: at {} nodes the pressure of a load with 'where_open' closes what it opens: it is left there; expected "
     "smaller elements",
     "where the pressure acts a joint closes, and where it does not it opens", "smaller elements there"},
    {WarningKind::About::result, "friction-turned",
     "step {}: at t = {} friction is in doubt: {}, and {}; expected shorter steps ([steps])",
     "nodes that have just come into contact carry most of the friction, and it turned round within the step, "
     "contact moved on by more than its size, or bodies came from apart along the surface; or bodies slid past each "
     "other in the first step",
     "shorter steps"},
    {WarningKind::About::result, "step-cut", "step {}: from t = {} to {} {}, and it was cut in two: {}",
     "the step could not be solved in one piece, or friction was in doubt", "nothing, if the run ends with 0"},
    {WarningKind::About::result, "undetermined-force",
     "{}: {} of {} nodes in contact are also held along the obstacle's normal by a fix, or pressed on by other "
     "obstacles along directions that depend on each other{}. How the force divides between them is not determined; "
     "all that presses there, {:.3g}, is counted as this obstacle's",
     "several conditions hold the same nodes. Only the sum of their forces is determined",
     "let the fix end before the contact does"},
    {WarningKind::About::result, "undetermined-motion",
     "{}: neither loads nor fixes nor obstacles determine these motions: {}; there are many solutions, and the one "
     "that "
     "moves least along them is given",
     "the result is right, except for this motion. Of all solutions the program gives the one that moves least",
     "a fix, if the place matters"},
    {WarningKind::About::result, "unbalanced", "body '{}': forces balance up to {:.2g} only, where {}",
     "forces are not known more accurately than that, or the loads are so small that their effect is not known",
     "a smaller tolerance, if the message says so; otherwise larger loads, or less prescribed displacement. An error "
     "that comes from the machine's precision cannot be removed"},
    {WarningKind::About::result, "large-turn",
     "{}: {} turns by {:.2g} degrees. Linear elasticity and contact are meant for small turns: this turn adds "
     "false strains of {:.1g}{}",
     "linear elasticity counts part of the turn as strain", "smaller displacements, or turn the model instead"},
    {WarningKind::About::result, "large-strain",
     "{}: strains are up to {}, and beyond {:g} in {:.3g} % of the body: linear elasticity and contact are meant for "
     "small strains{}",
     "strains are over `0.2` in more than a twentieth of a body",
     "smaller loads; or use the results only as numbers that are proportional to the loads"},
    {WarningKind::About::result, "accuracy-not-reached",
     "{}: the error of the {} is {} {:.3g} of it, but {:g} was asked for: {}",
     "an adaptive run ended before it was as accurate as `refine.tolerance` says",
     "more `refine.max_unknowns`, `max_steps` or `max_seconds`, or a larger `tolerance`"},
    {WarningKind::About::result, "bound-not-sharp",
     "{}: the upper bound of the energy error holds, but it is larger than it might be: the linear solve that makes it "
     "sharper did not converge",
     "`estimate = true` makes the upper bound smaller by one more linear solve, which did not converge here. The bound "
     "is the one of `estimate = \"cheap\"`",
     "nothing, if the bound is small enough; otherwise a mesh without slender elements"},
    {WarningKind::About::result, "no-pictures", "no pictures were drawn: {}", "the library for pictures does not load",
     "nothing: all other results are there"},
    {WarningKind::About::result, "missing-picture", "a picture is missing: {}", "usually there is too little memory",
     "nothing: all other results are there"},
    {WarningKind::About::result, "interrupted",
     "interrupted: these results are those of the last iterate, which is no solution",
     "the solve was interrupted before it had a solution", "let it come to its end"},
    {WarningKind::About::result, "no-output",
     "standard output: cannot be written: is the disk full, or its reader gone? The results are in their files.",
     "this warning is only printed, because the report is written before it", "read the report"},
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
