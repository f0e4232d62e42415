#pragma once
#include <string>
#include <vector>

#include "core/io/picture.hpp"
#include "core/io/warning.hpp"
#include "core/mesh/mesh.hpp"

namespace signorini {

/// A vertex that an obstacle may reach.
struct Reached {
  Index vertex;
  int obstacle;  ///< number in the scene
};

/// What a picture of the result needs, on the vertices of the finest mesh.
template <int D>
struct Shown {
  const MeshHierarchy<D>& hierarchy;
  std::vector<double> displacement;  ///< D per vertex, empty for scalar problems
  std::vector<double> value;         ///< von Mises stress, or u
  std::string label;
  std::vector<Flags> contact;    ///< 0 where the vertex is free, 1 in contact, with friction 2 where it slips, 3 sticks
  std::vector<double> pressure;  ///< contact pressure, empty for scalar problems
  std::vector<double> tangential;  ///< tangential traction, three per vertex, likewise
  std::vector<Reached> reached;    ///< by obstacles, ascending; of two bodies that touch each other on the slave
  bool two_bodies = false;         ///< parts of the mesh touch each other
};

/// The panels of result.png. Meshes too fine to be seen are drawn on a coarser level; a note in `notes` says when even
/// the coarsest is too fine. Panels may be empty.
/// The deformed body coloured by `value`, bodies in space that touch each other cut open where they do, and the contact
/// pressure seen along its normal (3D) or as a profile (2D); where there is friction, besides, where it slips and
/// sticks, in 2D with the tangential traction. Profiles are lines for each obstacle. They begin to count in the middle
/// of its contact, the mean place weighted by pressure.
template <int D>
std::vector<Panel> elastic_panels(const Shown<D>& shown, Warnings& notes);
/// The graph of u (2D) or a section (3D), and the coincidence set likewise.
template <int D>
std::vector<Panel> scalar_panels(const Shown<D>& shown, Warnings& notes);

}  // namespace signorini
