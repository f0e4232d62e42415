#include "amg/coarsening/mode_aggregation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "amg/coarsening/strength.hpp"
#include "amg/coarsening/tentative.hpp"
#include "core/algebra/products.hpp"
#include "transfer/modifier.hpp"

namespace signorini {
namespace {

constexpr int power_steps = 10;
constexpr double underestimate = 1.1;  // of the largest eigenvalue by so many steps of the power method
// What a coarse vector that moves its nodes by one may do to a row for weakly coupled neighbours, over the row's
// diagonal: modes that only rounding tells from others would be blown up without limit.
constexpr double most_motion = 10;

/// An upper bound, about, for the eigenvalues of D^-1 A with the diagonal blocks D, on the components that are free.
template <int B>
double largest_eigenvalue(const Level<B>& level) {
  const auto n = static_cast<std::size_t>(level.vectors) * B;
  std::vector<double> v(n), next(n);
  for (std::size_t i = 0; i < n; ++i) v[i] = std::fmod(static_cast<double>(i + 1) * 0.6180339887498949, 1.0) - 0.5;
  double ratio = 1;
  for (int step = 0; step < power_steps; ++step) {
    double before = 0, after = 0;
    for (Index p = 0; p < level.vectors; ++p) modifier::drop<B>(level.off[p], v.data() + Offset{p} * B);
    for (Index p = 0; p < level.vectors; ++p) {
      double Av[B];
      row_product(*level.A, p, v.data(), Av);
      modifier::drop<B>(level.off[p], Av);
      double* w = next.data() + Offset{p} * B;
      block::product<B>(level.inverse.data() + Offset{p} * B * B, Av, w);
      for (int i = 0; i < B; ++i) {
        before += v[Offset{p} * B + i] * v[Offset{p} * B + i];
        after += w[i] * w[i];
      }
    }
    if (!(before > 0 && after > 0)) break;
    ratio = std::sqrt(after / before);
    for (std::size_t i = 0; i < n; ++i) v[i] = next[i] / ratio;
  }
  return underestimate * ratio;
}

/// One row at a time of (I - omega D^-1 A) P0, where weakly coupled neighbours count as if they moved with the
/// aggregate of the row: the near null space stays exact, but for modes that the aggregate cannot tell apart, and weak
/// couplings do not widen the interpolation. Neighbours of another part need not move with it, however weakly coupled.
template <int B>
class SmoothedRows {
 public:
  SmoothedRows(const Level<B>& level, const NearNullSpace& modes, Index group, const StrengthGraph& graph,
               const Aggregates& aggregates, const Tentative& tentative)
      : level_(level),
        modes_(modes),
        graph_(graph),
        aggregates_(aggregates),
        group_(group),
        tentative_(tentative),
        per_row_(tentative.per_aggregate * B * B),
        damping_(4 / (3 * largest_eigenvalue(level))),
        local_(tentative.block),
        strong_to_(static_cast<std::size_t>(graph.size()), -1),
        weak_(static_cast<std::size_t>(B * modes.modes), 0.0),
        place_(aggregates.root.size(), -1) {
    for (Index p = 0; p < level.vectors; ++p)
      if (!modifier::is_plain<B>(level, level.frames, p)) make_local(p);
  }

  void append_row(Index p, Prolongation& P) {
    constexpr Flags all = (1u << B) - 1;
    if (level_.off[p] != all && aggregate_of(p) >= 0) {
      sum_neighbours(p);
      for (const Index a : found_) append_entries(p, a, P);
      for (const Index a : found_) place_[a] = -1;
      found_.clear();
      sum_.clear();
    }
    P.row.push_back(static_cast<Offset>(P.column.size()));
  }

 private:
  Index aggregate_of(Index p) const { return aggregates_.of[p / group_]; }
  bool in_one_part(Index a, Index b) const { return modes_.part.empty() || modes_.part[a] == modes_.part[b]; }

  // D N' P0: as columns of values in local coordinates.
  void make_local(Index p) {
    for (Index k = 0; k < tentative_.per_aggregate; ++k)
      for (int j = 0; j < B; ++j) {
        double* block = local_.data() + Offset{p} * per_row_ + k * B * B;
        double global[B], local[B];
        for (int i = 0; i < B; ++i) global[i] = block[i * B + j];
        modifier::value_to_local<B>(level_, level_.frames, p, global, local);
        for (int i = 0; i < B; ++i) block[i * B + j] = local[i];
      }
  }

