#include "core/io/vtu_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <span>

#include "core/base/error.hpp"
#include "core/io/mesh_file_data.hpp"
#include "core/io/vtu_array.hpp"

namespace signorini {
namespace {

constexpr const char* group_arrays[] = {"gmsh:physical", "CellEntityIds", "physical", "medit:ref", "PhysicalIds"};

std::string type_name(Offset type) {
  static const std::map<Offset, const char*> names{{2, "poly-vertex"},
                                                   {4, "poly-line"},
                                                   {6, "triangle strip"},
                                                   {7, "polygon"},
                                                   {8, "pixel"},
                                                   {9, "quadrilateral"},
                                                   {11, "voxel"},
                                                   {12, "hexahedron"},
                                                   {13, "wedge"},
                                                   {14, "pyramid"},
                                                   {23, "quadratic quadrilateral"},
                                                   {25, "quadratic hexahedron"},
                                                   {42, "polyhedron"},
                                                   {68, "Lagrange curve"},
                                                   {69, "Lagrange triangle"},
                                                   {71, "Lagrange tetrahedron"}};
  const auto name = names.find(type);
  return name == names.end() ? fmt::format("type {}", type) : fmt::format("{} (type {})", name->second, type);
}

class VtuReader {
 public:
  VtuReader(std::string_view content, std::string_view place) {
    format_.content = content;
    format_.place = place;
    load();
    read_format();
  }

  AnyMesh read(FileGroups* groups) {
    const pugi::xml_node piece = only_piece();
    read_points(piece);
    read_cells(piece);
    return make_mesh(
        std::move(data_), [this](int, Index group) { return names(group); }, format_.place, groups);
  }

 private:
  /// Appended raw data is no XML: the document is what comes before it.
  void load() {
    const std::string_view all = format_.content;
    const std::size_t start = all.find("<AppendedData");
    std::string head;
    std::string_view xml = all;
    if (start != std::string_view::npos) {
      const std::size_t bracket = all.find('>', start), mark = all.find('_', bracket);
      const std::size_t end = all.rfind("</AppendedData>");
      if (mark == std::string_view::npos || end == std::string_view::npos || end < mark ||
          all.find("</VTKFile>", end) == std::string_view::npos)
        input_error(format_.place, "the appended data has no end; is the file truncated?");
      format_.appended = all.substr(mark + 1, end - mark - 1);
      head = fmt::format("{}</AppendedData></VTKFile>", all.substr(0, bracket + 1));
      xml = head;
    }
    const pugi::xml_parse_result result = document_.load_buffer(xml.data(), xml.size());
    if (!result) {
      const auto line = 1 + std::count(xml.begin(), xml.begin() + std::min<Offset>(result.offset, xml.size()), '\n');
      input_error(fmt::format("{}:{}", format_.place, line),
                  fmt::format("not well-formed XML: {}", result.description()));
    }
  }

  void read_format() {
    const pugi::xml_node root = document_.child("VTKFile");
    if (!root) input_error(format_.place, "expected a VTKFile element, found other XML");
    const std::string_view kind = root.attribute("type").as_string();
    if (kind != "UnstructuredGrid")
      format_.fail(root, fmt::format("found a VTK file of type '{}', expected UnstructuredGrid", kind));
    const auto choose = [&](const char* name, const char* fallback, std::initializer_list<std::string_view> choices) {
      const std::string_view value = root.attribute(name).as_string(fallback);
      for (std::size_t i = 0; i < choices.size(); ++i)
        if (choices.begin()[i] == value) return i;
      format_.fail(root, fmt::format("{} '{}' is not read, expected {}{}", name, value, choices.begin()[0],
                                     choices.size() > 1 ? fmt::format(" or {}", choices.begin()[1]) : ""));
    };
    const bool big = choose("byte_order", "LittleEndian", {"LittleEndian", "BigEndian"}) == 1;
    format_.swapped = big != (std::endian::native == std::endian::big);
    format_.header_bytes = choose("header_type", "UInt32", {"UInt32", "UInt64"}) == 1 ? 8 : 4;
    format_.compressed = root.attribute("compressor").as_string()[0] != '\0';
    if (format_.compressed) choose("compressor", "", {"vtkZLibDataCompressor"});
    if (const pugi::xml_node appended = root.child("AppendedData")) {
      const std::string_view encoding = appended.attribute("encoding").as_string("base64");
      if (encoding != "raw" && encoding != "base64")
        format_.fail(appended, fmt::format("found encoding '{}', expected raw or base64", encoding));
      format_.appended_base64 = encoding == "base64";
    }
  }

  pugi::xml_node only_piece() const {
    const pugi::xml_node grid = document_.child("VTKFile").child("UnstructuredGrid");
    if (!grid) format_.fail(document_.child("VTKFile"), "expected an UnstructuredGrid element");
    pugi::xml_node found;
    for (const pugi::xml_node piece : grid.children("Piece")) {
      if (integer_attribute(piece, "NumberOfCells", -1, format_) == 0) continue;
      if (found) format_.fail(piece, "second piece: only meshes of one piece are read");
      found = piece;
    }
    if (!found) format_.fail(grid, "the grid has no cells");
    return found;
  }

  pugi::xml_node array(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node found = parent.find_child_by_attribute("DataArray", "Name", name);
    if (!found) format_.fail(parent, fmt::format("expected an array '{}' in {}", name, parent.name()));
    return found;
  }

