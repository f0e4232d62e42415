#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/io/surface_formats.hpp"

namespace signorini {
namespace {

enum class NumberKind { integer, natural, real };
struct PlyType {
  std::string_view name, other_name;
  NumberKind kind;
  std::size_t size;
};
constexpr PlyType ply_types[] = {
    {"char", "int8", NumberKind::integer, 1},   {"uchar", "uint8", NumberKind::natural, 1},
    {"short", "int16", NumberKind::integer, 2}, {"ushort", "uint16", NumberKind::natural, 2},
    {"int", "int32", NumberKind::integer, 4},   {"uint", "uint32", NumberKind::natural, 4},
    {"int64", "long", NumberKind::integer, 8},  {"uint64", "ulong", NumberKind::natural, 8},
    {"float", "float32", NumberKind::real, 4},  {"double", "float64", NumberKind::real, 8}};

struct Property {
  std::string name;
  const PlyType* count = nullptr;  ///< of a list
  const PlyType* type = nullptr;
};

struct Element {
  std::string name;
  std::size_t size;
  std::vector<Property> properties;
};

enum class Storage { text, little, big };

struct Header {
  Storage storage = Storage::text;
  std::vector<Element> elements;
};

const PlyType& type_of(const TextLines& lines, std::string_view word) {
  for (const PlyType& type : ply_types)
    if (word == type.name || word == type.other_name) return type;
  lines.fail_at(word, "a type such as 'float', 'double', 'uchar' or 'int'");
}

Property read_property(TextLines& lines) {
  Property property;
  std::string_view word = lines.word();
  if (word == "list") {
    property.count = &type_of(lines, lines.word());
    if (property.count->kind == NumberKind::real) lines.fail("the length of a list is no integer");
    word = lines.word();
  }
  property.type = &type_of(lines, word);
  property.name = lines.word();
  if (property.name.empty()) lines.fail_at({}, "the name of a property");
  return property;
}

Storage storage_of(const TextLines& lines, std::string_view word) {
  if (word == "ascii") return Storage::text;
  if (word == "binary_little_endian") return Storage::little;
  if (word == "binary_big_endian") return Storage::big;
  lines.fail_at(word, "'ascii', 'binary_little_endian' or 'binary_big_endian'");
}

Header read_header(TextLines& lines) {
  if (const std::string_view word = lines.next(); word != "ply") lines.fail_at(word, "'ply', as every PLY file begins");
  std::optional<Storage> storage;
  Header header;
  while (lines.next_line()) {
    const std::string_view word = lines.word();
    if (word == "format") {
      storage = storage_of(lines, lines.word());
    } else if (word == "element") {
      const std::string_view name = lines.word();
      const auto expected = [&] { return fmt::format("the number of elements '{}'", name); };
      header.elements.push_back({std::string(name), lines.count(lines.word(), expected), {}});
    } else if (word == "property") {
      if (header.elements.empty()) lines.fail("a property before any element; expected an element first");
      header.elements.back().properties.push_back(read_property(lines));
    } else if (word == "end_header") {
      if (!storage) lines.fail("the header has no line 'format'; expected 'format ascii 1.0' or one of binary data");
      header.storage = *storage;
      return header;
    } else if (word != "comment" && word != "obj_info") {
      lines.fail_at(word, "'format', 'element', 'property', 'comment' or 'end_header'");
    }
  }
  lines.fail("the file ends within its header, without 'end_header'; is it truncated?");
}

/// The numbers behind the header, as text or as bytes.
class Values {
 public:
  Values(TextLines& lines, std::string_view content, Storage storage, std::string_view place)
      : lines_(lines), bytes_(content), storage_(storage), place_(place) {
    at_ = lines.position();
    if (storage != Storage::text) at_ = std::min(at_ + (content.substr(at_, 2) == "\r\n" ? 2 : 1), content.size());
  }

  template <class Of>
  double real(const PlyType& type, const Of& of) {
    if (storage_ == Storage::text) return lines_.real(lines_.next(), of);
    return type.kind == NumberKind::real ? (type.size == 4 ? raw<float>(of) : raw<double>(of))
                                         : static_cast<double>(integer(type, of));
  }

  template <class Of>
  Offset integer(const PlyType& type, const Of& of) {
    if (storage_ == Storage::text) return lines_.integer(lines_.next(), of);
    const bool natural = type.kind == NumberKind::natural;
    switch (type.size) {
      case 1:
        return natural ? raw<std::uint8_t>(of) : raw<std::int8_t>(of);
      case 2:
        return natural ? raw<std::uint16_t>(of) : raw<std::int16_t>(of);
      case 4:
        return natural ? Offset{raw<std::uint32_t>(of)} : Offset{raw<std::int32_t>(of)};
      default:
        return raw<std::int64_t>(of);
    }
  }

  [[noreturn]] void fail(std::string_view message) const {
    if (storage_ == Storage::text) lines_.fail(message);
    input_error(place_, fmt::format("byte {}: {}", at_, message));
  }

