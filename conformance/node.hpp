#pragma once
#include <cmath>

#include "conformance/sample.hpp"

namespace signorini::conformance {

/// An obstacle at a single node, which a sample describes: what the obstacle says about it.
template <int B>
class Node {
 public:
  using Vector = std::array<double, B>;

  /// @param faceted whether the sample's facet bounds what is admissible
  Node(const Obstacle<B>& obstacle, const Sample<B>& sample, bool faceted = false)
      : obstacle_(obstacle), sample_(sample) {
    block::invert<B>(sample_.M.data(), inverse_);
    std::copy(sample_.normal.begin(), sample_.normal.end(), facet_.normal);
    facet_.lower = -infinity;
    facet_.upper = block::dot<B>(sample_.normal.data(), sample_.z.data());
    facet_.tolerated = 1e-12 * (std::fabs(facet_.upper) + sample_.size);
    view_.vectors = view_.slots = 1;
    view_.row = row_;
    view_.column = view_.slot = view_.constrained = &none_;
    view_.value = sample_.M.data();
    view_.inverse = inverse_;
    view_.b = b_.data();
    view_.x = x_.data();
    view_.lower = sample_.lower.data();
    view_.upper = sample_.upper.data();
    view_.relaxation = 1;
    view_.data = sample_.data.data();
    view_.before = sample_.before.data();
    view_.width = sample_.width;
    view_.last = sample_.last.data();
    view_.tangential = &sample_.tangential;
    view_.facet_row = faceted ? row_ : nullptr;
    view_.facet = faceted ? &facet_ : nullptr;
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  const Sample<B>& sample() const { return sample_; }
  const Obstacle<B>& obstacle() const { return obstacle_; }
  const Facet<B>& facet() const { return facet_; }

  double change(const Vector& from, const Vector& to) const {
    const Functional<B>* phi = obstacle_.functional();
    return phi ? phi->change(view_, 0, 1, from.data(), to.data()) : 0;
  }
  double slope(const Vector& at, const Vector& step) const {
    const Functional<B>* phi = obstacle_.functional();
    return phi ? phi->slope(view_, 0, 1, at.data(), step.data()) : 0;
  }
  /// How large slopes are at a place.
  double slopes(const Vector& at) const {
    double sum = 0;
    for (int k = 0; k < B; ++k) sum += std::fmax(std::fabs(slope(at, unit(k, 1))), std::fabs(slope(at, unit(k, -1))));
    return sum;
  }

  /// The local solver's y for 1/2 (y-x)'M(y-x) - r'(y-x) + phi(y).
  Vector minimiser(const Vector& x, const Vector& r) {
    ask(x, r);
    obstacle_.sweep(view_, 0, 1, Order::forward);
    return x_;
  }
  double natural_residual(const Vector& x, const Vector& r) {
    ask(x, r);
    return obstacle_.natural_residual(view_, 0, 1, r.data());
  }

  struct Distance {
    Vector lower, upper;
    Flags critical = 0;
  };
  Distance distance(const Vector& x) {
    ask(x, {});
    Distance out;
    obstacle_.distance(view_, 0, 1, out.lower.data(), out.upper.data(), &out.critical);
    return out;
  }

  struct Model : Distance {
    Vector gradient{};
    std::array<double, B * B> hessian{};
    Flags held = 0;  ///< by bounds: critical before
    bool is_smooth(int k) const { return !(this->critical >> k & 1u); }
  };
  Model model(const Vector& x) {
    Model out;
    static_cast<Distance&>(out) = distance(x);
    out.held = out.critical;
    obstacle_.linearisation()->linearise(
        view_, 0, 1, {out.gradient.data(), out.hessian.data(), out.lower.data(), out.upper.data(), &out.critical});
    return out;
  }

  /// The numbers that renew() makes of x and the force; -1 behind them, where it has nothing to write.
  std::array<double, most_data> renewed() {
    std::array<double, most_data> out = sample_.data;
    for (int k = sample_.width; k < most_data; ++k) out[k] = -1;
    ask(sample_.x, sample_.force);
    obstacle_.renewal()->renew(view_, 0, 1, sample_.force.data(), out.data());
    return out;
  }

  Vector product(const Vector& d) const {
    Vector out;
    block::product<B>(sample_.M.data(), d.data(), out.data());
    return out;
  }
  static Vector unit(int k, double length) {
    Vector out{};
    out[k] = length;
    return out;
  }

 private:
  void ask(const Vector& x, const Vector& r) {
    x_ = x;
    b_ = r;
    block::add_product<B>(sample_.M.data(), x.data(), b_.data());
  }

  static constexpr Offset row_[2] = {0, 1};
  static constexpr Index none_ = 0;

  const Obstacle<B>& obstacle_;
  const Sample<B> sample_;
  LevelView<B> view_{};
  Facet<B> facet_{};
  double inverse_[B * B];
  Vector x_{}, b_{};
};

template <int B>
std::array<double, B> difference(const std::array<double, B>& to, const std::array<double, B>& from) {
  std::array<double, B> out;
  for (int k = 0; k < B; ++k) out[k] = to[k] - from[k];
  return out;
}

template <int B>
double length(const std::array<double, B>& v) {
  return block::norm<B>(v.data());
}

template <class Numbers>
bool all_finite(const Numbers& numbers) {
  return std::ranges::all_of(numbers, [](double v) { return std::isfinite(v); });
}

}  // namespace signorini::conformance
