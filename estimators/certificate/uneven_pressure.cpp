#include "estimators/certificate/uneven_pressure.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "estimators/certificate/stress_element.hpp"

namespace signorini {
namespace {

/// Parts of a side of less than this are rounding.
constexpr double no_part = 1e-12;

class Fan {
 public:
  Fan(const std::array<Point<2>, 3>& corner, const Material<2>& material, const Point<2>& d)
      : corner_(corner), material_(material), d_(d), side_(length<2>(difference<2>(corner[1], corner[0]))) {}

  /// The next part of the side, with values of what acts there.
  void add(double from, double to, double first, double last) {
    if (to - from > no_part) parts_.push_back({from, to, first, last});
  }

  double norm() {
    ways_.assign(parts_.size() + 1, {});
    free_.assign(ways_.size(), 0);
    hand_on();
    double energy = this->energy();
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (std::size_t k = 1; k < parts_.size(); ++k) energy = improve(k, energy);
    return std::sqrt(2 * energy);
  }

 private:
  static constexpr int sweeps = 3;
  using Traction = std::array<Point<2>, 2>;  // times the length of the side, at its first end, then at the vertex

  Point<2> place(double s) const {
    return {(1 - s) * corner_[0][0] + s * corner_[1][0], (1 - s) * corner_[0][1] + s * corner_[1][1]};
  }

  /// What all parts before do, as a linear traction on the line to the vertex opposite: f + w x (x - c).
  void hand_on() {
    Point<2> force{};
    double moment = 0;  // about the origin
    for (std::size_t k = 0; k + 1 < parts_.size(); ++k) {
      const PressureOnPart& part = parts_[k];
      const double size = (part.to - part.from) * side_;
      const Point<2> a = place(part.from), b = place(part.to);
      for (int i = 0; i < 2; ++i) force[i] += size * (part.first + part.last) / 2 * d_[i];
      moment += size * (cross(a) * (2 * part.first + part.last) + cross(b) * (part.first + 2 * part.last)) / 6;
      const Point<2> x = place(part.to), middle = midpoint<2>(x, corner_[2]), half = difference<2>(x, middle);
      const double about = moment - (middle[0] * force[1] - middle[1] * force[0]), w = about / (dot(half, half) / 3);
      ways_[k + 1] = {Point<2>{force[0] - w * half[1], force[1] + w * half[0]},
                      Point<2>{force[0] + w * half[1], force[1] - w * half[0]}};
    }
  }
  double cross(const Point<2>& x) const { return x[0] * d_[1] - x[1] * d_[0]; }

  /// With a linear traction along the line, which has no force and no moment.
  Traction way(std::size_t k) const {
    Traction out = ways_[k];
    if (k == 0 || k == parts_.size()) return out;
    const Point<2> along = difference<2>(corner_[2], place(parts_[k].from));
    for (int i = 0; i < 2; ++i) {
      out[0][i] += free_[k] * along[i];
      out[1][i] -= free_[k] * along[i];
    }
    return out;
  }

  double energy() const {
    double sum = 0;
    for (std::size_t k = 0; k < parts_.size(); ++k) sum += energy(k);
    return sum;
  }
  /// Of the triangle of a part: it hands on what comes from the one before, and what acts on it.
  double energy(std::size_t k) const {
    const PressureOnPart& part = parts_[k];
    std::array<Point<2>, 3> x{place(part.from), place(part.to), corner_[2]};
    const double size = (part.to - part.from) * side_;
    const Traction in = way(k), on = way(k + 1);
    typename StressElement<2>::FaceValues z;  // opposite to a vertex: the other two, in their order
    for (int i = 0; i < 2; ++i) {
      z[0][0][i] = -on[0][i], z[0][1][i] = -on[1][i];
      z[1][0][i] = in[0][i], z[1][1][i] = in[1][i];
      z[2][0][i] = size * part.first * d_[i], z[2][1][i] = size * part.last * d_[i];
    }
    if (signed_volume<2>(x) < 0) {
      std::swap(x[0], x[1]);
      std::swap(z[0], z[1]);
      std::swap(z[2][0], z[2][1]);
    }
    const LinearElement<2> element = linear_element(x);
    return StressElement<2>(element, x).misfit(material_, {}, {}, z);
  }

  /// The least energy along one free traction, which is a parabola.
  double improve(std::size_t k, double now) {
    const double scale = size_of(ways_[k]) / length<2>(difference<2>(corner_[2], place(parts_[k].from)));
    if (!(scale > 0)) return now;
    const double start = free_[k], before = energy(k - 1) + energy(k);
    const auto at = [&](double by) {
      free_[k] = start + by;
      return energy(k - 1) + energy(k);
    };
    const double plus = at(scale), minus = at(-scale), bend = plus + minus - 2 * before;
    const double best = bend > 0 ? at(scale * (minus - plus) / (2 * bend)) : at(0);
    if (best < before) return now + best - before;
    free_[k] = start;
    return now;
  }
  static double size_of(const Traction& t) { return length<2>(t[0]) + length<2>(t[1]); }

  const std::array<Point<2>, 3>& corner_;
  const Material<2>& material_;
  const Point<2> d_;
  const double side_;
  std::vector<PressureOnPart> parts_;
  std::vector<Traction> ways_;
  std::vector<double> free_;
};

}  // namespace

double norm_of_uneven(const std::array<Point<2>, 3>& corner, const Material<2>& material, const Point<2>& d,
                      std::vector<PressureOnPart> parts, const std::array<double, 2>& linear) {
  std::ranges::sort(parts, {}, &PressureOnPart::from);
  Fan fan(corner, material, d);
  const auto of_linear = [&](double s) { return (1 - s) * linear[0] + s * linear[1]; };
  double end = 0;
  for (const PressureOnPart& part : parts) {
    fan.add(end, part.from, -of_linear(end), -of_linear(part.from));
    fan.add(part.from, part.to, part.first - of_linear(part.from), part.last - of_linear(part.to));
    end = part.to;
  }
  fan.add(end, 1, -of_linear(end), -of_linear(1));
  return fan.norm();
}

}  // namespace signorini
