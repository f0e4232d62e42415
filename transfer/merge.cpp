#include "transfer/merge.hpp"

#include <algorithm>
#include <cmath>

#include "core/solver/weights.hpp"

namespace signorini {

namespace {

// Products of rotations that would vanish in exact arithmetic.
constexpr double negligible = 1e-14;

// d(fine direction) / d(coarse component j)
template <int B, class Weight>
void coupling(const Frames<B>& fine, Index p, int direction, const Weight& W, const LevelSystem<B>& coarse, Index q,
              double* M) {
  const double *Np = fine.dual_at(p), *Qq = coarse.frames.at(q);
  double n[B], moved[B] = {};  // the direction in global coordinates, of the fine vector and of the coarse one
  for (int i = 0; i < B; ++i) n[i] = Np ? Np[i * B + direction] : double(i == direction);
  W.add_force(n, moved);
  if (Qq)
    block::transposed_product<B>(Qq, moved, M);
  else
    for (int j = 0; j < B; ++j) M[j] = moved[j];
  for (int j = 0; j < B; ++j)
    if ((coarse.off[q] >> j & 1u) || std::fabs(M[j]) <= negligible * W.size()) M[j] = 0;
}

// One side of a row: sum side M_j c_j <= distance, with side = 1 for the upper bound and -1 for the lower one.
template <int B>
struct Row {
  std::span<const Term> terms;
  double side, distance;
  Constraints<B>& coarse;

  // How far the term may go at most by the bounds found so far.
  double reach(const Term& t) const {
    return side * t.weight > 0 ? t.weight * side * coarse.upper[t.at] : t.weight * side * coarse.lower[t.at];
  }
  void limit(const Term& t, double room) const {
    if (side * t.weight > 0)
      coarse.upper[t.at] = std::min(coarse.upper[t.at], room);
    else
      coarse.lower[t.at] = std::max(coarse.lower[t.at], -room);
  }

  void share_equally() const {
    const double each = distance / static_cast<double>(terms.size());
    for (const Term& t : terms) limit(t, each / std::fabs(t.weight));
  }

  void share_in_common() const {
    double sum = 0;
    for (std::size_t k = 0; k < terms.size(); ++k) {
      const bool same_vector = k > 0 && terms[k].at / B == terms[k - 1].at / B;
      if (same_vector || terms[k].weight < 0) return share_equally();
      sum += terms[k].weight;
    }
    for (const Term& t : terms) limit(t, distance / sum);
  }

