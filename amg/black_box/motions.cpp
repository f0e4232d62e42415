#include "amg/black_box/motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "amg/black_box/given_bounds.hpp"
#include "amg/black_box/refuse_indefinite.hpp"
#include "amg/coarse/allowed_motions.hpp"
#include "amg/linear/held_cholesky.hpp"
#include "amg/linear/unit_diagonal.hpp"
#include "core/base/dense.hpp"

namespace signorini {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double rounding_of_rows = 64 * epsilon;        // of the sum of the entries' sizes
constexpr double rounding_of_motions = 16 * epsilon;     // of Sd, the diagonal of S is one; times sqrt(size of d)
constexpr double rounding_of_components = 16 * epsilon;  // of those of d, over the largest
constexpr double rounding_of_squares = 8 * epsilon;      // of d'Sd for d of length one
constexpr double rounding_of_loads = 256 * epsilon;      // of the work, relative to its terms; times the same
constexpr double negligible = 1e-9;                      // components of a motion, relative to the largest
constexpr double rounding_of_projections = 1e-11;        // onto cones, of what is projected
constexpr double far = 100;                              // how far off a cone a motion may be, in violated conditions

// What may be factorised: few vectors or entries, or nearly a tree. To order them and to count the factor's takes
// little time then; whether it is made, the count tells.
constexpr std::size_t few_vectors = 4000;
constexpr Offset few_entries = 300'000;
constexpr std::size_t most_motions = 100;  // of one component
constexpr int most_hidden = 10;            // of these, that no small pivot shows
constexpr double suspicious = 1e-4;        // pivots, of a diagonal of one

enum class Dominance { none, weak, strict };

/// Of the diagonal entry of row i of block row p over the others. In more digits: what is left may be little.
struct Excess {
  double value = 0, of_sizes = 0;  // of_sizes: the sum of all entries' sizes
  int entries = 0;                 // that are not zero

  template <int B>
  Excess(const BlockMatrix<B>& A, Index p, int i) {
    long double all = 0;
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
      for (int j = 0; j < B; ++j) {
        const double size = std::abs(A.at(k)[i * B + j]);
        all += size;
        entries += size > 0;
      }
    of_sizes = static_cast<double>(all);
    value = static_cast<double>(2 * static_cast<long double>(A.diagonal(p)[i * (B + 1)]) - all);
  }

  Dominance dominance() const {
    const double small = std::min(2 * epsilon * entries, rounding_of_rows) * of_sizes;
    return value > small ? Dominance::strict : value >= -small ? Dominance::weak : Dominance::none;
  }

  /// Whether it is more than summing the others in the machine's precision leaves.
  bool is_more_than_sums_leave() const { return value > 0.25 * epsilon * (entries - 1) * of_sizes; }
};

template <int B>
Dominance dominance(const BlockMatrix<B>& A, Index p, int i) {
  return Excess(A, p, i).dominance();
}

template <int B>
Interval bounds_of(const Constraints<B>& c, Offset i) {
  const Index slot = c.slot.empty() ? -1 : c.slot[static_cast<std::size_t>(i / B)];
  if (slot < 0) return {-infinity, infinity};
  return {c.lower[Offset{slot} * B + i % B], c.upper[Offset{slot} * B + i % B]};
}

}  // namespace

template <int B>
class Motions<B>::Finder {
 public:
  Finder(const BlockMatrix<B>& A, Motions& out) : A_(A), out_(out), place_(static_cast<std::size_t>(A.size()), -1) {}

  void run() {
    out_.regular_ = true;
    if (is_held()) return;
    for (Index p = 0; p < A_.size(); ++p)
      if (place_[p] < 0) settle(collect(p));
    out_.regular_ = out_.regular_ && out_.bases_.empty();
  }

 private:
  struct Seen {
    Offset blocks = 0;
    Dominance least = Dominance::strict, most = Dominance::none;  // of its rows
  };

  // The usual case, in little time: the diagonal dominates, and two passes come from strict rows to all others.
  bool is_held() const {
    if constexpr (B > 1) return false;
    std::vector<char> held(place_.size(), 0);
    const auto is_tied = [&](Index p) {
      const auto first = A_.column.begin();
      return std::any_of(first + A_.row[p], first + A_.row[p + 1], [&](Index q) { return held[q] != 0; });
    };
    for (Index p = 0; p < A_.size(); ++p) {
      const Dominance row = dominance(A_, p, 0);
      if (row == Dominance::none) return false;
      held[p] = row == Dominance::strict || is_tied(p);
    }
    for (Index p = A_.size() - 1; p >= 0; --p) held[p] = held[p] || is_tied(p);
    return std::ranges::all_of(held, [](char yes) { return yes != 0; });
  }

