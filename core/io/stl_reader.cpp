#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/base/error.hpp"
#include "core/io/surface_formats.hpp"

namespace signorini {
namespace {

constexpr std::size_t head = 80, record = 50;  // bytes, of which a record holds a normal, three points and two more

std::uint32_t triangle_count(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= head + sizeof count) std::memcpy(&count, bytes.data() + head, sizeof count);
  return count;
}

std::size_t size_of_binary(std::string_view bytes) {
  return head + sizeof(std::uint32_t) + record * std::size_t{triangle_count(bytes)};
}

bool equal(std::string_view word, std::string_view lower) {
  return std::ranges::equal(word, lower, {}, [](unsigned char c) { return std::tolower(c); });
}

/// The head of a binary file may begin with "solid" as well, but hardly any is free of zero bytes.
bool is_text(std::string_view bytes) {
  const std::string_view content = bytes.substr(0, bytes.find_last_not_of('\0') + 1);
  const std::size_t first = std::min(content.find_first_not_of(" \t\r\n"), content.size());
  return equal(content.substr(first, 5), "solid") && bytes.size() != size_of_binary(bytes) &&
         content.substr(0, head + sizeof(std::uint32_t)).find('\0') == std::string_view::npos;
}

PolygonSoup read_binary(std::string_view bytes, std::string_view place) {
  const std::size_t triangles = triangle_count(bytes), needed = size_of_binary(bytes);
  if (bytes.size() < needed)
    input_error(place, fmt::format("the file has {} bytes, its {} triangles take {}; is it truncated?", bytes.size(),
                                   triangles, needed));
  PolygonSoup soup;
  soup.points.reserve(3 * triangles);
  soup.faces.reserve(triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    float numbers[12];
    std::memcpy(numbers, bytes.data() + head + sizeof(std::uint32_t) + record * t, sizeof numbers);
    const std::size_t n = soup.points.size();
    soup.faces.push_back({n, n + 1, n + 2});
    for (std::size_t k = 3; k < 12; k += 3) soup.points.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
    if (!std::all_of(numbers + 3, numbers + 12, [](float x) { return std::isfinite(x); }))
      input_error(place, fmt::format("triangle {} has a coordinate that is not finite", t));
  }
  return soup;
}

class StlText {
 public:
  StlText(std::string_view content, std::string_view place) : lines_(content, place, {}) {}

  PolygonSoup read() {
    bool open = false;
    for (std::string_view word = lines_.next(); !word.empty(); word = lines_.next()) {
      if (open && equal(word, "facet")) {
        read_facet();
        continue;
      }
      if (!equal(word, open ? "endsolid" : "solid")) lines_.fail_at(word, open ? "'facet' or 'endsolid'" : "'solid'");
      open = !open;
      skip_line();  // a name
    }
    if (open) lines_.fail("the file ends without 'endsolid'; is it truncated?");
    return std::move(soup_);
  }

 private:
  void skip_line() {
    while (!lines_.word().empty()) {
    }
  }

  void expect(std::string_view keyword) {
    const std::string_view word = lines_.next();
    if (!equal(word, keyword)) lines_.fail_at(word, fmt::format("'{}'", keyword));
  }

  void read_facet() {
    expect("normal");
    skip_line();  // of its own, which may be anything
    expect("outer");
    expect("loop");
    auto& face = soup_.faces.emplace_back();
    std::string_view word = lines_.next();
    for (; equal(word, "vertex"); word = lines_.next()) {
      face.push_back(soup_.points.size());
      soup_.points.push_back(read_coordinates(lines_, Words::of_text, [] { return "a vertex"; }));
    }
    if (!equal(word, "endloop")) lines_.fail_at(word, "'vertex' or 'endloop'");
    check_corners(lines_, soup_.faces.size() - 1, face.size());
    expect("endfacet");
  }

  TextLines lines_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_stl(std::string_view content, std::string_view place) {
  return is_text(content) ? StlText(content, place).read() : read_binary(content, place);
}

}  // namespace signorini
