#pragma once
#include <fmt/format.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "core/base/error.hpp"
#include "core/mesh/mesh.hpp"
#include "core/sdk/settings.hpp"

/// Meshing and closest-point queries by CGAL, in shared libraries of their own (signorini_plane for two dimensions,
/// signorini_geometry for three; GPL) that are loaded only when a scene needs them. Nothing else includes CGAL.
namespace signorini::geometry {

/// Target edge length at a point.
template <int D>
using Size = std::function<double(const Point<D>&)>;

struct Disk {
  Point<2> center;
  double radius;
  bool lower_half = false;
  bool right_half = false;  ///< its straight side there has no name
  bool upper_half = false;  ///< likewise; not beside lower_half
};
struct Polygon {
  std::vector<Point<2>> points;
  std::vector<int> edges = {};  ///< the number in the name of each edge, -1: it has none; empty: their places
};
/// Per axis, whether only the part with the larger coordinates is there, cut at the centre. Faces there have no name.
using Halved = std::array<bool, 3>;
struct Ball {
  Point<3> center;
  double radius;
  bool lower_half = false;
  Halved halved = {};  ///< along z not beside lower_half
};
struct Cylinder {
  Point<3> center;
  double radius, height;
  Halved halved = {};
};
struct Solid {
  std::string file;
};  ///< a closed triangle surface: OFF, OBJ, STL or PLY

using Shape2 = std::variant<Disk, Polygon>;
using Shape3 = std::variant<Ball, Cylinder, Solid>;

/// What is wrong with a shape: Error(Exit::input, "SHAPE: KEY: COMPLAINT").
class ShapeError : public Error {
 public:
  /// @param key of the shape as scenes name it, or "size"; "" for the shape as a whole
  ShapeError(const std::string& shape, const std::string& key, const std::string& complaint)
      : Error(Exit::input, fmt::format("{}: {}{}{}", shape, key, key.empty() ? "" : ": ", complaint)),
        key_(key),
        complaint_(complaint) {}
  const std::string& key() const { return key_; }
  const std::string& complaint() const { return complaint_; }

 private:
  std::string key_, complaint_;
};

template <int D>
class Engine;

template <>
class Engine<2> {
 public:
  virtual ~Engine() = default;
  /// As of three dimensions.
  virtual Mesh<2> mesh(const Shape2& shape, const Size<2>& size) const = 0;
};

template <>
class Engine<3> {
 public:
  virtual ~Engine() = default;
  /// Meshes with the parts and curves that the shape promises; the boundary vertices of curved shapes lie on the true
  /// surface. Meshes depend neither on units nor on the place: those of the same shape in other units are scaled, up to
  /// rounding, and sizes count to six digits. What is wrong is a ShapeError: unreadable file, surface not closed,
  /// self-intersecting polygon, bad size, details that would take very many elements.
  virtual Mesh<3> mesh(const Shape3& shape, const Size<3>& size) const = 0;
  /// Distance to a triangle surface file: negative inside a closed one. The normal of an open surface is oriented by
  /// its faces.
  /// @param crease the distance is that to the smooth surface through the vertices, see smooth_boundary(); without, to
  ///   the triangles
  virtual std::unique_ptr<DistanceFunction> surface(const std::string& file,
                                                    std::optional<double> crease = {}) const = 0;
};

/// The CGAL engine, loading its library on first use. Throws Error(Exit::plugin) when the library is missing.
template <int D>
const Engine<D>& engine();

}  // namespace signorini::geometry
