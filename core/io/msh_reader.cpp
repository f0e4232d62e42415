#include "core/io/msh_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/base/error.hpp"
#include "core/io/mesh_file_data.hpp"
#include "core/io/msh_input.hpp"
#include "core/io/msh_nodes.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/subsimplices.hpp"

namespace signorini {
namespace {

/// Physical tags are negative where the group has the opposite orientation, which a set of faces does not care for.
using Physicals = std::vector<int>;

std::string type_name(int type) {
  static const std::map<int, const char*> names{{3, "quadrangle"},
                                                {5, "hexahedron"},
                                                {6, "prism"},
                                                {7, "pyramid"},
                                                {10, "second-order quadrangle"},
                                                {12, "second-order hexahedron"},
                                                {13, "second-order prism"},
                                                {14, "second-order pyramid"},
                                                {16, "second-order quadrangle"},
                                                {17, "second-order hexahedron"},
                                                {18, "second-order prism"},
                                                {19, "second-order pyramid"},
                                                {21, "third-order triangle"},
                                                {26, "third-order line"},
                                                {29, "third-order tetrahedron"}};
  const auto name = names.find(type);
  return name == names.end() ? fmt::format("type {}", type) : fmt::format("{} (type {})", name->second, type);
}

/// An element that several physical groups contain is written once for each of them by version 2.2: keeps the first.
template <int Corners>
void drop_repeated(FileCells<Corners>& cells, Index vertices) {
  const Numbering numbering = number_subsimplices<Corners>(vertices, static_cast<Offset>(cells.vertices.size()),
                                                           [&](Offset i) { return sorted(cells.vertices[i]); });
  std::vector<Offset> first(numbering.distinct, -1);
  FileCells<Corners> kept;
  for (std::size_t i = 0; i < cells.vertices.size(); ++i) {
    Offset& f = first[numbering.number[i]];
    if (f >= 0 && cells.group[f] != cells.group[i]) continue;  // twice in one group is an error, found later
    if (f < 0) f = static_cast<Offset>(i);
    kept.add(cells.vertices[i], cells.label[i], cells.group[i], cells.middle_of(i));
  }
  cells = std::move(kept);
}

/// Sections by the names of version 1, which have no $MeshFormat before them, and of the others.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> names_of_version_1 = {
    {{"NOD", "Nodes"}, {"ELM", "Elements"}}};

class MshReader {
 public:
  MshReader(std::string_view content, std::string_view place) : in_(content, place) {}

  AnyMesh read(FileGroups* groups) {
    while (!in_.at_end()) read_section();
    for (const char* needed : {"Nodes", "Elements"})
      if (!done_.contains(needed)) in_.fail(fmt::format("the file has no section ${}", needed));
    if (version_ < 3 && entities_.size() > 1) {
      const auto n = static_cast<Index>(data_.points.size());
      if (data_.tetrahedra.vertices.empty())
        drop_repeated(data_.triangles, n);
      else
        drop_repeated(data_.tetrahedra, n);
    }
    return make_mesh(
        std::move(data_), [this](int dimension, Index e) { return names(dimension, e); }, in_.place(), groups);
  }

 private:
  void read_section() {
    const std::string_view marker = in_.word();
    if (marker.size() < 2 || marker[0] != '$')
      in_.fail(fmt::format("expected a section such as $Nodes, found '{}'", marker.substr(0, 40)));
    std::string name(marker.substr(1)), end = "$End" + name;
    for (const auto& [old, now] : names_of_version_1)
      if (name == old) {
        if (version_ != 0 && version_ != 1) in_.fail(fmt::format("${} in a file of version {}", name, version_));
        version_ = 1;
        name = now;
        end = fmt::format("$END{}", old);
      }
    const bool known =
        name == "MeshFormat" || name == "PhysicalNames" || name == "Entities" || name == "Nodes" || name == "Elements";
    if (name == "PartitionedEntities") in_.fail("partitioned meshes are not read: save the mesh without partitions");
    if (!known) return in_.skip_past(end);
    if (!done_.insert(name).second) in_.fail(fmt::format("second section ${}", name));
    if (name != "MeshFormat" && version_ == 0) in_.fail("expected $MeshFormat first");
    if (in_.binary) in_.rest_of_line();
    if (name == "MeshFormat") read_format();
    if (name == "PhysicalNames") read_names();
    if (name == "Entities") read_entities();
    if (name == "Nodes") version_ >= 4 ? read_nodes_4() : read_nodes_2();
    if (name == "Elements") version_ >= 4 ? read_elements_4() : version_ == 1 ? read_elements_1() : read_elements_2();
    in_.expect(end);
  }

