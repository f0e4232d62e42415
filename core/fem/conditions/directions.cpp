#include "core/fem/conditions/directions.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"
#include "core/base/rounding.hpp"
#include "core/fem/elements/element.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini {
namespace {

Point<2> away_from_axis(const LocalFrame<2>& frame, const Point<2>& x) { return difference<2>(x, frame.center); }

Point<3> unit_axis(const LocalFrame<3>& frame) {
  Point<3> out = frame.axis;
  normalise(out);
  return out;
}

Point<3> away_from_axis(const LocalFrame<3>& frame, const Point<3>& x) {
  Point<3> out = difference<3>(x, frame.center);
  const Point<3> along = unit_axis(frame);
  const double height = dot(out, along);
  for (int i = 0; i < 3; ++i) out[i] -= height * along[i];
  return out;
}

std::array<Point<2>, 2> cylindrical(const LocalFrame<2>& frame, const Point<2>& x) {
  Point<2> away = away_from_axis(frame, x);
  if (is_on_axis<2, 2>(frame, x)) away = {1, 0};
  normalise(away);
  return {away, {-away[1], away[0]}};
}

std::array<Point<3>, 3> cylindrical(const LocalFrame<3>& frame, const Point<3>& x) {
  const Point<3> along = unit_axis(frame);
  Point<3> away = away_from_axis(frame, x);
  if (is_on_axis<3, 3>(frame, x)) away = tangents(along)[0];
  normalise(away);
  return {away, cross(along, away), along};
}

}  // namespace

std::array<Point<2>, 1> tangents(const Point<2>& normal) { return {{{-normal[1], normal[0]}}}; }

std::array<Point<3>, 2> tangents(const Point<3>& normal) {
  const auto farthest =
      std::min_element(normal.begin(), normal.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }) -
      normal.begin();
  Point<3> first{};
  first[farthest] = 1;
  for (int i = 0; i < 3; ++i) first[i] -= normal[farthest] * normal[i];
  normalise(first);
  return {first, cross(normal, first)};
}

template <int D, int B>
bool is_on_axis(const LocalFrame<B>& frame, const Point<D>& x) {
  if constexpr (B == D) {
    if (frame.kind != Frame::cylindrical) return false;
    const Point<D> away = away_from_axis(frame, x), arm = difference<D>(x, frame.center);
    const double size = std::max({length<D>(arm), length<D>(x), length<D>(frame.center)});
    return length<D>(away) <= rounding_of_differences * size;
  }
  return false;
}

template <int D, int B>
std::array<std::array<double, B>, B> directions(const LocalFrame<B>& frame, const Point<D>& x, const Point<D>& normal) {
  std::array<std::array<double, B>, B> out{};
  for (int i = 0; i < B; ++i) out[i][i] = 1;
  if constexpr (B == D) {
    if (frame.kind == Frame::cylindrical) return cylindrical(frame, x);
    if (frame.kind == Frame::normal) {
      out[0] = normal;
      std::ranges::copy(tangents(normal), out.begin() + 1);
    }
  }
  return out;
}

#define SIGNORINI_INSTANTIATE(D, B)                                                                     \
  template bool is_on_axis<D, B>(const LocalFrame<B>&, const Point<D>&);                                \
  template std::array<std::array<double, B>, B> directions<D, B>(const LocalFrame<B>&, const Point<D>&, \
                                                                 const Point<D>&);
SIGNORINI_INSTANTIATE(2, 1)
SIGNORINI_INSTANTIATE(3, 1)
SIGNORINI_INSTANTIATE(2, 2)
SIGNORINI_INSTANTIATE(3, 3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
