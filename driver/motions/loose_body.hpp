#pragma once
#include <string>
#include <vector>

#include "driver/motions/free_motions.hpp"

namespace signorini {

/// A body as far as its prescribed values leave it free to move without energy: whether obstacles hold it against the
/// loads, and where it comes to rest where neither they nor the loads decide. Obstacles are taken by their bounds
/// alone. Costs next to nothing where the prescribed values hold the body.
template <int D, int B>
class LooseBody {
 public:
  /// Keeps references to all of them.
  LooseBody(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization)
      : body_(nodes, model, discretization) {}

  /// Whether the prescribed values leave it no motion.
  bool held() const { return body_.none(); }

  /// See LimitAnalysis.
  bool needs_friction() const;
  /// Likewise.
  void require_minimum() const;

  /// Moves x (local coordinates), or the undeformed body where that has less energy then, as a rigid body to where
  /// prescribed values, obstacles and loads take it. What is stiff comes to rest next to that, and iterations find it
  /// slowly.
  /// @return the way of the undeformed body there (local coordinates); empty: it stays where it is
  /// @throws Error(Exit::input) where that is a turn by more than a hundred radians
  std::vector<double> fall(std::vector<double>& x) const;

  /// Whether the motion that takes the undeformed body nearest to x (local coordinates), of those that the prescribed
  /// values leave, is beyond linearised contact: more than a turn by one radian, or than a way of a hundred times
  /// the size of the body.
  bool is_far_away(const std::vector<double>& x) const;

  /// Moves x (local coordinates) by the rigid motion of those that springs alone hold, beside obstacles, which lowers
  /// the energy most. Only springs, loads and bounds see it: where springs are soft that is little beside the stiffness
  /// of the body, and iterations hardly do.
  /// @return the energy norm of the motion, user's unit
  double rest_on_springs(std::vector<double>& x) const;

  /// Of all solutions that differ by motions which cost nothing, moves x (local coordinates), one of them, to that of
  /// least mean square. What the obstacles press on keeps its contact, and its place along them where there is
  /// friction. Nothing is moved where obstacles have other energies.
  /// @return names of motions that span those which nothing decides
  std::vector<std::string> settle(std::vector<double>& x) const;

 private:
  using Motions = RigidMotions<D, B>;
  using Free = FreeMotions<D, B>;
  using Room = typename Free::Room;

  Eigen::VectorXd nearest_motion(const std::vector<double>& x) const;
  double turn(const Eigen::VectorXd& motion) const;  // radians, the largest about an axis
  void refuse_turned(const Eigen::VectorXd& motion) const;
  std::vector<double> as_prescribed() const;
  bool is_near(const typename Motions::Motion& motion) const;
  Eigen::VectorXd come_clear(std::vector<double>& x) const;
  Eigen::VectorXd let_fall(std::vector<double>& x) const;
  void touch(double rounding, std::vector<double>& x) const;
  void add_pressed(Index slot, const std::vector<double>& x, std::vector<double>& forces,
                   std::vector<Eigen::RowVectorXd>& rows) const;
  Eigen::MatrixXd pressed(const std::vector<double>& x) const;
  static Eigen::RowVectorXd along(const Room& room, const Eigen::MatrixXd& costless);
  Eigen::MatrixXd undecided(const std::vector<Room>& rooms, const Eigen::MatrixXd& costless, double size) const;
  Eigen::VectorXd least_motion(const std::vector<double>& x, const std::vector<Room>& rooms,
                               const Eigen::MatrixXd& costless) const;
  std::vector<double> displacements(const Eigen::VectorXd& motion) const;
  Eigen::VectorXd work_along(const std::vector<double>& forces, const Eigen::MatrixXd& of) const;
  void move(const Eigen::VectorXd& motion, std::vector<double>& x) const;
  void move_and_stay(const Eigen::VectorXd& motion, std::vector<double>& x) const;

  const FreeMotions<D, B> body_;
};

}  // namespace signorini
