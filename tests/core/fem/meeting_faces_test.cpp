// Obstacles that meet at nodes: each has its part of the force there, and the pressure is that of all.
#include "core/fem/recovery/meeting_faces.hpp"

#include <gtest/gtest.h>

#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

/// The faces of the bottom left or right of a half.
template <int D>
Selection half_of_bottom(bool right) {
  Selection on;
  on.where = expression([right](const Site& s) {
    return s.x[D - 1] < 1e-9 && (right ? s.x[0] > 0.5 - 1e-9 : s.x[0] < 0.5 + 1e-9) ? 1.0 : 0.0;
  });
  return on;
}

/// A unit block on a floor under the uniform pressure p, without Poisson's ratio.
template <int D>
Model<D> pressed_block(double p) {
  Model<D> model;
  model.poisson = 0;
  for (const std::string side : {"left", "front"})
    if (side == "left" || D == 3) {
      model.fixes.push_back(fix<D>(side, {}, Frame::normal));
      model.fixes.back().value[0] = 0;
    }
  Load<D> press{Selection{"top", {}, ""}, {}};
  for (int i = 0; i < D; ++i) press.value[i] = i == D - 1 ? -p : 0;
  model.loads.push_back(press);
  return model;
}

template <int D>
ObstacleTerm<D> floor_under(const Selection& on) {
  std::array<double, D> up{};
  up[D - 1] = 1;
  auto out = term<D>([up](const SurfaceVertex& v) { return bound<D>(up, -v.position[D - 1], infinity); }, {});
  out.on = on;
  return out;
}

constexpr double p = 0.2;

template <int D>
void expect_half(const ContactSummary<D>& summary) {
  EXPECT_NEAR(summary.force[D - 1], p / 2, 1e-11);
  EXPECT_NEAR(summary.area, 0.5, 1e-11);
  EXPECT_NEAR(summary.max_pressure, p, 1e-10);
}

template <int D>
void expect_uniform_on_two() {
  const Mesh<D> mesh = distorted_mesh<D>(D == 2 ? 8 : 4);
  Model<D> model = pressed_block<D>(p);
  model.obstacles = {floor_under<D>(half_of_bottom<D>(false)), floor_under<D>(half_of_bottom<D>(true))};
  const auto discrete = discretize(mesh, model);
  const auto state = contact_state(mesh, model, discrete, solve_bounded(discrete.problem));
  expect_half<D>(state.obstacles[0]);
  expect_half<D>(state.obstacles[1]);
  for (const ContactNode<D>& node : state.nodes) {
    if (node.contact) {
      EXPECT_NEAR(node.pressure, p, 1e-10);
    }
  }
}

TEST(MeetingFaces, ObstaclesShareAUniformPressure) {
  expect_uniform_on_two<2>();
  expect_uniform_on_two<3>();
}

/// The fix beside the obstacle holds the nodes where they meet.
template <int D>
void expect_uniform_beside_fix() {
  const Mesh<D> mesh = distorted_mesh<D>(D == 2 ? 8 : 4);
  Model<D> model = pressed_block<D>(p);
  Fix<D> held = fix<D>({}, {});
  held.on = half_of_bottom<D>(false);
  held.value[D - 1] = 0;
  model.fixes.push_back(held);
  model.obstacles = {floor_under<D>(half_of_bottom<D>(true))};
  const auto discrete = discretize(mesh, model);
  const auto state = contact_state(mesh, model, discrete, solve_bounded(discrete.problem));
  expect_half<D>(state.obstacles[0]);
}

TEST(MeetingFaces, AnObstacleSharesAUniformPressureWithAFix) {
  expect_uniform_beside_fix<2>();
  expect_uniform_beside_fix<3>();
}

// The same for a flux through the bottom.
TEST(MeetingFaces, ScalarObstaclesShareAUniformFlux) {
  const Mesh<2> mesh = distorted_mesh<2>(8);
  Model<1> model;
  model.loads.push_back({Selection{"top", {}, ""}, {-p}});
  for (const bool right : {false, true}) {
    model.obstacles.push_back(term<1>([](const SurfaceVertex&) { return bound<1>({1}, 0, infinity); }, {}));
    model.obstacles.back().on = half_of_bottom<2>(right);
  }
  const auto discrete = discretize(mesh, model);
  const auto state = contact_state(mesh, model, discrete, solve_bounded(discrete.problem));
  for (const auto& summary : state.obstacles) {
    EXPECT_NEAR(summary.force[0], p / 2, 1e-11);
    EXPECT_NEAR(summary.area, 0.5, 1e-11);
    EXPECT_NEAR(summary.max_pressure, p, 1e-10);
  }
}

}  // namespace
}  // namespace signorini::testing
