#pragma once
#include <string>
#include <vector>

#include "amg/coarse/allowed_motions.hpp"
#include "core/fem/discretize.hpp"
#include "core/fem/rigid_motions.hpp"

namespace signorini {

/// A body as far as its prescribed values leave it free to move without energy: whether obstacles hold it against the
/// loads, and where it comes to rest where neither they nor the loads decide. Obstacles are taken by their bounds
/// alone. Costs next to nothing where the prescribed values hold the body.
template <int D, int B>
class LooseBody {
 public:
  /// Keeps references to all of them.
  LooseBody(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization);

  /// Whether the prescribed values leave it no motion.
  bool held() const { return free_.cols() == 0; }

  /// Whether nothing but friction may hold the body: the loads do work along a motion that no bound ends.
  bool needs_friction() const;

  /// Error(Exit::no_solution) that names a motion along which the loads do work and that no bound ends, whatever
  /// friction takes of that work: then no forces within the cones of friction bear the loads, and without friction the
  /// energy has no minimum. Exact but for rounding: a motion counts whose work is more than 1e-10 of what the loads
  /// could do. (Where such forces are, Coulomb's law may yet have no solution.)
  void require_minimum() const;

  /// Moves x (local coordinates), or the undeformed body where that has less energy then, as a rigid body to where
  /// prescribed values, obstacles and loads take it. What is stiff comes to rest next to that, and iterations find it
  /// slowly.
  /// @return the way of the undeformed body there (local coordinates); empty: it stays where it is
  std::vector<double> fall(std::vector<double>& x) const;

  /// Whether the motion that takes the undeformed body nearest to x (local coordinates), of those that the prescribed
  /// values leave, is beyond linearised contact: more than a turn by one radian, or than a way of a hundred times
  /// the size of the body.
  bool is_far_away(const std::vector<double>& x) const;

  /// Of all solutions that differ by motions which cost nothing, moves x (local coordinates), one of them, to that of
  /// least mean square. What the obstacles press on keeps its contact.
  /// @return names of motions that span those which nothing decides
  std::vector<std::string> settle(std::vector<double>& x) const;

 private:
  using Motions = RigidMotions<D, B>;

  /// What a bound leaves to motions c: lower <= row . c <= upper.
  struct Room {
    Index vertex;
    Eigen::RowVectorXd row;
    double lower, upper;
    double normal;  ///< component of the bounded direction along the one that presses against friction
  };

  /// What friction leaves to motions c: those that leave an obstacle by at least `coefficient` times their way along
  /// it. Against all others a force within its cone does work.
  struct Cone {
    Eigen::RowVectorXd away;
    Eigen::MatrixXd along;  ///< one row per tangential direction
    double coefficient;

    double size() const { return away.norm() + coefficient * along.norm(); }
    double excess(const Eigen::VectorXd& c) const { return away.dot(c) - coefficient * (along * c).norm(); }
    /// What a linear condition says of the same where it goes along as c.
    Eigen::RowVectorXd cut(const Eigen::VectorXd& c) const {
      return away - coefficient * (along * c).normalized().transpose() * along;
    }
  };

  /// What ends motions that go on.
  struct Ends {
    AllowedMotions allowed;
    std::vector<Eigen::RowVectorXd> rows;  ///< of what it knows
    std::vector<Cone> cones;

    void add(const Eigen::RowVectorXd& row);
    double worst(const Eigen::VectorXd& motion, std::size_t& cone) const;
    Eigen::VectorXd nearest(const Eigen::VectorXd& work, double enough);
    Eigen::VectorXd slide(const Eigen::VectorXd& motion) const;
  };

  void add_work();
  Ends ends() const;
  void add_end(const Room& room, Ends& out) const;
  std::string describe_fall(const Ends& ends, const Eigen::VectorXd& motion) const;
  Eigen::VectorXd nearest_motion(const std::vector<double>& x) const;
  double resistance(const Eigen::VectorXd& motion) const;
  double coefficient_of_friction(Index slot) const;
  int normal_component(Index slot) const;
  bool slides_along(const std::vector<double>& step, double least) const;
  std::vector<double> as_prescribed() const;
  bool is_near(const typename Motions::Motion& motion) const;
  Eigen::VectorXd come_clear(std::vector<double>& x) const;
  Eigen::VectorXd let_fall(std::vector<double>& x) const;
  void touch(double rounding, std::vector<double>& x) const;
  std::vector<Room> gaps(const std::vector<double>& x) const;
  std::vector<Room> rooms(const std::vector<double>& x) const;
  template <class Visit>
  void each_polyhedron(const Visit& visit) const;
  void add_pressed(Index slot, const std::vector<double>& x, std::vector<double>& forces,
                   std::vector<Eigen::RowVectorXd>& rows) const;
  Eigen::MatrixXd pressed(const std::vector<double>& x) const;
  static Eigen::RowVectorXd along(const Room& room, const Eigen::MatrixXd& costless);
  Eigen::MatrixXd undecided(const std::vector<Room>& rooms, const Eigen::MatrixXd& costless, double size) const;
  Eigen::VectorXd least_motion(const std::vector<double>& x, const std::vector<Room>& rooms,
                               const Eigen::MatrixXd& costless) const;
  void add(const Eigen::VectorXd& motion, std::vector<double>& x) const;
  void move(const Eigen::VectorXd& motion, std::vector<double>& x) const;
  void move_and_stay(const Eigen::VectorXd& motion, std::vector<double>& x) const;

  const Nodes<D>& nodes_;
  const Model<B>& model_;
  const Discretization<B>& discretization_;
  Motions motions_;
  Eigen::MatrixXd free_;  // columns: an orthonormal basis
  Eigen::VectorXd work_;  // of the loads along each of them
  double most_work_ = 0;  // that loads of this size could do along a motion of length one
};

}  // namespace signorini
