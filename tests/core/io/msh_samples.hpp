#pragma once
#include <fmt/format.h>

#include "mesh_samples.hpp"

namespace signorini::test {

struct MshVariant {
  double version;  ///< 1, 2, 2.2, 4 or 4.1
  bool binary = false;
  bool swapped = false;
  Offset stride = 1;  ///< between the tags of nodes
};

/// Writes MSH files of all kinds, after the Gmsh reference manual.
class MshWriter : ByteWriter {
 public:
  MshWriter(const Sample& sample, MshVariant variant)
      : ByteWriter(variant.swapped), sample_(sample), variant_(variant) {}

  std::string write() {
    const bool first = variant_.version == 1;
    if (!first) write_head();
    if (variant_.version >= 4) write_entities();
    const std::string line = variant_.binary ? "\n" : "";
    out += first ? "$NOD\n" : "$Nodes\n";
    variant_.version < 4 ? write_nodes_2() : write_nodes_4();
    out += line + (first ? "$ENDNOD\n$ELM\n" : "$EndNodes\n$Elements\n");
    variant_.version < 4 ? write_elements_2() : write_elements_4();
    out += line + (first ? "$ENDELM\n" : "$EndElements\n");
    return out;
  }

 private:
  template <class T>
  void put(T value, char separator = ' ') {
    if (variant_.binary)
      add<T>(value);
    else
      out += fmt::format("{}{}", value, separator);
  }
  using Int = std::int32_t;
  using Size = std::uint64_t;

  void write_head() {
    out += fmt::format("$MeshFormat\n{} {} 8\n", variant_.version, variant_.binary ? 1 : 0);
    if (variant_.binary) add<std::int32_t>(1), out += '\n';
    out += fmt::format("$EndMeshFormat\n$PhysicalNames\n{}\n", sample_.names.size());
    for (const auto& [key, name] : sample_.names)
      out += variant_.version == 2 ? fmt::format("{} \"{}\"\n", key.second, name)
                                   : fmt::format("{} {} \"{}\"\n", key.first, key.second, name);
    out += "$EndPhysicalNames\n";
  }

  /// The number of a node or an element in version 4.
  void put_tag(Offset value, char separator = ' ') {
    if (variant_.version > 4)
      put<Size>(static_cast<Size>(value), separator);
    else
      put<Int>(static_cast<Int>(value), separator);
  }
  void put_entity(int dimension, int tag) {
    put<Int>(variant_.version > 4 ? dimension : tag);
    put<Int>(variant_.version > 4 ? tag : dimension);
  }
  void put_range(std::size_t last) {
    if (variant_.version > 4) put<Size>(1), put<Size>(last);
    if (!variant_.binary) out += '\n';
  }

  Offset tag(std::size_t node) const { return 1 + static_cast<Offset>(node) * variant_.stride; }
  static int type(const SampleBlock& block) {
    constexpr int linear[] = {15, 1, 2, 4}, quadratic[] = {15, 8, 9, 11};
    const bool second = !block.cells.empty() && static_cast<int>(block.cells[0].size()) > block.dimension + 1;
    return (second ? quadratic : linear)[block.dimension];
  }

  void write_entities() {
    out += "$Entities\n";
    put<Size>(1);  // a point
    for (int dimension = 1; dimension <= 3; ++dimension)
      put<Size>(std::ranges::count_if(sample_.blocks, [&](const auto& b) { return b.dimension == dimension; }));
    put<Int>(1);
    for (int k = 0; k < (variant_.version > 4 ? 3 : 6); ++k) put<double>(0.25);
    put<Size>(1);
    put<Int>(77, '\n');
    for (int dimension = 1; dimension <= 3; ++dimension)
      for (const SampleBlock& block : sample_.blocks)
        if (block.dimension == dimension) {
          put<Int>(block.tag);
          for (int k = 0; k < 6; ++k) put<double>(k);
          put<Size>(block.physicals.size());
          for (const int p : block.physicals) put<Int>(p);
          put<Size>(2);
          put<Int>(1);
          put<Int>(-1, '\n');
        }
    out += variant_.binary ? "\n$EndEntities\n" : "$EndEntities\n";
  }

  void write_nodes_2() {
    out += fmt::format("{}\n", sample_.points.size());
    for (std::size_t i = 0; i < sample_.points.size(); ++i) {
      put<Int>(static_cast<Int>(tag(i)));
      write_point(i);
    }
  }

  void write_point(std::size_t i) {
    for (int k = 0; k < 3; ++k) put<double>(sample_.points[i][k], k == 2 ? '\n' : ' ');
  }

  /// Two blocks: the first ones on a surface, with parameters.
  void write_nodes_4() {
    const std::size_t n = sample_.points.size(), half = n / 2;
    put<Size>(2);
    put<Size>(n);
    put_range(tag(n - 1));
    for (const auto& [first, last] : {std::pair{std::size_t{0}, half}, {half, n}}) {
      const bool parametric = first == 0;
      put_entity(2, 1);
      put<Int>(parametric);
      put<Size>(last - first, '\n');
      for (std::size_t i = first; variant_.version > 4 && i < last; ++i) put_tag(tag(i), '\n');
      for (std::size_t i = first; i < last; ++i) {
        if (variant_.version == 4) put_tag(tag(i));
        write_point(i);
        if (parametric) put<double>(0.1), put<double>(0.2, '\n');
      }
    }
  }

  void write_elements_2() {
    const bool first = variant_.version == 1;
    std::size_t n = 1;  // a point
    for (const SampleBlock& block : sample_.blocks) n += block.cells.size() * block.physicals.size();
    out += fmt::format("{}\n", n);
    Int number = 1;
    if (variant_.binary)
      for (const Int k : {15, 1, 2, number, 77, 1, Int(tag(0))}) put<Int>(k);
    else
      out += fmt::format("{} 15 {}77 1 {}{}\n", number, first ? "" : "2 ", first ? "1 " : "", tag(0));
    for (const SampleBlock& block : sample_.blocks)
      for (const int physical : block.physicals) {
        if (variant_.binary) {
          put<Int>(type(block));
          put<Int>(static_cast<Int>(block.cells.size()));
          put<Int>(2);
        }
        for (const auto& cell : block.cells) {
          put<Int>(++number);
          if (!variant_.binary) out += fmt::format("{} {}", type(block), first ? "" : "2 ");
          put<Int>(physical);
          put<Int>(block.tag);
          if (variant_.version == 1) put<Int>(static_cast<Int>(cell.size()));
          for (const Index v : cell) put<Int>(static_cast<Int>(tag(v)));
          if (!variant_.binary) out += '\n';
        }
      }
  }

  void write_elements_4() {
    std::size_t n = 0;
    for (const SampleBlock& block : sample_.blocks) n += block.cells.size();
    put<Size>(sample_.blocks.size());
    put<Size>(n);
    put_range(n);
    Offset number = 0;
    for (const SampleBlock& block : sample_.blocks) {
      put_entity(block.dimension, block.tag);
      put<Int>(type(block));
      put<Size>(block.cells.size(), '\n');
      for (const auto& cell : block.cells) {
        put_tag(++number);
        for (const Index v : cell) put_tag(tag(v));
        if (!variant_.binary) out += '\n';
      }
    }
  }

  const Sample& sample_;
  MshVariant variant_;
};

}  // namespace signorini::test
