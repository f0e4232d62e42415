#pragma once
#include <string>
#include <vector>

#include "amg/coarse/allowed_motions.hpp"
#include "driver/motions/free_motions.hpp"

namespace signorini {

/// Whether obstacles, taken by their bounds and by the cones of friction, hold a body against its loads.
template <int D, int B>
class LimitAnalysis {
 public:
  /// Keeps a reference.
  explicit LimitAnalysis(const FreeMotions<D, B>& body) : body_(body) {}

  /// Whether nothing but friction may hold the body: the loads do work along a motion that no bound ends.
  bool needs_friction() const;

  /// Error(Exit::no_solution) that names a motion along which the loads do work and that no bound ends, whatever
  /// friction takes of that work: then no forces within the cones of friction bear the loads, and without friction the
  /// energy has no minimum. Exact but for rounding: a motion counts whose work is more than 1e-10 of what the loads
  /// could do. (Where such forces are, Coulomb's law may yet have no solution.)
  void require_minimum() const;

 private:
  using Free = FreeMotions<D, B>;
  using Room = typename Free::Room;

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

  Ends ends() const;
  void add_end(const Room& room, Ends& out) const;
  std::string describe_fall(const Ends& ends, const Eigen::VectorXd& motion) const;
  double resistance(const Eigen::VectorXd& motion) const;
  bool slides_along(const std::vector<double>& step, double least) const;

  const FreeMotions<D, B>& body_;
};

}  // namespace signorini
