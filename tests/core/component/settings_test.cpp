#include "core/component/settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/sdk/obstacle.hpp"

namespace signorini {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr OptionSpec specs[] = {
    {"fast", OptionType::boolean, "true", "", ""},
    {"count", OptionType::integer, "3", "[1, 9]", ""},
    {"weight", OptionType::number, "1/4", "(0, 1]", ""},
    {"mode", OptionType::text, "soft", "soft | hard", ""},
    {"bound", OptionType::field, "x + t", "", ""},
    {"axis", OptionType::vector, "[0, x, 2*y]", "", ""},
    {"extra", OptionType::field, "", "", ""},
};

const double point[3] = {1, 2, 3}, normal[3] = {0, 0, -1};

RawTable table(std::vector<std::pair<std::string, RawValue>> entries) {
  return {"scene.toml:7: obstacle.0", std::move(entries)};
}

RawValue raw(decltype(RawValue::value) value) { return {std::move(value), "scene.toml:9: obstacle.0.key"}; }

std::string rejection(const std::string& key, decltype(RawValue::value) value) {
  try {
    const std::vector<std::string> others = {"friction_model"};
    compile_settings("obstacle 'test'", specs, table({{key, raw(std::move(value))}}), others);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "no error";
}

TEST(Settings, DefaultsAreFilledInAndAreNotGiven) {
  const auto settings = compile_settings("obstacle 'test'", specs, table({}), {}, nullptr, 0.5);
  EXPECT_TRUE(settings->flag("fast"));
  EXPECT_EQ(settings->integer("count"), 3);
  EXPECT_EQ(settings->number("weight"), 0.25);
  EXPECT_STREQ(settings->text("mode"), "soft");
  for (const OptionSpec& spec : specs) EXPECT_FALSE(settings->has(spec.name));
  Status status;
  EXPECT_EQ(settings->value("bound", 0, point, normal, status), 1.5);
  ASSERT_EQ(settings->length("axis"), 3u);
  EXPECT_EQ(settings->value("axis", 0, point, normal, status), 0);
  EXPECT_EQ(settings->value("axis", 1, point, normal, status), 1);
  EXPECT_EQ(settings->value("axis", 2, point, normal, status), 4);
  EXPECT_TRUE(status.ok());
  EXPECT_EQ(settings->shape(), nullptr);
}

TEST(Settings, GivenValuesReplaceDefaults) {
  const auto settings = compile_settings("obstacle 'test'", specs,
                                         table({{"fast", raw(false)},
                                                {"count", raw(std::int64_t{9})},
                                                {"weight", raw(1.0)},
                                                {"mode", raw(std::string("hard"))},
                                                {"bound", raw(std::string("nz * z"))},
                                                {"axis", raw(RawValue::List{raw(1.5), raw(std::string("y"))})}}));
  EXPECT_FALSE(settings->flag("fast"));
  EXPECT_EQ(settings->integer("count"), 9);
  EXPECT_EQ(settings->number("weight"), 1);
  EXPECT_STREQ(settings->text("mode"), "hard");
  EXPECT_TRUE(settings->has("bound"));
  EXPECT_FALSE(settings->has("extra"));
  Status status;
  EXPECT_EQ(settings->value("bound", 0, point, normal, status), -3);
  EXPECT_EQ(settings->length("axis"), 2u);
  EXPECT_EQ(settings->value("axis", 1, point, normal, status), 2);
}

TEST(Settings, AnUnknownKeyNamesPlaceComponentAndTheNearestKey) {
  EXPECT_THAT(rejection("wieght", 1.0), AllOf(HasSubstr("scene.toml:9"), HasSubstr("obstacle 'test'"),
                                              HasSubstr("'wieght'"), HasSubstr("did you mean 'weight'?")));
  EXPECT_THAT(rejection("friction_modle", 1.0), HasSubstr("did you mean 'friction_model'?"));
}

TEST(Settings, AnotherTypeIsRejected) {
  EXPECT_THAT(rejection("fast", 1.0), HasSubstr("scene.toml:9"));
  EXPECT_THAT(rejection("count", 1.5), HasSubstr("scene.toml:9"));
  EXPECT_THAT(rejection("weight", true), HasSubstr("scene.toml:9"));
  EXPECT_THAT(rejection("mode", 1.0), HasSubstr("scene.toml:9"));
  EXPECT_THAT(rejection("axis", 1.0), HasSubstr("scene.toml:9"));
  EXPECT_THAT(rejection("bound", std::string("x +")), HasSubstr("scene.toml:9"));
}

TEST(Settings, AValueOutOfRangeIsRejectedWithTheRange) {
  EXPECT_THAT(rejection("count", std::int64_t{10}), HasSubstr("[1, 9]"));
  EXPECT_THAT(rejection("weight", 0.0), HasSubstr("(0, 1]"));
  EXPECT_THAT(rejection("mode", std::string("sofd")), HasSubstr("soft"));
}

TEST(Settings, AFieldThatIsNotFiniteIsAStatusThatNamesItsPlace) {
  const auto settings = compile_settings("obstacle 'test'", specs, table({{"bound", raw(std::string("1/(x-1)"))}}));
  Status status;
  settings->value("bound", 0, point, normal, status);
  EXPECT_EQ(status.code, static_cast<int>(Exit::input));
  EXPECT_THAT(status.message, AllOf(HasSubstr("scene.toml:9"), HasSubstr("1/(x-1)")));
}

TEST(Settings, ValuesAtManyVerticesAreThoseOneByOne) {
  const auto settings = compile_settings("obstacle 'test'", specs,
                                         table({{"bound", raw(std::string("x < 50 ? x : nz * t"))}}), {}, nullptr, 0.5);
  std::vector<SurfaceVertex> vertices(150);
  for (std::size_t k = 0; k < vertices.size(); ++k) vertices[k] = {{static_cast<double>(k)}, {0, 0, -1}};
  std::vector<double> values(vertices.size());
  Status status;
  settings->values("bound", vertices.data(), vertices.size(), values.data(), status);
  ASSERT_TRUE(status.ok()) << status.message;
  for (std::size_t k = 0; k < vertices.size(); ++k) EXPECT_EQ(values[k], k < 50 ? static_cast<double>(k) : -0.5);
  settings->values("extra", vertices.data(), 1, values.data(), status);
  EXPECT_FALSE(status.ok());
}

TEST(Settings, AFieldWithoutValueIsAStatus) {
  const auto settings = compile_settings("obstacle 'test'", specs, table({}));
  Status status;
  settings->value("extra", 0, point, normal, status);
  EXPECT_FALSE(status.ok());
  Status beyond;
  settings->value("axis", 3, point, normal, beyond);
  EXPECT_FALSE(beyond.ok());
}

}  // namespace
}  // namespace signorini
