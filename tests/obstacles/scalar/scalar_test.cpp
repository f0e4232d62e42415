// The scalar obstacle as its plugin provides it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/component/plugin_loader.hpp"
#include "core/component/settings.hpp"

namespace signorini {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Scalar : public testing::Test {
 protected:
  using Bounds = std::vector<std::pair<std::string, std::string>>;

  Scalar() { PluginLoader(registry_).require("scalar"); }

  std::unique_ptr<Obstacle<1>> create(const Bounds& bounds, Status& status) {
    RawTable table{"scene.toml:1: obstacle.0", {}};
    for (const auto& [key, text] : bounds) table.entries.push_back({key, {text, "scene.toml:2: obstacle.0." + key}});
    settings_ = compile_settings("obstacle 'scalar'", registry_.entry("obstacle", "scalar").options, table);
    return std::unique_ptr<Obstacle<1>>(registry_.obstacle("scalar").create1(*settings_, status));
  }

  LocalConstraint<1> assemble(const Bounds& bounds, const SurfaceVertex& vertex, Status& status) {
    LocalConstraint<1> constraint;
    const auto obstacle = create(bounds, status);
    if (status.ok()) obstacle->assemble(&vertex, 1, &constraint, status);
    return constraint;
  }

  Registry registry_;
  std::shared_ptr<const Settings> settings_;
};

const SurfaceVertex vertex = {{0.5, -2, 3}, {0, 1, 0}};

TEST_F(Scalar, BoundsTheUnknownByTheFieldsAtTheVertex) {
  Status status;
  const auto c = assemble({{"lower", "x + y"}, {"upper", "z * ny"}}, vertex, status);
  ASSERT_TRUE(status.ok()) << status.message;
  EXPECT_EQ(c.directions, 1);
  EXPECT_EQ(c.direction[0][0], 1);
  EXPECT_EQ(c.lower[0], -1.5);
  EXPECT_EQ(c.upper[0], 3);
}

TEST_F(Scalar, AMissingBoundIsInfinite) {
  Status status;
  EXPECT_EQ(assemble({{"lower", "0"}}, vertex, status).upper[0], infinity);
  EXPECT_EQ(assemble({{"upper", "0"}}, vertex, status).lower[0], -infinity);
  EXPECT_TRUE(status.ok());
}

TEST_F(Scalar, EqualBoundsAreAdmissible) {
  Status status;
  assemble({{"lower", "1"}, {"upper", "1"}}, vertex, status);
  EXPECT_TRUE(status.ok());
}

TEST_F(Scalar, EveryVertexGetsItsOwnBounds) {
  Status status;
  const auto obstacle = create({{"lower", "x"}}, status);
  const SurfaceVertex vertices[3] = {{{1, 0, 0}, {}}, {{2, 0, 0}, {}}, {{3, 0, 0}, {}}};
  LocalConstraint<1> c[3];
  obstacle->assemble(vertices, 3, c, status);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(c[k].lower[0], k + 1);
}

TEST_F(Scalar, NeedsABound) {
  Status status;
  EXPECT_EQ(create({}, status), nullptr);
  EXPECT_EQ(status.code, static_cast<int>(Exit::input));
  EXPECT_THAT(status.message, AllOf(HasSubstr("'lower'"), HasSubstr("'upper'")));
}

TEST_F(Scalar, CrossingBoundsHaveNoSolutionAndNameWhere) {
  Status status;
  assemble({{"lower", "1"}, {"upper", "x"}}, vertex, status);
  EXPECT_EQ(status.code, static_cast<int>(Exit::no_solution));
  EXPECT_THAT(status.message,
              AllOf(HasSubstr("(0.5, -2, 3)"), HasSubstr("'lower' is 1 "), HasSubstr("'upper' is 0.5")));
}

TEST_F(Scalar, ABoundThatIsNotFiniteIsBadInput) {
  for (const char* text : {"log(-x)", "1 / (x - 0.5)", "-1 / (x - 0.5)"}) {
    Status status;
    assemble({{"lower", text}}, vertex, status);
    EXPECT_EQ(status.code, static_cast<int>(Exit::input)) << text;
    EXPECT_THAT(status.message, HasSubstr("scene.toml:2: obstacle.0.lower"));
  }
}

TEST_F(Scalar, HasOneDirectionWithALowerAndAnUpperValue) {
  Status status;
  const ObstacleDescriptor descriptor = create({{"lower", "0"}}, status)->descriptor();
  ASSERT_EQ(descriptor.directions, 1);
  EXPECT_EQ(descriptor.direction[0].components, 1);
  EXPECT_EQ(descriptor.direction[0].values, 2);
}

TEST_F(Scalar, IsForScalarProblemsOnly) {
  EXPECT_EQ(registry_.obstacle("scalar").create2, nullptr);
  EXPECT_EQ(registry_.obstacle("scalar").create3, nullptr);
}

}  // namespace
}  // namespace signorini
