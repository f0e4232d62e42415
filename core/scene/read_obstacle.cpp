#include <fmt/format.h>

#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/read_tables.hpp"
#include "core/scene/table_reader.hpp"

namespace signorini {
namespace {

// `normal = "body"` is an option of plugins; only a list belongs to the shape.
bool has_normal(const TableReader& reader, const RawTable& table) {
  return reader.given("normal") && std::holds_alternative<RawValue::List>(table.find("normal")->value);
}

/// Beside the normal of a plane the plugin's option has another name.
void refuse_word(const TableReader& reader, const RawTable& table) {
  if (reader.given("normal") && !has_normal(reader, table))
    input_error(reader.origin("normal"),
                "'normal' is that of the plane, a list of numbers or expressions that points towards the body; the "
                "option 'normal' of the obstacle's type is called 'along' beside a plane, as in along = \"body\"");
}

Pairing pairing(const TableReader& reader) {
  return reader.text("pairing") == "closest" ? Pairing::closest : Pairing::normal;
}

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Scene::ObstacleShape shape(const TableReader& reader, const RawTable& table, std::string_view name) {
  if (name == "plane") {
    refuse_word(reader, table);
    return Scene::PlaneShape{reader.fields("point"), reader.fields("normal")};
  }
  if (name == "sphere")
    return Scene::SphereShape{reader.fields("center"), reader.field("radius"), reader.flag("inside")};
  if (name == "cylinder")
    return Scene::CylinderShape{reader.fields("center"), reader.fields("axis"), reader.field("radius")};
  if (name == "surface") {
    if (reader.text("geometry") == "facets") return Scene::SurfaceShape{reader.file("file"), {}};
    return Scene::SurfaceShape{reader.file("file"), radians(reader.number("crease"))};
  }
  Scene::ExpressionShape given{reader.field("distance"), {}};
  if (has_normal(reader, table)) given.normal = reader.fields("normal");
  return given;
}

}  // namespace

Scene::Obstacle read_obstacle(const RawTable& table, const std::filesystem::path& folder) {
  TableReader reader(table, find_table("obstacle")->keys, folder);
  Scene::Obstacle obstacle;
  const ShapeSpec* spec = reader.given("shape") ? &reader.use_shape(obstacle_shapes()) : nullptr;
  obstacle.type = reader.text("type");
  if (obstacle.type.empty())
    input_error(reader.origin("type"), "the type is empty, expected one of `signorini list obstacles`");
  obstacle.options = reader.check_known_keys();
  obstacle.source = reader.source();
  obstacle.body = reader.text("body");
  obstacle.on = reader.selection();
  if (reader.given("other")) obstacle.other = reader.text("other");
  obstacle.other_on = reader.selection("other_");
  const std::string slave = reader.text("slave");
  obstacle.slave = slave == "body" ? Slave::body : slave == "other" ? Slave::other : Slave::automatic;
  obstacle.pairing = pairing(reader);
  obstacle.resolve = reader.flag("resolve");
  obstacle.renew = reader.flag("renew");
  if (reader.given("pretension")) {
    reader.totals("pretension");  // which refuses what depends on the place
    obstacle.pretension = reader.field("pretension");
  }
  if (reader.given("lock_at")) obstacle.lock_at = reader.number("lock_at");
  if (!spec) return obstacle;
  obstacle.shape_name = spec->name;
  obstacle.shape = shape(reader, table, spec->name);
  const std::string_view name = spec->name;
  if (name == "expression" && reader.given("normal") && !has_normal(reader, table))
    obstacle.options.entries.emplace_back("normal", *table.find("normal"));
  if ((name == "plane" || name == "expression") && reader.given("along")) {
    reader.text("along");  // or it is refused
    if (obstacle.options.find("normal"))
      input_error(reader.origin("along"), "'normal' says it, too; expected one of the two");
    obstacle.options.entries.emplace_back("normal", *table.find("along"));
  }
  return obstacle;
}

Scene::Contact read_contact(const RawTable& table, const std::filesystem::path& folder) {
  const TableReader reader(table, find_table("contact")->keys, folder);
  reader.check_keys();
  Scene::Contact contact;
  contact.between = reader.texts("between");
  if (contact.between == std::vector<std::string>{"all"})
    contact.between.clear();
  else if (contact.between.size() < 2)
    input_error(reader.origin("between"), "expected \"all\", or the names of two bodies or more");
  if (reader.given("friction")) {
    reader.field("friction");  // or it is refused
    contact.friction = *table.find("friction");
  }
  if (reader.given("reach")) contact.reach = reader.number("reach");
  contact.adjust = reader.number("adjust");
  contact.pairing = pairing(reader);
  contact.resolve = reader.flag("resolve");
  contact.renew = reader.flag("renew");
  contact.source = reader.source();
  return contact;
}

std::vector<std::string> Scene::Obstacle::core_keys() const {
  std::vector<std::string> keys = names_of(find_table("obstacle")->keys);
  if (const ShapeSpec* spec = find_shape(obstacle_shapes(), shape_name))
    for (const std::string& key : names_of(spec->keys)) keys.push_back(key);
  return keys;
}

}  // namespace signorini
