#pragma once
#include <algorithm>
#include <utility>

#include "core/sdk/block.hpp"
#include "core/sdk/level_view.hpp"

namespace signorini {

/// What is admissible at one vector where a box does not say it: the bounds of its components and facets beside them,
/// any number of them, dependent or nearly parallel ones as well. Of B components in local coordinates.
template <int B>
class Polyhedron {
 public:
  /// Keeps all pointers.
  Polyhedron(const double* lower, const double* upper, const Facet<B>* first, const Facet<B>* last)
      : lower_(lower), upper_(upper), first_(first), sides_(2 * (B + static_cast<int>(last - first))) {}
  /// Of a slot that has facets.
  Polyhedron(const LevelView<B>& level, Index slot)
      : Polyhedron(level.lower + Offset{slot} * B, level.upper + Offset{slot} * B, level.facet + level.facet_row[slot],
                   level.facet + level.facet_row[slot + 1]) {}

  int facets() const { return sides_ / 2 - B; }
  const Facet<B>& facet(int k) const { return first_[k]; }

  /// The point y next to `target` in the norm of M, which is symmetric and semidefinite: exact up to rounding, bounds
  /// of components are met exactly. False where nothing is admissible; then y is of no use. Takes one side after the
  /// other. Where one is violated by what is nearest under those before, the point sought is on it, which leaves a
  /// problem with a dimension less (Seidel, Discrete Comput. Geom. 6, 1991).
  bool nearest(const double* M, const double* target, double* y) const {
    double axes[B * B];
    orthonormal_axes(M, axes);
    // A corner of nearly parallel sides is known badly; in another order it is that of others.
    Search s{axes, 0, {}, 0};
    for (; s.first < sides_; ++s.first) {
      if (!search<B>(s, sides_, target, axes, y)) continue;
      for (int k = 0; k < B; ++k) y[k] = y[k] < lower_[k] ? lower_[k] : y[k] > upper_[k] ? upper_[k] : y[k];
      return true;
    }
    return false;
  }

  /// Whether x violates nothing by more than rounding.
  bool contains(const double* x) const {
    for (int k = 0; k < sides_; ++k)
      if (Side side; get(k, side) && violates(side, x)) return false;
    return true;
  }

  /// What is left of facet k at x on both sides; 0 where it is touched, but for rounding.
  std::pair<double, double> room(int k, const double* x) const {
    const Facet<B>& f = first_[k];
    const double value = block::dot<B>(f.normal, x), terms = terms_of(f.normal, x);
    const auto left = [&](double room, double bound) {
      return room < infinity && room <= touching * (std::fabs(bound) + terms) ? 0 : room;
    };
    return {left(value - f.lower, f.lower), left(f.upper - value, f.upper)};
  }

  bool touches(int k, const double* x) const {
    const auto [below, above] = room(k, x);
    return below == 0 || above == 0;
  }

  /// The projector P onto the motions that neither change the components in `held` nor leave the facets that x touches.
  /// Returns the components that P leaves nothing of.
  Flags hold(const double* x, Flags held, double* P) const { return hold(x, x, held, P); }
  /// The same for facets that both x and y touch.
  Flags hold(const double* x, const double* y, Flags held, double* P) const {
    double rows[B * B];
    int count = 0;
    for (int k = 0; k < B; ++k)
      if (held >> k & 1u) {
        std::fill_n(rows + count * B, B, 0.0);
        rows[count++ * B + k] = 1;
      }
    for (int k = 0; k < facets() && count < B; ++k)
      if (touches(k, x) && touches(k, y)) count += add_row(first_[k].normal, rows, count);
    for (int i = 0; i < B; ++i)
      for (int j = 0; j < B; ++j) {
        double left = i == j;
        for (int k = 0; k < count; ++k) left -= rows[k * B + i] * rows[k * B + j];
        P[i * B + j] = count == B || ((held >> i | held >> j) & 1u) ? 0 : left;
      }
    return count == B ? static_cast<Flags>((1u << B) - 1) : held;
  }

  /// Narrows a box of corrections such that P d is admissible with each d = P d in it: the components have equal shares
  /// in what the facets leave. P: null for the identity.
  void share(const double* x, const double* P, double* lower, double* upper) const {
    for (int k = 0; k < facets(); ++k) {
      const auto [below, above] = room(k, x);
      double n[B];
      if (P)
        block::product<B>(P, first_[k].normal, n);
      else
        std::copy_n(first_[k].normal, B, n);
      const double least = negligible * block::norm<B>(first_[k].normal);
      const auto count = std::count_if(n, n + B, [&](double c) { return std::fabs(c) > least; });
      for (int i = 0; i < B; ++i) {
        if (!(std::fabs(n[i]) > least)) continue;
        const double part = std::fabs(n[i]) * static_cast<double>(count);
        lower[i] = std::max(lower[i], -(n[i] > 0 ? below : above) / part);
        upper[i] = std::min(upper[i], (n[i] > 0 ? above : below) / part);
      }
    }
  }

