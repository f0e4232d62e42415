#include "core/scene/read_tables.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/scene/table_reader.hpp"

namespace signorini {
namespace {

/// Of tables that need one.
/// @param missing what an error says of the keys
Selection picked(const TableReader& reader, const char* missing) {
  const std::optional<Selection> on = reader.selection();
  if (!on) input_error(reader.origin(), fmt::format("{} is given, expected one of them", missing));
  return *on;
}

Frame frame(const TableReader& reader) {
  const std::string name = reader.text("frame");
  return name == "normal" ? Frame::normal : name == "cylindrical" ? Frame::cylindrical : Frame::global;
}

Scene::FrameAxis axis(const TableReader& reader) {
  const auto given = [&](const char* key) { return reader.given(key) ? reader.point(key) : std::vector<double>(); };
  return {given("center"), given("axis")};
}

}  // namespace

Scene::Material read_material(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("material")->keys, folder);
  reader.check_keys();
  const auto field = [&](const char* key) {
    return reader.given(key) ? std::optional<Field>(reader.field(key)) : std::nullopt;
  };
  return {reader.text("body"), reader.text("volume"), field("young"), field("poisson"),
          field("diffusion"),  field("expansion"),    reader.source()};
}

Scene::Fix read_fix(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("fix")->keys, folder);
  reader.check_keys();
  return {reader.text("body"),    picked(reader, "neither 'on' nor 'where' nor 'at'"),
          reader.values("value"), frame(reader),
          reader.source(),        axis(reader)};
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
  if (reader.given("value"))
    for (const std::optional<Field>& component : reader.values("value")) {
      if (!component)
        input_error(reader.origin("value"), "'free' belongs into [[fix]]; a load has a value per component");
      load.value.push_back(*component);
    }
  if (reader.given("pressure")) load.pressure = reader.field("pressure");
  load.where_open = reader.flag("where_open");
  if (reader.given("from")) load.from = reader.text("from");
  load.force = reader.totals("force");
  load.torque = reader.totals("torque");
  if (reader.given("about")) load.about = reader.point("about");
  load.frame = frame(reader);
  load.axis = axis(reader);
  return load;
}

Scene::Spring read_spring(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("spring")->keys, folder);
  reader.check_keys();
  const bool total = reader.given("total");
  if (total == reader.given("stiffness"))
    input_error(reader.origin(total ? "total" : ""),
                fmt::format("{} 'stiffness' {} 'total' {} given, expected one of them", total ? "both" : "neither",
                            total ? "and" : "nor", total ? "are" : "is"));
  if (total) reader.totals("total");  // which refuses what depends on the place
  return {reader.text("body"),
          picked(reader, "neither 'on' nor 'where'"),
          reader.components(total ? "total" : "stiffness"),
          total,
          frame(reader),
          reader.source(),
          axis(reader)};
}

Scene::Probe read_probe(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("probe")->keys, folder);
  reader.check_keys();
  return {reader.text("name"), reader.text("body"), reader.point("at"), reader.source()};
}

}  // namespace signorini
