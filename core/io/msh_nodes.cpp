#include "core/io/msh_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace signorini {

void MshNodes::close(const MshInput& input) {
  if (tags_.empty()) return;
  const auto [low, high] = std::minmax_element(tags_.begin(), tags_.end());
  const auto repeated = [&](Offset tag) { input.fail(fmt::format("node {} is defined twice", tag)); };
  const auto n = static_cast<Index>(tags_.size());
  first_ = *low;
  // Unsigned: the difference of two tags may not fit the signed type.
  if (const auto range = static_cast<std::uint64_t>(*high) - static_cast<std::uint64_t>(*low);
      range < 2 * tags_.size()) {
    direct_.assign(range + 1, -1);
    for (Index i = 0; i < n; ++i)
      if (Index& entry = direct_[tags_[i] - first_]; std::exchange(entry, i) >= 0) repeated(tags_[i]);
    return;
  }
  sorted_.resize(n);
  std::iota(sorted_.begin(), sorted_.end(), 0);
  std::ranges::sort(sorted_, {}, [&](Index i) { return tags_[i]; });
  for (Index i = 1; i < n; ++i)
    if (tags_[sorted_[i]] == tags_[sorted_[i - 1]]) repeated(tags_[sorted_[i]]);
}

Index MshNodes::find(Offset tag, const MshInput& input) const {
  if (!direct_.empty()) {
    const auto i = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(first_);
    if (i < direct_.size() && direct_[i] >= 0) return direct_[i];
  } else {
    const auto i = std::ranges::lower_bound(sorted_, tag, {}, [&](Index k) { return tags_[k]; });
    if (i != sorted_.end() && tags_[*i] == tag) return *i;
  }
  input.fail(fmt::format("an element has node {}, which is not among the {} nodes", tag, tags_.size()));
}

}  // namespace signorini
