#include "core/solver/jump_builder.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/rounding.hpp"
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

/// No displacement of what depends on itself is so many times an unknown.
constexpr double largest_gain = 4;

/// Divides rows into those that depend on each other: strongly connected components, each after those that it depends
/// on (Tarjan, Depth-first search and linear graph algorithms, SIAM J. Comput. 1, 1972).
/// @tparam Row of an Index, what it depends on; null: nothing
template <int B, class Row>
class Circles {
 public:
  explicit Circles(const Row& row) : row_(row) {}

  /// Adds those of p, and of what it depends on.
  void visit(Index p) {
    if (place_.contains(p)) return;
    const auto at = static_cast<Index>(place_.size());
    Place& mine = place_[p] = {at, true};  // references stay in a map
    open_.push_back(p);
    for (const auto& [q, W] : *row_(p)) {
      if (!row_(q)) continue;
      visit(q);
      if (const Place& other = place_.at(q); other.open) mine.root = std::min(mine.root, other.root);
    }
    if (mine.root == at) close(p);
  }

  const std::vector<std::vector<Index>>& all() const { return all_; }
  /// Whether some of these, one of all(), depends on itself.
  bool is_circle(const std::vector<Index>& some) const {
    return some.size() > 1 || row_(some.front())->contains(some.front());
  }

 private:
  struct Place {
    Index root;
    bool open;
  };

  void close(Index p) {
    std::vector<Index>& out = all_.emplace_back();
    do {
      out.push_back(open_.back());
      place_.at(open_.back()).open = false;
      open_.pop_back();
    } while (out.back() != p);
  }

  const Row& row_;
  std::map<Index, Place> place_;
  std::vector<Index> open_;
  std::vector<std::vector<Index>> all_;
};

/// What u_p of a circle is by x_p and what comes from outside: (1 - W)^-1 within it. Empty where there is no inverse.
template <int B, class Row>
Eigen::MatrixXd gains(const std::vector<Index>& circle, const Row& row) {
  const auto size = static_cast<Index>(circle.size()) * B;
  Eigen::MatrixXd M = Eigen::MatrixXd::Identity(size, size);
  for (std::size_t s = 0; s < circle.size(); ++s)
    for (std::size_t t = 0; t < circle.size(); ++t) {
      const auto entry = row(circle[s])->find(circle[t]);
      if (entry == row(circle[s])->end()) continue;
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j)
          M(static_cast<Index>(s) * B + i, static_cast<Index>(t) * B + j) -= entry->second[i * B + j];
    }
  const Eigen::MatrixXd out = M.partialPivLu().inverse();
  return out.allFinite() ? out : Eigen::MatrixXd();
}

template <int B>
void add_product(const double* M, const BlockRow<B>& row, BlockRow<B>& out) {
  for (const auto& [r, Z] : row) {
    double MZ[B * B];
    block::multiply<B>(M, Z.data(), MZ);
    for (int i = 0; i < B * B; ++i) out[r][i] += MZ[i];
  }
}

/// What a common unknown takes along cancels but for rounding.
template <int B>
void erase_cancelled(BlockRow<B>& row) {
  std::erase_if(row, [](const auto& entry) {
    return std::ranges::all_of(entry.second, [](double w) { return std::abs(w) <= rounding_of_differences; });
  });
}

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
  const auto row = [&](Index q) { return q == p ? &W : weights(q); };
  Circles<B, decltype(row)> found(row);
  found.visit(p);
  return found.is_circle(found.all().back());
}

template <int B>
std::vector<Index> JumpBuilder<B>::circles(const std::map<Index, BlockRow<B>>& rows) const {
  const auto row = [&](Index p) {
    const auto found = rows.find(p);
    return found != rows.end() ? &found->second : weights(p);
  };
  Circles<B, decltype(row)> found(row);
  for (const auto& [p, W] : rows) found.visit(p);
  std::vector<Index> out;
  for (const std::vector<Index>& circle : found.all()) {
    if (!found.is_circle(circle)) continue;
    const Eigen::MatrixXd gain = gains<B>(circle, row);
    if (gain.size() > 0 && gain.cwiseAbs().maxCoeff() <= largest_gain) continue;
    std::ranges::copy_if(circle, std::back_inserter(out), [&](Index p) { return rows.contains(p); });
  }
  std::ranges::sort(out);
  return out;
}

/// Of rows that depend on each other, all others of which are known.
template <int B>
void JumpBuilder<B>::resolve(const std::vector<Index>& circle) {
  std::vector<BlockRow<B>> from_outside(circle.size());
  for (std::size_t s = 0; s < circle.size(); ++s) {
    from_outside[s][circle[s]] = identity<B>();
    for (const auto& [q, W] : rows_.at(circle[s]).weights) {
      if (std::ranges::find(circle, q) != circle.end()) continue;
      add_product<B>(W.data(), has(q) ? rows_.at(q).basis : BlockRow<B>{{q, identity<B>()}}, from_outside[s]);
    }
  }
  const auto row = [&](Index p) { return weights(p); };
  const bool alone = circle.size() == 1 && !weights(circle.front())->contains(circle.front());
  const Eigen::MatrixXd gain = alone ? Eigen::MatrixXd::Identity(B, B) : gains<B>(circle, row);
  for (std::size_t s = 0; s < circle.size(); ++s) {
    BlockRow<B>& out = rows_.at(circle[s]).basis;
    for (std::size_t t = 0; t < circle.size(); ++t) {
      std::array<double, B * B> M;
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) M[i * B + j] = gain(static_cast<Index>(s) * B + i, static_cast<Index>(t) * B + j);
      if (std::ranges::any_of(M, [](double c) { return c != 0; })) add_product<B>(M.data(), from_outside[t], out);
    }
    if (std::ranges::any_of(common_, [&](Index c) { return c != circle[s] && out.contains(c); }))
      erase_cancelled<B>(out);
  }
}

template <int B>
Jumps<B> JumpBuilder<B>::take() {
  const auto row = [&](Index p) { return weights(p); };
  Circles<B, decltype(row)> found(row);
  for (const auto& [p, rows] : rows_)
    if (row(p)) found.visit(p);
  for (const std::vector<Index>& circle : found.all()) resolve(circle);
  Jumps<B> out;
  out.common = common_;
  for (auto& [p, rows] : rows_) {
    out.vector.push_back(p);
    append<B>(rows.basis, out.basis);
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
  for (const Index p : all.common) out.share(p);
  return out.take();
}

template class JumpBuilder<1>;
template class JumpBuilder<2>;
template class JumpBuilder<3>;
template Jumps<1> chosen_jumps(const Jumps<1>&, const std::vector<char>&);
template Jumps<2> chosen_jumps(const Jumps<2>&, const std::vector<char>&);
template Jumps<3> chosen_jumps(const Jumps<3>&, const std::vector<char>&);

}  // namespace signorini