  // The component of p, into vectors_.
  Seen collect(Index p) {
    Seen seen;
    vectors_.assign(1, p);
    place_[p] = 0;
    for (std::size_t next = 0; next < vectors_.size(); ++next) {
      const Index q = vectors_[next];
      for (int i = 0; i < B && seen.least != Dominance::none; ++i) {
        const Dominance row = dominance(A_, q, i);
        seen.least = std::min(seen.least, row);
        seen.most = std::max(seen.most, row);
      }
      seen.blocks += A_.row[q + 1] - A_.row[q];
      for (Offset k = A_.row[q] + 1; k < A_.row[q + 1]; ++k) {
        Index& place = place_[A_.column[k]];
        if (place >= 0) continue;
        place = static_cast<Index>(vectors_.size());
        vectors_.push_back(A_.column[k]);
      }
    }
    return seen;
  }

  void settle(const Seen& seen) {
    const bool tree = seen.blocks <= blocks_of_a_tree * static_cast<Offset>(vectors_.size());
    if (seen.least == Dominance::none) {
      out_.regular_ = false;
      const bool cheap = vectors_.size() <= few_vectors || seen.blocks * B * B <= few_entries || tree;
      if (!cheap || !factorise()) out_.complete_ = false;
    } else if (seen.least == Dominance::weak && (B > 1 || seen.most == Dominance::weak)) {
      sign_.resize(static_cast<std::size_t>(A_.size()) * B, 0);
      for (const Index p : vectors_)
        for (int i = 0; i < B; ++i)
          if (sign_[Offset{p} * B + i] == 0) follow_signs(Offset{p} * B + i, tree);
    }
  }

  // Where the diagonal dominates and no row strictly, only entries of the same size are a motion, and couplings say
  // with which signs. Diagonals of trees are sums of so few others that what rounding leaves of them is known: more may
  // be a weak support.
  void follow_signs(Offset first, bool tree) {
    std::vector<Offset> rows{first};
    bool motion = true, clear = true;
    sign_[first] = 1;
    for (std::size_t next = 0; next < rows.size(); ++next) {
      const Offset i = rows[next];
      const auto p = static_cast<Index>(i / B);
      const auto in_block = static_cast<int>(i % B);
      const Excess excess(A_, p, in_block);
      motion = motion && excess.dominance() == Dominance::weak;
      clear = clear && !(tree && excess.is_more_than_sums_leave());
      for (Offset k = A_.row[p]; k < A_.row[p + 1]; ++k)
        for (int j = 0; j < B; ++j) {
          const double value = A_.at(k)[in_block * B + j];
          const Offset other = Offset{A_.column[k]} * B + j;
          if (value == 0 || other == i) continue;
          const auto expected = static_cast<signed char>(value < 0 ? sign_[i] : -sign_[i]);
          if (sign_[other] == 0) {
            sign_[other] = expected;
            rows.push_back(other);
          }
          motion = motion && sign_[other] == expected;
        }
    }
    if (!motion) return;
    const auto n = static_cast<Eigen::Index>(rows.size());
    Eigen::MatrixXd value(n, 1);
    for (Eigen::Index k = 0; k < n; ++k) value(k) = sign_[rows[static_cast<std::size_t>(k)]];
    out_.bases_.push_back({std::move(rows), Eigen::VectorXd::Ones(n), std::move(value), 0, clear});
  }

  // Returns whether everything is known of the component then.
  bool factorise() {
    std::vector<double> scales;
    const std::vector<Flags> nothing_masked(vectors_.size(), 0);
    const Eigen::SparseMatrix<double> S = with_unit_diagonal(component(), nothing_masked, scales);
    const Eigen::VectorXd scale = Eigen::Map<const Eigen::VectorXd>(scales.data(), S.rows());
    HeldCholesky factor;
    if (!factor.factorise(S, affordable_operations(S.nonZeros()))) return false;
    hold_hidden(S, factor);
    if (factor.falling_direction().size() > 0) refuse_if_indefinite(S, scale);
    if (factor.held().empty()) return true;
    return factor.held().size() <= most_motions && keep_motions(S, factor, scale);
  }

