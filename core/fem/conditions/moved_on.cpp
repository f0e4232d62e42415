#include "core/fem/conditions/moved_on.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/conditions/bounds.hpp"

namespace signorini {
namespace {

constexpr double touching = 1e-6;    // of how far nodes have come along their normals: what tolerances leave
constexpr double noticeable = 0.01;  // of what contact flattens, or of how far nodes have come

/// A bound, and what is left of it.
template <int D>
struct Left {
  const Bound<D>* bound;
  double along, left;
};

template <int D>
Left<D> left_of(const Bound<D>& bound, const std::vector<double>& u) {
  double along = 0;
  for (int i = 0; i < D; ++i) along += bound.direction[i] * u[Offset{bound.vertex} * D + i];
  return {&bound, along, std::min(along - bound.lower, bound.upper - along)};
}

/// Of those that touch, and of all, how far they have come.
struct Way {
  double least = infinity, most = -infinity, closed = 0;
};

/// By how much other bounds differ most from these at the same vertices.
template <int D>
double largest_change(const std::vector<Left<D>>& touch, const std::vector<Bound<D>>& other,
                      const std::vector<double>& u) {
  double out = 0;
  for (const Left<D>& at : touch) {
    double nearest = infinity;
    for (auto bound = std::ranges::lower_bound(other, at.bound->vertex, {}, &Bound<D>::vertex);
         bound != other.end() && bound->vertex == at.bound->vertex; ++bound)
      nearest = std::min(nearest, std::fabs(left_of(*bound, u).left - at.left));
    out = std::max(out, nearest);
  }
  return out;
}

}  // namespace

template <int D>
std::optional<Point<D>> moved_on(const Nodes<D>& nodes, const Model<D>& model, Index obstacle,
                                 const std::vector<double>& u) {
  const std::vector<Bound<D>> bounds = bounds_of(nodes, model, obstacle);
  std::vector<Left<D>> touch;
  Way way;
  double nearest = infinity;
  for (const Bound<D>& bound : bounds) {
    const Left<D>& at = touch.emplace_back(left_of(bound, u));
    way.closed = std::max(way.closed, std::fabs(at.along));
    nearest = std::min(nearest, at.left);
  }
  if (touch.empty()) return {};
  const double reach = std::max(nearest, 0.0) + touching * way.closed;
  std::erase_if(touch, [&](const Left<D>& at) { return at.left > reach; });
  Model<D> there = model;
  Point<D>& mean = there.obstacles[obstacle].moved;
  mean = {};
  double size = 0;
  for (const Left<D>& at : touch) {
    way.least = std::min(way.least, at.along);
    way.most = std::max(way.most, at.along);
    for (int i = 0; i < D; ++i) {
      const double by = u[Offset{at.bound->vertex} * D + i];
      mean[i] += by / static_cast<double>(touch.size());
      size = std::max(size, std::fabs(nodes.at(at.bound->vertex)[i]) + std::fabs(by));
    }
  }
  const double flattened = way.most - way.least;
  const double scale = flattened > touching * way.closed ? flattened : way.closed;
  const double change = largest_change(touch, bounds_of(nodes, there, obstacle), u);
  if (!(change > std::max(noticeable * scale, rounding_of_differences * size))) return {};
  return mean;
}

template std::optional<Point<2>> moved_on<2>(const Nodes<2>&, const Model<2>&, Index, const std::vector<double>&);
template std::optional<Point<3>> moved_on<3>(const Nodes<3>&, const Model<3>&, Index, const std::vector<double>&);

}  // namespace signorini
