#include "core/fem/pairs/contact_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/element.hpp"
#include "core/mesh/mirror.hpp"

namespace signorini {
namespace {

/// Of a node, the pair that covers most of it so far.
struct Claim {
  std::size_t pair;
  double weight;
};

}  // namespace

template <int D>
ContactPair<D>::ContactPair(const Nodes<D>& nodes, const Model<D>& model, const std::vector<FixedDirections<D>>& fixes,
                            Index obstacle, PairedFaces faces, std::vector<Point<D>> points,
                            std::vector<Index> left_out)
    : nodes_(&nodes),
      model_(&model),
      fixes_(&fixes),
      obstacle_(obstacle),
      faces_(std::move(faces)),
      points_(std::move(points)),
      left_out_(std::move(left_out)) {
  couple();
}

template <int D>
void ContactPair<D>::couple() {
  found_ = term().obstacle->functional()
               ? couple_whole_jumps<D>(*nodes_, *model_, term(), faces_, *fixes_, points_, left_out_)
               : couple_beside<D>(*nodes_, *model_, term(), faces_, points_, left_out_);
}

template <int D>
Point<D> ContactPair<D>::normal(Index k) const {
  Point<D> out = found_.normal[k];
  keep_within<D>(nodes_->mesh().mirrors, nodes_->mesh().points[found_.node[k]], out);
  normalise(out);
  return out;
}

template <int D>
std::optional<FreeNormal<D>> ContactPair<D>::free(Index k) const {
  return free_normal<D>(*fixes_, nodes_->of_vertex(found_.node[k]), normal(k));
}

template <int D>
void ContactPair<D>::leave_out(std::vector<Index> vertices) {
  left_out_.insert(left_out_.end(), vertices.begin(), vertices.end());
  std::ranges::sort(left_out_);
  left_out_.erase(std::unique(left_out_.begin(), left_out_.end()), left_out_.end());
  couple();
}

template <int D>
void share_slaves(std::vector<ContactPair<D>>& pairs) {
  if (pairs.size() < 2) return;
  std::map<Index, Claim> owner;  // by vertex
  std::vector<std::vector<Index>> others(pairs.size());
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const MortarCoupling<D>& found = pairs[n].coupling();
    for (Index k = 0; k < found.nodes(); ++k) {
      if (!pairs[n].free(k)) continue;
      const Claim mine{n, found.weight[k]};
      const auto [at, first] = owner.try_emplace(found.node[k], mine);
      if (first) continue;
      const bool more = mine.weight > (1 + rounding_of_differences) * at->second.weight;
      const Claim left = more ? std::exchange(at->second, mine) : mine;
      others[left.pair].push_back(found.node[k]);
    }
  }
  for (std::size_t n = 0; n < pairs.size(); ++n)
    if (!others[n].empty()) pairs[n].leave_out(std::move(others[n]));
}

template class ContactPair<2>;
template class ContactPair<3>;
template void share_slaves(std::vector<ContactPair<2>>&);
template void share_slaves(std::vector<ContactPair<3>>&);

}  // namespace signorini
