#include "core/geometry/cgal/filled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/dot.hpp"
#include "core/mesh/hinges.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::geometry {

namespace {

constexpr double off_domain = 1e-6;  // of the domain's own coordinates
constexpr double flat = 1e-9;        // of h^3

class Inspection {
 public:
  Inspection(const Mesh<3>& mesh, const Domain& domain) : mesh_(mesh), domain_(domain) {}

  Missed run(const std::vector<CreaseEdge>& creases) {
    look_at_elements();
    look_at_hinges();
    look_at_creases(creases);
    look_at_faces();
    look_at_volume();
    std::ranges::stable_sort(found_, std::greater(), &Found::off);
    Missed out;
    for (const Found& f : found_) out.places.push_back(f.place);
    if (!complaint_.empty() && !out.places.empty()) {
      const Point<3> at = domain_.units().given(out.places[0].at);
      complaint_ += fmt::format(" near [{:.6g}, {:.6g}, {:.6g}]", at[0], at[1], at[2]);
    }
    if (!complaint_.empty())
      complaint_ += "; expected a smaller size there, or a shape without gaps and angles so narrow";
    out.complaint = complaint_;
    return out;
  }

 private:
  struct Found {
    double off;
    Missed::Place place;
  };

  const Point<3>& point(Index v) const { return mesh_.points[v]; }
  Point<3> middle(Index a, Index b) const {
    return {(point(a)[0] + point(b)[0]) / 2, (point(a)[1] + point(b)[1]) / 2, (point(a)[2] + point(b)[2]) / 2};
  }
  double distance(Index a, Index b) const { return length<3>(difference<3>(point(a), point(b))); }

  void look_at_elements() {
    for (const Simplex<3>& element : mesh_.elements) {
      const auto p = corners<3>(mesh_.points, element);
      if (relative_volume<3>(p) > flat) continue;
      complaint_ = "an element is flat";
      Point<3> center{};
      double size = 0;
      for (const Point<3>& q : p) {
        for (int k = 0; k < 3; ++k) center[k] += q[k] / 4;
        size = std::max(size, length<3>(difference<3>(q, p[0])));
      }
      found_.push_back({0, {center, size}});
    }
  }

  void look_at_hinges() {
    const Hinges hinges = find_hinges(mesh_);
    if (hinges.vertices.empty() && hinges.edges.empty()) return;
    complaint_ = "parts of the mesh hang together by a vertex or an edge";
    for (const auto& [a, b] : hinges.edges) found_.push_back({infinity, {middle(a, b), distance(a, b)}});
    for (const Index v : hinges.vertices) {
      double size = 0;
      for (const Face<3>& face : mesh_.boundary)
        if (std::ranges::find(face.vertices, v) != face.vertices.end()) size = std::max(size, longest(face));
      found_.push_back({infinity, {point(v), size}});
    }
  }

  void look_at_creases(const std::vector<CreaseEdge>& creases) {
    std::set<std::array<Index, 2>> edges;
    for (const Face<3>& face : mesh_.boundary)
      for (int k = 0; k < 3; ++k) edges.insert(sorted(std::array{face.vertices[k], face.vertices[(k + 1) % 3]}));
    for (const CreaseEdge& crease : creases) {
      if (edges.contains(sorted(crease.ends))) continue;
      complaint_ = "the mesh leaves out a part of a sharp edge";
      found_.push_back({crease.length, {crease.middle, crease.length}});
    }
  }

  /// Of those that are off the surface, which explains a part of the volume.
  void look_at_faces() {
    for (const Face<3>& face : mesh_.boundary) {
      const auto& [a, b, c] = face.vertices;
      const Point<3> center{(point(a)[0] + point(b)[0] + point(c)[0]) / 3,
                            (point(a)[1] + point(b)[1] + point(c)[1]) / 3,
                            (point(a)[2] + point(b)[2] + point(c)[2]) / 3};
      double off = domain_.off_surface(center);
      for (const Point<3>& p : {middle(a, b), middle(b, c), middle(c, a)}) off = std::max(off, domain_.off_surface(p));
      if (off <= off_domain) continue;
      const double area = length<3>(cross(difference<3>(point(b), point(a)), difference<3>(point(c), point(a)))) / 2;
      explained_ += off * area;
      if (!domain_.flat()) continue;
      complaint_ = "the mesh cuts through the surface";
      found_.push_back({off, {center, longest(face)}});
    }
  }

  void look_at_volume() {
    double volume = 0;
    for (const Simplex<3>& element : mesh_.elements) volume += signed_volume<3>(corners<3>(mesh_.points, element));
    const double whole = domain_.volume(), off = volume - whole;
    if (std::abs(off) > explained_ + off_domain * whole && complaint_.empty())
      complaint_ = fmt::format("the volume of the mesh is off by {:.2g} %", 100 * off / whole);
  }

  double longest(const Face<3>& face) const {
    const auto& [a, b, c] = face.vertices;
    return std::max({distance(a, b), distance(b, c), distance(c, a)});
  }

  const Mesh<3>& mesh_;
  const Domain& domain_;
  std::vector<Found> found_;
  std::string complaint_;
  double explained_ = 0;
};

}  // namespace

Missed find_missed(const Mesh<3>& mesh, const Domain& domain, const std::vector<CreaseEdge>& creases) {
  return Inspection(mesh, domain).run(creases);
}

}  // namespace signorini::geometry
