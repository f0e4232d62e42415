#include "driver/scene/halved_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/mesh/mirror.hpp"

namespace signorini {
namespace {

constexpr double off_plane = 1e-9;  // of the extent

/// Applies one plane of symmetry to a shape.
class Halving {
 public:
  Halving(const Mirror& mirror, const Scene::Body& body, const std::string& place)
      : axis_(mirror.axis), at_(mirror.at), body_(body), place_(place) {}

  template <int D>
  void operator()(Scene::Block<D>& block) const {
    const double low = block.from[axis_], high = block.to[axis_];
    if (beside(low, high)) return;
    check_middle((low + high) / 2, high - low);
    block.from[axis_] = at_;
    block.cells[axis_] = (block.cells[axis_] + 1) / 2;
  }

  void operator()(geometry::Disk& disk) const {
    const double c = disk.center[axis_], r = disk.radius;
    const bool cut = axis_ == 0 ? disk.right_half : disk.lower_half;  // a half disk, or one at the axis
    const bool lower = axis_ == 1;
    if (beside(cut && !lower ? c : c - r, cut && lower ? c : c + r)) return;
    check_middle(cut ? c + (lower ? -r / 2 : r / 2) : c, 2 * r);
    (axis_ == 0 ? disk.right_half : disk.upper_half) = true;
  }

  void operator()(geometry::Ball& ball) const {
    const double c = ball.center[axis_], r = ball.radius;
    const bool cut = axis_ == 2 && ball.lower_half;
    if (beside(c - r, cut ? c : c + r)) return;
    check_middle(cut ? c - r / 2 : c, 2 * r);
    ball.halved[axis_] = true;
  }

  void operator()(geometry::Cylinder& cylinder) const {
    const double c = cylinder.center[axis_], half = axis_ == 2 ? cylinder.height / 2 : cylinder.radius;
    if (beside(c - half, c + half)) return;
    check_middle(c, 2 * half);
    cylinder.halved[axis_] = true;
  }

  void operator()(geometry::Polygon& polygon) const {
    const auto [low, high] =
        std::ranges::minmax_element(polygon.points, {}, [&](const Point<2>& p) { return p[axis_]; });
    const double extent = (*high)[axis_] - (*low)[axis_];
    if (beside((*low)[axis_], (*high)[axis_])) return;
    check_middle(((*low)[axis_] + (*high)[axis_]) / 2, extent);
    check_images(polygon, off_plane * extent);
    polygon = upper_part(polygon, off_plane * extent);
  }

  void operator()(const Scene::MeshFile&) const {}
  void operator()(const geometry::Solid&) const {}

 private:
  /// Whether all of the shape is on one side.
  bool beside(double low, double high) const {
    const double near = off_plane * (high - low);
    return low >= at_ - near || high <= at_ + near;
  }

  void check_middle(double middle, double extent) const {
    if (std::abs(middle - at_) > off_plane * extent)
      refuse(fmt::format("is not in its middle, {} = {:g}", axis_name(axis_), middle));
  }

  [[noreturn]] void refuse(const std::string& why) const {
    input_error(place_,
                fmt::format("the plane of symmetry {} = {:g} of body '{}' {}", axis_name(axis_), at_, body_.name, why));
  }

  /// Whether the corners, one after the other, have their images in the opposite order.
  void check_images(const geometry::Polygon& polygon, double near) const {
    const std::size_t n = polygon.points.size();
    const auto image_is = [&](const Point<2>& p, const Point<2>& q) {
      return std::abs(p[axis_] + q[axis_] - 2 * at_) <= near && std::abs(p[1 - axis_] - q[1 - axis_]) <= near;
    };
    for (std::size_t shift = 0; shift < n; ++shift) {
      std::size_t k = 0;
      while (k < n && image_is(polygon.points[k], polygon.points[(shift + n - k) % n])) ++k;
      if (k == n) return;
    }
    refuse("is none: the images of its corners are not its corners");
  }

  geometry::Polygon upper_part(const geometry::Polygon& polygon, double near) const {
    const std::size_t n = polygon.points.size();
    const auto number = [&](std::size_t k) { return polygon.edges.empty() ? static_cast<int>(k) : polygon.edges[k]; };
    const auto side = [&](const Point<2>& p) {
      const double off = p[axis_] - at_;
      return off > near ? 1 : off < -near ? -1 : 0;
    };
    geometry::Polygon out;
    int crossings = 0;
    const auto add = [&](Point<2> p, int edge, bool on_plane) {
      if (on_plane) p[axis_] = at_;
      out.points.push_back(p);
      out.edges.push_back(edge);
    };
    for (std::size_t k = 0; k < n; ++k) {
      const Point<2>&a = polygon.points[k], &b = polygon.points[(k + 1) % n];
      const int from = side(a), to = side(b);
      if (from == 0 && to == 0) refuse("runs along one of its edges");
      Point<2> middle;
      for (int i = 0; i < 2; ++i) middle[i] = (a[i] + b[i]) / 2;
      if (from > 0) add(a, number(k), false);
      if (from == 0) add(a, to > 0 ? number(k) : -1, true), ++crossings;
      if (from * to < 0) add(middle, to > 0 ? number(k) : -1, true), ++crossings;
    }
    if (crossings != 2) refuse("cuts it into more than two pieces");
    return out;
  }

  int axis_;
  double at_;
  const Scene::Body& body_;
  const std::string& place_;
};

}  // namespace

Scene::BodyShape halved_shape(const Scene& scene, const Scene::Body& body) {
  Scene::BodyShape shape = body.shape;
  for (const Mirror& mirror : scene.symmetry.planes)
    std::visit(Halving(mirror, body, scene.symmetry.source.of(axis_name(mirror.axis))), shape);
  return shape;
}

}  // namespace signorini