  void share_sharply() const {
    double largest = distance / static_cast<double>(terms.size());  // that a term may go
    for (;;) {
      double used = 0;
      int beyond = 0;
      for (const Term& t : terms)
        if (const double r = reach(t); r <= largest)
          used += r;
        else
          ++beyond;
      if (beyond == 0) return;
      const double next = (distance - used) / beyond;
      if (!(next > largest)) break;
      largest = next;
    }
    for (const Term& t : terms)
      if (reach(t) > largest) limit(t, largest / std::fabs(t.weight));
  }
};

}  // namespace

template <int B, Share share>
void Merge<B, share>::restrict_bounds(const Level<B>& fine, LevelSystem<B>& coarse) const {
  coarse.constraints.clear_bounds();
  if (share == Share::equal && is_uncoupled(fine, coarse)) {
    restrict_uncoupled(fine, coarse);
  } else if (share == Share::sharpest) {
    restrict_rows(fine, coarse, true, false);
    restrict_rows(fine, coarse, false, true);
  } else {
    restrict_rows(fine, coarse, true, true);
  }
}

// The rows of a single weight, the others, or all. Truncated directions do not count.
template <int B, Share share>
void Merge<B, share>::restrict_rows(const Level<B>& fine, LevelSystem<B>& coarse, bool single, bool others) const {
  const Prolongation& P = this->weights();
  std::vector<Term> terms;
  for (Index slot = 0; slot < fine.constraints.size(); ++slot) {
    const Index p = fine.constraints.vector[slot];
    if (!(P.row[p + 1] == P.row[p] + 1 ? single : others)) continue;
    for (int k = 0; k < B; ++k) {
      const double lower = fine.phases.lower[Offset{slot} * B + k], upper = fine.phases.upper[Offset{slot} * B + k];
      if ((fine.removed(p) >> k & 1u) || (lower == -infinity && upper == infinity)) continue;
      collect(fine, p, k, coarse, terms);
      for (const auto& [side, distance] : {std::pair(1.0, upper), std::pair(-1.0, -lower)}) {
        if (distance == infinity) continue;
        const Row<B> row{terms, side, distance, coarse.constraints};
        if constexpr (share == Share::equal) row.share_equally();
        if constexpr (share == Share::common) row.share_in_common();
        if constexpr (share == Share::sharpest) row.share_sharply();
      }
    }
  }
}

// Equal shares without a list of terms.
template <int B, Share share>
void Merge<B, share>::restrict_uncoupled(const Level<B>& fine, LevelSystem<B>& coarse) const {
  const Prolongation& P = this->weights();
  for (Index slot = 0; slot < fine.constraints.size(); ++slot) {
    const Index p = fine.constraints.vector[slot];
    for (int k = 0; k < B; ++k) {
      const double lower = fine.phases.lower[Offset{slot} * B + k], upper = fine.phases.upper[Offset{slot} * B + k];
      if ((fine.removed(p) >> k & 1u) || (lower == -infinity && upper == infinity)) continue;
      const auto moves = [&](Offset at) { return P.weight[at] != 0 && !(coarse.off[P.column[at]] >> k & 1u); };
      int terms = 0;
      for (Offset at = P.row[p]; at < P.row[p + 1]; ++at) terms += moves(at);
      for (Offset at = P.row[p]; at < P.row[p + 1]; ++at) {
        if (!moves(at)) continue;
        const double w = P.weight[at], whole = 1 / (terms * w);
        const Offset c = Offset{coarse.constraints.slot[P.column[at]]} * B + k;
        const double one = lower * whole, other = upper * whole;
        coarse.constraints.lower[c] = std::max(coarse.constraints.lower[c], w > 0 ? one : other);
        coarse.constraints.upper[c] = std::min(coarse.constraints.upper[c], w > 0 ? other : one);
      }
    }
  }
}

// Whether every direction couples to itself alone.
template <int B, Share share>
bool Merge<B, share>::is_uncoupled(const Level<B>& fine, const LevelSystem<B>& coarse) const {
  return this->frames(fine).slot.empty() && coarse.frames.slot.empty() && this->weights().block.empty();
}

template <int B, Share share>
void Merge<B, share>::collect(const Level<B>& fine, Index p, int direction, const LevelSystem<B>& coarse,
                              std::vector<Term>& terms) const {
  terms.clear();
  const Prolongation& P = this->weights();
  const bool uncoupled = is_uncoupled(fine, coarse);
  weights::with<B>(P, [&](const auto& weight) {
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) {
      const Index q = P.column[k];
      const Offset at = Offset{coarse.constraints.slot[q]} * B;
      if (uncoupled) {
        if (P.weight[k] != 0 && !(coarse.off[q] >> direction & 1u)) terms.push_back({at + direction, P.weight[k]});
        continue;
      }
      double M[B];
      coupling<B>(this->frames(fine), p, direction, weight(k), coarse, q, M);
      for (int j = 0; j < B; ++j)
        if (M[j] != 0) terms.push_back({at + j, M[j]});
    }
  });
}

template class Merge<1, Share::equal>;
template class Merge<2, Share::equal>;
template class Merge<3, Share::equal>;
template class Merge<1, Share::common>;
template class Merge<2, Share::common>;
template class Merge<3, Share::common>;
template class Merge<1, Share::sharpest>;
template class Merge<2, Share::sharpest>;
template class Merge<3, Share::sharpest>;

}  // namespace signorini
