#include "driver/scene/coarse_mesh.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/base/error.hpp"
#include "core/fem/elements/element.hpp"
#include "core/geometry/body_geometry.hpp"
#include "core/geometry/enclosed_volume.hpp"
#include "core/io/mesh_file.hpp"
#include "core/io/warning_kinds.hpp"
#include "core/mesh/join.hpp"
#include "core/mesh/meridian.hpp"
#include "core/mesh/mirror.hpp"
#include "core/mesh/separate.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/structured.hpp"
#include "driver/scene/halved_shape.hpp"
#include "driver/scene/materials.hpp"
#include "driver/scene/memory.hpp"
#include "driver/scene/mesh_warnings.hpp"
#include "driver/scene/numbers.hpp"

namespace signorini {
namespace {

[[noreturn]] void refuse_dimension(const Scene::Body& body, int found, int expected) {
  input_error(body.source.of("mesh"), fmt::format("a mesh with {} dimensions, expected {} as the other bodies have; "
                                                  "bodies of different dimensions need a scene each",
                                                  found, expected));
}

constexpr double noticeable_loss = 1e-3;  // of the volume: stresses are off by some times that

template <int D>
geometry::Size<D> target_size(const Scene::Body& body, const Progress& progress) {
  return [field = *body.size, &progress](const Point<D>& x) {
    progress.stop_if_interrupted();
    return field(site<D>(x, 1));
  };
}

Mesh<2> structured(const Scene::Block<2>& block) { return rectangle(block.from, block.to, block.cells); }
Mesh<3> structured(const Scene::Block<3>& block) { return box(block.from, block.to, block.cells); }

template <int D, class Shape>
constexpr bool is_free_shape =
    D == 2 ? std::is_constructible_v<geometry::Shape2, Shape> : std::is_constructible_v<geometry::Shape3, Shape>;

/// One overload per kind of shape; those of the other dimension are never reached.
template <int D>
struct Mesher {
  const Scene& scene;
  const Scene::Body& body;
  int block;
  Warnings* warnings;
  const Progress& progress;

  Mesh<D> operator()(const Scene::MeshFile& given) const {
    FileGroups groups;
    AnyMesh any = read_any_mesh(given.file, &groups);
    if (!std::holds_alternative<Mesh<D>>(any)) refuse_dimension(body, 5 - D, D);
    auto mesh = std::get<Mesh<D>>(std::move(any));
    refuse_lost_groups(scene, body, mesh, groups);
    mesh.region = regions(scene, body, mesh, groups);
    if (warnings)
      for (Warning& warning : mesh_warnings(mesh, groups, body.source.of("mesh")))
        warnings->push_back(std::move(warning));
    return mesh;
  }
  Mesh<D> operator()(const Scene::Block<D>& cells) const {
    check_memory(cells, block, body.source.of("cells"));
    return structured(cells);
  }
  template <class Shape>
  Mesh<D> operator()(const Shape& shape) const {
    if constexpr (is_free_shape<D, Shape>) {
      Mesh<D> mesh = free_mesh(shape);
      if constexpr (std::is_same_v<Shape, geometry::Solid>) compare_with_file(shape.file, mesh);
      separate_curved_faces(mesh);
      return mesh;
    }
    input_error(body.source.table, fmt::format("this shape has not {} dimensions", D));
  }

 private:
  /// Faces are flat between vertices on the surface.
  void compare_with_file(const std::string& file, const Mesh<D>& mesh) const {
    if (!warnings) return;
    double volume = 0;
    for (const Simplex<D>& element : mesh.elements) volume += signed_volume<D>(corners<D>(mesh.points, element));
    const double whole = geometry::enclosed_volume(read_surface(file)), off = volume - whole;
    if (!(std::abs(off) > noticeable_loss * whole)) return;
    warnings->push_back(
        warning<"chord-volume">(body.source.of("size"), 100 * std::abs(off) / whole, off < 0 ? "less" : "more"));
  }

  template <class Shape>
  Mesh<D> free_mesh(const Shape& shape) const {
    try {
      return geometry::engine<D>().mesh(shape, target_size<D>(body, progress));
    } catch (const geometry::ShapeError& error) {
      input_error(body.source.of(error.key()), error.complaint());
    }
  }
};
}  // namespace

int dimension_of(const Scene& scene) {
  if (scene.dimension != 0) return scene.dimension;
  std::optional<int> dimension;
  for (const Scene::Body& body : scene.bodies) {
    const int found = mesh_dimension(std::get<Scene::MeshFile>(body.shape).file);
    if (dimension && found != *dimension) refuse_dimension(body, found, *dimension);
    dimension = found;
  }
  check_dimension(scene, *dimension);
  return *dimension;
}

template <int D>
Mesh<D> mesh_of(const Scene& scene, const Scene::Body& given, int block, Warnings* warnings, const Progress& progress) {
  Mesh<D> mesh = std::visit(Mesher<D>{scene, given, block, warnings, progress}, halved_shape(scene, given));
  for (const Mirror& mirror : scene.symmetry.planes)
    add_mirror(mesh, mirror, scene.symmetry.source.of(axis_name(mirror.axis)));
  remove_faces_on_mirrors(mesh);
  std::vector<Mirror> beyond = mesh.mirrors;
  if constexpr (D == 2)
    if (given.plane == Plane::axisymmetric) {
      read_as_meridian(mesh, given.source.of("plane"));
      beyond.push_back({.axis = 0, .at = 0});
    }
  if (const auto* file = std::get_if<Scene::MeshFile>(&given.shape))
    geometry::give_geometry(mesh, file->reading.surfaces, file->reading.crease, beyond);
  return mesh;
}

template <int D>
Mesh<D> coarsest_mesh(const Scene& scene, std::size_t body, int block, Warnings* warnings, const Progress& progress) {
  const Scene::Body& given = scene.bodies[body];
  if (given.parts.empty()) return mesh_of<D>(scene, given, block, warnings, progress);
  std::vector<Mesh<D>> meshes;
  std::vector<std::string> names;
  std::vector<int> materials;
  for (const Scene::Body& part : given.parts) {
    meshes.push_back(mesh_of<D>(scene, part, block, warnings, progress));
    names.push_back(part.name);
    materials.push_back(static_cast<int>(numbers_of(scene.materials, part).size()));
  }
  return join(std::move(meshes), names, materials);
}

template Mesh<2> coarsest_mesh(const Scene&, std::size_t, int, Warnings*, const Progress&);
template Mesh<3> coarsest_mesh(const Scene&, std::size_t, int, Warnings*, const Progress&);

}  // namespace signorini