  /// normal . x <= bound
  struct Side {
    double normal[B];
    double bound;
    double tolerated;  ///< contradictions of other sides
    int component;     ///< that it bounds; -1: a facet
  };

  /// Sides: lower and upper bound of each component, then those of each facet. False where there is none.
  bool get(int k, Side& side) const {
    const double sign = k % 2 ? 1 : -1;
    side.component = k < 2 * B ? k / 2 : -1;
    if (side.component >= 0) {
      for (int i = 0; i < B; ++i) side.normal[i] = i == side.component ? sign : 0;
      side.bound = sign * (k % 2 ? upper_ : lower_)[side.component];
      side.tolerated = sides_ > 2 * B ? first_->tolerated : 0;
    } else {
      const Facet<B>& f = first_[k / 2 - B];
      for (int i = 0; i < B; ++i) side.normal[i] = sign * f.normal[i];
      side.bound = sign * (k % 2 ? f.upper : f.lower);
      side.tolerated = f.tolerated;
    }
    return side.bound < infinity;
  }

  static double excess(const Side& side, const double* x) { return block::dot<B>(side.normal, x) - side.bound; }
  /// What rounding makes of that; nothing at bounds of components.
  static double rounding_at(const Side& side, const double* x) {
    return side.component >= 0 ? 0 : rounding * (std::fabs(side.bound) + terms_of(side.normal, x));
  }
  static bool violates(const Side& side, const double* x) { return excess(side, x) > rounding_at(side, x); }

  /// Whether x is within the bounds of components but for what is tolerated.
  bool within_bounds(const double* x, double tolerated) const {
    for (int k = 0; k < B; ++k)
      if (!(x[k] >= lower_[k] - tolerated && x[k] <= upper_[k] + tolerated)) return false;
    return true;
  }

  /// Gram-Schmidt, twice, of the next row. Returns whether it is no combination of the `count` ones before.
  static bool add_row(const double* normal, double* rows, int count) {
    double* row = rows + count * B;
    std::copy_n(normal, B, row);
    for (int pass = 0; pass < 2; ++pass)
      for (int k = 0; k < count; ++k) {
        const double c = block::dot<B>(row, rows + k * B);
        for (int i = 0; i < B; ++i) row[i] -= c * rows[k * B + i];
      }
    const double length = block::norm<B>(row);
    if (!(length > negligible * block::norm<B>(normal))) return false;
    for (int i = 0; i < B; ++i) row[i] /= length;
    return true;
  }

 private:
  static constexpr double rounding = 2e-15;    // of the terms of a scalar product
  static constexpr double touching = 1e-13;    // what coarse corrections and sweeps make of that
  static constexpr double dependent = 1e-13;   // lengths that are rounding, relative to that of the whole vector
  static constexpr double oblique = 1e-3;      // the same of what is small
  static constexpr double negligible = 1e-12;  // parts of a normal
  static constexpr double singular = 1e-8;     // raises pivots that are smaller, relative to the diagonal

  static double terms_of(const double* a, const double* b) {
    double sum = 0;
    for (int i = 0; i < B; ++i) sum += std::fabs(a[i] * b[i]);
    return sum;
  }

  /// Columns of L^-T for M = L L', one after the other: orthonormal in the norm of M.
  static void orthonormal_axes(const double* M, double* axes) {
    double L[B * B];
    for (int i = 0; i < B; ++i) {
      for (int j = 0; j < i; ++j) {
        double sum = M[i * B + j];
        for (int k = 0; k < j; ++k) sum -= L[i * B + k] * L[j * B + k];
        L[i * B + j] = sum / L[j * B + j];
      }
      double pivot = M[i * B + i];
      for (int k = 0; k < i; ++k) pivot -= L[i * B + k] * L[i * B + k];
      const double least = singular * M[i * B + i];
      L[i * B + i] = std::sqrt(pivot > least || std::isnan(pivot) ? pivot : least > 0 ? least : 1);
    }
    for (int j = 0; j < B; ++j)
      for (int i = B - 1; i >= 0; --i) {
        double sum = i == j;
        for (int k = i + 1; k < B; ++k) sum -= L[k * B + i] * axes[j * B + k];
        axes[j * B + i] = sum / L[i * B + i];
      }
  }

