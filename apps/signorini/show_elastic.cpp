#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "apps/signorini/drawn_level.hpp"
#include "apps/signorini/show.hpp"
#include "apps/signorini/slice.hpp"
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
  std::vector<char> touched(mesh.points.size());
  for (const Index v : shown.touched) touched[v] = 1;
  const auto pressed = [&](Index v) { return touched[v] && !shown.pressure.empty() && shown.pressure[v] > 0; };
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

/// Bodies cut open through the middle of the contact zone, so that its normal lies in the section, as upright as may
/// be.
Panel cut_panel(const Shown<3>& shown, const ContactZone<3>& zone, std::vector<std::string>& notes) {
  Section section{zone.middle, tangents(zone.normal)[0], zone.normal};
  const auto widest = std::ranges::max_element(section.up, {}, [](double c) { return std::abs(c); });
  if (*widest < 0)
    for (double& c : section.up) c = -c;
  Panel panel;
  panel.title = "deformed bodies, cut open";
  panel.label = shown.label;
  panel.patches = few_patches(shown, notes, false, [&](const Drawn<3>& drawn) {
    std::vector<Point<3>> points;
    std::vector<double> value;
    for (std::size_t v = 0; v < drawn.fine.size(); ++v) {
      points.push_back(deformed(shown, drawn, static_cast<Index>(v), 1));
      value.push_back(shown.value[drawn.fine[v]]);
    }
    return slice(drawn.mesh->elements, points, value, section);
  });
  return panel;
}

/// The faces around the contact zone, seen along its normal.
/// @param add called as add(corners, vertices of the finest mesh, patches)
template <class Add>
std::vector<Patch> zone_patches(const Shown<3>& shown, const ContactZone<3>& zone, std::vector<std::string>& notes,
                                const Add& add) {
  const auto axes = tangents(zone.normal);
  return few_patches(shown, notes, false, [&](const Drawn<3>& drawn) {
    std::vector<Patch> patches;
    for (const auto& face : drawn.mesh->boundary) {
      if (is_too_many(patches)) break;
      std::array<Point<2>, 3> corners;
      std::array<Index, 3> vertices;
      bool inside = dot(area_normal(*drawn.mesh, face), zone.normal) > 0;
      for (int c = 0; c < 3 && inside; ++c) {
        const Point<3> d = difference<3>(drawn.mesh->points[face.vertices[c]], zone.middle);
        corners[c] = {dot(d, axes[0]), dot(d, axes[1])};
        vertices[c] = drawn.fine[face.vertices[c]];
        inside = length<3>(d) < 1.5 * zone.radius;
      }
      if (inside) add(corners, vertices, patches);
    }
    return patches;
  });
}

Panel pressure_panel(const Shown<3>& shown, const ContactZone<3>& zone, std::vector<std::string>& notes) {
  Panel panel;
  panel.title = panel.label = "contact pressure";
  panel.patches = zone_patches(shown, zone, notes, [&](const auto& corners, const auto& vertices, auto& patches) {
    Patch& patch = patches.emplace_back();
    for (int c = 0; c < 3; ++c) set_corner(patch, c, corners[c], shown.pressure[vertices[c]]);
  });
  return panel;
}

Point<2> middle(const Point<2>& a, const Point<2>& b) { return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; }

/// Where it slips and sticks: the third of a face next to a vertex has that one's colour.
Panel friction_panel(const Shown<3>& shown, const ContactZone<3>& zone, std::vector<std::string>& notes) {
  Panel panel;
  panel.title = "slip and stick";
  panel.words = {"open", "no friction", "slip", "stick"};
  panel.patches = zone_patches(shown, zone, notes, [&](const auto& corners, const auto& vertices, auto& patches) {
    const Point<2> centre{(corners[0][0] + corners[1][0] + corners[2][0]) / 3,
                          (corners[0][1] + corners[1][1] + corners[2][1]) / 3};
    for (int c = 0; c < 3; ++c)
      for (const int other : {(c + 1) % 3, (c + 2) % 3}) {
        Patch& patch = patches.emplace_back();
        const double value = shown.contact[vertices[c]];
        set_corner(patch, 0, corners[c], value);
        set_corner(patch, 1, middle(corners[c], corners[other]), value);
        set_corner(patch, 2, centre, value);
      }
  });
  return panel;
}

/// What value(vertex) is along the contact zone, by ascending place.
template <class Value>
Line along_zone(const Shown<2>& shown, const ContactZone<2>& zone, const Value& value) {
  const Point<2> tangent = tangents(zone.normal)[0];
  Line line;
  for (const Index v : shown.touched) {
    const Point<2> d = difference<2>(shown.hierarchy.finest().points[v], zone.middle);
    if (length<2>(d) < 1.5 * zone.radius) line.points.push_back({dot(d, tangent), value(v)});
  }
  std::sort(line.points.begin(), line.points.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
  return line;
}

Panel pressure_panel(const Shown<2>& shown, const ContactZone<2>& zone, std::vector<std::string>&) {
  Panel panel;
  panel.title = "contact pressure along the contact zone";
  panel.label = "contact pressure";
  panel.view = View::lines;
  panel.lines = {along_zone(shown, zone, [&](Index v) { return shown.pressure[v]; })};
  return panel;
}

/// The tangential traction, and where it slips and sticks.
Panel friction_panel(const Shown<2>& shown, const ContactZone<2>& zone, std::vector<std::string>&) {
  const Point<2> tangent = tangents(zone.normal)[0];
  const auto traction = [&](Index v) {
    return shown.tangential[3 * std::size_t(v)] * tangent[0] + shown.tangential[3 * std::size_t(v) + 1] * tangent[1];
  };
  const auto where = [&](Flags state, const char* name) {
    constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
    Line marks = along_zone(shown, zone, [&](Index v) { return shown.contact[v] == state ? traction(v) : nowhere; });
    marks.name = name;
    marks.joined = false;
    return marks;
  };
  Panel panel;
  panel.title = "slip and stick";
  panel.label = "tangential traction";
  panel.view = View::lines;
  panel.lines = {along_zone(shown, zone, traction), where(2, "slip"), where(3, "stick")};
  return panel;
}

bool has_friction(const std::vector<Flags>& contact) {
  return std::any_of(contact.begin(), contact.end(), [](Flags state) { return state > 1; });
}

}  // namespace

template <int D>
std::vector<Panel> elastic_panels(const Shown<D>& shown, std::vector<std::string>& notes) {
  const auto zone = contact_zone(shown);
  std::vector<Panel> panels{body_panel(shown, zone, notes)};
  if (!zone) return panels;
  if constexpr (D == 3)
    if (shown.two_bodies) panels.push_back(cut_panel(shown, *zone, notes));
  panels.push_back(pressure_panel(shown, *zone, notes));
  if (has_friction(shown.contact)) panels.push_back(friction_panel(shown, *zone, notes));
  return panels;
}

template std::vector<Panel> elastic_panels(const Shown<2>&, std::vector<std::string>&);
template std::vector<Panel> elastic_panels(const Shown<3>&, std::vector<std::string>&);

}  // namespace signorini
