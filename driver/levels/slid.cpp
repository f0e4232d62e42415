#include "driver/levels/slid.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/fem/elements/symmetric_motion.hpp"

namespace signorini {
namespace {

constexpr double noticeable = 0.05;

/// The nodes of one side in contact with one obstacle.
template <int D>
struct TouchingNodes {
  std::vector<Index> nodes;
  Point<D> motion{}, normal{};  // sums

  void add(const ContactNode<D>& node, const std::vector<double>& u) {
    nodes.push_back(node.vertex);
    for (int i = 0; i < D; ++i) {
      motion[i] += u[Offset{node.vertex} * D + i];
      normal[i] += node.direction[i];
    }
  }
  /// Largest less least component along a direction of what `at` has at the nodes.
  double range(const Point<D>& along, const auto& at) const {
    double low = infinity, high = -infinity;
    for (const Index p : nodes) {
      const double x = dot(at(p), along);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    return high - low;
  }
};

}  // namespace

template <int D>
double noticeably_slid(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& state,
                       const std::vector<ContactNode<D>>& masters, const std::vector<double>& u,
                       const std::vector<Point<D>>& shift) {
  std::vector<TouchingNodes<D>> slave(model.obstacles.size()), master(model.obstacles.size());
  for (const ContactNode<D>& node : state.nodes)
    if (node.contact) slave[node.obstacle].add(node, u);
  for (const ContactNode<D>& node : masters)
    if (node.contact) master[node.obstacle].add(node, u);
  double out = 0;
  for (std::size_t k = 0; k < slave.size(); ++k) {
    if (model.obstacles[k].tied || slave[k].nodes.empty() || master[k].nodes.empty()) continue;
    Point<D> slip{}, normal = slave[k].normal;
    for (int i = 0; i < D; ++i)
      slip[i] = slave[k].motion[i] / static_cast<double>(slave[k].nodes.size()) -
                master[k].motion[i] / static_cast<double>(master[k].nodes.size()) - (shift.empty() ? 0 : shift[k][i]);
    slip = symmetric_motion<D>(nodes.mesh(), model.plane, slip);
    normalise(normal);
    const double across = dot(slip, normal);
    for (int i = 0; i < D; ++i) slip[i] -= across * normal[i];
    const double way = normalise(slip);
    const auto motion = [&](Index p) {
      Point<D> by;
      std::copy_n(u.data() + Offset{p} * D, D, by.begin());
      return by;
    };
    const double reach = slave[k].range(slip, [&](Index p) { return nodes.at(p); });
    // Where nodes of one side move as differently as both do no body has slid as a whole.
    const double spread = slave[k].range(slip, motion) + master[k].range(slip, motion);
    if (reach > 0) out = std::max(out, way / std::max(noticeable * reach, spread));
  }
  return out;
}

template double noticeably_slid<2>(const Nodes<2>&, const Model<2>&, const ContactState<2>&,
                                   const std::vector<ContactNode<2>>&, const std::vector<double>&,
                                   const std::vector<Point<2>>&);
template double noticeably_slid<3>(const Nodes<3>&, const Model<3>&, const ContactState<3>&,
                                   const std::vector<ContactNode<3>>&, const std::vector<double>&,
                                   const std::vector<Point<3>>&);

}  // namespace signorini