  void read_format() {
    version_ = in_.text_real("the version of the format");
    if (std::ranges::find(versions, version_) == versions.end())
      in_.fail(fmt::format("found MSH version {}, expected one of 1 | {}", version_, fmt::join(versions, " | ")));
    const Offset kind = in_.text_integer("the file type"), size = in_.text_integer("the data size");
    if (kind != 0 && kind != 1) in_.fail(fmt::format("found file type {}, expected 0 (ASCII) or 1 (binary)", kind));
    if (size != 8) in_.fail(fmt::format("found data size {}, expected 8", size));
    if (kind == 0) return;
    in_.rest_of_line();
    in_.binary = true;
    const auto one = in_.raw<std::int32_t>("the number one that shows the byte order");
    in_.swapped = one == 1 << 24;
    if (one != 1 && !in_.swapped) in_.fail(fmt::format("found {} as the number one that shows the byte order", one));
  }

  void read_names() {
    const Offset n = in_.count(in_.text_integer("the number of names"), 6, 6, "names");
    for (Offset i = 0; i < n; ++i) {
      Offset dimension = any_dimension, tag = in_.text_integer("a dimension or a physical tag");
      if (!in_.next_is('"')) dimension = std::exchange(tag, in_.text_integer("a physical tag"));
      const std::string_view text = in_.rest_of_line();
      const std::size_t first = text.find('"'), last = text.rfind('"');
      if (first == last) in_.fail(fmt::format("expected a name in quotation marks, found '{}'", text.substr(0, 80)));
      names_[{dimension, tag}] = text.substr(first + 1, last - first - 1);
    }
  }

  void read_entities() {
    if (version_ < 4) in_.fail(fmt::format("$Entities in a file of version {}", version_));
    std::array<Offset, 4> counts;
    for (Offset& n : counts) n = in_.number<Offset>("a number of entities");
    for (int dimension = 0; dimension <= 3; ++dimension) {
      in_.count(counts[dimension], dimension == 0 ? 10 : 17, dimension == 0 ? 36 : 68, "entities");
      for (Offset i = 0; i < counts[dimension]; ++i) read_entity(dimension);
    }
  }

  void read_entity(int dimension) {
    const int tag = in_.number<std::int32_t>("an entity's tag");
    for (int k = 0; k < (dimension == 0 && version_ > 4 ? 3 : 6); ++k) in_.number<double>("a bounding box");
    const Offset n = in_.count(in_.number<Offset>("the number of physical tags"), 2, 4, "physical tags");
    Physicals physicals;
    for (Offset k = 0; k < n; ++k) physicals.push_back(in_.number<std::int32_t>("a physical tag"));
    entity_physicals_[{dimension, tag}] = std::move(physicals);
    if (dimension == 0) return;
    const Offset bounds = in_.count(in_.number<Offset>("the number of bounding entities"), 2, 4, "bounding entities");
    for (Offset k = 0; k < bounds; ++k) in_.number<std::int32_t>("a bounding entity");
  }

  void reserve_nodes(Offset n) {
    if (n > std::numeric_limits<Index>::max()) in_.fail(fmt::format("{} nodes are more than can be numbered", n));
    data_.points.reserve(n);
  }

  void read_point() {
    Point<3> p;
    for (double& x : p) x = in_.coordinate();
    data_.points.push_back(p);
  }

  void read_nodes_2() {
    const Offset n = in_.count(in_.text_integer("the number of nodes"), 8, 28, "nodes");
    reserve_nodes(n);
    if (in_.binary) in_.rest_of_line();
    for (Offset i = 0; i < n; ++i) {
      nodes_.add(in_.number<std::int32_t>("a node's tag"));
      read_point();
    }
    nodes_.close(in_);
  }

