#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/read_tables.hpp"
#include "core/scene/table_reader.hpp"

namespace signorini {
namespace {

constexpr double most_cells = 2e8;  // six tetrahedra each must be numbered by Index

template <class Value, std::size_t D>
std::array<Value, D> exactly(const std::vector<Value>& list, const std::string& place, std::string_view what) {
  if (list.size() != D) input_error(place, fmt::format("expected {} {}, found {}", D, what, list.size()));
  std::array<Value, D> fixed{};
  std::copy(list.begin(), list.end(), fixed.begin());
  return fixed;
}

template <int D>
Point<D> coordinates(const TableReader& reader, std::string_view key) {
  return exactly<double, D>(reader.point(key), reader.origin(key), "coordinates");
}

template <int D>
Scene::Block<D> block(const TableReader& reader) {
  const Scene::Block<D> block{coordinates<D>(reader, "from"), coordinates<D>(reader, "to"),
                              exactly<Index, D>(reader.integers("cells"), reader.origin("cells"), "numbers of cells")};
  double cells = 1;
  for (int k = 0; k < D; ++k) {
    cells *= block.cells[k];
    if (!(block.from[k] < block.to[k]))
      input_error(reader.origin("to"), fmt::format("'to' must be larger than 'from' in every coordinate; {} <= {}",
                                                   block.to[k], block.from[k]));
  }
  if (cells > most_cells)
    input_error(reader.origin("cells"), fmt::format("{:.3g} cells, at most {:.3g} can be numbered", cells, most_cells));
  return block;
}

geometry::Polygon polygon(const TableReader& reader) {
  geometry::Polygon polygon;
  for (const std::vector<double>& corner : reader.points("points"))
    polygon.points.push_back(exactly<double, 2>(corner, reader.origin("points"), "coordinates per point"));
  if (polygon.points.size() < 3)
    input_error(reader.origin("points"), fmt::format("expected at least 3 points, found {}", polygon.points.size()));
  return polygon;
}

Scene::BodyShape shape(const TableReader& reader, std::string_view name) {
  if (name == "rectangle") return block<2>(reader);
  if (name == "box") return block<3>(reader);
  if (name == "disk" || name == "half_disk")
    return geometry::Disk{coordinates<2>(reader, "center"), reader.number("radius"), name == "half_disk"};
  if (name == "ball" || name == "half_ball")
    return geometry::Ball{coordinates<3>(reader, "center"), reader.number("radius"), name == "half_ball"};
  if (name == "cylinder")
    return geometry::Cylinder{coordinates<3>(reader, "center"), reader.number("radius"), reader.number("height")};
  if (name == "solid") return geometry::Solid{reader.file("file").string()};
  return polygon(reader);
}

Plane plane(const std::string& name) {
  if (name == "axisymmetric") return Plane::axisymmetric;
  return name == "strain" ? Plane::strain : Plane::stress;
}

// Of a disk around the axis the half that turns around it is meshed.
void cut_at_axis(Scene::Body& body) {
  auto* disk = std::get_if<geometry::Disk>(&body.shape);
  if (disk && body.plane == Plane::axisymmetric) disk->right_half = disk->center[0] == 0;
}

Scene::Orthotropic orthotropic(const TableReader& reader) {
  const std::string& place = reader.origin("orthotropic");
  for (const char* key : {"young", "poisson"}) reader.forbid(key, "beside 'orthotropic'");
  Scene::Orthotropic out{
      exactly<double, 9>(reader.point("orthotropic"), place, "numbers (E1, E2, E3, nu12, nu13, nu23, G12, G13, G23)"),
      {},
      {},
      {}};
  if (const std::string wrong = complaint(out.constants); !wrong.empty()) input_error(place, wrong);
  if (reader.given("material_center"))
    for (const char* key : {"material_axes"}) reader.forbid(key, "beside 'material_center'");
  else
    reader.forbid("material_axis", "without 'material_center'");
  if (reader.given("material_axes")) out.axes = reader.points("material_axes");
  if (reader.given("material_center")) out.center = reader.point("material_center");
  if (reader.given("material_axis")) out.axis = reader.point("material_axis");
  return out;
}

void read_own_material(const TableReader& reader, Scene::Body& body) {
  const std::string where = fmt::format("for equation = '{}'", reader.text("equation"));
  if (body.equation == Scene::Equation::diffusion) {
    for (const char* key : {"young", "poisson", "expansion", "temperature", "orthotropic", "material_axes",
                            "material_center", "material_axis"})
      reader.forbid(key, where);
    if (body.plane != Plane::axisymmetric) reader.forbid("plane", where + ", unless it is 'axisymmetric'");
    body.diffusion = reader.field("diffusion");
    return;
  }
  reader.forbid("diffusion", where);
  if (reader.given("orthotropic")) {
    body.orthotropic = orthotropic(reader);
    body.young = mean_constants(body.orthotropic->constants).young;
  } else {
    for (const char* key : {"material_axes", "material_center", "material_axis"})
      reader.forbid(key, "without 'orthotropic'");
    for (const char* key : {"young", "poisson"}) reader.require(key, where + ", or 'orthotropic'");
    body.young = reader.field("young");
    body.poisson = reader.field("poisson");
  }
  if (reader.given("temperature")) reader.require("expansion", "by 'temperature'");
  if (reader.given("expansion")) body.expansion = reader.field("expansion");
  body.temperature = reader.field("temperature");
}

// What is left to "auto" is decided when all materials are known.
void read_pressure(const TableReader& reader, Scene::Body& body) {
  if (body.equation == Scene::Equation::diffusion) reader.forbid("pressure", "for equation = 'diffusion'");
  const std::string kind = reader.text("pressure");
  if (kind == "none") body.pressure = Pressure::none;
  if (kind != "linear" && kind != "constant") return;
  const std::string& origin = reader.origin("pressure");
  if (reader.given("orthotropic"))
    input_error(origin, fmt::format("'{}' is for isotropic bodies, this one is orthotropic", kind));
  if (body.plane == Plane::stress)
    input_error(origin, fmt::format("'{}' is for plane strain and 3D: in plane stress elements do not lock", kind));
  if (body.order == 1)
    input_error(
        origin,
        fmt::format("'{}' is for quadratic elements, and the body has order = 1; expected order = 2 or \"auto\"",
                    kind));
  body.order = 2;
  body.pressure = kind == "linear" ? Pressure::linear : Pressure::constant;
}

geometry::Surfaces surfaces(const std::string& name) {
  using enum geometry::Surfaces;
  if (name == "smooth") return smooth;
  if (name == "fit") return fit;
  return name == "facets" ? facets : automatic;
}

Scene::MeshFile mesh_file(const TableReader& reader) {
  return {reader.file("mesh"), {surfaces(reader.text("geometry")), reader.number("crease") * std::numbers::pi / 180}};
}

// The target edge length belongs to the shapes that a mesh generator fills.
void read_size(const TableReader& reader, Scene::Body& body) {
  const bool structured =
      std::holds_alternative<Scene::Block<2>>(body.shape) || std::holds_alternative<Scene::Block<3>>(body.shape);
  if (structured) reader.forbid("size", "beside 'cells'");
  if (reader.given("mesh")) reader.forbid("size", "beside 'mesh'");
  if (structured || reader.given("mesh")) return;
  reader.require("size", "by this shape: target edge length of the coarsest mesh");
  body.size = reader.field("size");
}

}  // namespace

Scene::Body read_body(const RawTable& table, const std::filesystem::path& folder) {
  TableReader reader(table, find_table("body")->keys, folder);
  if (reader.given("shape") == reader.given("mesh"))
    input_error(reader.origin(), reader.given("mesh") ? "both 'shape' and 'mesh' are given, expected one of them"
                                                      : "neither 'shape' nor 'mesh' is given, expected one of them");
  Scene::Body body;
  reader.know_shapes(body_shapes());
  const ShapeSpec* spec = reader.given("shape") ? &reader.use_shape(body_shapes()) : nullptr;
  reader.check_keys();
  body.source = reader.source();
  body.name = reader.text("name");
  if (body.name.empty()) input_error(reader.origin("name"), "the name is empty");
  body.shape = spec ? shape(reader, spec->name) : mesh_file(reader);
  for (const char* key : {"geometry", "crease"})
    if (spec) reader.forbid(key, "beside 'shape': the program knows what it meshes");
  body.equation = reader.text("equation") == "diffusion" ? Scene::Equation::diffusion : Scene::Equation::elasticity;
  if (const std::string order = reader.choice("order"); order != "auto") body.order = order == "1" ? 1 : 2;
  body.plane = plane(reader.text("plane"));
  cut_at_axis(body);
  read_pressure(reader, body);
  read_own_material(reader, body);
  read_size(reader, body);
  return body;
}

int dimension_of(const Scene::Body& body) {
  struct Dimension {
    int operator()(const Scene::MeshFile&) const { return 0; }
    int operator()(const Scene::Block<2>&) const { return 2; }
    int operator()(const geometry::Disk&) const { return 2; }
    int operator()(const geometry::Polygon&) const { return 2; }
    int operator()(const Scene::Block<3>&) const { return 3; }
    int operator()(const geometry::Ball&) const { return 3; }
    int operator()(const geometry::Cylinder&) const { return 3; }
    int operator()(const geometry::Solid&) const { return 3; }
  };
  return std::visit(Dimension{}, body.shape);
}

}  // namespace signorini
