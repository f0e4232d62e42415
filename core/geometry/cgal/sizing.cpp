#include "core/geometry/cgal/sizing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cmath>

#include "core/base/proc.hpp"

namespace signorini::geometry {

namespace {

// What CGAL's triangulations, their refinement queues and the mesh itself take per element.
constexpr double bytes_per_element = 400;
constexpr double most_elements = 2e8;
// Evaluations granted to details that the expected number of elements knows nothing of: some seconds in 2D, a minute in
// 3D.
template <int D>
constexpr double spare_evaluations = D == 2 ? 2e6 : 1e7;

// Vertices granted to them, and queries between two looks at whether the user interrupts.
constexpr double spare_vertices = 3e5, queries_per_poll = 64;

// Sizes of fewer spacings of floating point numbers leave no room for vertices between vertices.
constexpr double least_spacings = 8;

// A shape thinner than any size asked for may take so many elements by itself; some ten seconds.
constexpr double most_unasked = 2e5, most_stretch = 2;

// Decimal ones: sizes are usually given with fewer, and stay what they are then.
double to_six_digits(double x) {
  if (!(x > 0) || !std::isfinite(x)) return x;
  const double scale = std::pow(10.0, 5 - std::floor(std::log10(x)));
  return std::round(x * scale) / scale;
}

double available_bytes() {
  if (const auto bytes = proc_bytes("/proc/meminfo", "MemAvailable")) return *bytes;
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

template <int D>
Sizing<D>::Sizing(const Size<D>& size, double ceiling, double diameter, const OwnUnits<D>& units, std::string shape,
                  std::string narrowest)
    : size_(size),
      ceiling_(ceiling),
      floor_(1e-6 * diameter),
      units_(units),
      shape_(std::move(shape)),
      narrowest_(std::move(narrowest)) {}

template <int D>
double Sizing<D>::operator()(const Point<D>& p) const {
  double h = std::min(asked(p), ceiling_);
  for (const Halved& near : halved_) {
    double square = 0;
    for (int k = 0; k < D; ++k) square += (p[k] - near.center[k]) * (p[k] - near.center[k]);
    if (square < near.distance * near.distance) h /= 2;
  }
  return h;
}

template <int D>
double Sizing<D>::asked(Point<D> p) const {
  p = last_ = units_.given(p);
  const double found = size_(p), h = to_six_digits(found / units_.unit);
  if (!std::isfinite(found) || found <= 0)
    fail(fmt::format("found {} at [{:g}], expected a positive length", found, fmt::join(p, ", ")));
  if (h < floor_)
    fail(fmt::format("found {:g} at [{:g}], too small for this shape (the least is {:g})", found, fmt::join(p, ", "),
                     floor_ * units_.unit));
  double farthest = 0;
  for (const double x : p) farthest = std::max(farthest, std::abs(x));
  if (const double spacing = std::numeric_limits<double>::epsilon() * farthest; found < least_spacings * spacing)
    fail(fmt::format("found {:g} at [{:g}], where numbers are {:.2g} apart; expected a shape nearer to the origin",
                     found, fmt::join(p, ", "), spacing));
  if (++evaluations_ > limit_) no_end();
  smallest_ = std::min(smallest_, h);
  return h;
}

template <int D>
void Sizing<D>::count_query() const {
  if (++queries_ > query_limit_) no_end();
  if (std::fmod(queries_, queries_per_poll) == 0) poll();
}

template <int D>
void Sizing<D>::fail(const std::string& complaint) const {
  throw ShapeError(shape_, "size", complaint);
}

template <int D>
void Sizing<D>::no_end(const std::optional<Point<D>>& place) const {
  std::string where = narrowest_;
  if (place)
    where =
        fmt::format("near [{:.6g}] vertices would be too close to sharp edges", fmt::join(units_.given(*place), ", "));
  throw NoEnd(
      shape_, "size",
      fmt::format(
          "the mesh does not come to an end{}{}; expected a size that varies gradually, on a shape without gaps "
          "and angles far below it",
          where.empty() ? "" : ": ", where));
}

template <int D>
void Sizing<D>::expect(double elements) {
  if (elements > most_elements)
    fail(fmt::format("too small, about {:.1g} elements; at most {:.1g} are possible", elements, most_elements));
  if (const double available = available_bytes(); elements * bytes_per_element > available)
    fail(fmt::format("too small, about {:.1g} elements would need {:.1f} GB of memory, {:.1f} GB are available",
                     elements, elements * bytes_per_element / 1e9, available / 1e9));
  limit_ = evaluations_ + spare_evaluations<D> + 100 * elements;
  query_limit_ = queries_ + spare_evaluations<D> + 200 * elements;
  most_vertices_ = static_cast<std::size_t>(spare_vertices + elements);
}

template <int D>
void Sizing<D>::check_thickness(double measure) const {
  const double elements = expected_elements<D>(measure, {ceiling_});
  if (smallest_ <= most_stretch * ceiling_ || elements <= most_unasked) return;
  fail(
      fmt::format("the shape is only {0:.3g} thick, about {1:.1g} elements no larger than that would fill it, and the "
                  "least size is {2:.3g}; expected a thicker shape, or size = {0:.3g} if so many are meant",
                  ceiling_ * units_.unit, elements, smallest_ * units_.unit));
}

template <int D>
double expected_elements(double measure, const std::vector<double>& sizes) {
  // Regular simplices of edge 1 number 4 / sqrt(3) per unit of area and 6 sqrt(2) per unit of volume.
  const double density = D == 2 ? 4 / std::sqrt(3) : 6 * std::sqrt(2);
  double sum = 0;
  for (const double h : sizes) sum += std::pow(h, -D);
  return density * measure * sum / static_cast<double>(sizes.size());
}

template class Sizing<2>;
template class Sizing<3>;
template double expected_elements<2>(double, const std::vector<double>&);
template double expected_elements<3>(double, const std::vector<double>&);

}  // namespace signorini::geometry
