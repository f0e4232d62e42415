#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/io/surface_formats.hpp"

namespace signorini {
namespace {

/// Statements of the format that are neither vertices nor faces of polygons.
constexpr std::array<std::string_view, 37> others = {
    "vt",     "vn",     "vp",     "p",     "l",        "o",          "g",        "s",     "mg",    "mtllib",
    "usemtl", "maplib", "usemap", "bevel", "c_interp", "d_interp",   "lod",      "ctech", "stech", "cstype",
    "deg",    "bmat",   "step",   "curv",  "curv2",    "surf",       "parm",     "trim",  "hole",  "scrv",
    "sp",     "end",    "con",    "call",  "csh",      "shadow_obj", "trace_obj"};

/// A corner of a face: a vertex by its number, counted from 1 or backwards from the last one, before what may follow
/// after a slash.
std::size_t corner(const TextLines& lines, std::string_view word, std::size_t vertices) {
  const auto expected = [] { return "a vertex such as 3, 3/1, 3//2 or -1, counted from 1 or back from the last one"; };
  const Offset number = lines.integer(word.substr(0, word.find('/')), expected);
  if (number > 0) return static_cast<std::size_t>(number - 1);
  if (number == 0 || -number > static_cast<Offset>(vertices)) lines.fail_at(word, expected());
  return vertices - static_cast<std::size_t>(-number);
}

}  // namespace

PolygonSoup read_obj(std::string_view content, std::string_view place) {
  TextLines lines(content, place, {.comments = true, .continued = true});
  PolygonSoup soup;
  std::vector<Offset> line_of_face;
  while (lines.next_line()) {
    const Offset line = lines.line();
    const std::string_view statement = lines.word();
    if (statement == "v") {
      soup.points.push_back(
          read_coordinates(lines, Words::of_line, [&] { return fmt::format("vertex {}", soup.points.size() + 1); }));
    } else if (statement == "f") {
      auto& face = soup.faces.emplace_back();
      for (std::string_view word = lines.word(); !word.empty(); word = lines.word())
        face.push_back(corner(lines, word, soup.points.size()));
      check_corners(lines, soup.faces.size() - 1, face.size());
      line_of_face.push_back(line);
    } else if (std::ranges::find(others, statement) == others.end()) {
      lines.fail_at(statement, "a statement of an OBJ file such as 'v' or 'f'");
    }
  }
  for (std::size_t f = 0; f < soup.faces.size(); ++f)  // vertices may follow the faces that name them
    for (const std::size_t v : soup.faces[f])
      if (v >= soup.points.size())
        lines.fail(line_of_face[f],
                   fmt::format("face {} has vertex {}, expected one of the {} vertices", f, v + 1, soup.points.size()));
  return soup;
}

}  // namespace signorini