  // Row p of A P0, by aggregates.
  void sum_neighbours(Index p) {
    const BlockMatrix<B>& A = *level_.A;
    const Index own = aggregate_of(p), node = p / group_;
    place(own);
    for (const Index to : graph_.neighbours(node)) strong_to_[to] = node;
    bool any_weak = false;
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) {
      const Index r = A.column[k], a = aggregate_of(r);
      if (a < 0) continue;
      if (a != own && strong_to_[r / group_] != node && in_one_part(node, r / group_)) {
        add_weak(A.at(k), r);
        any_weak = true;
        continue;
      }
      double* sum = place(a);
      const double* block = local_.data() + Offset{r} * per_row_;
      for (Index m = 0; m < per_row_; m += B * B) {
        double product[B * B];
        block::multiply<B>(A.at(k), block + m, product);
        for (int i = 0; i < B * B; ++i) sum[m + i] += product[i];
      }
    }
    if (any_weak) move_with(own, most_motion * size(A.diagonal(p)));
    std::ranges::sort(found_);
  }

  // What the modes at r do to the row.
  void add_weak(const double* A, Index r) {
    for (Index mode = 0; mode < modes_.modes; ++mode) {
      double global[B], local[B];
      for (int i = 0; i < B; ++i) global[i] = modes_.at(Offset{r} * B + i)[mode];
      modifier::value_to_local<B>(level_, level_.frames, r, global, local);
      for (int i = 0; i < B; ++i)
        for (int j = 0; j < B; ++j) weak_[i * modes_.modes + mode] += A[i * B + j] * local[j];
    }
  }

  static double size(const double* block) {
    double largest = 0;
    for (int i = 0; i < B * B; ++i) largest = std::max(largest, std::abs(block[i]));
    return largest;
  }

  // The modes in terms of the coarse vectors of an aggregate, by its triangular factor.
  void move_with(Index a, double limit) {
    const Offset first = Offset{a} * tentative_.per_aggregate * B;
    double* sum = place(a);
    for (int i = 0; i < B; ++i) {
      double* y = weak_.data() + i * modes_.modes;
      for (Index mode = 0; mode < modes_.modes; ++mode) {
        for (Index k = 0; k < mode; ++k) y[mode] -= y[k] * tentative_.coarse.at(first + k)[mode];
        const double pivot = tentative_.coarse.at(first + mode)[mode];
        y[mode] = std::abs(y[mode]) < limit * pivot ? y[mode] / pivot : 0;
        sum[(mode / B * B + i) * B + mode % B] += y[mode];
      }
    }
    std::ranges::fill(weak_, 0.0);
  }

  double* place(Index a) {
    if (place_[a] < 0) {
      place_[a] = static_cast<Offset>(sum_.size());
      found_.push_back(a);
      sum_.resize(sum_.size() + static_cast<std::size_t>(per_row_), 0.0);
    }
    return sum_.data() + place_[a];
  }

  void append_entries(Index p, Index a, Prolongation& P) const {
    std::vector<double>& values = B == 1 ? P.weight : P.block;
    const double* own = a == aggregate_of(p) ? tentative_.block.data() + Offset{p} * per_row_ : nullptr;
    for (Index k = 0; k < tentative_.per_aggregate; ++k) {
      double smooth[B * B];
      to_correction(p, sum_.data() + place_[a] + k * B * B, smooth);
      P.column.push_back(a * tentative_.per_aggregate + k);
      for (int i = 0; i < B * B; ++i) values.push_back((own ? own[k * B * B + i] : 0) - damping_ * smooth[i]);
    }
  }

  // Q D^-1 sum
  void to_correction(Index p, const double* sum, double* out) const {
    double local[B * B];
    block::multiply<B>(level_.inverse.data() + Offset{p} * B * B, sum, local);
    if (const double* Q = level_.frames.at(p))
      block::multiply<B>(Q, local, out);
    else
      std::copy(local, local + B * B, out);
  }

