#include "core/fem/recovery/forces.hpp"

#include "tests/verification/run.hpp"
#include "tests/verification/scene_text.hpp"

// What acts on a body: loads, fixes and obstacles balance each other, and each has its closed form where there is one.

namespace signorini::test {
namespace {

const std::string exact = "solver.tolerance=1e-12";

/// Forces of a solution sum to zero beside the forces themselves.
template <int B>
void expect_balance(const std::string& what, const Forces<B>& forces) {
  std::array<double, B> sum{};
  double size = 0;
  for (const auto* part : {&forces.applied, &forces.reactions, &forces.contact})
    for (const auto& force : *part)
      for (int i = 0; i < B; ++i) {
        sum[i] += force[i];
        size += std::abs(force[i]);
      }
  EXPECT_GT(size, 0) << what;
  for (int i = 0; i < B; ++i) EXPECT_NEAR(sum[i], 0, 1e-10 * size) << what << ", component " << i;
}

template <int D, int B>
void expect_balance_of(const std::string& file, int refinements) {
  expect_balance<B>(file, run_shipped<D, B>(file, {uniform(refinements), exact}).results.forces);
}

// Sources, fluxes, sliding planes of symmetry, held contact, oblique planes, displaced and free bodies.
TEST(Forces, balance_in_scenes_of_all_kinds) {
  expect_balance_of<2, 1>("obstacle_radial_2d.toml", 2);
  expect_balance_of<3, 1>("obstacle_cube_3d.toml", 1);
  expect_balance_of<2, 1>("obstacle_torsion_disk.toml", 1);
  expect_balance_of<2, 2>("cylinder_on_plane_2d.toml", 1);
  expect_balance_of<3, 3>("ball_on_plane.toml", 0);
  expect_balance_of<3, 3>("block_on_surface.toml", 1);
  expect_balance_of<3, 3>("punch.toml", 0);
}

TEST(Forces, balance_where_fixes_in_normal_frames_meet_an_oblique_plane) {
  const auto solved = run<3, 3>(
      SceneText{.body = "shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\ncells = [3, 3, 3]\norder = 1\nyoung = "
                        "1\npoisson = 0.3",
                .fixes = {"on = \"left\"\nframe = \"normal\"\nvalue = [0.01, \"free\", \"free\"]",
                          "on = \"top\"\nvalue = [\"free\", 0, \"-0.05 + 0.01 * x\"]"},
                .loads = {"value = [0, 0.01, \"-0.1 * z\"]", "on = \"right\"\nvalue = [\"0.1 * y\", 0, 0.02]"},
                .obstacle =
                    "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0.2, 0.1, 1]",
                .refinements = 1},
      {exact});
  EXPECT_GT(solved.contact().nodes, 3);
  expect_balance<3>("oblique plane", solved.results.forces);
}

/// A block that nothing lets widen, under the pressure p: its sides carry nu / (1 - nu) of it. All fixes share edges
/// with each other and with the contact.
template <int D>
void expect_confined_block(const std::string& body, const std::vector<std::string>& sides, const std::string& bottom,
                           const std::string& press, const std::string& plane) {
  SceneText scene{
      .body = body + "\norder = 1\nyoung = 3\npoisson = 0.3", .loads = {press}, .obstacle = plane, .refinements = 1};
  const std::string slide = D == 2 ? "[0, \"free\"]" : "[0, \"free\", \"free\"]";
  for (const std::string& side : sides)
    scene.fixes.push_back("on = \"" + side + "\"\nframe = \"normal\"\nvalue = " + slide);
  const auto solved = run<D, D>(scene, {exact});
  const double p = 0.02, side = p * 0.3 / 0.7;
  const Forces<D>& forces = solved.results.forces;
  ASSERT_EQ(forces.reactions.size(), sides.size());
  for (std::size_t k = 0; k < sides.size(); ++k)
    for (std::size_t i = 0; i < D; ++i)
      EXPECT_NEAR(forces.reactions[k][i],
                  i != k / 2   ? 0
                  : k % 2 == 0 ? side
                               : -side,
                  1e-10 * p)
          << sides[k] << ", component " << i;
  EXPECT_NEAR(forces.applied[0][D - 1], -p, 1e-13 * p) << bottom;
  EXPECT_NEAR(forces.contact[0][D - 1], p, 1e-10 * p) << bottom;
}

TEST(Forces, sides_of_a_confined_block_carry_what_poisson_says) {
  expect_confined_block<2>("shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [3, 3]", {"left", "right"},
                           "bottom", "on = \"top\"\nvalue = [0, -0.02]",
                           "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0]\nnormal = [0, 1]");
  expect_confined_block<3>(
      "shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\ncells = [2, 2, 2]", {"left", "right", "front", "back"},
      "bottom", "on = \"top\"\nvalue = [0, 0, -0.02]",
      "type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]");
}

// u = x (1 - x) / 2 beside no obstacle: half of the source leaves at each end.
TEST(Forces, reactions_of_a_scalar_body_are_the_fluxes_at_its_ends) {
  const auto solved = run<2, 1>(
      SceneText{.body = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 0.5]\ncells = [8, 4]\nequation = \"diffusion\"",
                .fixes = {"on = \"left\"\nvalue = 0", "on = \"right\"\nvalue = 0"},
                .loads = {"value = 1", "on = \"top\"\nvalue = \"x - 0.5\""},
                .obstacle = "type = \"scalar\"\nlower = -1"},
      {exact});
  const Forces<1>& forces = solved.results.forces;
  EXPECT_NEAR(forces.applied[0][0], 0.5, 1e-14);
  EXPECT_NEAR(forces.applied[1][0], 0, 1e-14);
  EXPECT_EQ(forces.contact[0][0], 0);
  EXPECT_NEAR(forces.reactions[0][0] + forces.reactions[1][0], -0.5, 1e-11);
  EXPECT_LT(forces.reactions[1][0], forces.reactions[0][0]);  // the flux through the top leaves at the right
}

}  // namespace
}  // namespace signorini::test
