#include "core/fem/recovery/traction_recovery.hpp"
#include "core/fem/recovery/fit_limits.hpp"

#include <algorithm>
#include <cmath>

namespace signorini {
namespace {

constexpr double common = 0.5;  // length of the mean of unit vectors that have a direction in common

template <int D, int B>
class TractionRecovery {
 public:
  using Vector = std::array<double, B>;
  using Reached = typename PressedFaces<D, B>::Reached;

  TractionRecovery(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, const PressedFaces<D, B>& faces)
      : faces_(faces), samples_(nodes, surface, faces) {
    for (Index k = 0; k < faces.size(); ++k) {
      const auto& around = faces.around(k);
      stuck_.push_back(sticks(k) && !around.empty() && std::ranges::all_of(around, [&](Index j) { return sticks(j); }));
    }
  }

  void run() {
    for (Index k = 0; k < faces_.size(); ++k)
      if (const ContactNode<B>& node = faces_.node(k); faces_.pressed(k) && node.friction && node.area > 0)
        faces_.node(k).traction = borne(k, traction(k));
  }

 private:
  bool sticks(Index k) const { return faces_.pressed(k) && faces_.node(k).sticks; }
  bool slips(Index k) const { return faces_.pressed(k) && faces_.node(k).friction && !faces_.node(k).sticks; }

  /// Around a node.
  Vector mean(Index k) const {
    Vector out = faces_.node(k).tangential;
    for (double& f : out) f /= faces_.node(k).area;
    return out;
  }
  /// What friction bears, for a pressure at the node.
  double limit(Index k, double pressure) const {
    const ContactNode<B>& node = faces_.node(k);
    return node.law.coefficient * pressure + node.law.bound / node.area;
  }

  Vector traction(Index k) const {
    if (slips(k)) return all_it_bears(k);
    const std::vector<Reached> slipping =
        faces_.around(k, {rings, rings, 0}, [this](Index other) { return slips(other); });
    if (slipping.empty()) return inside(k);
    const auto direction = common_direction(slipping);
    return direction ? near_edge(k, *direction) : mean(k);
  }

  /// No more than friction bears, where nodes stick, too: fits of pressure and traction know nothing of each other.
  Vector borne(Index k, Vector traction) const {
    const double length = std::sqrt(dot(traction, traction)), most = limit(k, faces_.node(k).recovered);
    for (int i = 0; i < B && length > most; ++i) traction[i] *= most / length;
    return traction;
  }

  Vector all_it_bears(Index k) const {
    Vector out = mean(k);
    const double length = std::sqrt(dot(out, out));
    for (int i = 0; i < B && length > 0; ++i) out[i] *= limit(k, faces_.node(k).recovered) / length;
    return out;
  }

  /// Of slip. Nothing where it differs from node to node.
  std::optional<Vector> common_direction(const std::vector<Reached>& slipping) const {
    Vector sum{};
    for (const Reached& other : slipping) {
      const Vector t = mean_at(other);
      const double length = std::sqrt(dot(t, t));
      for (int i = 0; i < B && length > 0; ++i) sum[i] += t[i] / length;
    }
    const double length = std::sqrt(dot(sum, sum));
    if (!(length > common * static_cast<double>(slipping.size()))) return {};
    for (double& s : sum) s /= length;
    return sum;
  }

  /// The same, at a mirror image of the node as well.
  Vector mean_at(const Reached& place) const {
    if constexpr (B == D) return faces_.turned(place.image, mean(place.node));
    return mean(place.node);
  }

  /// How much less than friction bears there is along a direction of slip, as a mean around the node.
  double left(const Reached& place, const Vector& direction) const {
    const Index k = place.node;
    return slips(k) ? 0 : std::max(limit(k, faces_.node(k).pressure) - dot(mean_at(place), direction), 0.0);
  }

  Vector near_edge(Index k, const Vector& direction) const {
    const auto some =
        faces_.around(k, {rings_beyond, most_rings, enough<D>}, [this](Index other) -> bool { return stuck_[other]; });
    const Vector around = mean(k);
    if (some.size() < enough<D>) return around;
    const auto squares = samples_.around(k, some, [&](const Reached& s) {
      const double value = left(s, direction);
      return value * value;
    });
    const auto fit = PolynomialFit<1, D - 1>(squares).at({});
    if (!fit) return around;
    const double rest =
        between_means(k, std::sqrt(std::max(fit->front(), 0.0)), [&](Index j) { return left({j}, direction); });
    const double along = limit(k, faces_.node(k).recovered) - rest - dot(around, direction);
    Vector out = around;
    for (int i = 0; i < B; ++i) out[i] += along * direction[i];
    return out;
  }

  /// Farther inside what sticks.
  Vector inside(Index k) const {
    const auto some =
        faces_.around(k, {rings, most_rings, enough<D>}, [this](Index other) -> bool { return stuck_[other]; });
    Vector out = mean(k);
    if (some.size() < enough<D>) return out;
    for (int i = 0; i < B; ++i) {
      const auto component = [&](Index j) { return mean(j)[static_cast<std::size_t>(i)]; };
      const auto fit = fitted_value(
          samples_.around(k, some, [&](const Reached& s) { return mean_at(s)[static_cast<std::size_t>(i)]; }));
      if (fit) out[i] = between_means(k, *fit, component);
    }
    return out;
  }

  /// Cut off where it is farther from the means at the node and its neighbours than a quarter of the largest.
  template <class Mean>
  double between_means(Index k, double value, const Mean& mean_at) const {
    double least = mean_at(k), most = least, largest = std::abs(least);
    for (const Index other : faces_.around(k)) {
      if (!faces_.pressed(other)) continue;
      const double there = mean_at(other);
      least = std::min(least, there);
      most = std::max(most, there);
      largest = std::max(largest, std::abs(there));
    }
    const double more = (excess - 1) * largest;
    return std::clamp(value, least - more, most + more);
  }

  const PressedFaces<D, B>& faces_;
  const SurfaceSamples<D, B> samples_;
  std::vector<bool> stuck_;  // with all neighbours
};

}  // namespace

template <int D, int B>
void recover_traction(const Nodes<D>& nodes, const ContactSurface<D, B>& surface, const PressedFaces<D, B>& faces) {
  bool any = false;
  for (Index k = 0; k < faces.size(); ++k) any = any || faces.node(k).friction;
  if (any) TractionRecovery<D, B>(nodes, surface, faces).run();
}

#define SIGNORINI_INSTANTIATE(D, B) \
  template void recover_traction(const Nodes<D>&, const ContactSurface<D, B>&, const PressedFaces<D, B>&);
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
