#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace signorini {

enum class KeyType {
  boolean,
  integer,
  number,  ///< or an expression without variables
  text,
  choice,      ///< one of several texts or whole numbers
  texts,       ///< one text or a list of them
  file,        ///< an existing file, relative to the scene's folder
  condition,   ///< an expression that picks boundary faces
  field,       ///< a number or an expression
  fields,      ///< a field per dimension
  values,      ///< a field per component of the unknown; a single one for scalar bodies
  components,  ///< a field for all components, or a list with one for each
  totals,      ///< the same, of t alone
  moment,      ///< a function of t for each axis; 2D: a single one
  point,       ///< a number per dimension
  points,      ///< a list of points
  integers,    ///< a whole number per dimension
  ascending,   ///< a list of numbers, each larger than the one before
};

inline constexpr std::string_view every_value = "*";  ///< the key itself

/// In a word or two: "whole number".
const char* type_name(KeyType type);

/// One key of a scene. The tables of these are the only place that knows them: validation, messages and the reference
/// come from here.
struct KeySpec {
  const char* name;
  KeyType type;
  const char* fallback;    ///< as TOML; "" for none; null when the key is required
  const char* range;       ///< as OptionSpec::range
  std::string_view later;  ///< what is understood, but not available in this version: a range, or every_value
  const char* help;
};

struct TableSpec {
  const char* name;
  bool listed;  ///< written `[[name]]`
  const char* help;
  std::span<const KeySpec> keys;
};

/// A shape of bodies or of obstacles: a set of further keys.
struct ShapeSpec {
  const char* name;
  int dimension;  ///< 2 or 3; 0 for both
  const char* help;
  std::span<const KeySpec> keys;
};

std::span<const KeySpec> top_keys();
std::span<const TableSpec> table_specs();
std::span<const ShapeSpec> body_shapes();
std::span<const ShapeSpec> obstacle_shapes();

/// Of bodies or of obstacles; none in other tables.
std::span<const ShapeSpec> shapes_of(const TableSpec& table);

const TableSpec* find_table(std::string_view name);
const KeySpec* find_key(std::span<const KeySpec> keys, std::string_view name);
const ShapeSpec* find_shape(std::span<const ShapeSpec> shapes, std::string_view name);
std::vector<std::string> names_of(std::span<const KeySpec> keys);
std::vector<std::string> names_of(std::span<const ShapeSpec> shapes);

/// All keys that a table may have whatever its shape; with repetitions.
std::vector<std::string> all_names(const TableSpec& table);

}  // namespace signorini
