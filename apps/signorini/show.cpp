#include "apps/signorini/show.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "apps/signorini/slice.hpp"
#include "core/fem/element.hpp"
#include "core/fem/fixes.hpp"

namespace signorini {
namespace {
constexpr std::size_t most_patches = 60000;  ///< what gnuplot draws in a second or two

/// A level of the hierarchy, and for each of its vertices that on the finest level.
template <int D>
struct Drawn {
  const Mesh<D>* mesh;
  std::vector<Index> fine;
};

template <int D>
Drawn<D> finest(const MeshHierarchy<D>& hierarchy) {
  Drawn<D> drawn{&hierarchy.finest(), std::vector<Index>(hierarchy.finest().points.size())};
  std::iota(drawn.fine.begin(), drawn.fine.end(), 0);
  return drawn;
}

/// One level down; false on the coarsest.
template <int D>
bool coarsen(const MeshHierarchy<D>& hierarchy, Drawn<D>& drawn) {
  const auto level = drawn.mesh - hierarchy.levels.data();
  if (level == 0) return false;
  const auto& parents = hierarchy.refinements[level - 1].parents;
  drawn.mesh = &hierarchy.levels[level - 1];
  std::vector<Index> fine(drawn.mesh->points.size());
  for (std::size_t v = 0; v < parents.size(); ++v)
    if (parents[v][0] == parents[v][1]) fine[parents[v][0]] = drawn.fine[v];
  drawn.fine = std::move(fine);
  return true;
}

/// The finest level on which `patches` are few enough to be drawn in a moment.
template <int D, class Patches>
std::vector<Patch> few_patches(const Shown<D>& shown, std::vector<std::string>& notes, Patches patches) {
  Drawn<D> drawn = finest(shown.hierarchy);
  std::vector<Patch> result = patches(drawn);
  while (result.size() > most_patches && coarsen(shown.hierarchy, drawn)) result = patches(drawn);
  if (result.size() <= most_patches) return result;
  notes.push_back(fmt::format("result.png was left out: {} triangles are too many to draw", result.size()));
  return {};
}

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

void set_corner(Patch& patch, int c, const Point<2>& x, double value) {
  patch.corner[c][0] = x[0];
  patch.corner[c][1] = x[1];
  patch.corner[c][2] = 0;
  patch.value[c] = value;
}

void set_corner(Patch& patch, int c, const Point<3>& x, double value) {
  std::copy(x.begin(), x.end(), patch.corner[c]);
  patch.value[c] = value;
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
  const double factor = exaggeration(shown);
  Panel panel;
  panel.title = factor == 1 ? "deformed body" : fmt::format("deformed body (displacements x {:g})", factor);
  panel.label = shown.label;
  panel.view = D == 2 ? View::flat : View::space;
  panel.patches = few_patches(shown, notes, [&](const Drawn<D>& drawn) {
    std::vector<Patch> patches;
    for (const auto& triangle : triangles(*drawn.mesh)) {
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
  panel.patches = few_patches(shown, notes, [&](const Drawn<3>& drawn) {
    std::vector<Patch> patches;
    for (const auto& face : drawn.mesh->boundary) {
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

std::vector<double> contact_indicator(const std::vector<Flags>& contact) {
  std::vector<double> result(contact.size());
  std::transform(contact.begin(), contact.end(), result.begin(), [](Flags flags) { return flags ? 1.0 : 0.0; });
  return result;
}

Panel scalar_panel(const Shown<2>& shown, const std::vector<double>& value, View view,
                   std::vector<std::string>& notes) {
  Panel panel;
  panel.view = view;
  panel.patches = few_patches(shown, notes, [&](const Drawn<2>& drawn) {
    std::vector<Patch> patches;
    for (const auto& element : drawn.mesh->elements) {
      Patch& patch = patches.emplace_back();
      for (int c = 0; c < 3; ++c) {
        set_corner(patch, c, drawn.mesh->points[element[c]], value[drawn.fine[element[c]]]);
        if (view == View::graph) patch.corner[c][2] = patch.value[c];
      }
    }
    return patches;
  });
  return panel;
}

/// A section through the middle; not exactly there, where vertices of regular meshes lie.
Panel scalar_panel(const Shown<3>& shown, const std::vector<double>& value, View, std::vector<std::string>& notes) {
  const auto& points = shown.hierarchy.finest().points;
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
  const double at = 0.4999 * (*low)[1] + 0.5001 * (*high)[1];
  Panel panel;
  panel.patches = few_patches(shown, notes, [&](const Drawn<3>& drawn) {
    std::vector<double> values;
    for (const Index v : drawn.fine) values.push_back(value[v]);
    return slice(*drawn.mesh, values, at);
  });
  return panel;
}

template <int D>
std::vector<Panel> scalar_panels(const Shown<D>& shown, std::vector<std::string>& notes) {
  std::vector<Panel> panels{scalar_panel(shown, shown.value, View::graph, notes)};
  panels[0].title = panels[0].label = shown.label;
  if (std::none_of(shown.contact.begin(), shown.contact.end(), [](Flags flags) { return flags != 0; })) return panels;
  panels.push_back(scalar_panel(shown, contact_indicator(shown.contact), View::flat, notes));
  panels[1].title = "coincidence set";
  panels[1].label = "1 in contact";
  return panels;
}

bool empty(const Panel& panel) { return panel.patches.empty() && panel.curve.empty(); }
}  // namespace

template <int D>
std::vector<Panel> result_panels(const Shown<D>& shown, std::vector<std::string>& notes) {
  std::vector<Panel> panels;
  if (shown.displacement.empty()) {
    panels = scalar_panels(shown, notes);
  } else {
    const auto zone = contact_zone(shown);
    panels.push_back(body_panel(shown, zone, notes));
    if (zone) panels.push_back(pressure_panel(shown, *zone, notes));
  }
  panels.erase(std::remove_if(panels.begin(), panels.end(), empty), panels.end());
  return panels;
}

template std::vector<Panel> result_panels(const Shown<2>&, std::vector<std::string>&);
template std::vector<Panel> result_panels(const Shown<3>&, std::vector<std::string>&);

}  // namespace signorini
