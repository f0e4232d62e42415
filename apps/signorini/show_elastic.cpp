#include <cmath>
#include <optional>

#include "apps/signorini/drawn_level.hpp"
#include "apps/signorini/show.hpp"
#include "core/fem/element.hpp"
#include "core/fem/fixes.hpp"

namespace signorini {
namespace {

/// Largest edge of the box around a mesh.
template <int D>
double extent(const Mesh<D>& mesh) {
  double widest = 0;
  for (int k = 0; k < D; ++k) {
    const auto [low, high] = std::minmax_element(mesh.points.begin(), mesh.points.end(),
                                                 [k](const auto& a, const auto& b) { return a[k] < b[k]; });
    widest = std::max(widest, (*high)[k] - (*low)[k]);
  }
  return widest;
}

/// Factor by which displacements are drawn: one when they can be seen, else a round number that makes them visible.
template <int D>
double exaggeration(const Shown<D>& shown) {
  double largest = 0;
  for (const double u : shown.displacement) largest = std::max(largest, std::abs(u));
  const double wanted = 0.05 * extent(shown.hierarchy.finest());
  if (!(largest > 0) || largest >= wanted) return 1;
  const double ratio = wanted / largest, power = std::pow(10, std::floor(std::log10(ratio)));
  return power * (ratio / power >= 5 ? 5 : ratio / power >= 2 ? 2 : 1);
}

template <int D>
Point<D> deformed(const Shown<D>& shown, const Drawn<D>& drawn, Index v, double factor) {
  Point<D> x = drawn.mesh->points[v];
  for (int k = 0; k < D; ++k) x[k] += factor * shown.displacement[std::size_t(drawn.fine[v]) * D + k];
  return x;
}

const std::vector<std::array<Index, 3>>& triangles(const Mesh<2>& mesh) { return mesh.elements; }

std::vector<std::array<Index, 3>> triangles(const Mesh<3>& mesh) {
  std::vector<std::array<Index, 3>> result;
  for (const auto& face : mesh.boundary) result.push_back(face.vertices);
  return result;
}

/// Mean outer normal of the faces in contact weighted by pressure, and the middle and radius of the contact set.
template <int D>
struct ContactZone {
  Point<D> normal{}, middle{};
  double radius = 0;
};

template <int D>
std::optional<ContactZone<D>> contact_zone(const Shown<D>& shown) {
  const Mesh<D>& mesh = shown.hierarchy.finest();
  ContactZone<D> zone;
  double total = 0;
  const auto pressed = [&](Index v) { return !shown.pressure.empty() && shown.pressure[v] > 0; };
  for (const auto& face : mesh.boundary)
    for (const Index v : face.vertices)
      if (pressed(v)) {
        const Point<D> n = area_normal(mesh, face);
        const double weight = shown.pressure[v] * std::sqrt(dot(n, n));
        total += weight;
        for (int k = 0; k < D; ++k) {
          zone.normal[k] += shown.pressure[v] * n[k];
          zone.middle[k] += weight * mesh.points[v][k];
        }
      }
  if (!(total > 0) || !(normalise(zone.normal) > 1e-3 * total)) return std::nullopt;
  for (double& x : zone.middle) x /= total;
  for (const Index v : shown.touched)
    if (pressed(v)) zone.radius = std::max(zone.radius, length<D>(difference<D>(mesh.points[v], zone.middle)));
  zone.radius = std::max(zone.radius, 0.01 * extent(mesh));
  return zone;
}

template <int D>
Panel body_panel(const Shown<D>& shown, const std::optional<ContactZone<D>>& zone, std::vector<std::string>& notes) {
  const double factor = zone ? 1 : exaggeration(shown);  // exaggerated, a contact zone would not fit the obstacle
  Panel panel;
  panel.title = factor == 1 ? "deformed body" : fmt::format("deformed body (displacements x {:g})", factor);
  panel.label = shown.label;
  panel.view = D == 2 ? View::flat : View::space;
  panel.patches = few_patches(shown, notes, true, [&](const Drawn<D>& drawn) {
    std::vector<Patch> patches;
    for (const auto& triangle : triangles(*drawn.mesh)) {
      if (is_too_many(patches)) break;
      Patch& patch = patches.emplace_back();
      for (int c = 0; c < 3; ++c)
        set_corner(patch, c, deformed(shown, drawn, triangle[c], factor), shown.value[drawn.fine[triangle[c]]]);
    }
    return patches;
  });
  if constexpr (D == 3)
    if (zone) {  // from the side, so far round that the contact zone is seen
      Point<3> side{panel.from[0], panel.from[1], panel.from[2]};
      const double along = dot(side, zone->normal);
      for (int k = 0; k < 3; ++k) side[k] -= along * zone->normal[k];
      normalise(side);
      for (int k = 0; k < 3; ++k) panel.from[k] = 0.9 * side[k] + 0.435 * zone->normal[k];
    }
  return panel;
}

/// The pressure around the contact zone, seen along its normal.
Panel pressure_panel(const Shown<3>& shown, const ContactZone<3>& zone, std::vector<std::string>& notes) {
  Panel panel{"contact pressure", "contact pressure", View::flat, {}, {}, {}};
  const auto axes = tangents(zone.normal);
  panel.patches = few_patches(shown, notes, false, [&](const Drawn<3>& drawn) {
    std::vector<Patch> patches;
    for (const auto& face : drawn.mesh->boundary) {
      if (is_too_many(patches)) break;
      Patch patch;
      bool inside = dot(area_normal(*drawn.mesh, face), zone.normal) > 0;
      for (int c = 0; c < 3 && inside; ++c) {
        const Point<3> d = difference<3>(drawn.mesh->points[face.vertices[c]], zone.middle);
        set_corner(patch, c, Point<2>{dot(d, axes[0]), dot(d, axes[1])}, shown.pressure[drawn.fine[face.vertices[c]]]);
        inside = length<3>(d) < 1.5 * zone.radius;
      }
      if (inside) patches.push_back(patch);
    }
    return patches;
  });
  return panel;
}

Panel pressure_panel(const Shown<2>& shown, const ContactZone<2>& zone, std::vector<std::string>&) {
  Panel panel{"contact pressure along the contact zone", "contact pressure", View::curve, {}, {}, {}};
  const Point<2> tangent = tangents(zone.normal)[0];
  for (const Index v : shown.touched) {
    const Point<2> d = difference<2>(shown.hierarchy.finest().points[v], zone.middle);
    if (length<2>(d) < 1.5 * zone.radius) panel.curve.push_back({dot(d, tangent), shown.pressure[v]});
  }
  std::sort(panel.curve.begin(), panel.curve.end());
  return panel;
}

}  // namespace

template <int D>
std::vector<Panel> elastic_panels(const Shown<D>& shown, std::vector<std::string>& notes) {
  const auto zone = contact_zone(shown);
  std::vector<Panel> panels{body_panel(shown, zone, notes)};
  if (zone) panels.push_back(pressure_panel(shown, *zone, notes));
  return panels;
}

template std::vector<Panel> elastic_panels(const Shown<2>&, std::vector<std::string>&);
template std::vector<Panel> elastic_panels(const Shown<3>&, std::vector<std::string>&);

}  // namespace signorini
