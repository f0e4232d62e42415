#pragma once
#include <vector>

#include "core/fem/assembly/discretize.hpp"
#include "core/fem/motions/rigid_motions.hpp"
#include "core/sdk/friction.hpp"

namespace signorini {

/// Motions without energy, in springs either, that the prescribed values of a body leave, what loads do along them, and
/// what bounds leave of them. Motions are coefficients of the columns of `free`, or of `sprung` where that is said.
template <int D, int B>
struct FreeMotions {
  /// Parts of the most that is possible: work of loads, components of motions.
  static constexpr double negligible = 1e-10;
  static constexpr double projected = 1e-13;  ///< of what is projected: rounding
  static constexpr double decided = 1e-8;     ///< singular values of what forces forbid, relative to the largest

  /// What a bound leaves to motions c: lower <= row . c <= upper.
  struct Room {
    Index vertex;
    Eigen::RowVectorXd row;
    double lower, upper;
    double normal;  ///< component of the bounded direction along the one that presses against friction
  };

  /// Keeps references to all of them.
  FreeMotions(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization);

  /// Whether there are none.
  bool none() const { return free.cols() == 0; }

  /// What the bounds leave to an iterate; those that are not part of the problem, too.
  std::vector<Room> gaps(const std::vector<double>& x) const { return gaps(x, free); }
  /// The same to an admissible iterate.
  std::vector<Room> rooms(const std::vector<double>& x) const { return rooms(x, free); }
  /// @param of motions, one per column
  std::vector<Room> rooms(const std::vector<double>& x, const Eigen::MatrixXd& of) const;

  /// Zero where there is none.
  double coefficient_of_friction(Index slot) const { return friction(slot).coefficient; }
  /// The component across the obstacle at a slot with friction, -1 elsewhere.
  int normal_component(Index slot) const;

  /// Whether obstacles have no energy but that of friction which what presses causes.
  bool only_pressed_friction() const;

  /// Moves x (local coordinates) but for prescribed components.
  /// @param motion of all modes: free times the coefficients
  void add(const Eigen::VectorXd& motion, std::vector<double>& x) const;

  /// Calls visit(slot) for those whose bounds are the faces of a polyhedron.
  template <class Visit>
  void each_polyhedron(const Visit& visit) const {
    const Constraints<B>& c = discretization.problem.constraints;
    for (Index slot = 0; slot < c.size(); ++slot)
      if (c.has_facets(slot)) visit(slot);
  }

  const Nodes<D>& nodes;
  const Model<B>& model;
  const Discretization<B>& discretization;
  const RigidMotions<D, B> motions;
  const Eigen::MatrixXd unfixed;  ///< columns: an orthonormal basis of what prescribed values leave
  const Eigen::MatrixXd free;     ///< the same of those that have no energy in springs, either
  const Eigen::MatrixXd sprung;   ///< the same of what is across these: springs alone hold it
  Eigen::VectorXd work;           ///< of the loads along each of them
  double most_work = 0;           ///< that loads of this size could do along a motion of length one

 private:
  FrictionLaw friction(Index slot) const;
  void add_work();
  std::vector<Room> gaps(const std::vector<double>& x, const Eigen::MatrixXd& of) const;
};

}  // namespace signorini
