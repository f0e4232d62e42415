#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <string>

/// Tables of scenes as text, for tests and benchmarks. Vectors and expressions are given as TOML: "[0, 0, 1]".
namespace signorini::tables {

using Text = const std::string&;

/// A rectangle or a box, elastic and of linear elements unless `material` says something else.
inline std::string block(Text name, Text from, Text to, Text cells,
                         Text material = "order = 1\nyoung = 1\npoisson = 0.3\n") {
  return fmt::format("[[body]]\nname = \"{}\"\nshape = \"{}\"\nfrom = {}\nto = {}\ncells = {}\n{}", name,
                     std::ranges::count(from, ',') == 1 ? "rectangle" : "box", from, to, cells, material);
}

inline std::string fix(Text body, Text on, Text value) {
  return fmt::format("[[fix]]\nbody = \"{}\"\non = \"{}\"\nvalue = {}\n", body, on, value);
}

/// @param on empty: a body force or a source
inline std::string load(Text body, Text value, Text on = "") {
  const std::string part = on.empty() ? "" : fmt::format("on = \"{}\"\n", on);
  return fmt::format("[[load]]\nbody = \"{}\"\n{}value = {}\n", body, part, value);
}

/// A plane against an elastic body.
inline std::string plane(Text body, Text on, Text point, Text normal) {
  return fmt::format(
      "[[obstacle]]\ntype = \"contact\"\nbody = \"{}\"\non = \"{}\"\nshape = \"plane\"\npoint = {}\nnormal = {}\n",
      body, on, point, normal);
}

/// What a scalar body may not fall below.
inline std::string floor(Text body, Text lower) {
  return fmt::format("[[obstacle]]\ntype = \"scalar\"\nbody = \"{}\"\nlower = {}\n", body, lower);
}

inline std::string probe(Text name, Text body, Text at) {
  return fmt::format("[[probe]]\nname = \"{}\"\nbody = \"{}\"\nat = {}\n", name, body, at);
}

}  // namespace signorini::tables
