#pragma once
#include <vector>

#include "core/fem/model.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mortar/couple.hpp"

namespace signorini {

/// The numbers of the faces that an obstacle between two bodies picks of each.
struct PairedFaces {
  std::vector<Index> slave, master;
};

template <int D>
PairedFaces paired_faces(const Mesh<D>& mesh, const ObstacleTerm<D>& term, double t);

/// The sides of an obstacle between two bodies, coupled. They see each other from anywhere.
template <int D>
MortarCoupling<D> couple_sides(const Mesh<D>& mesh, const ObstacleTerm<D>& term, const std::vector<Index>& slave,
                               const std::vector<Index>& master);

/// Of a face.
template <int D>
double longest_edge(const Mesh<D>& mesh, const Face<D>& face);

}  // namespace signorini