  void read_nodes_4() {
    const Offset blocks = in_.count(in_.number<Offset>("the number of blocks"), 8, 20, "blocks");
    const Offset n = in_.count(in_.number<Offset>("the number of nodes"), 8, node_bytes(), "nodes");
    reserve_nodes(n);
    skip_range_of_tags("node");
    for (Offset block = 0; block < blocks; ++block) {
      const int dimension = read_block_entity().dimension;
      const bool parametric = in_.number<std::int32_t>("whether nodes have parameters") != 0;
      const Offset size = in_.count(in_.number<Offset>("the number of nodes in a block"), 8, node_bytes(), "nodes");
      if (dimension < 0 || dimension > 3) in_.fail(fmt::format("found an entity of dimension {}", dimension));
      if (size > n - static_cast<Offset>(data_.points.size()))
        in_.fail(fmt::format("more than the {} nodes announced", n));
      for (Offset i = 0; version_ > 4 && i < size; ++i) nodes_.add(in_.number<Offset>("a node's tag"));
      for (Offset i = 0; i < size; ++i) {
        if (version_ == 4) nodes_.add(in_.number<std::int32_t>("a node's tag"));
        read_point();
        for (int k = 0; parametric && k < dimension; ++k) in_.number<double>("a node's parameter");
      }
    }
    if (static_cast<Offset>(data_.points.size()) != n)
      in_.fail(fmt::format("found {} nodes, announced were {}", data_.points.size(), n));
    nodes_.close(in_);
  }

  struct BlockEntity {
    int dimension, tag;
  };
  BlockEntity read_block_entity() {
    const auto dimension = [&] { return in_.number<std::int32_t>("an entity's dimension"); };
    const int first = version_ == 4 ? in_.number<std::int32_t>("an entity's tag") : dimension();
    return version_ == 4 ? BlockEntity{dimension(), first}
                         : BlockEntity{first, in_.number<std::int32_t>("an entity's tag")};
  }

  void skip_range_of_tags(const char* of) {
    for (const char* which : {"least", "greatest"})
      if (version_ > 4) in_.number<Offset>(fmt::format("the {} {} tag", which, of).c_str());
  }

  // At least, of binary files of version 4.
  Offset node_bytes() const { return version_ > 4 ? 32 : 28; }
  Offset element_bytes() const { return version_ > 4 ? 16 : 8; }

  /// The number of a node or an element.
  Offset read_tag(const char* meaning) {
    return version_ > 4 ? in_.number<Offset>(meaning) : Offset{in_.number<std::int32_t>(meaning)};
  }

  Index read_node() {
    ++nodes_read_;
    return nodes_.find(read_tag("an element's node"), in_);
  }

  template <int Corners>
  std::array<Index, Corners> read_corners() {
    std::array<Index, Corners> v;
    for (Index& corner : v) corner = read_node();
    return v;
  }

  template <int Corners>
  void read_cell(FileCells<Corners>& cells, Offset label, Index entity) {
    cells.add(read_corners<Corners>(), label, entity);
  }

  template <int Corners>
  void read_curved(FileCells<Corners>& cells, const EdgeOrder<Corners>& order, Offset label, Index entity) {
    const auto corners = read_corners<Corners>();
    MiddleNodes<Corners> given, middle;
    for (Index& node : given) node = read_node();
    for (std::size_t k = 0; k < middle.size(); ++k) middle[k] = given[order[k]];
    cells.add(corners, label, entity, middle);
  }

  void read_cell(Offset type, Offset label, Index entity) {
    switch (type) {
      case 1:
        return read_cell(data_.lines, label, entity);
      case 2:
        return read_cell(data_.triangles, label, entity);
      case 4:
        return read_cell(data_.tetrahedra, label, entity);
      case 8:
        return read_curved(data_.lines, line_edges, label, entity);
      case 9:
        return read_curved(data_.triangles, triangle_edges, label, entity);
      case 11:
        return read_curved(data_.tetrahedra, gmsh_tetrahedron_edges, label, entity);
      case 15:
        read_node();
        return;
      default:
        in_.fail(fmt::format("element {} is a {}; expected triangles or tetrahedra of first or second order", label,
                             type_name(static_cast<int>(type))));
    }
  }

  /// The number of an entity; a new one where there is none of that key yet.
  Index entity(int dimension, int physical, int tag, const Physicals& physicals) {
    const auto [found, is_new] =
        entity_number_.try_emplace({dimension, physical, tag}, static_cast<Index>(entities_.size()));
    if (is_new) entities_.push_back(physicals);
    return found->second;
  }

  struct Tags {
    int physical = 0, entity = 0;
  };
  Tags read_tags(int count) {
    Tags tags;
    for (int k = 0; k < count; ++k) {
      const int tag = in_.number<std::int32_t>("an element's tag");
      if (k == 0) tags.physical = tag;
      if (k == 1) tags.entity = tag;
    }
    return tags;
  }

