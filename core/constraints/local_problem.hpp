#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/sdk/block.hpp"
#include "core/sdk/obstacle.hpp"

namespace signorini {

/// The local problem of one slot, 1/2 (v - x)'M(v - x) - r'(v - x) + phi(v) within its bounds, as a problem of a single
/// vector: what an obstacle with a functional says of it, and whether that is true.
template <int B>
class LocalProblem {
 public:
  using Vector = std::array<double, B>;

  /// @param all the problem that the slot is of, with what is frozen in phi; without facets at the slot
  LocalProblem(const Obstacle<B>& obstacle, const LevelView<B>& all, Index slot)
      : obstacle_(obstacle), phi_(*obstacle.functional()), view_(all) {
    M_ = all.value + all.row[all.constrained[slot]] * B * B;
    block::invert<B>(M_, inverse_);
    view_.vectors = view_.slots = 1;
    view_.row = row_;
    view_.column = view_.slot = view_.constrained = &none_;
    view_.value = M_;
    view_.inverse = inverse_;
    view_.b = b_.data();
    view_.x = x_.data();
    view_.lower += Offset{slot} * B;
    view_.upper += Offset{slot} * B;
    view_.data += Offset{slot} * view_.width;
    view_.before += Offset{slot} * view_.width;
    view_.last += Offset{slot} * B;
    view_.tangential += slot;
    view_.relaxation = 1;
    view_.facet_row = nullptr;
  }
  LocalProblem(const LocalProblem&) = delete;
  LocalProblem& operator=(const LocalProblem&) = delete;

  double lower(int k) const { return view_.lower[k]; }
  double upper(int k) const { return view_.upper[k]; }

  /// What the obstacle's own sweep says is the minimiser.
  Vector minimiser(const Vector& x, const Vector& r) {
    x_ = x;
    b_ = r;
    block::add_product<B>(M_, x.data(), b_.data());
    obstacle_.sweep(view_, 0, 1, Order::forward);
    return x_;
  }

  double change(const Vector& from, const Vector& to) const { return phi_.change(view_, 0, 1, from.data(), to.data()); }
  double slope(const Vector& at, const Vector& step) const { return phi_.slope(view_, 0, 1, at.data(), step.data()); }

  /// M^-1 r
  Vector correction(const Vector& r) const {
    Vector out;
    block::product<B>(inverse_, r.data(), out.data());
    return out;
  }
  /// M d
  Vector force(const Vector& d) const {
    Vector out;
    block::product<B>(M_, d.data(), out.data());
    return out;
  }

  bool is_within_bounds(const Vector& x, double rounding) const {
    for (int k = 0; k < B; ++k)
      if (x[k] < lower(k) - rounding || x[k] > upper(k) + rounding) return false;
    return true;
  }

  /// x + d, where the bounds leave it.
  Vector moved(const Vector& x, const Vector& d) const {
    Vector out;
    for (int k = 0; k < B; ++k) out[k] = block::clamp(x[k] + d[k], lower(k), upper(k));
    return out;
  }

  /// A place with less energy than y, which is said to be the minimiser for x and r: a step of this length along a
  /// component, or down what is left of the forces, lowers the energy by more than a part of its terms. Exact
  /// minimisers have none, however rounding has moved them off a kink.
  std::optional<Vector> better_than(const Vector& y, const Vector& x, const Vector& r, double length) const {
    constexpr double rounding = 1e-7;
    Vector way, left = r;
    for (int k = 0; k < B; ++k) way[k] = y[k] - x[k];
    const Vector back = force(way);
    for (int k = 0; k < B; ++k) left[k] -= back[k];
    const double size = block::norm<B>(left.data());
    for (int side = 0; side < 2 * B + 1; ++side) {
      Vector d{};
      if (side < 2 * B)
        d[side / 2] = side % 2 ? -length : length;
      else if (size > 0)
        for (int k = 0; k < B; ++k) d[k] = length * left[k] / size;
      const Vector z = moved(y, d);
      for (int k = 0; k < B; ++k) d[k] = z[k] - y[k];
      if (block::norm<B>(d.data()) < 0.01 * length) continue;  // bounds leave rounding of it
      const Vector Md = force(d);
      double terms = std::fabs(change(y, z)), gain = -change(y, z);
      for (int k = 0; k < B; ++k) {
        gain += d[k] * (left[k] - 0.5 * Md[k]);
        terms += std::fabs(d[k]) * (std::fabs(r[k]) + std::fabs(back[k]) + std::fabs(Md[k]));
      }
      if (gain > rounding * terms) return z;
    }
    return {};
  }

  /// What no convex phi says of a step from x to z.
  struct Contradiction {
    double first, change, last;  ///< slope at x along the step, phi(z) - phi(x), slope at z along it
  };
  std::optional<Contradiction> contradiction(const Vector& x, const Vector& z) const {
    constexpr double rounding = 1e-6;
    Vector d, back;
    for (int k = 0; k < B; ++k) d[k] = z[k] - x[k], back[k] = -d[k];
    const Contradiction out{slope(x, d), change(x, z), -slope(z, back)};
    const double tolerated = rounding * (std::fabs(out.first) + std::fabs(out.change) + std::fabs(out.last));
    if (!std::isfinite(tolerated)) return {};  // which is told elsewhere
    if (out.change >= out.first - tolerated && out.change <= out.last + tolerated) return {};
    return out;
  }

 private:
  static constexpr Offset row_[2] = {0, 1};
  static constexpr Index none_ = 0;

  const Obstacle<B>& obstacle_;
  const Functional<B>& phi_;
  LevelView<B> view_;
  const double* M_;
  double inverse_[B * B];
  Vector b_{}, x_{};
};

}  // namespace signorini
