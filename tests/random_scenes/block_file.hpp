#pragma once
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

#include "core/mesh/simplex.hpp"
#include "core/mesh/structured.hpp"
#include "tests/core/io/msh_samples.hpp"
#include "tests/core/io/vtu_samples.hpp"
#include "view.hpp"

namespace signorini::test {

/// A block by its cells, with the parts that shapes have: left, right, (front, back,) bottom, top.
template <int D>
struct Block {
  Point<D> from{}, to{};
  std::array<Index, D> cells{};
};

template <int D>
const std::vector<std::string>& block_parts() {
  static const std::vector<std::string> names =
      D == 2 ? std::vector<std::string>{"left", "right", "bottom", "top"}
             : std::vector<std::string>{"left", "right", "front", "back", "bottom", "top"};
  return names;
}

/// What a block is written as: the same mesh as a shape and in files of other programs; its surface, to be filled.
enum class Form { shape, msh1, msh2, msh4, binary_msh, second_order, vtu, binary_vtu, off, obj, ply, stl };

constexpr Form mesh_forms[] = {Form::msh2,         Form::msh1, Form::msh4,      Form::binary_msh,
                               Form::second_order, Form::vtu,  Form::binary_vtu};
constexpr Form surface_forms[] = {Form::off, Form::obj, Form::ply, Form::stl};

inline bool is_surface(Form form) { return form >= Form::off; }
/// Its parts go by their numbers.
inline bool is_nameless(Form form) { return form == Form::msh1 || form == Form::vtu || form == Form::binary_vtu; }

inline const char* extension(Form form) {
  switch (form) {
    case Form::vtu:
    case Form::binary_vtu:
      return "vtu";
    case Form::off:
      return "off";
    case Form::obj:
      return "obj";
    case Form::ply:
      return "ply";
    case Form::stl:
      return "stl";
    default:
      return "msh";
  }
}

template <int D>
Mesh<D> mesh_of(const Block<D>& block, const View<D>& view) {
  Mesh<D> out;
  if constexpr (D == 2)
    out = rectangle(block.from, block.to, block.cells);
  else
    out = box(block.from, block.to, block.cells);
  for (Point<D>& x : out.points) x = view.place(x);
  return out;
}

/// Each part in a group of its number, and the body in the next one.
template <int D>
Sample sample_by_number(const Mesh<D>& mesh) {
  Sample out;
  for (const Point<D>& x : mesh.points) out.points.push_back({x[0], x[1], D == 3 ? x[D - 1] : 0});
  int tag = 0;
  const auto add = [&](int dimension, const std::string& name) -> SampleBlock& {
    out.names[{dimension, ++tag}] = name;
    return out.blocks.emplace_back(SampleBlock{dimension, tag, {tag}, {}});
  };
  for (const auto& part : mesh.parts) {
    SampleBlock& block = add(D - 1, part.name);
    for (const Index f : part.faces)
      block.cells.emplace_back(mesh.boundary[f].vertices.begin(), mesh.boundary[f].vertices.end());
  }
  SampleBlock& body = add(D, "all");
  for (const auto& element : mesh.elements) body.cells.emplace_back(element.begin(), element.end());
  return out;
}

/// The boundary as triangles.
inline std::string surface_text(const Mesh<3>& mesh, Form form) {
  const auto n = mesh.points.size(), faces = mesh.boundary.size();
  std::string points, triangles, stl = "solid block\n";
  for (const Point<3>& x : mesh.points)
    points += fmt::format("{}{:.17g}\n", form == Form::obj ? "v " : "", fmt::join(x, " "));
  for (const auto& face : mesh.boundary) {
    auto v = face.vertices;
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const Index p : v) stl += fmt::format("vertex {:.17g}\n", fmt::join(mesh.points[p], " "));
    stl += "endloop\nendfacet\n";
    for (Index& p : v) p += form == Form::obj;
    triangles += fmt::format("{} {}\n", form == Form::obj ? "f" : "3", fmt::join(v, " "));
  }
  switch (form) {
    case Form::stl:
      return stl + "endsolid block\n";
    case Form::off:
      return fmt::format("OFF\n{} {} 0\n", n, faces) + points + triangles;
    case Form::obj:
      return points + triangles;
    default:
      return fmt::format(
                 "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                 "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                 n, faces) +
             points + triangles;
  }
}

inline std::string mesh_text(const Sample& sample, Form form) {
  const auto middle = [](const Point<3>& a, const Point<3>& b) { return signorini::midpoint<3>(a, b); };
  switch (form) {
    case Form::msh1:
      return MshWriter(sample, {1}).write();
    case Form::msh4:
      return MshWriter(sample, {4.1}).write();
    case Form::binary_msh:
      return MshWriter(sample, {4.1, true}).write();
    case Form::second_order:
      return MshWriter(second_order(sample, middle, false), {2.2}).write();
    case Form::vtu:
      return VtuWriter(sample, {}).write();
    case Form::binary_vtu:
      return VtuWriter(sample, {VtuData::raw, true}).write();
    default:
      return MshWriter(sample, {2.2}).write();
  }
}

/// Writes it, but for shapes.
template <int D>
std::filesystem::path write_block(const std::filesystem::path& folder, const std::string& name, const Block<D>& block,
                                  Form form, const View<D>& view) {
  const std::filesystem::path file = folder / fmt::format("{}.{}", name, extension(form));
  const Mesh<D> mesh = mesh_of(block, view);
  std::ofstream out(file, std::ios::binary);
  if constexpr (D == 3)
    if (is_surface(form)) return out << surface_text(mesh, form), file;
  out << mesh_text(sample_by_number(mesh), form);
  return file;
}

}  // namespace signorini::test
