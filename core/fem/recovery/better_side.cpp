#include "core/fem/recovery/better_side.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace signorini {
namespace {

/// What it adds to the error of what was taken to be independent that so many go along with each other.
double added(double so_many, double error) { return std::sqrt(so_many - 1) * error; }

/// One side of an obstacle between bodies.
template <int B>
class PressedSide {
 public:
  /// @param all those of several obstacles, each by ascending node
  PressedSide(std::vector<ContactNode<B>>& all, Index obstacle) {
    for (ContactNode<B>& node : all)
      if (node.obstacle == obstacle) nodes_.push_back(&node);
  }

  /// Of a node in contact, in the mean; NaN without any.
  double area() const {
    double sum = 0;
    int count = 0;
    for (const ContactNode<B>* node : nodes_)
      if (node->contact) sum += node->area, ++count;
    return sum / count;
  }

  double largest() const {
    double out = 0;
    for (const ContactNode<B>* node : nodes_)
      if (node->contact) out = std::max(out, node->recovered);
    return out;
  }

  /// With nodes without contact that see nothing but nodes in contact: between coarse nodes, as long as some node of
  /// this side presses on each of these.
  /// @param known without them
  double area_with_gaps(const PressedSide& other, const MasterMeans& seen, double known) const {
    if (2 * in_contact() < other.in_contact()) return known;
    for (const ContactNode<B>* node : nodes_) {
      const auto row = std::ranges::lower_bound(seen.node, node->vertex);
      if (node->contact || row == seen.node.end() || *row != node->vertex) continue;
      const std::ptrdiff_t k = row - seen.node.begin();
      const std::span of_other(seen.column.begin() + seen.row[k], seen.column.begin() + seen.row[k + 1]);
      const auto presses = [&](Index q) { return !other.at(q) || other.at(q)->contact; };
      if (std::ranges::all_of(of_other, presses)) known += node->area;
    }
    return known;
  }

  /// Pressures, and what friction is of them, become those of the other side.
  /// @param seen what nodes see of it
  void take(const PressedSide& other, const MasterMeans& seen) {
    for (ContactNode<B>* node : nodes_) {
      const auto row = std::ranges::lower_bound(seen.node, node->vertex);
      if (!node->contact || row == seen.node.end() || *row != node->vertex) continue;
      const double before = node->recovered;
      node->recovered = other.mean(seen, row - seen.node.begin()).value_or(before);
      if constexpr (B > 1)
        for (double& t : node->traction) t *= before > 0 ? node->recovered / before : 1;
    }
  }

 private:
  std::ptrdiff_t in_contact() const {
    return std::ranges::count_if(nodes_, [](const ContactNode<B>* node) { return node->contact; });
  }

  const ContactNode<B>* at(Index vertex) const {
    const auto found = std::ranges::lower_bound(nodes_, vertex, {}, [](const auto* node) { return node->vertex; });
    return found != nodes_.end() && (*found)->vertex == vertex ? *found : nullptr;
  }

  /// Without contact the pressure is zero. Weights at nodes of the side that looks are no part of the mean.
  std::optional<double> mean(const MasterMeans& seen, std::ptrdiff_t row) const {
    double sum = 0, part = 0, least = infinity, most = 0;
    for (Offset k = seen.row[row]; k < seen.row[row + 1]; ++k) {
      const ContactNode<B>* node = at(seen.column[k]);
      if (!node) continue;
      const double pressure = node->contact ? node->recovered : 0;
      sum += seen.weight[k] * pressure, part += seen.weight[k];
      least = std::min(least, pressure), most = std::max(most, pressure);
    }
    return part > 0 ? std::optional(std::clamp(sum / part, least, most)) : std::nullopt;
  }

  std::vector<ContactNode<B>*> nodes_;
};

}  // namespace

template <int B>
void take_better_side(const Model<B>& model, const PairedBodies<B>& pairs, MasterSide<B>& masters,
                      ContactState<B>& slaves) {
  for (Index k = 0; k < std::ssize(model.obstacles); ++k) {
    if (!model.obstacles[k].other || model.obstacles[k].tied) continue;
    PressedSide<B> slave(slaves.nodes, k), master(masters.nodes, k);
    ContactSummary<B>& summary = slaves.obstacles[k];
    const RecoveredPressure& of_master = masters.pressures[k];
    const double larger = master.area() / slave.area();  // NaN where one is not pressed
    if (larger > 1 && pairs.means && of_master.error < added(larger, summary.error)) {
      summary.resolved = of_master.resolved;
      if (!summary.resolved) continue;
      slave.take(master, *pairs.means);
      const double all = slave.area_with_gaps(master, *pairs.means, summary.area);
      summary.area = std::max(summary.area, std::min(of_master.area, all));
      summary.max_pressure = slave.largest();
      summary.peaks_at_edge = of_master.peaks_at_edge;
    } else if (larger < 1 && summary.resolved && summary.error < added(1 / larger, of_master.error)) {
      master.take(slave, masters.seen[k]);
    }
  }
}

template void take_better_side(const Model<2>&, const PairedBodies<2>&, MasterSide<2>&, ContactState<2>&);
template void take_better_side(const Model<3>&, const PairedBodies<3>&, MasterSide<3>&, ContactState<3>&);

}  // namespace signorini
