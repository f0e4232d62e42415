#pragma once
#include <vector>

#include "core/fem/elements/across.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/mesh/mesh.hpp"

/// Bodies of which one side of planes of symmetry is meshed: which conditions go on beyond the planes, whether they are
/// symmetric, and what the whole of a quantity is.
namespace signorini {

/// The planes that each condition goes on beyond. It stands for its images there, too; where it does not go on it is
/// one of two that are each other's images.
struct ConditionsAcross {
  std::vector<Planes> fixes, loads, springs, obstacles;  ///< as those of the model
};

/// By parts that have vertices on a plane, and by expressions that hold at the images of the faces they pick.
/// Error(Exit::input) where an expression holds at some of these images only.
template <int D, int B>
ConditionsAcross conditions_across(const Nodes<D>& nodes, const Model<B>& model);

/// Error(Exit::input) for material, fixes, loads, springs and obstacles that are not symmetric about planes they go on
/// beyond, as far as the vertices of this mesh and their images show.
template <int D, int B>
void refuse_asymmetric(const Mesh<D>& mesh, const Model<B>& model, const ConditionsAcross& across);

/// Both, on a mesh of a hierarchy that has vertices enough. Nothing where there are no planes.
template <int D, int B>
void check_symmetry(const MeshHierarchy<D>& hierarchy, const Model<B>& model);

/// What a quantity of the part that is meshed makes of the whole, and back.
class Whole {
 public:
  Whole(const std::vector<Mirror>& mirrors, Planes across);

  /// How many images there are: 1, 2, 4 or 8.
  int copies() const { return copies_; }
  /// Whether components along an axis cancel.
  bool cancels(int axis) const { return axes_ >> axis & 1u; }
  /// Total of a vector, with an entry per unknown; a scalar unknown knows no axes.
  template <class Vector>
  Vector total(Vector v) const {
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = v.size() > 1 && cancels(static_cast<int>(i)) ? 0 : copies_ * v[i];
    return v;
  }

 private:
  int copies_;
  unsigned axes_ = 0;
};

}  // namespace signorini
