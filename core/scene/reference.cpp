#include <fmt/format.h>

#include "core/base/markdown.hpp"
#include "core/input/expression.hpp"
#include "core/scene/examples.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/specs.hpp"

namespace signorini {

const char* type_name(KeyType type) {
  switch (type) {
    case KeyType::boolean:
      return "true or false";
    case KeyType::integer:
      return "whole number";
    case KeyType::number:
      return "number";
    case KeyType::text:
      return "text";
    case KeyType::choice:
      return "text or whole number";
    case KeyType::texts:
      return "text or list of texts";
    case KeyType::file:
      return "file";
    case KeyType::condition:
      return "expression";
    case KeyType::field:
      return "number or expression";
    case KeyType::fields:
      return "list of numbers or expressions, one per dimension";
    case KeyType::values:
      return "list of numbers or expressions, one per component; for scalar bodies a single one";
    case KeyType::components:
      return "number or expression; or a list with one per component";
    case KeyType::totals:
      return "list of numbers or expressions in t, one per component; for scalar bodies a single one";
    case KeyType::moment:
      return "3D: list of three numbers or expressions in t; 2D: a single one";
    case KeyType::point:
      return "list of numbers, one per dimension";
    case KeyType::points:
      return "list of points";
    case KeyType::integers:
      return "list of whole numbers, one per dimension";
    case KeyType::ascending:
      return "ascending list of numbers";
  }
  return "";
}

namespace {

std::string default_of(const KeySpec& key) {
  if (!key.fallback) return "required";
  if (!*key.fallback) return "";
  const bool word = (key.type == KeyType::text || key.type == KeyType::choice) && *key.fallback != '"';
  return word ? fmt::format("`\"{}\"`", key.fallback) : fmt::format("`{}`", key.fallback);
}

std::string note_of(const KeySpec& key) {
  if (key.later.empty()) return "";
  if (key.later == every_value) return " *Not yet available.*";
  return fmt::format(" *Not yet available: {}.*", in_cell(key.later));
}

std::string keys_table(std::span<const KeySpec> keys) {
  std::string text = "| key | type | default | range | |\n| --- | --- | --- | --- | --- |\n";
  for (const KeySpec& key : keys)
    text += fmt::format("| `{}` | {} | {} | {} | {}.{} |\n", key.name, type_name(key.type), default_of(key),
                        in_cell(key.range), key.help, note_of(key));
  return text;
}

std::string shapes_section(std::string_view title, std::span<const ShapeSpec> shapes) {
  std::string text = fmt::format("\n### {}\n", title);
  for (const ShapeSpec& shape : shapes) {
    const std::string dimension = shape.dimension == 0 ? "2D and 3D" : fmt::format("{}D", shape.dimension);
    text +=
        fmt::format("\n`shape = \"{}\"` ({}): {}.\n\n{}", shape.name, dimension, shape.help, keys_table(shape.keys));
  }
  return text;
}

std::string functions() {
  std::string text;
  for (const ExpressionFunction& f : expression_functions())
    text += fmt::format("{}`{}`", text.empty() ? "" : " ", f.name);
  return text;
}

constexpr const char* introduction_to_scenes = R"md(# Scenes

<!-- Written by scene_reference(); a test compares. Do not edit. -->

A scene is a TOML file that says what is solved: a body, what holds and loads it, and what it may not penetrate. This page lists
every table and key. [Solve a scene](solve_a_scene.md) is the guide, and [apps/scenes](../apps/scenes/README.md) has scenes to
start from. The examples on this page, put together, are a scene.

- All bodies of a scene have the same dimension: all are in the plane, or all are in space.
- Lengths, moduli and forces are in any one consistent system of units.
- File names are relative to the scene's folder.
- Unknown keys are errors.
- Any key can be changed on the command line by its dotted path, tables that may stand several times by their number:
  `--set solver.tolerance=1e-6`, `--set fix.0.value.2=-0.05`.

## Expressions

Where a number is expected, a text is an expression:

| written | means |
| --- | --- |
| `where = "z > 0.5 && x < 1"` | the faces whose vertices all lie there |
| `value = [0, "-0.01*(1 + cos(pi*x))"]` | moved down by different amounts |
| `young = "x < 1 ? 1 : 1000"` | two materials |
| `value = ["-2*nx", "-2*ny", "-2*nz"]` | a load of 2 against the outer normal: a pressure |
| `radius = "2*cos(pi/6)"` | a number, computed |

| name | is | may be used where |
| --- | --- | --- |
| `x`, `y`, `z` | the position | the tables below say *number or expression* |
| `nx`, `ny`, `nz` | the outer normal | the same, on boundaries only |
| `t` | the step parameter, see `[steps]` | the same |
| `pi` | the number | everywhere |

Functions are named and meant as in C. `log` is natural; `min` and `max` take two or more arguments; `sign` is -1, 0 or 1:

{}

Operators bind as in C: `!` and signs, `* /`, `+ -`, `< > <= >=`, `== !=`, `&&`, `||`, `c ? a : b`. `^` is power. It binds
more tightly than a sign, and from the right: `-x^2` is `-(x^2)`, `2^3^2` is `2^9`.

A value that is not finite where it is used is an error.

## Outside any table

{}{})md";

std::string example_of(std::string_view table) {
  const std::string_view example = table_text(table).example;
  return example.empty() ? "" : fmt::format("```toml\n{}\n```\n\n", example);
}

}  // namespace

std::string scene_reference() {
  std::string text = fmt::format(introduction_to_scenes, functions(), example_of(""), keys_table(top_keys()));
  for (const TableSpec& table : table_specs()) {
    const std::string name = table.listed ? fmt::format("[[{}]]", table.name) : fmt::format("[{}]", table.name);
    text += fmt::format("\n## `{}`\n\n{}\n\n{}{}{}", name, table.help, example_of(table.name), keys_table(table.keys),
                        table_text(table.name).details);
    if (std::string_view(table.name) == "body") text += shapes_section("Shapes of bodies", body_shapes());
    if (std::string_view(table.name) == "obstacle")
      text += shapes_section("Shapes of rigid obstacles", obstacle_shapes());
  }
  return text;
}

}  // namespace signorini