  const Level<B>& level_;
  const NearNullSpace& modes_;
  const StrengthGraph& graph_;
  const Aggregates& aggregates_;
  const Index group_;
  const Tentative& tentative_;
  const Index per_row_;
  const double damping_;
  std::vector<double> local_;     // the tentative interpolation in local coordinates
  std::vector<Index> strong_to_;  // per node: the last one that it is coupled to strongly
  std::vector<double> weak_;      // what the modes at weakly coupled neighbours do to the row at work
  std::vector<Offset> place_;     // per aggregate: its blocks among `sum_`, -1: none
  std::vector<Index> found_;
  std::vector<double> sum_;
};

template <int B>
using Matrix = Eigen::Matrix<double, B, B, B == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

/// Gives the first coarse vector of each aggregate the values of the root, which becomes its twin; else it stays what
/// the modes made of it: where the root is held, or would be a bad measure of its aggregate.
template <int B>
void align_with_roots(const Level<B>& level, const Aggregates& aggregates, Index group, const Tentative& tentative,
                      ModeAggregation& result) {
  constexpr double badly_scaled = 4;
  Prolongation& P = result.prolongation;
  P.twin.assign(static_cast<std::size_t>(P.coarse), -1);
  std::vector<Matrix<B>> inverse(aggregates.root.size(), Matrix<B>::Identity());
  for (Index a = 0; a < aggregates.size(); ++a) {
    const Index root = aggregates.root[a] * group;
    const Matrix<B> at_root(tentative.block.data() + Offset{root} * result.group * B * B);
    const Matrix<B> back = at_root.inverse();
    const double limit = badly_scaled * std::sqrt(B);
    if (level.off[root] != 0 || !(at_root.norm() <= limit && back.norm() <= limit)) continue;
    P.twin[a * result.group] = root;
    inverse[a] = back;
    Eigen::Map<Eigen::Matrix<double, B, Eigen::Dynamic, Eigen::RowMajor>> modes(
        result.coarse.at(Offset{a} * result.group * B), B, result.coarse.modes);
    modes = (at_root * modes).eval();
  }
  std::vector<double>& values = B == 1 ? P.weight : P.block;
  for (std::size_t k = 0; k < P.column.size(); ++k)
    if (P.column[k] % result.group == 0) {
      Eigen::Map<Matrix<B>> block(values.data() + k * B * B);
      block = (block * inverse[P.column[k] / result.group]).eval();
    }
}

/// What is left alone in its part moves by itself on the coarse level, too.
template <int B>
Aggregates with_the_last_ones(const Level<B>& level, Index group, const StrengthGraph& graph, Aggregates aggregates) {
  constexpr Flags all = (1u << B) - 1;
  for (Index g = 0; g < graph.size(); ++g) {
    const auto first = level.off.begin() + Offset{g} * group;
    if (aggregates.of[g] >= 0 || std::all_of(first, first + group, [](Flags off) { return off == all; })) continue;
    aggregates.of[g] = aggregates.size();
    aggregates.root.push_back(g);
  }
  return rooted_at_the_surface(graph, std::move(aggregates.of), std::move(aggregates.root));
}

}  // namespace

template <int B>
ModeAggregation mode_aggregation(const Level<B>& level, const NearNullSpace& fine, Index group,
                                 const Aggregator& aggregator, bool stretched) {
  const StrengthGraph graph = strong_couplings_of_groups(*level.A, level.off, group, fine.part, stretched);
  Aggregates aggregates = aggregator.aggregate(graph);
  if (!fine.part.empty()) aggregates = with_the_last_ones(level, group, graph, std::move(aggregates));
  const Tentative tentative = tentative_interpolation<B>(fine, group, aggregates);
  ModeAggregation out;
  out.group = tentative.per_aggregate;
  out.prolongation.coarse = aggregates.size() * out.group;
  SmoothedRows<B> rows(level, fine, group, graph, aggregates, tentative);
  for (Index p = 0; p < level.vectors; ++p) rows.append_row(p, out.prolongation);
  out.coarse = tentative.coarse;
  if (!fine.part.empty())
    for (const Index root : aggregates.root) out.coarse.part.push_back(fine.part[root]);
  align_with_roots(level, aggregates, group, tentative, out);
  return out;
}

template ModeAggregation mode_aggregation(const Level<1>&, const NearNullSpace&, Index, const Aggregator&, bool);
template ModeAggregation mode_aggregation(const Level<2>&, const NearNullSpace&, Index, const Aggregator&, bool);
template ModeAggregation mode_aggregation(const Level<3>&, const NearNullSpace&, Index, const Aggregator&, bool);

}  // namespace signorini
