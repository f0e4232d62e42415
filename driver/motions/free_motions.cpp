#include "driver/motions/free_motions.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/rounding.hpp"
#include "core/fem/assembly/springs.hpp"
#include "core/fem/motions/deciding_rows.hpp"
#include "core/mesh/connected.hpp"

namespace signorini {
namespace {

/// Per node the body it belongs to; empty where there is one.
template <int D, int B>
std::vector<Index> bodies_of(const Nodes<D>& nodes, const Model<B>& model) {
  return is_paired(model) ? connected_parts(nodes.mesh()) : std::vector<Index>();
}

/// Those of `free` that have no energy in springs.
template <int D, int B>
Eigen::MatrixXd not_in_springs(const Nodes<D>& nodes, const Model<B>& model, const RigidMotions<D, B>& motions,
                               const Eigen::MatrixXd& free) {
  if (free.cols() == 0 || model.springs.empty()) return free;
  DecidingRows rows(static_cast<int>(free.cols()));
  each_spring_hold<D, B>(nodes, model, [&](const SpringHold<B>& hold) {
    if (rows.complete()) return;
    typename RigidMotions<D, B>::Row row = RigidMotions<D, B>::Row::Zero(motions.count());
    for (const auto& [p, value] : hold.nodes) row += value * motions.along(p, hold.direction.data());
    rows.add(row * free);
  });
  return rows.complete() ? Eigen::MatrixXd(free.rows(), 0) : Eigen::MatrixXd(free * rows.null_space());
}

/// Those of the first space that are across the second one, which is a part of it.
Eigen::MatrixXd across(const Eigen::MatrixXd& space, const Eigen::MatrixXd& part) {
  if (part.cols() == 0 || space.cols() == part.cols()) return space.leftCols(space.cols() - part.cols());
  return space * null_space(part.transpose() * space, rounding_of_bases);
}

}  // namespace

template <int D, int B>
FreeMotions<D, B>::FreeMotions(const Nodes<D>& nodes, const Model<B>& model, const Discretization<B>& discretization)
    : nodes(nodes),
      model(model),
      discretization(discretization),
      motions(nodes, model.plane, bodies_of(nodes, model)),
      unfixed(motions.free(discretization.problem)),
      free(not_in_springs(nodes, model, motions, unfixed)),
      sprung(across(unfixed, free)) {
  if (!none()) add_work();
}

// Of the loads themselves: what prescribed values add to the right-hand side does none.
template <int D, int B>
void FreeMotions<D, B>::add_work() {
  const std::vector<double>& loads = discretization.load;
  using Row = typename RigidMotions<D, B>::Row;
  Row sum = Row::Zero(motions.count());
  for (Index p = 0; p < nodes.size(); ++p) {
    const double* b = loads.data() + Offset{p} * B;
    const auto here = motions.along(p, b);
    sum += here;
    most_work += here.norm();
  }
  work = free.transpose() * sum.transpose();
}

template <int D, int B>
auto FreeMotions<D, B>::rooms(const std::vector<double>& x, const Eigen::MatrixXd& of) const -> std::vector<Room> {
  std::vector<Room> out = gaps(x, of);
  for (Room& room : out) {
    room.lower = std::min(room.lower, 0.0);
    room.upper = std::max(room.upper, 0.0);
  }
  return out;
}

template <int D, int B>
auto FreeMotions<D, B>::gaps(const std::vector<double>& x, const Eigen::MatrixXd& of) const -> std::vector<Room> {
  std::vector<Room> out;
  const DiscreteProblem<B>& problem = discretization.problem;
  const auto add = [&](Index p, const Eigen::RowVectorXd& row, double lower, double upper, double normal) {
    if (row.norm() > negligible || normal != 0) out.push_back({p, row, lower, upper, normal});
  };
  for (Index slot = 0; slot < problem.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k) {
      const Offset at = Offset{slot} * B + k;
      const double lower = problem.constraints.lower[at], upper = problem.constraints.upper[at];
      if (lower == -infinity && upper == infinity) continue;
      const Index p = problem.constraints.vector[slot];
      const double value = x[Offset{p} * B + k];
      add(p, motions.along(problem, p, k) * of, lower - value, upper - value, k == normal_component(slot) ? 1 : 0);
    }
  each_polyhedron([&](Index slot) {
    const Constraints<B>& c = problem.constraints;
    const Index p = c.vector[slot];
    for (Offset f = c.facet_row[slot]; f < c.facet_row[slot + 1]; ++f) {
      const Facet<B>& face = c.facet[f];
      double direction[B], value = 0;
      block::product<B>(problem.frames.dual_at(p), face.normal, direction);
      for (int k = 0; k < B; ++k) value += face.normal[k] * x[Offset{p} * B + k];
      const int k = normal_component(slot);
      add(p, motions.along(problem, p, direction) * of, face.lower - value, face.upper - value,
          k < 0 ? 0 : face.normal[k]);
    }
  });
  return out;
}

template <int D, int B>
FrictionLaw FreeMotions<D, B>::friction(Index slot) const {
  if (discretization.functional.empty() || discretization.functional[slot] < 0) return {};
  const Constraints<B>& c = discretization.problem.constraints;
  const Friction* friction = model.obstacles[discretization.functional[slot]].obstacle->friction();
  return friction ? friction->law(c.data.data() + Offset{slot} * c.width) : FrictionLaw{};
}

template <int D, int B>
bool FreeMotions<D, B>::only_pressed_friction() const {
  const std::vector<Index>& functional = discretization.functional;
  for (std::size_t slot = 0; slot < functional.size(); ++slot)
    if (functional[slot] >= 0 &&
        (!model.obstacles[functional[slot]].obstacle->friction() || friction(static_cast<Index>(slot)).bound != 0))
      return false;
  return true;
}

template <int D, int B>
int FreeMotions<D, B>::normal_component(Index slot) const {
  if (!(coefficient_of_friction(slot) > 0)) return -1;
  const Flags tangential = discretization.problem.constraints.tangential[slot];
  for (int k = 0; k < B; ++k)
    if (!(tangential >> k & 1u)) return k;
  return -1;
}

template <int D, int B>
void FreeMotions<D, B>::add(const Eigen::VectorXd& motion, std::vector<double>& x) const {
  const DiscreteProblem<B>& problem = discretization.problem;
  const double size = motion.norm();
  for (Index p = 0; p < nodes.size(); ++p)
    for (int k = 0; k < B; ++k) {
      if (problem.fixed[p] >> k & 1u) continue;
      const double by = motions.along(problem, p, k) * motion;
      if (std::abs(by) > rounding_of_sums * size) x[Offset{p} * B + k] += by;
    }
}

template struct FreeMotions<2, 1>;
template struct FreeMotions<3, 1>;
template struct FreeMotions<2, 2>;
template struct FreeMotions<3, 3>;

}  // namespace signorini
