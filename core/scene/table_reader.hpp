#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/fem/model/model.hpp"
#include "core/input/field.hpp"
#include "core/input/raw.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/specs.hpp"

namespace signorini {

/// Reads one table against its specification. Every getter takes the name of a key of the specification and checks
/// type, range and availability; a missing value is the specification's default, or an error where there is none.
class TableReader {
 public:
  TableReader(const RawTable& table, std::span<const KeySpec> keys, const std::filesystem::path& folder);

  /// Adds the keys of the shape that the key `shape` names.
  const ShapeSpec& use_shape(std::span<const ShapeSpec> shapes);
  /// For messages about keys of shapes in a table without the key `shape`.
  void know_shapes(std::span<const ShapeSpec> shapes) { shapes_ = shapes; }
  /// Errors for keys that no specification knows, and for values that are not available in this version.
  void check_keys() const;
  /// The same, but unknown keys are returned: they are a plugin's.
  RawTable check_known_keys() const;

  bool given(std::string_view key) const { return table_.find(key) != nullptr; }
  /// Error unless the key is given; `why` completes "missing key 'young', required ...".
  void require(std::string_view key, std::string_view why) const;
  /// Error if the key is given; `where` completes "'young' has no meaning ...".
  void forbid(std::string_view key, std::string_view where) const;

  bool flag(std::string_view key) const;
  int integer(std::string_view key) const;
  double number(std::string_view key) const;
  std::string text(std::string_view key) const;
  /// Whole numbers as texts.
  std::string choice(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key) const;
  std::filesystem::path file(std::string_view key) const;
  Field field(std::string_view key) const;
  std::vector<Field> fields(std::string_view key) const;
  /// A field per component of the unknown; a single value is a list of one. "free" is empty.
  std::vector<std::optional<Field>> values(std::string_view key) const;
  /// A single value is a list of one.
  std::vector<Field> components(std::string_view key) const;
  /// A function of t per entry; a single value is a list of one. Empty where the key is not given.
  std::vector<Field> totals(std::string_view key) const;
  std::vector<double> point(std::string_view key) const;
  std::vector<std::vector<double>> points(std::string_view key) const;
  std::vector<Index> integers(std::string_view key) const;
  /// Not empty.
  std::vector<double> ascending(std::string_view key) const;
  /// What `on`, `where` or, in tables that have it, `at` pick; nothing when none is given, an error when several are.
  /// @param prefix of these keys: "other_"
  std::optional<Selection> selection(const std::string& prefix = "") const;

  const std::string& origin() const { return table_.origin; }
  const std::string& origin(std::string_view key) const;
  Scene::Source source() const;

 private:
  Selection parts(const std::string& key) const;
  const KeySpec* find_spec(std::string_view key) const;
  const KeySpec& spec(std::string_view key) const;
  RawValue value(const KeySpec& spec) const;
  void check_available(const KeySpec& spec, const RawValue& raw) const;
  void check_later() const;
  [[noreturn]] void unknown_key(const std::string& key, const RawValue& raw) const;

  const RawTable& table_;
  std::span<const KeySpec> keys_;
  std::span<const ShapeSpec> shapes_;
  const ShapeSpec* shape_ = nullptr;
  std::filesystem::path folder_;
};

/// Error(Exit::input) unless `folder` is an existing folder.
void check_folder(const std::filesystem::path& folder, const std::string& place);

/// What is wrong unless `file` is an existing file, with the nearest one of its folder; empty otherwise.
std::string file_complaint(const std::filesystem::path& file);

/// Error(Exit::input) with that complaint.
void check_file(const std::filesystem::path& file, const std::string& place);

}  // namespace signorini
