#include "core/solver/jump_builder.hpp"

#include <algorithm>
#include <set>

#include "core/sdk/block.hpp"

namespace signorini {
namespace {

template <int B>
std::array<double, B * B> identity() {
  std::array<double, B * B> out{};
  for (int i = 0; i < B; ++i) out[i * (B + 1)] = 1;
  return out;
}

template <int B>
void append(const BlockRow<B>& row, BlockRows<B>& out) {
  for (const auto& [q, W] : row) {
    out.column.push_back(q);
    out.weight.insert(out.weight.end(), W.begin(), W.end());
  }
  out.row.push_back(static_cast<Offset>(out.column.size()));
}

template <int B>
BlockRow<B> row_of(const BlockRows<B>& rows, Index s) {
  BlockRow<B> out;
  for (Offset k = rows.row[s]; k < rows.row[s + 1]; ++k) std::copy_n(rows.at(k), B * B, out[rows.column[k]].begin());
  return out;
}

/// Finds what depends on each other: strongly connected components (Tarjan, Depth-first search and linear graph
/// algorithms, SIAM J. Comput. 1, 1972).
/// @tparam Row of an Index, what it depends on; null: nothing
template <int B, class Row>
class Circles {
 public:
  explicit Circles(const Row& row) : row_(row) {}

  void visit(Index p) {
    if (place_.contains(p)) return;
    const auto at = static_cast<Index>(place_.size());
    Place& mine = place_[p] = {at, at, true};  // references stay in a map
    open_.push_back(p);
    if (const BlockRow<B>* row = row_(p))
      for (const auto& [q, W] : *row) {
        if (!row_(q)) continue;
        if (q == p) circles_.insert(p);
        visit(q);
        if (const Place& other = place_.at(q); other.open) mine.root = std::min(mine.root, other.root);
      }
    if (mine.root == at) close(p);
  }

  bool on_circle(Index p) const { return circles_.contains(p); }

 private:
  struct Place {
    Index number, root;
    bool open;
  };

  void close(Index p) {
    const auto first = std::find(open_.rbegin(), open_.rend(), p).base() - 1;
    const bool several = open_.end() - first > 1;
    for (auto q = first; q != open_.end(); ++q) {
      place_.at(*q).open = false;
      if (several) circles_.insert(*q);
    }
    open_.erase(first, open_.end());
  }

  const Row& row_;
  std::map<Index, Place> place_;
  std::vector<Index> open_;
  std::set<Index> circles_;
};

}  // namespace

template <int B>
void JumpBuilder<B>::add(Index p, BlockRow<B> W) {
  rows_[p].weights = std::move(W);
}

template <int B>
void JumpBuilder<B>::add(Index p, BlockRow<B> by_unknowns, BlockRow<B> by_displacements) {
  by_unknowns.try_emplace(p);  // rows of products keep their columns
  rows_[p] = {std::move(by_unknowns), std::move(by_displacements), true};
}

template <int B>
const BlockRow<B>* JumpBuilder<B>::weights(Index p) const {
  const auto found = rows_.find(p);
  return found != rows_.end() && !found->second.resolved ? &found->second.weights : nullptr;
}

template <int B>
bool JumpBuilder<B>::leads_to(const BlockRow<B>& W, Index p) const {
  return !circles({{p, W}}).empty();
}

template <int B>
std::vector<Index> JumpBuilder<B>::circles(const std::map<Index, BlockRow<B>>& rows) const {
  const auto row = [&](Index p) {
    const auto found = rows.find(p);
    return found != rows.end() ? &found->second : weights(p);
  };
  Circles<B, decltype(row)> found(row);
  std::vector<Index> out;
  for (const auto& [p, W] : rows) found.visit(p);
  for (const auto& [p, W] : rows)
    if (found.on_circle(p)) out.push_back(p);
  return out;
}

template <int B>
const BlockRow<B>& JumpBuilder<B>::resolve(Index p) {
  Rows& rows = rows_.at(p);
  if (!rows.basis.empty()) return rows.basis;
  BlockRow<B> out;
  out[p] = identity<B>();
  for (const auto& [q, W] : rows.weights) {
    if (!has(q)) {
      for (int i = 0; i < B * B; ++i) out[q][i] += W[i];
      continue;
    }
    for (const auto& [r, Z] : resolve(q)) {
      double WZ[B * B];
      block::multiply<B>(W.data(), Z.data(), WZ);
      for (int i = 0; i < B * B; ++i) out[r][i] += WZ[i];
    }
  }
  return rows.basis = std::move(out);
}

template <int B>
Jumps<B> JumpBuilder<B>::take() {
  Jumps<B> out;
  for (auto& [p, rows] : rows_) {
    out.vector.push_back(p);
    append<B>(resolve(p), out.basis);
    out.given.push_back(rows.resolved);
    if (rows.resolved) {
      append<B>(rows.weights, out.inverse);
      continue;
    }
    BlockRow<B> inverse = rows.weights;
    for (auto& [q, W] : inverse)
      for (double& w : W) w = -w;
    inverse[p] = identity<B>();
    append<B>(inverse, out.inverse);
  }
  return out;
}

template <int B>
Jumps<B> chosen_jumps(const Jumps<B>& all, const std::vector<char>& keep) {
  JumpBuilder<B> out;
  for (Index s = 0; s < all.size(); ++s) {
    if (!keep[s]) continue;
    const Index p = all.vector[s];
    BlockRow<B> inverse = row_of(all.inverse, s);
    if (all.given[s]) {
      out.add(p, row_of(all.basis, s), std::move(inverse));
      continue;
    }
    inverse.erase(p);
    for (auto& [q, W] : inverse)
      for (double& w : W) w = -w;
    out.add(p, std::move(inverse));
  }
  return out.take();
}

template class JumpBuilder<1>;
template class JumpBuilder<2>;
template class JumpBuilder<3>;
template Jumps<1> chosen_jumps(const Jumps<1>&, const std::vector<char>&);
template Jumps<2> chosen_jumps(const Jumps<2>&, const std::vector<char>&);
template Jumps<3> chosen_jumps(const Jumps<3>&, const std::vector<char>&);

}  // namespace signorini
