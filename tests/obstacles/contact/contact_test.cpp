// The contact obstacle as its plugin provides it, against distances known in closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/component/plugin_loader.hpp"
#include "core/component/settings.hpp"

namespace signorini {
namespace {

using testing::HasSubstr;

class Sphere final : public DistanceFunction {
 public:
  Sphere(Point<3> center, double radius) : center_(center), radius_(radius) {}
  Distance at(const double* point, const double*, Status&) const noexcept override {
    double r[3], length = 0;
    for (int i = 0; i < 3; ++i) {
      r[i] = point[i] - center_[i];
      length += r[i] * r[i];
    }
    length = std::sqrt(length);
    return {length - radius_, {r[0] / length, r[1] / length, r[2] / length}};
  }

 private:
  Point<3> center_;
  double radius_;
};

/// The same answer everywhere.
class Constant final : public DistanceFunction {
 public:
  explicit Constant(Distance distance, Status status = {}) : distance_(distance), status_(status) {}
  Distance at(const double*, const double*, Status& status) const noexcept override {
    if (!status_.ok()) status = status_;
    return distance_;
  }

 private:
  Distance distance_;
  Status status_;
};

template <int B>
class Contact {
 public:
  explicit Contact(std::shared_ptr<const DistanceFunction> shape, const std::string& normal = "obstacle") {
    PluginLoader(registry_).require("contact");
    settings_ =
        compile_settings("obstacle 'contact'", registry_.entry("obstacle", "contact").options,
                         {"scene.toml:1: obstacle.0", {{"normal", {normal, "scene.toml:2"}}}}, {}, std::move(shape));
    const ObstacleType& type = registry_.obstacle("contact");
    if constexpr (B == 2)
      obstacle_.reset(type.create2(*settings_, status));
    else
      obstacle_.reset(type.create3(*settings_, status));
  }

  LocalConstraint<B> at(const SurfaceVertex& vertex) {
    LocalConstraint<B> constraint;
    if (status.ok()) obstacle_->assemble(&vertex, 1, &constraint, status);
    return constraint;
  }

  Status status;

 private:
  Registry registry_;
  std::shared_ptr<const Settings> settings_;
  std::unique_ptr<Obstacle<B>> obstacle_;
};

TEST(Contact, BoundsTheDisplacementAlongTheObstaclesNormalByTheDistance) {
  Contact<3> contact(std::make_shared<Sphere>(Point<3>{0, 0, -5}, 2));
  const auto c = contact.at({{3, 0, -1}, {0, 0, -1}});  // (3, 0, 4) from the center
  ASSERT_TRUE(contact.status.ok()) << contact.status.message;
  EXPECT_EQ(c.directions, 1);
  EXPECT_DOUBLE_EQ(c.direction[0][0], 0.6);
  EXPECT_DOUBLE_EQ(c.direction[0][1], 0);
  EXPECT_DOUBLE_EQ(c.direction[0][2], 0.8);
  EXPECT_DOUBLE_EQ(c.lower[0], -3);
  EXPECT_EQ(c.upper[0], infinity);
}

TEST(Contact, InThePlaneTheThirdCoordinatePlaysNoPart) {
  Contact<2> contact(std::make_shared<Sphere>(Point<3>{0, -5, 0}, 2));
  const auto c = contact.at({{3, -1, 0}, {0, -1, 0}});
  EXPECT_DOUBLE_EQ(c.direction[0][0], 0.6);
  EXPECT_DOUBLE_EQ(c.direction[0][1], 0.8);
  EXPECT_DOUBLE_EQ(c.lower[0], -3);
}

TEST(Contact, TheBodysNormalIsTakenWhenAskedFor) {
  Contact<3> contact(std::make_shared<Sphere>(Point<3>{0, 0, -5}, 2), "body");
  const auto c = contact.at({{3, 0, -1}, {0, 0, -1}});
  ASSERT_TRUE(contact.status.ok()) << contact.status.message;
  EXPECT_EQ(c.direction[0][0], 0);
  EXPECT_EQ(c.direction[0][2], 1) << "away from the obstacle, so against the outer normal of the body";
  EXPECT_DOUBLE_EQ(c.lower[0], -3);
}

TEST(Contact, ADirectionHasUnitLength) {
  Contact<2> contact(std::make_shared<Constant>(Distance{1, {3, 4, 0}}));
  const auto c = contact.at({});
  EXPECT_DOUBLE_EQ(c.direction[0][0], 0.6);
  EXPECT_DOUBLE_EQ(c.direction[0][1], 0.8);
}

TEST(Contact, AVertexInsideTheObstacleIsPushedOut) {
  Contact<3> contact(std::make_shared<Sphere>(Point<3>{0, 0, 0}, 2));
  EXPECT_DOUBLE_EQ(contact.at({{0, 0, 1.5}, {0, 0, -1}}).lower[0], 0.5);
  EXPECT_TRUE(contact.status.ok());
}

TEST(Contact, ADistanceThatIsNotFiniteIsBadInput) {
  for (const double distance : {-infinity, infinity, std::nan("")}) {
    Contact<2> contact(std::make_shared<Constant>(Distance{distance, {0, 1, 0}}));
    contact.at({{1, 2, 0}, {0, -1, 0}});
    EXPECT_EQ(contact.status.code, static_cast<int>(Exit::input));
    EXPECT_THAT(contact.status.message, HasSubstr("(1, 2, 0)"));
  }
}

TEST(Contact, AMissingNormalIsBadInput) {
  Contact<2> obstacle(std::make_shared<Constant>(Distance{1, {0, 0, 1}}));
  obstacle.at({{1, 2, 0}, {0, -1, 0}});
  EXPECT_EQ(obstacle.status.code, static_cast<int>(Exit::input));
  Contact<3> body(std::make_shared<Constant>(Distance{1, {0, 0, 1}}), "body");
  body.at({{1, 2, 0}, {0, 0, 0}});
  EXPECT_EQ(body.status.code, static_cast<int>(Exit::input));
  EXPECT_THAT(body.status.message, HasSubstr("body"));
}

TEST(Contact, AFailedDistanceIsHandedOn) {
  Status failed;
  failed.fail(static_cast<int>(Exit::input), "no distance here");
  Contact<3> contact(std::make_shared<Constant>(Distance{}, failed));
  contact.at({});
  EXPECT_STREQ(contact.status.message, "no distance here");
}

TEST(Contact, NeedsAShape) {
  const Contact<3> contact(nullptr);
  EXPECT_EQ(contact.status.code, static_cast<int>(Exit::input));
  EXPECT_THAT(contact.status.message, HasSubstr("'shape'"));
}

}  // namespace
}  // namespace signorini
