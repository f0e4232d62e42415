#pragma once
#include "core/sdk/polyhedron.hpp"

namespace signorini {

/// Minimises a strictly convex function of one vector on the facets of a polyhedron, from its minimiser for the bounds
/// of components alone: minimise(force, y) with a force added to what acts. One facet after the other, as in
/// Polyhedron::nearest(); on facets the function's dual has its maximum where they are met, which is a root of a
/// monotone function for each of them. To rounding.
/// @param stiffness the diagonal of the function's quadratic part, roughly
template <int B, class Minimise>
class ConstrainedMinimiser {
 public:
  ConstrainedMinimiser(const Polyhedron<B>& polyhedron, const double* stiffness, const Minimise& minimise)
      : polyhedron_(polyhedron), stiffness_(stiffness), minimise_(minimise) {}

  /// False where nothing is admissible; then y is of no use.
  bool run(double* y) { return search(2 * polyhedron_.facets(), 0, y); }

 private:
  using Side = typename Polyhedron<B>::Side;
  static constexpr int most_steps = 200;

  /// On the sides that are met, under the first `sides` of the facets.
  bool search(int sides, int met, double* y) {
    double none[B] = {};
    if (!on_sides(met, none, y)) return false;
    for (int k = 0; k < sides; ++k) {
      Side side;
      if (!polyhedron_.get(2 * B + k, side) || !polyhedron_.violates(side, y)) continue;
      if (met < B && Polyhedron<B>::add_row(side.normal, rows_, met)) {
        met_[met] = side;
        if (!search(k, met + 1, y)) return false;
      } else if (polyhedron_.excess(side, y) > side.tolerated) {
        return false;
      }
    }
    return true;
  }

  /// The minimiser where the first `count` sides are met.
  bool on_sides(int count, const double* force, double* y) {
    if (count == 0) {
      minimise_(force, y);
      return true;
    }
    if (count == B) return at_corner(y);
    const Side& side = met_[count - 1];
    double give = 0;  // how far a force along the normal moves it, roughly
    for (int i = 0; i < B; ++i) give += side.normal[i] * side.normal[i] / stiffness_[i];
    double pushed[B], last = 0;
    const auto excess_at = [&](double push) {
      last = push;
      for (int i = 0; i < B; ++i) pushed[i] = force[i] - push * side.normal[i];
      return on_sides(count - 1, pushed, y) ? polyhedron_.excess(side, y) : std::nan("");
    };
    const auto is_met = [&](double excess) { return std::fabs(excess) <= 0.5 * Polyhedron<B>::rounding_at(side, y); };
    const double at_zero = excess_at(0);
    if (is_met(at_zero)) return true;
    if (!reach(excess_at, is_met, at_zero, std::fabs(at_zero) / give)) return false;
    land(excess_at, side, last, std::max(std::fabs(last), std::fabs(at_zero) / give), y);
    return true;
  }

  /// Pushes, by steps that grow, until the side is met or passed, and then until it is met.
  template <class Excess, class Met>
  static bool reach(const Excess& excess_at, const Met& is_met, double at_low, double step) {
    const double way = at_low > 0 ? 1 : -1;
    for (double low = 0;; step *= 4) {
      const double high = low + way * step, at_high = excess_at(high);
      if (!std::isfinite(high) || std::isnan(at_high)) return false;
      if (is_met(at_high)) return true;
      if (way * at_high < 0) return find_root(excess_at, is_met, low, at_low, high, at_high);
      low = high, at_low = at_high;
    }
  }

  /// Takes y, reached by the push `last`, onto the side: there rounding is that of y, not of the whole way to it. Goes
  /// the way that a small push gives, along which what sticks and what is at a bound rests.
  template <class Excess>
  void land(const Excess& excess_at, const Side& side, double last, double size, double* y) const {
    const double off = polyhedron_.excess(side, y);
    if (off == 0) return;
    double at[B];
    std::copy_n(y, B, at);
    const double change = excess_at(last + 1e-6 * size) - off, part = off / change;
    for (int i = 0; i < B; ++i) y[i] = std::fabs(part) < 1 ? at[i] - part * (y[i] - at[i]) : at[i];
  }

  /// Between two pushes with excesses of different sign: by secants, halved where one end stays (Illinois).
  template <class Excess, class Met>
  static bool find_root(const Excess& excess_at, const Met& is_met, double a, double at_a, double b, double at_b) {
    for (int k = 0; k < most_steps; ++k) {
      double c = k % 4 == 3 ? 0.5 * (a + b) : b - at_b * (b - a) / (at_b - at_a);
      if (!(c > std::min(a, b) && c < std::max(a, b))) c = 0.5 * (a + b);
      const double at_c = excess_at(c);
      if (std::isnan(at_c)) return false;
      if (is_met(at_c) || c == a || c == b) return true;
      if ((at_c > 0) != (at_b > 0))
        a = b, at_a = at_b;
      else
        at_a *= 0.5;
      b = c;
      at_b = at_c;
    }
    return true;
  }

  /// The point where B sides meet, which has to be within the bounds of components but for rounding.
  bool at_corner(double* y) const {
    double far[B], zero[B] = {}, unit[B * B] = {};
    std::fill_n(far, B, infinity);
    Facet<B> facets[B];
    double none[B];
    std::fill_n(none, B, -infinity);
    for (int k = 0; k < B; ++k) {
      unit[k * (B + 1)] = 1;
      std::copy_n(met_[k].normal, B, facets[k].normal);
      facets[k].lower = facets[k].upper = met_[k].bound;
      facets[k].tolerated = met_[k].tolerated;
    }
    return Polyhedron<B>(none, far, facets, facets + B).nearest(unit, zero, y) &&
           polyhedron_.within_bounds(y, met_[0].tolerated);
  }

  const Polyhedron<B>& polyhedron_;
  const double* stiffness_;
  const Minimise& minimise_;
  Side met_[B];
  double rows_[B * B];  // the normals of those, orthonormal
};

}  // namespace signorini
