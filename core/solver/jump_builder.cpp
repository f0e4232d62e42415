#include "core/solver/jump_builder.hpp"

#include <algorithm>

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
bool JumpBuilder<B>::leads_to(const BlockRow<B>& W, Index p) const {
  return std::ranges::any_of(W, [&](const auto& entry) {
    if (entry.first == p) return true;
    const auto next = rows_.find(entry.first);
    return next != rows_.end() && !next->second.resolved && leads_to(next->second.weights, p);
  });
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
