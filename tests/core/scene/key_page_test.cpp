#include "core/scene/key_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/scene/table_reader.hpp"
#include "core/scene/toml.hpp"

namespace signorini {
namespace {
using testing::HasSubstr;

/// Reads the key as scenes do, which checks its type and range.
void read_key(const KeyPlace& place, const RawTable& table) {
  if (place.key->type == KeyType::file) return;  // which is not there
  TableReader reader(table, place.table ? place.table->keys : top_keys(), ".");
  if (place.shape) reader.use_shape(shapes_of(*place.table));
  const std::string_view key = place.key->name;
  switch (place.key->type) {
    case KeyType::boolean:
      return void(reader.flag(key));
    case KeyType::integer:
      return void(reader.integer(key));
    case KeyType::number:
      return void(reader.number(key));
    case KeyType::text:
      return void(reader.text(key));
    case KeyType::choice:
      return void(reader.choice(key));
    case KeyType::texts:
      return void(reader.texts(key));
    case KeyType::field:
      return void(reader.field(key));
    case KeyType::fields:
      return void(reader.fields(key));
    case KeyType::values:
      return void(reader.values(key));
    case KeyType::components:
      return void(reader.components(key));
    case KeyType::totals:
    case KeyType::moment:
      return void(reader.totals(key));
    case KeyType::point:
      return void(reader.point(key));
    case KeyType::points:
      return void(reader.points(key));
    case KeyType::integers:
      return void(reader.integers(key));
    case KeyType::ascending:
      return void(reader.ascending(key));
    case KeyType::condition:
    case KeyType::file:
      return;
  }
}

TEST(KeyPage, EveryKeyHasAnExampleThatScenesTake) {
  for (const KeyPlace& place : key_places()) {
    if (place.key->later == every_value) continue;
    const std::string example = key_example(place);
    SCOPED_TRACE(place.path() + "\n" + example);
    const RawDocument document = parse_toml(example, "example");
    const RawTable& table = place.table ? document.of(place.table->name).at(0) : document.top;
    ASSERT_TRUE(table.find(place.key->name));
    EXPECT_NO_THROW(read_key(place, table));
    EXPECT_THAT(key_page(place), HasSubstr(std::string(place.key->help).substr(0, 10)));
  }
}

TEST(KeyPage, IsFoundByItsPathOrItsNameAlone) {
  ASSERT_EQ(keys_named("solver.tolerance").size(), 1u);
  EXPECT_EQ(keys_named("solver.tolerance").front().path(), "solver.tolerance");
  EXPECT_EQ(keys_named("title").front().path(), "title");
  EXPECT_EQ(keys_named("tolerance").size(), 2u) << "of [refine], too";
  EXPECT_EQ(keys_named("body.ball.radius").size(), 1u);
  EXPECT_EQ(keys_named("body.radius").size(), 5u) << "of every round shape";
  EXPECT_TRUE(keys_named("solver.tolerence").empty());
}

TEST(KeyPage, SaysTypeRangeDefaultAndHowToSetIt) {
  const std::string page = key_page(keys_named("solver.cycle").front());
  for (const char* text : {"shape of the cycle", "V | W | F", "default   V", "cycle = \"W\"",
                           "signorini solve SCENE.toml --set solver.cycle=W", "full multigrid"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(key_page(keys_named("body.young").front()), HasSubstr("young = 210000"));
  for (const char* text : {"energy | force | peak_pressure", "goal = \"force\"", "\n  force: the largest normal force"})
    EXPECT_THAT(key_page(keys_named("refine.goal").front()), HasSubstr(text));
}

TEST(KeyPage, ChoicesThatAreExplainedHaveALineEach) {
  EXPECT_EQ(with_choices_on_lines("1: linear; 2: quadratic. auto: either; or not", "auto | 1 | 2"),
            "1: linear;\n2: quadratic.\nauto: either; or not");
  EXPECT_EQ(with_choices_on_lines("at most; all", "[0, 1]"), "at most; all");
}

TEST(TablePage, ListsKeysAndShapes) {
  const std::string page = table_page(*find_table("body"));
  for (const char* text : {"[[body]]", "young", "shape = \"ball\"", "cells"}) EXPECT_THAT(page, HasSubstr(text));
}

}  // namespace
}  // namespace signorini
