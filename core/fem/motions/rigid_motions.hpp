#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/solver/discrete_problem.hpp"

namespace signorini {

inline constexpr int most_bodies = 16;  ///< of one problem

/// Motions without energy as combinations of modes. Elasticity (B = D): the translations along the axes, then the
/// rotations (3D: about x, y and z) about the middle of the body as they move points at a distance of half its size,
/// all of them in units of length. Diffusion (B = 1): the constant. Of several bodies that are one problem each has
/// modes of its own: first the translations of all of them, then their rotations.
template <int D, int B>
class RigidMotions {
 public:
  static constexpr int modes = B == 1 ? 1 : D * (D + 1) / 2;  ///< of one body
  static constexpr int translations = B == 1 ? 1 : D;         ///< among them
  using Motion = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, modes * most_bodies, 1>;
  using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, modes * most_bodies>;

  /// Keeps a reference. An axisymmetric elastic body has the translation along the axis alone: the other modes have
  /// energy, move nothing here and are never free.
  /// @param of_node per node the number of its body; empty: there is one
  explicit RigidMotions(const Nodes<D>& nodes, Plane plane = Plane::strain, std::vector<Index> of_node = {});

  /// Half the longest extent of a body.
  double size() const { return size_; }
  /// Of all bodies.
  int count() const { return modes * static_cast<int>(bodies_.size()); }

  /// How much each mode moves the node p along d.
  Row along(Index p, const double* d) const;
  /// The same of the unknowns of a problem, where these are jumps by how much it moves p more than the other body.
  Row along(const DiscreteProblem<B>& problem, Index p, const double* d) const;
  /// The same along local component k of the node.
  Row along(const DiscreteProblem<B>& problem, Index p, int k) const;

  /// Those that the prescribed values leave free: an orthonormal basis, one per column, none where they hold the body.
  Eigen::MatrixXd free(const DiscreteProblem<B>& problem) const;

  /// The one nearest to the prescribed values, by least squares; the shortest where there are several.
  Motion nearest_to_prescribed(const DiscreteProblem<B>& problem) const;

  /// For messages: "translation along (1, 0)", "rotation about (0.5, 2)".
  std::string describe(const Motion& motion) const;
  /// A basis of a space of motions, as simple as it goes: first translations, then rotations.
  std::vector<Motion> simple_basis(const Eigen::MatrixXd& space) const;

 private:
  struct Body {
    Point<D> low, high, middle{};
    double size = 0;
  };
  using One = Eigen::Matrix<double, modes, 1>;

  void add(Index p, const double* d, Row& row) const;
  One part(const Motion& motion, std::size_t body) const;
  std::string at(const Body& body, const Point<D>& from_middle) const;
  std::string describe(const Body& body, const One& motion) const;
  std::string name_of(std::size_t body) const;

  const Nodes<D>& nodes_;
  bool axial_;  // no motion but along the axis
  std::vector<Index> of_node_;
  std::vector<Body> bodies_;
  double size_ = 0;
};

}  // namespace signorini
