#pragma once
#include <string>
#include <vector>

#include "core/io/warning.hpp"
#include "driver/reports/results.hpp"

namespace signorini {

/// Obstacles that the body starts deep inside, more than a tenth of its extent, or completely: it is likely that the
/// normal is reversed. One sentence each.
/// @param everywhere asks the whole boundary, not just the part the obstacle acts on
template <int D, int B>
Warnings start_warnings(const Nodes<D>& nodes, const Model<B>& model, bool everywhere = false);

/// Error(Exit::input) for a rigid obstacle that acts outwards on the faces that it may touch: it lies on the wrong
/// side.
template <int D>
void refuse_pulling(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& contact,
                    const std::vector<double>& u);

/// Obstacles between two bodies of which no face of one is in front of the other one's: nothing happens there.
template <int D, int B>
Warnings pair_warnings(const Nodes<D>& nodes, const Model<B>& model);

/// Bodies and obstacles that face each other, and that no step brings together.
template <int D, int B>
Warnings apart_warnings(const Scene& scene, std::size_t body, const Report& report, const Results<D, B>& results);

/// Where the deformed body is inside an obstacle, or off it where contact is claimed, by more than a hundredth of the
/// displacements there; contacts of too few nodes; and forces that held vertices
/// share with the obstacle. One sentence per obstacle and kind, for the worst step.
Warnings contact_warnings(const Scene& scene, const Report& report);

/// Error(Exit::input) where a body turns as a whole by more than half a turn, and obstacles were to stop it.
template <int D>
void refuse_turned(const Nodes<D>& nodes, const Model<D>& model, const std::vector<double>& u);

/// A body that turns, in the end, by more than a tenth of a radian as a whole, or so that linear kinematics moves it
/// outwards by more than a hundredth of what contact moves it by along its normals.
template <int D>
Warnings turn_warnings(const Model<D>& model, const Nodes<D>& nodes, const Results<D, D>& results);

/// Bodies and obstacles whose flat faces seem to stand for curved surfaces where they touch each other, on a refined
/// mesh: with a distance between both that counts beside the displacements there. One sentence per obstacle and kind.
template <int D, int B>
Warnings chord_warnings(const Model<B>& model, const MeshHierarchy<D>& hierarchy, const Nodes<D>& nodes,
                        const Results<D, B>& results);

}  // namespace signorini
