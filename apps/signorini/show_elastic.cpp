#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "apps/signorini/drawn_level.hpp"
#include "apps/signorini/show.hpp"
#include "apps/signorini/slice.hpp"
#include "core/fem/conditions/directions.hpp"
#include "core/fem/conditions/walls.hpp"
#include "core/fem/elements/element.hpp"

namespace signorini {
namespace {

/// Cosine of the angle to the eye from which on a face shows nothing but its edge.
constexpr double seen_from_the_side = 0.1;

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
  double force = 0;            ///< about
  std::vector<char> counts{};  ///< per vertex: whether an obstacle may reach it
};

/// Of the vertices that some obstacles may reach.
template <int D>
std::optional<ContactZone<D>> contact_zone(const Shown<D>& shown, std::span<const Reached> reached) {
  const Mesh<D>& mesh = shown.hierarchy.finest();
  ContactZone<D> zone;
  double total = 0;
  zone.counts.assign(mesh.points.size(), 0);
  for (const auto& [v, obstacle] : reached) zone.counts[v] = 1;
  const auto pressed = [&](Index v) { return zone.counts[v] && !shown.pressure.empty() && shown.pressure[v] > 0; };
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
  zone.force = normalise(zone.normal);
  if (!(total > 0) || !(zone.force > 1e-3 * total)) return std::nullopt;
  for (double& x : zone.middle) x /= total;
  for (const auto& [v, obstacle] : reached)
    if (pressed(v)) zone.radius = std::max(zone.radius, length<D>(difference<D>(mesh.points[v], zone.middle)));
  zone.radius = std::max(zone.radius, 0.01 * extent(mesh));
  return zone;
}

/// The contact with one obstacle.
template <int D>
struct Contact {
  std::string name;  ///< of the obstacle; empty where it is the only one
  ContactZone<D> zone;
  std::span<const Reached> reached;
};

/// Of each obstacle that presses.
template <int D>
std::vector<Contact<D>> contacts_of(const Shown<D>& shown) {
  std::vector<Contact<D>> out;
  std::span<const Reached> rest = shown.reached;
  while (!rest.empty()) {
    const int obstacle = rest.front().obstacle;
    const auto end = std::ranges::find_if(rest, [&](const Reached& r) { return r.obstacle != obstacle; });
    const auto here = rest.first(static_cast<std::size_t>(end - rest.begin()));
    rest = rest.subspan(here.size());
    if (auto zone = contact_zone(shown, here))
      out.push_back({fmt::format("obstacle {}", obstacle), std::move(*zone), here});
  }
  if (out.size() == 1) out.front().name.clear();
  return out;
}

template <int D>
Panel body_panel(const Shown<D>& shown, const std::optional<ContactZone<D>>& zone, Warnings& notes) {
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

/// The vertex in contact that is nearest to the middle: that itself may lie between places that touch.
Point<3> nearest_to_middle(const Shown<3>& shown, const ContactZone<3>& zone) {
  Point<3> best = zone.middle;
  double least = infinity;
  for (std::size_t v = 0; v < zone.counts.size(); ++v) {
    if (!zone.counts[v] || !(shown.pressure[v] > 0)) continue;
    const Point<3>& x = shown.hierarchy.finest().points[v];
    if (const double away = length<3>(difference<3>(x, zone.middle)); away < least) least = away, best = x;
  }
  return best;
}

/// Bodies cut open through the contact zone, so that its normal lies in the section, as upright as may be.
Panel cut_panel(const Shown<3>& shown, const ContactZone<3>& zone, Warnings& notes) {
  Section section{nearest_to_middle(shown, zone), tangents(zone.normal)[0], zone.normal};
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

/// The faces around the contact zone that may touch, seen along its normal.
/// @param add called as add(corners, vertices of the finest mesh, patches)
template <class Add>
std::vector<Patch> zone_patches(const Shown<3>& shown, const ContactZone<3>& zone, Warnings& notes, const Add& add) {
  const auto axes = tangents(zone.normal);
  return few_patches(shown, notes, false, [&](const Drawn<3>& drawn) {
    std::vector<Patch> patches;
    for (const auto& face : drawn.mesh->boundary) {
      if (is_too_many(patches)) break;
      std::array<Point<2>, 3> corners;
      std::array<Index, 3> vertices;
      const Point<3> normal = area_normal(*drawn.mesh, face);
      bool inside = dot(normal, zone.normal) > seen_from_the_side * length<3>(normal);
      bool counts = false;
      for (int c = 0; c < 3 && inside; ++c) {
        const Point<3> d = difference<3>(drawn.mesh->points[face.vertices[c]], zone.middle);
        corners[c] = {dot(d, axes[0]), dot(d, axes[1])};
        vertices[c] = drawn.fine[face.vertices[c]];
        inside = length<3>(d) < 1.5 * zone.radius;
        counts = counts || zone.counts[vertices[c]];
      }
      if (inside && counts) add(corners, vertices, patches);
    }
    return patches;
  });
}

std::string with_name(const char* title, const std::string& name) {
  return name.empty() ? title : fmt::format("{}, {}", title, name);
}

Panel pressure_panel(const Shown<3>& shown, const Contact<3>& contact, Warnings& notes) {
  const ContactZone<3>& zone = contact.zone;
  Panel panel;
  panel.label = "contact pressure";
  panel.title = with_name("contact pressure", contact.name);
  panel.patches = zone_patches(shown, zone, notes, [&](const auto& corners, const auto& vertices, auto& patches) {
    Patch& patch = patches.emplace_back();
    for (int c = 0; c < 3; ++c) set_corner(patch, c, corners[c], shown.pressure[vertices[c]]);
  });
  return panel;
}

Point<2> middle(const Point<2>& a, const Point<2>& b) { return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; }

/// Where it slips and sticks: the third of a face next to a vertex has that one's colour.
Panel friction_panel(const Shown<3>& shown, const Contact<3>& contact, Warnings& notes) {
  const ContactZone<3>& zone = contact.zone;
  Panel panel;
  panel.title = with_name("slip and stick", contact.name);
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

/// The contact with one obstacle.
struct Profile {
  std::string name;  ///< of the obstacle; empty where it is the only one
  ContactZone<2> zone;
  std::vector<std::pair<double, Index>> places;  ///< ascending from the middle of the zone, and the vertices there
  Point<2> tangent() const { return tangents(zone.normal)[0]; }
};

Profile profile(const Shown<2>& shown, const ContactZone<2>& zone, std::span<const Reached> reached) {
  Profile out{{}, zone, {}};
  for (const auto& [v, obstacle] : reached) {
    const Point<2> d = difference<2>(shown.hierarchy.finest().points[v], zone.middle);
    if (length<2>(d) < 1.5 * zone.radius) out.places.emplace_back(dot(d, out.tangent()), v);
  }
  std::ranges::sort(out.places);
  return out;
}

std::vector<Profile> profiles(const Shown<2>& shown) {
  std::vector<Profile> out;
  for (const Contact<2>& contact : contacts_of(shown)) {
    out.push_back(profile(shown, contact.zone, contact.reached));
    out.back().name = contact.name;
  }
  return out;
}

/// What value(vertex) is along a contact.
template <class Value>
Line along(const Profile& profile, const Value& value) {
  Line line{{}, profile.name};
  for (const auto& [place, v] : profile.places) line.points.push_back({place, value(v)});
  return line;
}

/// A line for each contact: value(profile, vertex). They leave the styles 1 and 2 to marks of friction.
template <class Value>
Panel profile_panel(const std::vector<Profile>& profiles, const Value& value) {
  Panel panel;
  panel.across = "place along the contact, from its middle";
  panel.view = View::lines;
  for (const Profile& profile : profiles) {
    Line& line = panel.lines.emplace_back(along(profile, [&](Index v) { return value(profile, v); }));
    line.style = panel.lines.size() == 1 ? 0 : static_cast<int>(panel.lines.size()) + 1;
  }
  return panel;
}

Panel pressure_panel(const Shown<2>& shown, const std::vector<Profile>& profiles) {
  Panel panel = profile_panel(profiles, [&](const Profile&, Index v) { return shown.pressure[v]; });
  panel.title = "contact pressure along the contact zone";
  panel.label = "contact pressure";
  return panel;
}

/// The tangential traction, and where it slips and sticks.
Panel friction_panel(const Shown<2>& shown, const std::vector<Profile>& profiles) {
  const auto traction = [&](const Profile& profile, Index v) {
    const double* on_vertex = &shown.tangential[3 * std::size_t(v)];
    return dot(Point<2>{on_vertex[0], on_vertex[1]}, profile.tangent());
  };
  Panel panel = profile_panel(profiles, traction);
  panel.title = "slip and stick";
  panel.label = "tangential traction";
  for (Line& line : panel.lines) line.marked = false;
  const auto mark = [&](Flags state, const char* name) {
    Line marks{{}, name, false};
    marks.style = state - 1;
    for (const Profile& profile : profiles)
      for (const auto& [place, v] : profile.places)
        if (shown.contact[v] == state) marks.points.push_back({place, traction(profile, v)});
    panel.lines.push_back(std::move(marks));
  };
  mark(2, "slip");
  mark(3, "stick");
  return panel;
}

bool has_friction(const std::vector<Flags>& contact) {
  return std::any_of(contact.begin(), contact.end(), [](Flags state) { return state > 1; });
}

void add_contact(const Shown<2>& shown, const std::optional<ContactZone<2>>&, Warnings&, std::vector<Panel>& panels) {
  const std::vector<Profile> contacts = profiles(shown);
  if (contacts.empty()) return;
  panels.push_back(pressure_panel(shown, contacts));
  if (has_friction(shown.contact)) panels.push_back(friction_panel(shown, contacts));
}

/// Of several contacts the one that presses most.
void add_contact(const Shown<3>& shown, const std::optional<ContactZone<3>>&, Warnings& notes,
                 std::vector<Panel>& panels) {
  const std::vector<Contact<3>> contacts = contacts_of(shown);
  if (contacts.empty()) return;
  const Contact<3>& most = *std::ranges::max_element(contacts, {}, [](const auto& c) { return c.zone.force; });
  if (shown.two_bodies) panels.push_back(cut_panel(shown, most.zone, notes));
  panels.push_back(pressure_panel(shown, most, notes));
  if (has_friction(shown.contact)) panels.push_back(friction_panel(shown, most, notes));
}

}  // namespace

template <int D>
std::vector<Panel> elastic_panels(const Shown<D>& shown, Warnings& notes) {
  const auto zone = contact_zone(shown, std::span(shown.reached));
  std::vector<Panel> panels{body_panel(shown, zone, notes)};
  add_contact(shown, zone, notes, panels);
  return panels;
}

template std::vector<Panel> elastic_panels(const Shown<2>&, Warnings&);
template std::vector<Panel> elastic_panels(const Shown<3>&, Warnings&);

}  // namespace signorini
