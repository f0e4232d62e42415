#include "core/fem/contact.hpp"

#include <algorithm>
#include <cmath>

#include "core/algebra/products.hpp"
#include "core/fem/element.hpp"
#include "core/fem/select.hpp"

namespace signorini {
namespace {

constexpr double positive_force = 1e-8;  // of the largest force
constexpr double on_bound = 1e-12;       // of the numbers compared

// Cosine of the angle up to which a face counts as one that the obstacle pushes against: 60 degrees, less rounding.
constexpr double facing = 0.5 - 1e-9;

// Measures of the contact at vertices, see ContactNode::area.
template <int D, int B>
class TributaryAreas {
 public:
  TributaryAreas(const Mesh<D>& mesh, const ObstacleTerm<B>& term, double t) : mesh_(mesh) {
    if (B == 1 && !term.on)
      volumes_ = vertex_volumes(mesh);
    else
      faces_ = term.on ? surface(mesh, select_faces(mesh, *term.on, t)) : surface(mesh);
  }

  double at(const ContactNode<B>& node) const {
    if (!volumes_.empty()) return volumes_[node.vertex];
    const auto found = std::lower_bound(faces_.vertices.begin(), faces_.vertices.end(), node.vertex);
    if (found == faces_.vertices.end() || *found != node.vertex) return 0;
    const auto v = static_cast<std::size_t>(found - faces_.vertices.begin());
    double all = 0, pushed = 0;
    for (Offset k = faces_.first[v]; k < faces_.first[v + 1]; ++k) {
      const Point<D> n = area_normal(mesh_, mesh_.boundary[faces_.around[k]]);
      const double measure = std::sqrt(dot(n, n));
      all += measure;
      if constexpr (B == D)
        if (-dot(n, node.direction) >= facing * measure) pushed += measure;
    }
    return (pushed > 0 ? pushed : all) / D;
  }

 private:
  const Mesh<D>& mesh_;
  Surface<D> faces_;
  std::vector<double> volumes_;  // per vertex of the mesh, where the obstacle acts on the body
};

template <int B>
class NodeReader {
 public:
  NodeReader(const Discretization<B>& discretization, const std::vector<double>& x)
      : problem_(discretization.problem), discretization_(discretization), x_(x), r_(x.size()) {
    residual(problem_.A, x.data(), problem_.b.data(), r_.data());
    for (double& r : r_) r = -r;
    for (const double v : x) size_ = std::max(size_, std::fabs(v));
  }

  // Direction k of a slot; only those that are bounded are read.
  bool bounded(Index slot, int k) const {
    return discretization_.lower_obstacle[Offset{slot} * B + k] >= 0 ||
           discretization_.upper_obstacle[Offset{slot} * B + k] >= 0;
  }

  ContactNode<B> read(Index slot, int k) const {
    const Offset at = Offset{slot} * B + k;
    const Index p = problem_.constraints.vector[slot];
    const double lower = problem_.constraints.lower[at], upper = problem_.constraints.upper[at];
    const double x = x_[Offset{p} * B + k], r = r_[Offset{p} * B + k];
    const bool at_lower = touches(x - lower, lower), at_upper = touches(upper - x, upper);
    const bool below = discretization_.upper_obstacle[at] < 0 || nearer_to_lower(at, x, r, at_lower, at_upper);
    const bool contact = at_lower || at_upper;
    const Index obstacle = (below ? discretization_.lower_obstacle : discretization_.upper_obstacle)[at];
    const double push = contact ? std::max(below ? r : -r, 0.0) : 0;  // what is left off contact is rounding
    ContactNode<B> node{p, obstacle, contact, below ? x - lower : upper - x, 0, push, {}, {}};
    add_along(p, k, below ? 1 : -1, node.direction);
    add_along(p, k, below ? push : -push, node.force);
    return node;
  }

 private:
  // Where both bounds are touched the force tells which of them pushes.
  bool nearer_to_lower(Offset at, double x, double r, bool at_lower, bool at_upper) const {
    if (discretization_.lower_obstacle[at] < 0) return false;
    if (at_lower != at_upper) return at_lower;
    return at_lower ? r >= 0 : x - problem_.constraints.lower[at] <= problem_.constraints.upper[at] - x;
  }

  bool touches(double gap, double bound) const {
    return std::isfinite(bound) && gap <= on_bound * std::max(size_, std::fabs(bound));
  }

  // Adds r times the direction that local component k measures.
  void add_along(Index p, int k, double r, std::array<double, B>& to) const {
    const double* N = problem_.frames.dual_at(p);
    for (int i = 0; i < B; ++i) to[i] += N ? N[i * B + k] * r : (i == k ? r : 0);
  }

  const DiscreteProblem<B>& problem_;
  const Discretization<B>& discretization_;
  const std::vector<double>& x_;
  std::vector<double> r_;
  double size_ = 0;
};

template <int B>
void add_to(ContactSummary<B>& summary, const ContactNode<B>& node, double least_force) {
  if (!node.contact) return;
  ++summary.nodes;
  if (B == 1 || node.pressure * node.area > least_force) summary.area += node.area;
  for (int i = 0; i < B; ++i) summary.force[i] += node.force[i];
  summary.max_pressure = std::max(summary.max_pressure, node.pressure);
}

}  // namespace

template <int D, int B>
ContactState<B> contact_state(const Mesh<D>& mesh, const Model<B>& model, const Discretization<B>& discretization,
                              const std::vector<double>& x) {
  ContactState<B> state;
  state.obstacles.resize(model.obstacles.size());
  const NodeReader<B> reader(discretization, x);
  std::vector<double> largest(model.obstacles.size());
  for (Index slot = 0; slot < discretization.problem.constraints.size(); ++slot)
    for (int k = 0; k < B; ++k)
      if (reader.bounded(slot, k)) {
        state.nodes.push_back(reader.read(slot, k));
        double& force = largest[state.nodes.back().obstacle];
        force = std::max(force, state.nodes.back().pressure);
      }
  for (std::size_t obstacle = 0; obstacle < model.obstacles.size(); ++obstacle) {
    const TributaryAreas<D, B> areas(mesh, model.obstacles[obstacle], model.t);
    for (ContactNode<B>& node : state.nodes) {
      if (node.obstacle != static_cast<Index>(obstacle)) continue;
      node.area = areas.at(node);
      node.pressure = node.area > 0 ? node.pressure / node.area : 0;
      add_to(state.obstacles[obstacle], node, positive_force * largest[obstacle]);
    }
  }
  return state;
}

template ContactState<1> contact_state(const Mesh<2>&, const Model<1>&, const Discretization<1>&,
                                       const std::vector<double>&);
template ContactState<1> contact_state(const Mesh<3>&, const Model<1>&, const Discretization<1>&,
                                       const std::vector<double>&);
template ContactState<2> contact_state(const Mesh<2>&, const Model<2>&, const Discretization<2>&,
                                       const std::vector<double>&);
template ContactState<3> contact_state(const Mesh<3>&, const Model<3>&, const Discretization<3>&,
                                       const std::vector<double>&);

}  // namespace signorini
