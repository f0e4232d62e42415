#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/fem/model.hpp"
#include "core/fem/nodes.hpp"
#include "core/solver/discrete_problem.hpp"

namespace signorini {

/// Motions without energy as combinations of modes. Elasticity (B = D): the translations along the axes, then the
/// rotations (3D: about x, y and z) about the middle of the body as they move points at a distance of half its size,
/// all of them in units of length. Diffusion (B = 1): the constant.
template <int D, int B>
class RigidMotions {
 public:
  static constexpr int modes = B == 1 ? 1 : D * (D + 1) / 2;
  static constexpr int translations = B == 1 ? 1 : D;
  using Motion = Eigen::Matrix<double, modes, 1>;
  using Row = Eigen::Matrix<double, 1, modes>;

  /// Keeps a reference. An axisymmetric elastic body has the translation along the axis alone: the other modes have
  /// energy, move nothing here and are never free.
  explicit RigidMotions(const Nodes<D>& nodes, Plane plane = Plane::strain);

  /// Half the longest extent of the body.
  double size() const { return size_; }

  /// How much each mode moves the node p along d.
  Row along(Index p, const double* d) const;
  /// The same along local component k of the node.
  Row along(const Frames<B>& frames, Index p, int k) const;

  /// Those that the prescribed values leave free: an orthonormal basis, one per column, none where they hold the body.
  Eigen::MatrixXd free(const DiscreteProblem<B>& problem) const;

  /// The one nearest to the prescribed values, by least squares; the shortest where there are several.
  Motion nearest_to_prescribed(const DiscreteProblem<B>& problem) const;

  /// For messages: "translation along (1, 0)", "rotation about (0.5, 2)".
  std::string describe(const Motion& motion) const;
  /// A basis of a space of motions, as simple as it goes: first translations, then rotations.
  std::vector<Motion> simple_basis(const Eigen::MatrixXd& space) const;

 private:
  std::string at(const Point<D>& from_middle) const;

  const Nodes<D>& nodes_;
  bool axial_;  // no motion but along the axis
  Point<D> middle_{};
  double size_ = 0;
};

/// The vectors that all rows of a matrix are orthogonal to, but for `tolerance` of its norm: an orthonormal basis.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& rows, double tolerance);

}  // namespace signorini
