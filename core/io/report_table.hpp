#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/types.hpp"

/// Tables of what report.json holds: the only place that knows its keys. The file itself, docs/report.md and the schema
/// are made from them.
namespace signorini::report {

using Json = nlohmann::ordered_json;

enum class Kind { flag, whole, number, text, numbers, texts, object, objects, nothing };

struct ObjectSpec;

/// A key as people and the schema read it.
struct KeySpec {
  std::string name;
  Kind kind;
  std::string help;
  bool null = false;                        ///< may be null; numbers may in any case
  bool sometimes = false;                   ///< may be left out
  const ObjectSpec& (*object)() = nullptr;  ///< of objects, and of lists of them
};

struct ObjectSpec {
  std::string name;  ///< in the schema
  std::vector<KeySpec> keys;
};

/// A key with its value in what it belongs to. One that is left out is discarded.
template <class T>
struct Row {
  KeySpec key;
  std::function<Json(const T&)> value;
};

/// Specialised for everything that is an object of the report: `name`, and `rows()`.
template <class T>
struct Table;

template <class T>
const std::vector<Row<T>>& rows() {
  static const std::vector<Row<T>> made = Table<T>::rows();
  return made;
}

template <class T>
const ObjectSpec& object_spec() {
  static const ObjectSpec made = [] {
    ObjectSpec spec{Table<T>::name, {}};
    for (const Row<T>& row : rows<T>()) spec.keys.push_back(row.key);
    return spec;
  }();
  return made;
}

template <class T>
Json as_object(const T& of) {
  Json json = Json::object();
  for (const Row<T>& row : rows<T>())
    if (Json value = row.value(of); !value.is_discarded()) json[row.key.name] = std::move(value);
  return json;
}

/// An empty list stays one.
template <class T>
Json as_objects(const std::vector<T>& list) {
  Json json = Json::array();
  for (const T& entry : list) json.push_back(as_object(entry));
  return json;
}

inline Json left_out() { return Json(Json::value_t::discarded); }

template <class V>
constexpr Kind kind_of() {
  if constexpr (std::is_same_v<V, bool>) return Kind::flag;
  if constexpr (std::is_same_v<V, int> || std::is_same_v<V, Index>) return Kind::whole;
  if constexpr (std::is_same_v<V, double>) return Kind::number;
  if constexpr (std::is_same_v<V, std::string>) return Kind::text;
  if constexpr (std::is_same_v<V, std::vector<double>>) return Kind::numbers;
  if constexpr (std::is_same_v<V, std::vector<std::string>>) return Kind::texts;
}

/// A member as it is.
template <class T, class V>
Row<T> member(const char* name, V T::*of, const char* help) {
  return {{name, kind_of<V>(), help}, [of](const T& value) -> Json { return value.*of; }};
}

template <class T, class V>
Row<T> objects(const char* name, std::vector<V> T::*of, const char* help) {
  return {{name, Kind::objects, help, false, false, &object_spec<V>},
          [of](const T& value) { return as_objects(value.*of); }};
}

template <class T, class V>
Row<T> object(const char* name, V T::*of, const char* help) {
  return {{name, Kind::object, help, false, false, &object_spec<V>},
          [of](const T& value) { return as_object(value.*of); }};
}

/// The rows of a part, with part(whole) in their place.
template <class T, class Part, class Find>
std::vector<Row<T>> of_part(const std::vector<Row<Part>>& part, Find find) {
  std::vector<Row<T>> all;
  all.reserve(part.size());
  for (const Row<Part>& row : part)
    all.push_back({row.key, [value = row.value, find](const T& whole) { return value(find(whole)); }});
  return all;
}

template <class T>
void add(std::vector<Row<T>>& all, std::vector<Row<T>> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace signorini::report