  // A motion that hardly moves the unknown of its pivot makes no small one: solutions show it.
  static void hold_hidden(const Eigen::SparseMatrix<double>& S, HeldCholesky& factor) {
    for (int k = 0; k < most_hidden && factor.smallest_pivot() < suspicious; ++k) {
      Eigen::VectorXd d = neither_smooth_nor_rough(S.rows());
      for (int step = 0; step < 2; ++step) d = factor.solve(d).normalized();
      if (!is_motion(S, d)) return;
      factor.factorise(S, infinity, factor.smallest_pivot());
    }
  }

  // Row by row, too: weak springs may have little energy beside all of the motion's terms. (Not of blocks: where a
  // rotation hardly moves anything, rounding of the rest of it is more than that of a row.)
  static bool is_motion(const Eigen::SparseMatrix<double>& S, const Eigen::VectorXd& d) {
    const Eigen::VectorXd Sd = S.selfadjointView<Eigen::Lower>() * d;
    const double small = rounding_of_motions * std::sqrt(static_cast<double>(S.rows()));
    if (!(Sd.norm() <= small && d.dot(Sd) <= rounding_of_squares)) return false;
    if constexpr (B > 1) return true;
    Eigen::VectorXd terms = d.cwiseAbs();
    for (Eigen::Index column = 0; column < S.cols(); ++column)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(S, column); entry; ++entry)
        if (entry.row() != column) {
          terms[entry.row()] += std::abs(entry.value() * d[column]);
          terms[column] += std::abs(entry.value() * d[entry.row()]);
        }
    const double of_motion = rounding_of_components * d.cwiseAbs().maxCoeff();
    return (Sd.cwiseAbs().array() <= rounding_of_rows * terms.array() + of_motion).all();
  }

  static Eigen::VectorXd neither_smooth_nor_rough(Eigen::Index size) {
    Eigen::VectorXd v(size);
    for (Eigen::Index k = 0; k < size; ++k) v[k] = std::cos(static_cast<double>(k * k));
    return v;
  }

  // A pivot may be negative by rounding, but not after what rounding may do was added to the diagonal.
  void refuse_if_indefinite(Eigen::SparseMatrix<double> S, const Eigen::VectorXd& scale) const {
    for (Eigen::Index k = 0; k < S.rows(); ++k) S.coeffRef(k, k) += rounding_of_energy;
    HeldCholesky factor;
    factor.factorise(S);
    const Eigen::VectorXd d = factor.falling_direction();
    if (d.size() == 0) return;
    const double energy = d.dot(S.selfadjointView<Eigen::Lower>() * d), of_diagonal = d.squaredNorm();
    Eigen::Index largest = 0;
    scale.cwiseProduct(d).cwiseAbs().maxCoeff(&largest);
    refuse_if_negative({energy - rounding_of_energy * of_diagonal, of_diagonal}, row(largest));
  }

  Offset row(Eigen::Index k) const { return Offset{vectors_[static_cast<std::size_t>(k / B)]} * B + k % B; }

  // The matrix of the component alone, its vectors numbered by their place in it.
  BlockMatrix<B> component() const {
    BlockMatrix<B> out;
    for (const Index p : vectors_) {
      for (Offset k = A_.row[p]; k < A_.row[p + 1]; ++k) out.column.push_back(place_[A_.column[k]]);
      out.value.insert(out.value.end(), A_.at(A_.row[p]), A_.at(A_.row[p + 1]));
      out.row.push_back(static_cast<Offset>(out.column.size()));
    }
    return out;
  }

  // Pivots may be small without vanishing: only what the matrix itself does not resist is a motion.
  bool keep_motions(const Eigen::SparseMatrix<double>& S, const HeldCholesky& factor, const Eigen::VectorXd& scale) {
    const Eigen::Index n = S.rows();
    Eigen::MatrixXd value(n, static_cast<Eigen::Index>(factor.held().size()));
    for (Eigen::Index k = 0; k < value.cols(); ++k) {
      Eigen::VectorXd d = factor.solve(Eigen::VectorXd::Unit(n, factor.held()[static_cast<std::size_t>(k)]));
      d.normalize();
      const Eigen::VectorXd Sd = S.selfadjointView<Eigen::Lower>() * d;
      d -= factor.solve(Sd - d.dot(Sd) * d);  // the spring would answer what is along d by more of d
      d.normalize();
      if (!is_motion(S, d)) return false;
      value.col(k) = d;
    }
    if (value.cols() > 1) value = orthonormal_columns(value);
    std::vector<Offset> rows;
    for (Eigen::Index k = 0; k < n; ++k) rows.push_back(row(k));
    const double left = Eigen::MatrixXd(S.selfadjointView<Eigen::Lower>() * value).norm();
    const double error = std::max(rounding_of_motions, 2 * left) * norm_of_pseudoinverse(factor, value);
    out_.bases_.push_back({std::move(rows), scale, std::move(value), error, true});
    return true;
  }

  // By a few steps of the power method.
  static double norm_of_pseudoinverse(const HeldCholesky& factor, const Eigen::MatrixXd& motions) {
    constexpr int steps = 6;
    Eigen::VectorXd v = neither_smooth_nor_rough(motions.rows());
    double norm = 0;
    for (int step = 0; step < steps; ++step) {
      v -= motions * (motions.transpose() * v);
      if (!(v.norm() > 0)) break;
      v = factor.solve(v.normalized());
      v -= motions * (motions.transpose() * v);
      norm = v.norm();
    }
    return norm;
  }

  const BlockMatrix<B>& A_;
  Motions& out_;
  std::vector<Index> place_;       // per vector: in its component; -1: not seen yet
  std::vector<Index> vectors_;     // of the component at hand
  std::vector<signed char> sign_;  // per unknown; 0: not seen yet
};