  /// What is left of the file, in bytes.
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  template <class T, class Of>
  T raw(const Of& of) {
    if (left() < sizeof(T)) fail(fmt::format("the file ends where {} is expected; is it truncated?", of()));
    char copy[sizeof(T)];
    std::memcpy(copy, bytes_.data() + at_, sizeof(T));
    if (storage_ == Storage::big) std::reverse(copy, copy + sizeof(T));
    at_ += sizeof(T);
    T value;
    std::memcpy(&value, copy, sizeof(T));
    return value;
  }

  TextLines& lines_;
  std::string_view bytes_;
  Storage storage_;
  std::string_view place_;
  std::size_t at_ = 0;
};

class PlyReader {
 public:
  PlyReader(std::string_view content, std::string_view place)
      : lines_(content, place, {}), header_(read_header(lines_)), values_(lines_, content, header_.storage, place) {}

  PolygonSoup read() {
    for (const Element& element : header_.elements)
      if (element.name == "vertex")
        read_vertices(element);
      else
        read_others(element);
    for (std::size_t f = 0; f < soup_.faces.size(); ++f)  // vertices may follow the faces that name them
      for (const std::size_t v : soup_.faces[f])
        if (v >= soup_.points.size())
          values_.fail(fmt::format("face {} of {} has vertex {}, expected 0 to {}", f, soup_.faces.size(), v,
                                   static_cast<Offset>(soup_.points.size()) - 1));
    return std::move(soup_);
  }

 private:
  /// The number of a coordinate in a vertex, 3 for anything else.
  static std::size_t axis(const Property& property) {
    return property.name.size() == 1 && !property.count
               ? std::min(std::string_view("xyz").find(property.name), std::size_t{3})
               : 3;
  }

  void read_vertices(const Element& element) {
    for (const char name : {'x', 'y', 'z'})
      if (std::ranges::count_if(element.properties,
                                [&](const Property& p) { return !p.count && p.name == std::string(1, name); }) != 1)
        values_.fail(fmt::format("the header gives vertices no property {}, or several; expected x, y and z", name));
    check_size(element);
    for (std::size_t v = 0; v < element.size; ++v) {
      Point<3> p{};
      for (const Property& property : element.properties) {
        const auto of = [&] { return fmt::format("{} of vertex {} of {}", property.name, v, element.size); };
        if (const std::size_t k = axis(property); k < 3)
          p[k] = values_.real(*property.type, of);
        else
          skip(property, of);
      }
      if (!std::ranges::all_of(p, [](double x) { return std::isfinite(x); }))
        values_.fail(fmt::format("vertex {} is at ({}, {}, {}), expected finite numbers", v, p[0], p[1], p[2]));
      soup_.points.push_back(p);
    }
  }

  void read_others(const Element& element) {
    if (element.properties.empty()) return;  // takes no room
    check_size(element);
    for (std::size_t e = 0; e < element.size; ++e)
      for (const Property& property : element.properties) {
        const auto of = [&] { return fmt::format("{} of {} {} of {}", property.name, element.name, e, element.size); };
        const bool corners = property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
        if (element.name == "face" && corners)
          read_face(property, of);
        else
          skip(property, of);
      }
  }

  template <class Of>
  void read_face(const Property& property, const Of& of) {
    const std::size_t corners = length(property, of);
    check_corners(soup_.faces.size(), corners);
    auto& face = soup_.faces.emplace_back();
    for (std::size_t k = 0; k < corners; ++k) {
      const Offset v = values_.integer(*property.type, of);
      if (v < 0) values_.fail(fmt::format("found {}, expected {}", v, of()));
      face.push_back(static_cast<std::size_t>(v));
    }
  }

  void check_corners(std::size_t face, std::size_t corners) const {
    if (corners < 3) values_.fail(fmt::format("face {} has {} vertices; expected at least 3", face, corners));
  }

  template <class Of>
  void skip(const Property& property, const Of& of) {
    for (std::size_t k = property.count ? length(property, of) : 1; k > 0; --k) skip_one(*property.type, of);
  }

  /// Anything but text may be not finite.
  template <class Of>
  void skip_one(const PlyType& type, const Of& of) {
    if (header_.storage != Storage::text)
      values_.real(type, of);
    else if (lines_.next().empty())
      lines_.fail_at({}, of());
  }

  template <class Of>
  std::size_t length(const Property& property, const Of& of) {
    const Offset n = values_.integer(*property.count, [&] { return "the length of " + of(); });
    if (n < 0 || static_cast<std::size_t>(n) > values_.left())
      values_.fail(fmt::format("found {} as the length of {}, expected one that the file can hold", n, of()));
    return static_cast<std::size_t>(n);
  }

  void check_size(const Element& element) const {
    if (element.size > values_.left())
      values_.fail(fmt::format("the header promises {} elements '{}', more than the remaining {} bytes can hold",
                               element.size, element.name, values_.left()));
  }

  TextLines lines_;
  Header header_;
  Values values_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_ply(std::string_view content, std::string_view place) { return PlyReader(content, place).read(); }

}  // namespace signorini
