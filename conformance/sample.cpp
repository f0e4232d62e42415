#include "conformance/sample.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>

#include "conformance/node.hpp"

namespace signorini::conformance {
namespace {

/// As long as it is wide: eigenvalues are within some tens of each other.
template <int B>
std::array<double, B * B> random_matrix(double size, Random& random) {
  std::array<double, B * B> out{}, root;
  for (double& v : root) v = random.between(-1, 1);
  for (int i = 0; i < B; ++i)
    for (int j = 0; j < B; ++j) {
      for (int k = 0; k < B; ++k) out[i * B + j] += size * root[k * B + i] * root[k * B + j];
      if (i == j) out[i * B + j] += 0.1 * size;
    }
  return out;
}

double random_size(Random& random) {
  const double kind = random.unit();
  return kind < 0.1 ? 1e-12 : kind < 0.2 ? 1e12 : random.size(1e-3, 1);
}

/// Which components are orthogonal to the first direction: those of no direction, and of directions across it.
template <int B>
Flags tangential_of(const LocalConstraint<B>& c) {
  Flags out = 0;
  for (int k = 1; k < B; ++k)
    if (k >= c.directions || std::fabs(block::dot<B>(c.direction[0], c.direction[k])) < 1e-6)
      out |= static_cast<Flags>(1u << k);
  return out;
}

/// Near places of that size, or where the obstacle has them.
template <int B>
void bring_bounds_near(Sample<B>& s, Random& random) {
  for (int k = 0; k < B; ++k) {
    const double below = random.chance(0.2) ? 0 : -s.size * random.unit(), above = s.size * random.unit();
    if (std::isfinite(s.lower[k])) s.lower[k] = below;
    if (std::isfinite(s.upper[k])) s.upper[k] = std::isfinite(s.lower[k]) ? std::fmax(above, s.lower[k]) : above;
  }
}

template <int B>
void choose_forces(const Obstacle<B>& obstacle, Sample<B>& s, Random& random) {
  double stiffness = 1;
  if (obstacle.functional() && !obstacle.renewal()) {
    const Node<B> node(obstacle, s);
    const double slopes = node.slopes(s.x) + node.slopes(s.z);
    if (std::isfinite(slopes) && slopes > 0) stiffness = slopes / s.size * random.size(0.1, 10);
  }
  s.M = random_matrix<B>(stiffness, random);
  s.force = random.vector<B>(stiffness * s.size * random.size(0.03, 30));
  if (!obstacle.renewal()) return;
  if (random.chance(0.5) && std::isfinite(s.lower[0])) {  // it presses
    s.x[0] = s.lower[0];
    s.force[0] = -std::fabs(s.force[0]);
  }
  s.data = Node<B>(obstacle, s).renewed();
  std::fill(s.data.begin() + s.width, s.data.end(), std::nan(""));
}

template <class Numbers>
std::string listed(const Numbers& numbers) {
  return fmt::format("({:.6g})", fmt::join(numbers, ", "));
}

}  // namespace

SurfaceVertex random_vertex(int dimension, Random& random) {
  SurfaceVertex v{};
  const std::array<double, 2> plane = random.direction<2>();
  const std::array<double, 3> space = random.direction<3>();
  for (int i = 0; i < dimension; ++i) {
    v.position[i] = random.between(0, 1);
    v.normal[i] = dimension == 2 ? plane[i] : space[i];
    v.away[i] = -v.normal[i];
  }
  v.measure = random.size(1e-3, 1);
  v.vertex = random.chance(0.2) ? -1 : static_cast<long>(1000 * random.unit());
  v.gap = random.between(-0.1, 0.3);
  return v;
}

template <int B>
std::vector<Sample<B>> samples_of(const Obstacle<B>& obstacle, int count, Random& random) {
  std::vector<Sample<B>> out;
  const int width = std::clamp(obstacle.descriptor().data, 0, most_data);
  for (int number = 0; number < count; ++number) {
    const SurfaceVertex vertex = random_vertex(B == 1 ? 2 : B, random);
    LocalConstraint<B> c;
    Status status;
    obstacle.assemble(&vertex, 1, &c, status);
    if (!status.ok() || c.directions < 0 || c.directions > B) continue;  // which is told elsewhere
    if (c.directions == 0) continue;
    Sample<B> s;
    s.size = random_size(random);
    s.width = width;
    s.directions = c.directions;
    s.tangential = tangential_of(c);
    s.data.fill(std::nan(""));  // what is not announced is not there
    std::copy_n(c.data, width, s.data.begin());
    for (int k = 0; k < B; ++k) {
      s.lower[k] = k < c.directions ? c.lower[k] : -infinity;
      s.upper[k] = k < c.directions ? c.upper[k] : infinity;
    }
    if (random.chance(0.5)) bring_bounds_near(s, random);
    if (random.chance(0.7)) s.last = random.vector<B>(0.5 * s.size);
    s.before.fill(std::nan(""));
    for (int k = 0; k < width; ++k) s.before[k] = s.data[k] * random.unit();
    s.x = random.chance(0.1) ? s.last : random.vector<B>(s.size);
    s.z = random.vector<B>(s.size);
    s.w = random.vector<B>(s.size);
    s.step = random.vector<B>(s.size);
    s.normal = random.direction<B>();
    s.put_within_bounds();
    choose_forces(obstacle, s, random);
    out.push_back(s);
  }
  // What fails first is the example, and numbers of usual size are read more easily.
  std::ranges::stable_sort(out, {}, [](const Sample<B>& s) { return s.size < 1e-6 || s.size > 1e6; });
  return out;
}

template <int B>
std::string describe(const Sample<B>& s, std::string_view parts) {
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
  for (const char part : parts) {
    if (part == 'x') add("x = " + listed(s.x));
    if (part == 'z') add("z = " + listed(s.z));
    if (part == 'w') add("w = " + listed(s.w));
    if (part == 'd') add("d = " + listed(s.step));
    if (part == 'M') add("M = " + listed(s.M) + ", r = " + listed(s.force));
    if (part == 'n')
      add(fmt::format("facet {} . v <= {:.6g}", listed(s.normal), block::dot<B>(s.normal.data(), s.z.data())));
  }
  add(fmt::format("bounds {} to {}", listed(s.lower), listed(s.upper)));
  if (s.width > 0) add("numbers " + listed(std::span(s.data).first(static_cast<std::size_t>(s.width))));
  if (std::ranges::any_of(s.last, [](double v) { return v != 0; })) add("last " + listed(s.last));
  return text;
}

double rounded_to(double value, int digits) {
  return std::isfinite(value) ? std::strtod(fmt::format("{:.{}e}", value, digits - 1).c_str(), nullptr) : value;
}

#define SIGNORINI_INSTANTIATE(B)                                                   \
  template std::vector<Sample<B>> samples_of<B>(const Obstacle<B>&, int, Random&); \
  template std::string describe<B>(const Sample<B>&, std::string_view);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini::conformance
