// Plugins that were linked with another version of the SDK's library.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

#include "core/base/error.hpp"
#include "core/component/plugin_loader.hpp"
#include "core/component/settings.hpp"
#include "core/sdk/plugin.hpp"

namespace signorini {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string rejection(Registry& registry, const std::string& folder, const std::string& id) {
  PluginLoader loader(registry, {folder});
  try {
    loader.require(id);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string rebuild() {
  return "rebuild against SDK " + std::to_string(sdk::abi_major) + "." + std::to_string(sdk::abi_minor);
}

TEST(KeptPlugin, IsLoadedAndGivesItsBounds) {
  Registry registry;
  const std::string reason = rejection(registry, SIGNORINI_SOURCE_DIR "/tests/obstacles/kept", "slot");
  if (!reason.empty()) {  // by another compiler, under sanitizers, or an interface of another major version
    EXPECT_THAT(reason, HasSubstr(rebuild()));
    GTEST_SKIP() << reason;
  }
  const RawValue gap{std::string("x / 4"), "gap"}, axis{RawValue::List{{0.0, "axis"}, {2.0, "axis"}}, "axis"};
  const auto settings = compile_settings("obstacle 'slot'", registry.entry("obstacle", "slot").options,
                                         {"slot", {{"gap", gap}, {"axis", axis}}});
  Status status;
  const std::unique_ptr<Obstacle<2>> slot(registry.obstacle("slot").create2(*settings, status));
  ASSERT_TRUE(slot) << status.message;
  LocalConstraint<2> c;
  const SurfaceVertex vertex = {{2, 0, 0}, {0, 1, 0}};
  slot->assemble(&vertex, 1, &c, status);
  EXPECT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(c.directions, 1);
  EXPECT_EQ(c.direction[0][1], 1);
  EXPECT_EQ(c.lower[0], -0.5);
  EXPECT_EQ(c.upper[0], 0.5);
}

// Compiled against the headers of version 0.2.0.
TEST(LastRelease, APluginOfItIsLoadedOrRefusedInOneMessageWithTheCure) {
  Registry registry;
  const std::string reason = rejection(registry, SIGNORINI_SOURCE_DIR "/tests/obstacles/last_release", "slot");
  if (reason.empty()) {
    EXPECT_TRUE(registry.has("obstacle", "slot"));
  } else {
    EXPECT_THAT(reason, HasSubstr(rebuild()));
  }
}

TEST(LastRelease, AnSdkThatIsNotThereIsNamedWithTheCure) {
  Registry registry;
  EXPECT_THAT(rejection(registry, SIGNORINI_FIXTURES "/old", "old_sdk"),
              AllOf(HasSubstr("libsignorini_sdk.so.4"), HasSubstr("linked with another version of signorini"),
                    HasSubstr(rebuild())));
}

}  // namespace
}  // namespace signorini
