#include "core/component/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/component/staging.hpp"

namespace signorini {
namespace {

using testing::AllOf;
using testing::HasSubstr;

template <int B>
struct Tool {
  virtual ~Tool() = default;
  virtual int size() const = 0;
};

template <int B>
struct Hammer : Tool<B> {
  int size() const override { return B; }
};

Entry entry(const std::string& kind, const std::string& id, const std::string& file = "a.so") {
  return {.kind = kind, .id = id, .help = "help", .options = {}, .file = file, .version = "1"};
}

void add_hammer(Registry& registry, const std::string& id, const std::string& file = "a.so") {
  registry.add<Tool<1>, Tool<2>>(
      entry("smoother", id, file), [] { return std::make_unique<Hammer<1>>(); },
      [] { return std::make_unique<Hammer<2>>(); });
}

template <class Function>
std::string error_of(Exit status, Function&& function) {
  try {
    function();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status);
    return error.what();
  }
  return "no error";
}

TEST(Registry, CreatesTheInterfaceAskedFor) {
  Registry registry;
  add_hammer(registry, "hammer");
  EXPECT_EQ(registry.create<Tool<1>>("smoother", "hammer")->size(), 1);
  EXPECT_EQ(registry.create<Tool<2>>("smoother", "hammer")->size(), 2);
}

TEST(Registry, AnUnknownIdNamesTheNearestAndAllOfItsKind) {
  Registry registry;
  add_hammer(registry, "forward");
  add_hammer(registry, "backward");
  registry.add<Tool<1>>(entry("coarse", "forwards"), [] { return std::make_unique<Hammer<1>>(); });
  EXPECT_THAT(error_of(Exit::input, [&] { registry.create<Tool<1>>("smoother", "foward"); }),
              AllOf(HasSubstr("no smoother 'foward'"), HasSubstr("did you mean 'forward'?"),
                    HasSubstr("(available: backward, forward)")));
}

TEST(Registry, AnInterfaceThatAComponentLacksIsAnError) {
  Registry registry;
  add_hammer(registry, "hammer");
  EXPECT_THAT(error_of(Exit::input, [&] { registry.create<Tool<3>>("smoother", "hammer"); }), HasSubstr("'hammer'"));
  EXPECT_THAT(error_of(Exit::input, [&] { registry.obstacle("hammer"); }), HasSubstr("no obstacle 'hammer'"));
}

TEST(Registry, ADuplicateNamesBothProvidersAndKeepsTheFirst) {
  Registry registry;
  add_hammer(registry, "hammer", "first.so");
  EXPECT_THAT(error_of(Exit::plugin, [&] { add_hammer(registry, "hammer", "second.so"); }),
              AllOf(HasSubstr("smoother 'hammer'"), HasSubstr("first.so"), HasSubstr("second.so")));
  EXPECT_EQ(registry.entry("smoother", "hammer").file, "first.so");
}

TEST(Registry, TheSameIdMayStandInTwoKinds) {
  Registry registry;
  add_hammer(registry, "auto");
  EXPECT_NO_THROW(registry.add<Tool<1>>(entry("coarse", "auto"), [] { return std::make_unique<Hammer<1>>(); }));
  EXPECT_EQ(registry.entries("coarse").size(), 1u);
  EXPECT_EQ(registry.entries().size(), 2u);
}

TEST(Registry, KnowsTheFileOfAnAddress) {
  EXPECT_THAT(file_of(reinterpret_cast<const void*>(&file_of)), testing::HasSubstr("/libsignorini_core.so."));
}

Obstacle<1>* null_creator(const Settings&, Status&) noexcept { return nullptr; }

ObstacleType type(const char* id, std::span<const OptionSpec> options = {}) {
  return {id, "help", options.data(), options.size(), false, null_creator, nullptr, nullptr};
}

// What the registrar says to one obstacle type.
std::string complaint(const ObstacleType& obstacle) {
  StagingRegistrar staging;
  Status status;
  staging.obstacle(obstacle, status);
  Registry registry;
  EXPECT_EQ(error_of(Exit::plugin, [&] { staging.commit(registry, "a.so", "1"); }), status.message);
  EXPECT_TRUE(registry.entries().empty());
  return status.message;
}

TEST(StagingRegistrar, IsInvisibleUntilItIsCommitted) {
  StagingRegistrar staging;
  Status status;
  staging.obstacle(type("a"), status);
  staging.obstacle(type("b"), status);
  EXPECT_TRUE(status.ok());
  Registry registry;
  staging.commit(registry, "a.so", "2.0");
  EXPECT_EQ(registry.entries("obstacle").size(), 2u);
  EXPECT_EQ(registry.entry("obstacle", "b").version, "2.0");
  EXPECT_EQ(registry.obstacle("a").create1, &null_creator);
}

TEST(StagingRegistrar, CommitsAllOrNothing) {
  Registry registry;
  registry.add_obstacle(type("b"), entry("", "", "first.so"));
  StagingRegistrar staging;
  Status status;
  staging.obstacle(type("a"), status);
  staging.obstacle(type("b"), status);
  EXPECT_THAT(error_of(Exit::plugin, [&] { staging.commit(registry, "second.so", "1"); }),
              AllOf(HasSubstr("first.so"), HasSubstr("second.so")));
  EXPECT_FALSE(registry.has("obstacle", "a"));
}

TEST(StagingRegistrar, RefusesFaultyTypes) {
  static constexpr OptionSpec twice[] = {{"a", OptionType::number, "", "", ""}, {"a", OptionType::text, "", "", ""}};
  static constexpr OptionSpec null[] = {{"a", OptionType::number, nullptr, "", ""}};
  static constexpr OptionSpec taken[] = {{"where", OptionType::number, "", "", ""}};
  EXPECT_THAT(complaint(type("A b")), HasSubstr("'A b' is no obstacle id"));
  EXPECT_THAT(complaint(type("")), HasSubstr("no obstacle id"));
  EXPECT_THAT(complaint(type(nullptr)), HasSubstr("no obstacle id"));
  EXPECT_THAT(complaint(type("a", twice)), HasSubstr("option 'a' stands twice"));
  EXPECT_THAT(complaint(type("a", null)), HasSubstr("null text"));
  EXPECT_THAT(complaint(type("a", taken)), HasSubstr("'where' has the name of a key of every obstacle"));
  ObstacleType without = type("a");
  without.create1 = nullptr;
  EXPECT_THAT(complaint(without), HasSubstr("no constructor"));
}

TEST(StagingRegistrar, TakesEstimatorsAndRefusesFaultyOnes) {
  const auto create = [](Status&) noexcept -> ErrorEstimator* { return nullptr; };
  const auto complaint_of = [](const EstimatorType& type) {
    StagingRegistrar staging;
    Status status;
    staging.estimator(type, status);
    Registry registry;
    if (status.ok()) staging.commit(registry, "a.so", "1");
    EXPECT_EQ(registry.has("estimator", "a"), status.ok());
    return std::string(status.message);
  };
  EXPECT_EQ(complaint_of({"a", "help", create}), "");
  EXPECT_THAT(complaint_of({"A b", "help", create}), HasSubstr("'A b' is no estimator id"));
  EXPECT_THAT(complaint_of({"a", nullptr, create}), HasSubstr("no help"));
  EXPECT_THAT(complaint_of({"a", "help", nullptr}), HasSubstr("no constructor"));
  EXPECT_THAT(complaint_of({"a", "help", create, 8}), HasSubstr("SampledElement has 8 bytes in the plugin"));
}

TEST(StagingRegistrar, RefusesToRegisterNothing) {
  Registry registry;
  EXPECT_THAT(error_of(Exit::plugin, [&] { StagingRegistrar().commit(registry, "a.so", "1"); }), HasSubstr("nothing"));
}

}  // namespace
}  // namespace signorini
