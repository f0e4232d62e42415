#include "core/fem/fixes.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "core/fem/element.hpp"
#include "core/fem/select.hpp"

namespace signorini {
namespace {

constexpr double same_direction = 1e-6;  // sine of the angle below which two directions are one
constexpr double axis_rounding = 1e-12;
const double smooth_cosine = std::cos(std::numbers::pi / 6);

// Replaces a unit vector within rounding of a coordinate axis by that axis.
template <int B>
void snap_to_axis(double* d) {
  const int largest =
      static_cast<int>(std::max_element(d, d + B, [](double a, double b) { return std::fabs(a) < std::fabs(b); }) - d);
  for (int i = 0; i < B; ++i)
    if (i != largest && std::fabs(d[i]) > axis_rounding) return;
  for (int i = 0; i < B; ++i) d[i] = i == largest ? std::copysign(1.0, d[i]) : 0.0;
}

// One normal per group of faces that meet smoothly at a vertex.
template <int D>
std::vector<Point<D>> group_normals(const Mesh<D>& mesh, const Index* faces, std::size_t count) {
  std::vector<Point<D>> area(count), unit(count);
  std::vector<std::size_t> group(count);
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    unit[i] = area[i] = area_normal(mesh, mesh.boundary[faces[i]]);
    normalise(unit[i]);
    for (std::size_t j = 0; j < i; ++j) {
      const Index curve = mesh.boundary[faces[i]].curve;
      const bool smooth =
          (curve >= 0 && curve == mesh.boundary[faces[j]].curve) || dot(unit[i], unit[j]) > smooth_cosine;
      if (smooth) std::replace(group.begin(), group.begin() + i + 1, std::size_t{group[i]}, std::size_t{group[j]});
    }
  }
  std::vector<Point<D>> normals;
  for (std::size_t g = 0; g < count; ++g) {
    Point<D> sum{};
    for (std::size_t i = 0; i < count; ++i)
      if (group[i] == g)
        for (int k = 0; k < D; ++k) sum[k] += area[i][k];
    if (normalise(sum) > 0) normals.push_back(sum);
  }
  return normals;
}

template <int B>
void add_global(const Fix<B>& fix, const Site& where, FixedDirections<B>& fixed) {
  for (int i = 0; i < B; ++i) {
    if (!fix.value[i]) continue;
    double axis[B] = {};
    axis[i] = 1;
    fixed.add(axis, (*fix.value[i])(where));
  }
}

template <int D>
void add_normal(const Fix<D>& fix, const Site& where, const Point<D>& normal, FixedDirections<D>& fixed) {
  if (fix.value[0]) fixed.add(normal.data(), (*fix.value[0])(where));
  const auto tangent = tangents(normal);
  for (int i = 1; i < D; ++i)
    if (fix.value[i]) fixed.add(tangent[i - 1].data(), (*fix.value[i])(where));
}

template <int D, int B>
void add_fix(const Mesh<D>& mesh, const Fix<B>& fix, double t, std::vector<Index>& slot,
             std::vector<FixedDirections<B>>& fixes) {
  const Surface<D> picked = surface(mesh, select_faces(mesh, fix.on, t));
  const std::vector<Point<D>> normals = vertex_normals(mesh, picked);
  for (std::size_t v = 0; v < picked.vertices.size(); ++v) {
    const Index p = picked.vertices[v];
    if (slot[p] < 0) {
      slot[p] = static_cast<Index>(fixes.size());
      fixes.push_back({.vertex = p});
    }
    FixedDirections<B>& fixed = fixes[slot[p]];
    if constexpr (B == D)
      if (fix.frame == Frame::normal) {
        const Index* faces = picked.around.data() + picked.first[v];
        for (const Point<D>& n : group_normals(mesh, faces, picked.first[v + 1] - picked.first[v]))
          add_normal<D>(fix, site<D>(mesh.points[p], t, n), n, fixed);
        continue;
      }
    add_global(fix, site<D>(mesh.points[p], t, normals[v]), fixed);
  }
}

}  // namespace

template <int B>
void FixedDirections<B>::add(const double* d, double v0) {
  double rest[B], rest_value = v0;
  std::copy_n(d, B, rest);
  for (int k = 0; k < count; ++k) {
    const double c = std::inner_product(direction[k], direction[k] + B, rest, 0.0);
    for (int i = 0; i < B; ++i) rest[i] -= c * direction[k][i];
    rest_value -= c * value[k];
  }
  const double length = std::sqrt(std::inner_product(rest, rest + B, rest, 0.0));
  if (length < same_direction || count == B) return;
  for (int i = 0; i < B; ++i) direction[count][i] = rest[i] / length;
  snap_to_axis<B>(direction[count]);
  value[count++] = rest_value / length;
}

template <int B>
bool FixedDirections<B>::along_axes() const {
  for (int k = 0; k < count; ++k)
    if (std::count(direction[k], direction[k] + B, 0.0) != B - 1) return false;
  return true;
}

template <int D, int B>
std::vector<FixedDirections<B>> collect_fixes(const Mesh<D>& mesh, const Model<B>& model) {
  std::vector<FixedDirections<B>> fixes;
  if (model.fixes.empty()) return fixes;
  std::vector<Index> slot(mesh.points.size(), -1);
  // What is prescribed first stays, hence backwards.
  for (auto fix = model.fixes.rbegin(); fix != model.fixes.rend(); ++fix) add_fix(mesh, *fix, model.t, slot, fixes);
  std::erase_if(fixes, [](const auto& f) { return f.count == 0; });
  std::sort(fixes.begin(), fixes.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
  return fixes;
}

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

template struct FixedDirections<1>;
template struct FixedDirections<2>;
template struct FixedDirections<3>;
template std::vector<FixedDirections<1>> collect_fixes(const Mesh<2>&, const Model<1>&);
template std::vector<FixedDirections<1>> collect_fixes(const Mesh<3>&, const Model<1>&);
template std::vector<FixedDirections<2>> collect_fixes(const Mesh<2>&, const Model<2>&);
template std::vector<FixedDirections<3>> collect_fixes(const Mesh<3>&, const Model<3>&);

}  // namespace signorini
