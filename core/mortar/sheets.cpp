#include "core/mortar/sheets.hpp"

#include <algorithm>
#include <numeric>

#include "core/mesh/simplex.hpp"

namespace signorini::mortar {

template <int D>
void Sheets<D>::find(const Side<D>& side, std::span<const Index> faces, const Creases<D>* creases) {
  edges_.clear();
  neighbours_.clear();
  root_.resize(faces.size());
  std::iota(root_.begin(), root_.end(), Index{0});
  count_ = static_cast<Index>(faces.size());
  if (count_ < 2) return;
  for (Index f = 0; f < count_; ++f)
    for (int opposite = 0; opposite < D; ++opposite) {
      Edge edge;
      for (int i = 0, k = 0; i < D; ++i)
        if (i != opposite) edge[k++] = side.faces[faces[f]][i];
      edges_.push_back({sorted(edge), {f, opposite}});
    }
  std::ranges::sort(edges_, [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second.face < b.second.face;
  });
  const auto root = [this](Index f) {
    while (root_[f] != f) f = root_[f] = root_[root_[f]];
    return f;
  };
  for (std::size_t e = 1; e < edges_.size(); ++e) {
    if (edges_[e].first != edges_[e - 1].first) continue;
    neighbours_.emplace_back(edges_[e - 1].second, edges_[e].second);
    const Seat& seat = edges_[e].second;
    if (creases && creases->is_crease(faces[seat.face], seat.opposite)) continue;
    const Index a = root(edges_[e - 1].second.face), b = root(seat.face);
    if (a != b) root_[a] = b, --count_;
  }
  for (Index f = 0; f < static_cast<Index>(faces.size()); ++f) root_[f] = root(f);
}

template class Sheets<2>;
template class Sheets<3>;

}  // namespace signorini::mortar