  /// What brings a point back to a side: a way of length one across it.
  struct Return {
    Side side;
    double way[B];
    double length;  ///< of the side's normal
    bool oblique;   ///< little of it is across the sides before: its corner with them is known badly
  };

  struct Search {
    const double* axes;  ///< of the whole space
    int first;           ///< side, the others follow
    Return met[B];       ///< sides that the point found is on; the ways keep it on those before
    int count;
  };

  /// Nearest to `origin` under so many sides, in the space through it that N orthonormal axes span.
  template <int N>
  bool search(Search& s, int sides, const double* origin, const double* axes, double* y) const {
    std::copy_n(origin, B, y);
    s.count = B - N;
    for (int k = 0; k < sides; ++k) {
      Side side;
      if (!get((s.first + k) % sides_, side) || !violates(side, y)) continue;
      if constexpr (N > 0) {
        double n[N], length2 = 0, whole2 = 0;
        for (int i = 0; i < N; ++i) n[i] = block::dot<B>(axes + i * B, side.normal), length2 += n[i] * n[i];
        for (int i = 0; i < B; ++i)
          whole2 += block::dot<B>(s.axes + i * B, side.normal) * block::dot<B>(s.axes + i * B, side.normal);
        if (length2 > dependent * dependent * whole2) {
          s.met[B - N].oblique = length2 < oblique * oblique * whole2;
          if (!search_on<N>(s, side, k, n, std::sqrt(length2), origin, axes, y)) return false;
          continue;
        }
      }
      if (excess(side, y) > side.tolerated) return false;
    }
    return true;
  }

  /// The same on side k.
  /// @param n its normal along the axes
  template <int N>
  bool search_on(Search& s, const Side& side, int k, double* n, double length, const double* origin, const double* axes,
                 double* y) const {
    double foot[B], left[B * B];
    Return& back = s.met[B - N];
    back.side = side;
    back.length = length;
    for (int i = 0; i < N; ++i) n[i] /= length;
    for (int i = 0; i < B; ++i) {
      back.way[i] = 0;
      for (int j = 0; j < N; ++j) back.way[i] += n[j] * axes[j * B + i];
    }
    std::copy_n(origin, B, foot);
    go_back(back, foot);
    complement<N>(n, axes, left);
    if (!search<N - 1>(s, k, foot, left, y)) return false;
    // From far away, rounding of the whole way is more than that of where it ends.
    for (int i = B - N; i < s.count; ++i)
      if (!s.met[i].oblique) go_back(s.met[i], y);
    if (side.component >= 0) y[side.component] = side.normal[side.component] * side.bound;
    return true;
  }

  static void go_back(const Return& back, double* y) {
    const double by = excess(back.side, y) / back.length;
    for (int i = 0; i < B; ++i) y[i] -= by * back.way[i];
  }

  /// The axes but for the direction n among them, by a reflection that takes n to the last one.
  template <int N>
  static void complement(const double* n, const double* axes, double* left) {
    double v[N];
    for (int i = 0; i < N; ++i) v[i] = n[i];
    v[N - 1] += n[N - 1] < 0 ? -1 : 1;
    const double scale = 1 / std::fabs(v[N - 1]);  // 2 / v'v
    for (int j = 0; j + 1 < N; ++j)
      for (int i = 0; i < B; ++i) {
        double sum = 0;
        for (int k = 0; k < N; ++k) sum += v[k] * axes[k * B + i];
        left[j * B + i] = axes[j * B + i] - scale * v[j] * sum;
      }
  }

  const double *lower_, *upper_;
  const Facet<B>* first_;
  int sides_;
};

/// Whether a slot has facets.
template <int B>
inline bool has_facets(const LevelView<B>& level, Index slot) {
  return level.facet_row && level.facet_row[slot] < level.facet_row[slot + 1];
}

/// A component beside the B ones: the critical flag of slots that touch a facet.
template <int B>
inline constexpr Flags on_facet = 1u << B;

/// What facets leave of the distances of the slots from <= slot < to, and whether they are touched.
template <int B>
inline void share_facets(const LevelView<B>& level, Index from, Index to, double* lower, double* upper,
                         Flags* critical) {
  if (!level.facet_row) return;
  for (Index slot = from; slot < to; ++slot) {
    if (!has_facets(level, slot)) continue;
    const Polyhedron<B> polyhedron(level, slot);
    const double* x = level.x + Offset{level.constrained[slot]} * B;
    polyhedron.share(x, nullptr, lower + Offset{slot} * B, upper + Offset{slot} * B);
    for (int k = 0; k < polyhedron.facets(); ++k)
      if (polyhedron.touches(k, x)) critical[slot] |= on_facet<B>;
  }
}

}  // namespace signorini
