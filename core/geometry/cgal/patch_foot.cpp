#include "core/geometry/cgal/patch_foot.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {
namespace {

constexpr int most_steps = 20;
constexpr double settled = 1e-14;

using Weights = std::array<double, 3>;
using Derivatives = CubicPatch<3>::Derivatives;

/// Along the step from weight 0 to weight k: first derivatives; k and l: second ones.
Point<3> slope(const Derivatives& d, int k) { return difference<3>(d.first[k], d.first[0]); }
Point<3> second(const Derivatives& d, int k, int l) {
  Point<3> out;
  for (int i = 0; i < 3; ++i) out[i] = d.second[k][l][i] - d.second[k][0][i] - d.second[0][l][i] + d.second[0][0][i];
  return out;
}

PatchFoot foot(const CubicPatch<3>& patch, const Weights& weights, bool inside) {
  const Derivatives d = patch.derivatives(weights);
  return {d.value, cross(slope(d, 1), slope(d, 2)), weights, inside};
}

/// Where the offset is perpendicular; nothing if that is not on the patch.
std::optional<PatchFoot> inner(const CubicPatch<3>& patch, const Point<3>& p, Weights w) {
  for (int step = 0; step < most_steps; ++step) {
    const Derivatives d = patch.derivatives(w);
    const Point<3> off = difference<3>(d.value, p), a = slope(d, 1), b = slope(d, 2);
    const double ga = dot(off, a), gb = dot(off, b);
    const double haa = dot(a, a) + dot(off, second(d, 1, 1)), hbb = dot(b, b) + dot(off, second(d, 2, 2)),
                 hab = dot(a, b) + dot(off, second(d, 1, 2));
    const double det = haa * hbb - hab * hab;
    if (!(haa > 0 && det > 0)) return {};
    const double u = -(hbb * ga - hab * gb) / det, v = -(haa * gb - hab * ga) / det;
    w = {w[0] - u - v, w[1] + u, w[2] + v};
    if (!(std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]) < 4)) return {};
    if (std::abs(u) + std::abs(v) <= settled) break;
  }
  if (*std::ranges::min_element(w) <= 0) return {};
  return foot(patch, w, true);
}

/// On the edge between corners a and b, by Newton's method within [0, 1].
PatchFoot on_edge(const CubicPatch<3>& patch, const Point<3>& p, int a, int b, double t) {
  double low = 0, high = 1;
  Weights w{};
  const auto at = [&](double s) {
    w = {};
    w[a] = 1 - s;
    w[b] = s;
    return patch.derivatives(w);
  };
  const auto gradient = [&](const Derivatives& d) {
    return dot(difference<3>(d.value, p), difference<3>(d.first[b], d.first[a]));
  };
  if (gradient(at(0)) >= 0) {
    high = t = 0;
  } else if (gradient(at(1)) <= 0) {
    low = t = 1;
  }
  for (int step = 0; step < 3 * most_steps && low < high; ++step) {
    const Derivatives d = at(t);
    const double g = gradient(d);
    (g < 0 ? low : high) = t;
    const Point<3> along = difference<3>(d.first[b], d.first[a]);
    Point<3> turn;
    for (int i = 0; i < 3; ++i) turn[i] = d.second[a][a][i] - 2 * d.second[a][b][i] + d.second[b][b][i];
    const double h = dot(along, along) + dot(difference<3>(d.value, p), turn);
    double next = t - g / h;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (std::abs(next - t) <= settled) break;
    t = next;
  }
  at(t);
  return foot(patch, w, false);
}

}  // namespace

PatchFoot nearest_on_patch(const CubicPatch<3>& patch, const Point<3>& p, const Weights& start) {
  if (const auto found = inner(patch, p, start)) return *found;
  PatchFoot best;
  double least = infinity;
  for (const auto [a, b] : simplex_edges<2>()) {
    const double sum = start[a] + start[b];
    const PatchFoot found = on_edge(patch, p, a, b, sum > 0 ? std::clamp(start[b] / sum, 0.0, 1.0) : 0.5);
    const double distance = length<3>(difference<3>(found.at, p));
    if (distance >= least) continue;
    least = distance;
    best = found;
  }
  return best;
}

}  // namespace signorini::geometry