template <int B>
Motions<B>::Motions(const BlockMatrix<B>& A) {
  Finder(A, *this).run();
}

template <int B>
typename Motions<B>::Fall Motions<B>::fall(const std::vector<double>& b, const Constraints<B>& constraints) const {
  bool certain = complete_;
  std::optional<Offset> unclear;
  for (const Basis& basis : bases_)
    if (const Eigen::VectorXd d = falling_direction(basis, b, constraints, certain); d.size() > 0) {
      Eigen::Index largest = 0;
      basis.scale.cwiseProduct(d).cwiseAbs().maxCoeff(&largest);
      const Offset row = basis.row[static_cast<std::size_t>(largest)];
      if (basis.clear) return {row, {}, true};
      unclear = row;
    }
  return {{}, unclear, certain && !unclear};
}

// The one next to the forces among the motions that every bound allows, if there is more than rounding of it.
template <int B>
Eigen::VectorXd Motions<B>::falling_direction(const Basis& basis, const std::vector<double>& b,
                                              const Constraints<B>& constraints, bool& certain) {
  const Eigen::Index n = basis.value.rows();
  Eigen::VectorXd force(n);
  for (Eigen::Index k = 0; k < n; ++k)
    force[k] = basis.scale[k] * b[static_cast<std::size_t>(basis.row[static_cast<std::size_t>(k)])];
  const Eigen::VectorXd work = basis.value.transpose() * force;
  const Eigen::VectorXd terms = basis.value.cwiseAbs().transpose() * force.cwiseAbs();
  const double small = rounding_of_loads * std::sqrt(static_cast<double>(n));
  const double error = basis.error * force.norm();
  if ((work.cwiseAbs().array() <= small * terms.array() + error).all()) return {};

  const double least = negligible * basis.value.cwiseAbs().maxCoeff();
  AllowedMotions allowed(basis.value.cols());
  for (Eigen::Index k = 0; k < n; ++k) {
    const Interval bounds = bounds_of(constraints, basis.row[static_cast<std::size_t>(k)]);
    if (bounds.all()) continue;
    if (basis.value.row(k).cwiseAbs().maxCoeff() > least) allowed.bound(basis.value.row(k), bounds.lower, bounds.upper);
  }
  if (allowed.all()) return basis.value * work;
  const Eigen::VectorXd falling = allowed.nearest(work);
  if (!(falling.norm() > std::max(rounding_of_projections * work.norm(), small * terms.norm() + error))) return {};
  // Little of the forces may be left: whether it is more than rounding and conditions that are not quite met explain,
  // their work along it tells.
  const double missed = std::max(0.0, -allowed.least_rate(falling));
  if (work.dot(falling) > (small * terms.norm() + error) * falling.norm() + far * missed * work.norm())
    return basis.value * falling;
  certain = false;
  return {};
}

template class Motions<1>;
template class Motions<2>;
template class Motions<3>;

}  // namespace signorini
