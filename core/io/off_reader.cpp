#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/io/surface_formats.hpp"

namespace signorini {
namespace {

/// The keyword in the beginning: [ST][C][N][4][n]OFF. What the letters add follows the coordinates of a vertex.
struct Keyword {
  bool known = false, homogeneous = false;
};

Keyword keyword(std::string_view word) {
  Keyword found;
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  found.homogeneous = word.starts_with('4');
  found.known = word.substr(found.homogeneous ? 1 : 0) == "OFF";
  return found;
}

bool is_count(std::string_view word) {
  return !word.empty() && std::ranges::all_of(word, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

PolygonSoup read_off(std::string_view content, std::string_view place) {
  TextLines lines(content, place, {.comments = true});
  std::string_view first = lines.next();
  const Keyword found = keyword(first);
  if (!found.known && !is_count(first)) lines.fail_at(first, "'OFF', as every OFF file begins");
  if (found.known) first = lines.next();
  if (first == "BINARY") lines.fail("a binary OFF file; expected one that is text");
  const std::size_t vertices = lines.count(first, [] { return "the number of vertices"; });
  const std::size_t faces = lines.count(lines.next(), [] { return "the number of faces"; });
  PolygonSoup soup;
  soup.points.reserve(vertices);
  soup.faces.reserve(faces);
  // Each begins a line: what else is in that one are colours, normals or textures.
  for (std::size_t v = 0; v < vertices; ++v) {
    lines.next_line();
    const auto name = [&] { return fmt::format("vertex {} of {}", v, vertices); };
    Point<3>& p = soup.points.emplace_back(read_coordinates(lines, Words::of_text, name));
    if (!found.homogeneous) continue;
    const double w = lines.real(lines.next(), [&] { return "w of " + name(); });
    for (double& x : p) x /= w;
    if (!std::ranges::all_of(p, [](double x) { return std::isfinite(x); }))
      lines.fail(fmt::format("{} lies at infinity: its w is {}", name(), w));
  }
  for (std::size_t f = 0; f < faces; ++f) {
    lines.next_line();
    const std::size_t corners =
        lines.count(lines.next(), [&] { return fmt::format("the number of vertices of face {} of {}", f, faces); });
    check_corners(lines, f, corners);
    const auto expected = [&] {
      return fmt::format("a vertex of face {} of {}, from 0 to {}", f, faces, static_cast<Offset>(vertices) - 1);
    };
    auto& face = soup.faces.emplace_back();
    for (std::size_t k = 0; k < corners; ++k) {
      const std::string_view word = lines.next();
      const Offset v = lines.integer(word, expected);
      if (v < 0 || static_cast<std::size_t>(v) >= vertices) lines.fail_at(word, expected());
      face.push_back(static_cast<std::size_t>(v));
    }
  }
  return soup;
}

}  // namespace signorini