  void read_tagged_cell(int type, const Tags& tags, Offset label) {
    const Physicals physicals = tags.physical == 0 ? Physicals{} : Physicals{tags.physical};
    read_cell(type, label, entity(type, tags.physical, tags.entity, physicals));
  }

  void read_labelled_cell(int type, int tag_count, Offset label) {
    const Tags tags = read_tags(tag_count);
    read_tagged_cell(type, tags, label);
  }

  void read_elements_2() {
    need_nodes();
    const Offset n = in_.count(in_.text_integer("the number of elements"), 6, 8, "elements");
    if (in_.binary) in_.rest_of_line();
    for (Offset i = 0; i < n;) {
      const int first = in_.number<std::int32_t>("an element's number or type");
      const int second = in_.number<std::int32_t>("an element's type or number");
      const int tags = in_.number<std::int32_t>("the number of tags");
      const int type = in_.binary ? first : second;
      const int size = in_.binary ? second : 1;
      if (tags < 0 || size < 1 || size > n - i)
        in_.fail(fmt::format("found a block of {} elements with {} tags, expected 1 to {} elements with 0 or more tags",
                             size, tags, n - i));
      for (int k = 0; k < size; ++k, ++i)
        read_labelled_cell(type, tags, in_.binary ? in_.number<std::int32_t>("an element's number") : first);
    }
  }

  /// Lines of element, type, physical and elementary tag, count of nodes and these.
  void read_elements_1() {
    need_nodes();
    const Offset n = in_.count(in_.text_integer("the number of elements"), 6, 6, "elements");
    for (Offset i = 0; i < n; ++i) {
      const Offset label = in_.text_integer("an element's number");
      const auto type = in_.number<std::int32_t>("an element's type");
      const Tags tags = read_tags(2);
      const Offset nodes = in_.text_integer("an element's number of nodes");
      const Offset before = nodes_read_;
      read_tagged_cell(type, tags, label);
      if (nodes_read_ - before != nodes)
        in_.fail(
            fmt::format("element {} has {} nodes, expected {} of type {}", label, nodes, nodes_read_ - before, type));
    }
  }

  void read_elements_4() {
    need_nodes();
    const Offset blocks = in_.count(in_.number<Offset>("the number of blocks"), 8, 20, "blocks");
    const Offset n = in_.count(in_.number<Offset>("the number of elements"), 4, element_bytes(), "elements");
    skip_range_of_tags("element");
    Offset found = 0;
    for (Offset block = 0; block < blocks; ++block) {
      const auto [dimension, tag] = read_block_entity();
      const int type = in_.number<std::int32_t>("an element type");
      const Offset size =
          in_.count(in_.number<Offset>("the number of elements in a block"), 4, element_bytes(), "elements");
      const Index where = entity(dimension, 0, tag, entity_physicals_[{dimension, tag}]);
      for (Offset i = 0; i < size; ++i) read_cell(type, read_tag("an element's number"), where);
      found += size;
    }
    if (found != n) in_.fail(fmt::format("found {} elements, announced were {}", found, n));
  }

  void need_nodes() const {
    if (!done_.contains("Nodes")) in_.fail("expected $Nodes before $Elements");
  }

  std::vector<std::string> names(int dimension, Index entity) const {
    std::vector<std::string> result;
    for (const int tag : entities_[entity]) {
      const Offset positive = std::abs(Offset{tag});
      auto name = names_.find({dimension, positive});
      if (name == names_.end()) name = names_.find({any_dimension, positive});
      result.push_back(name == names_.end() || name->second.empty() ? fmt::format("{}", positive) : name->second);
    }
    return result;
  }

  MshInput in_;
  static constexpr std::array versions{2.0, 2.1, 2.2, 4.0, 4.1};  // that $MeshFormat tells
  static constexpr Offset any_dimension = -1;                     // of names before version 2.1
  double version_ = 0;                                            // until it is known
  Offset nodes_read_ = 0;
  std::set<std::string> done_;
  std::map<std::pair<Offset, Offset>, std::string> names_;     // by dimension and physical tag
  std::map<std::pair<int, int>, Physicals> entity_physicals_;  // version 4, by dimension and tag
  std::map<std::tuple<int, int, int>, Index> entity_number_;   // by dimension, physical tag (version 2) and tag
  std::vector<Physicals> entities_;
  MshNodes nodes_;
  MeshFileData data_;
};

}  // namespace

AnyMesh read_msh(std::string_view content, std::string_view place, FileGroups* groups) {
  return MshReader(content, place).read(groups);
}

}  // namespace signorini