  void read_points(const pugi::xml_node& piece) {
    const pugi::xml_node node = piece.child("Points").child("DataArray");
    if (!node) format_.fail(piece, "expected an array in Points");
    const Offset n = integer_attribute(piece, "NumberOfPoints", -1, format_);
    if (n > std::numeric_limits<Index>::max())
      format_.fail(piece, fmt::format("{} points are more than can be numbered", n));
    if (integer_attribute(node, "NumberOfComponents", 1, format_) != 3)
      format_.fail(node, "expected points of 3 components");
    const std::vector<double> x = read_array<double>(node, 3 * n, format_);
    for (Offset i = 0; i < n; ++i) {
      data_.points.push_back({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
      for (const double c : data_.points.back())
        if (!std::isfinite(c))
          format_.fail(node, fmt::format("point {} has a coordinate {}, expected a finite number", i, c));
    }
  }

  void read_cells(const pugi::xml_node& piece) {
    const pugi::xml_node cells = piece.child("Cells");
    const Offset n = integer_attribute(piece, "NumberOfCells", -1, format_);
    const std::vector<Offset> type = read_array<Offset>(array(cells, "types"), n, format_);
    const pugi::xml_node offsets = array(cells, "offsets");
    const std::vector<Offset> end = read_array<Offset>(offsets, n, format_);
    if (end.back() < 0) format_.fail(offsets, fmt::format("array 'offsets' ends with {}", end.back()));
    const std::vector<Offset> vertex = read_array<Offset>(array(cells, "connectivity"), end.back(), format_);
    const std::vector<Index> group = read_groups(piece.child("CellData"), n);
    for (Offset c = 0, first = 0; c < n; first = end[c++]) {
      if (end[c] < first || end[c] > static_cast<Offset>(vertex.size()))
        format_.fail(offsets, fmt::format("cell {} ends at {}, before {} or after the last vertex", c, end[c], first));
      add_cell(cells, type[c], {vertex.data() + first, vertex.data() + end[c]}, c, group[c]);
    }
  }

  void add_cell(const pugi::xml_node& cells, Offset type, std::span<const Offset> vertices, Offset c, Index group) {
    switch (type) {
      case 1:
        return;
      case 3:
        return add_cell(cells, data_.lines, vertices, c, group);
      case 5:
        return add_cell(cells, data_.triangles, vertices, c, group);
      case 10:
        return add_cell(cells, data_.tetrahedra, vertices, c, group);
      case 21:
        return add_curved(cells, data_.lines, line_edges, vertices, c, group);
      case 22:
        return add_curved(cells, data_.triangles, triangle_edges, vertices, c, group);
      case 24:
        return add_curved(cells, data_.tetrahedra, vtk_tetrahedron_edges, vertices, c, group);
      default:
        format_.fail(cells, fmt::format("cell {} is a {}; expected triangles or tetrahedra, linear or quadratic", c,
                                        type_name(type)));
    }
  }

  template <std::size_t N>
  std::array<Index, N> nodes_of(const pugi::xml_node& cells, std::span<const Offset> vertices, Offset c) const {
    if (vertices.size() != N)
      format_.fail(cells, fmt::format("cell {} has {} vertices, expected {}", c, vertices.size(), N));
    std::array<Index, N> v;
    for (std::size_t i = 0; i < N; ++i) {
      if (vertices[i] < 0 || vertices[i] >= static_cast<Offset>(data_.points.size()))
        format_.fail(cells,
                     fmt::format("cell {} has vertex {}, there are {} points", c, vertices[i], data_.points.size()));
      v[i] = static_cast<Index>(vertices[i]);
    }
    return v;
  }

  template <int Corners>
  void add_cell(const pugi::xml_node& cells, FileCells<Corners>& to, std::span<const Offset> vertices, Offset c,
                Index group) {
    to.add(nodes_of<Corners>(cells, vertices, c), c, group);
  }

  template <int Corners>
  void add_curved(const pugi::xml_node& cells, FileCells<Corners>& to, const EdgeOrder<Corners>& order,
                  std::span<const Offset> vertices, Offset c, Index group) {
    const auto all = nodes_of<Corners*(Corners + 1) / 2>(cells, vertices, c);
    std::array<Index, Corners> corners;
    std::copy_n(all.begin(), Corners, corners.begin());
    MiddleNodes<Corners> middle;
    for (std::size_t k = 0; k < middle.size(); ++k) middle[k] = all[Corners + order[k]];
    to.add(corners, c, group, middle);
  }

  /// The group of each cell, counted in the order in which they appear; 0 for all where there is no array of groups.
  std::vector<Index> read_groups(const pugi::xml_node& cell_data, Offset cells) {
    std::vector<Index> group(cells, 0);
    for (const char* name : group_arrays) {
      const pugi::xml_node node = cell_data.find_child_by_attribute("DataArray", "Name", name);
      if (!node) continue;
      std::map<Offset, Index> number;
      const std::vector<Offset> value = read_array<Offset>(node, cells, format_);
      for (Offset c = 0; c < cells; ++c) {
        const auto [entry, is_new] = number.try_emplace(value[c], static_cast<Index>(group_names_.size()));
        if (is_new) group_names_.push_back(fmt::format("{}", value[c]));
        group[c] = entry->second;
      }
      break;
    }
    return group;
  }

  std::vector<std::string> names(Index group) const {
    if (group_names_.empty()) return {};
    return {group_names_[group]};
  }

  VtuFormat format_;
  pugi::xml_document document_;
  MeshFileData data_;
  std::vector<std::string> group_names_;
};

}  // namespace

AnyMesh read_vtu(std::string_view content, std::string_view place, FileGroups* groups) {
  return VtuReader(content, place).read(groups);
}

}  // namespace signorini
