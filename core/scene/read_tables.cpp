#include "core/scene/read_tables.hpp"

#include "core/base/error.hpp"
#include "core/scene/table_reader.hpp"

namespace signorini {

Scene::Material read_material(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("material")->keys, folder);
  reader.check_keys();
  const auto field = [&](const char* key) {
    return reader.given(key) ? std::optional<Field>(reader.field(key)) : std::nullopt;
  };
  return {reader.text("body"), reader.text("volume"), field("young"),
          field("poisson"),    field("diffusion"),    reader.source()};
}

Scene::Fix read_fix(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("fix")->keys, folder);
  reader.check_keys();
  const std::optional<Selection> on = reader.selection();
  if (!on) input_error(reader.origin(), "neither 'on' nor 'where' is given, expected one of them");
  return {reader.text("body"), *on, reader.values("value"),
          reader.text("frame") == "normal" ? Frame::normal : Frame::global, reader.source()};
}

namespace {

/// Of a force or a torque, which has no free components.
std::vector<Field> all_given(const TableReader& reader, const char* key) {
  std::vector<Field> out;
  if (!reader.given(key)) return out;
  for (const std::optional<Field>& component : reader.values(key)) {
    if (!component) input_error(reader.origin(key), "expected a value per component; 0 is no force");
    out.push_back(*component);
  }
  return out;
}

}  // namespace

Scene::Rigid read_rigid(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("rigid")->keys, folder);
  reader.check_keys();
  const std::optional<Selection> on = reader.selection();
  if (!on) input_error(reader.origin(), "neither 'on' nor 'where' is given, expected one of them");
  Scene::Rigid rigid{reader.text("body"), *on, {}, {}, {}, all_given(reader, "force"), all_given(reader, "torque"),
                     reader.source()};
  if (reader.given("point")) rigid.point = reader.point("point");
  if (reader.given("displacement")) rigid.displacement = reader.values("displacement");
  if (reader.given("rotation")) rigid.rotation = reader.values("rotation");
  return rigid;
}

Scene::Load read_load(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("load")->keys, folder);
  reader.check_keys();
  Scene::Load load{reader.text("body"), reader.selection(), {}, reader.source()};
  for (const std::optional<Field>& component : reader.values("value")) {
    if (!component)
      input_error(reader.origin("value"), "'free' belongs into [[fix]]; a load has a value per component");
    load.value.push_back(*component);
  }
  return load;
}

Scene::Probe read_probe(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("probe")->keys, folder);
  reader.check_keys();
  return {reader.text("name"), reader.text("body"), reader.point("at"), reader.source()};
}

}  // namespace signorini
