// A flat punch on a block between smooth walls: uniform stress whatever the mesh and wherever the block stands.
#include "core/fem/recovery/stress.hpp"
#include "core/mesh/structured.hpp"
#include "mesh_file.hpp"
#include "run.hpp"
#include "scene_text.hpp"
#include "tests/core/geometry/surfaces.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

constexpr double strain = 0.01, nu = 0.3;

template <int D>
Mesh<D> block(Index cells) {
  Point<D> to;
  std::array<Index, D> n;
  to.fill(1);
  n.fill(cells);
  if constexpr (D == 2)
    return rectangle({}, to, n);
  else
    return signorini::box({}, to, n);
}

/// Moves the vertices by up to a fifth of a cell, those on the boundary along it.
template <int D>
Mesh<D> irregular(Mesh<D> mesh, Index cells) {
  Random random(7);
  for (Point<D>& x : mesh.points)
    for (double& v : x) {
      const double by = random.between(-0.2, 0.2) / cells;
      if (v > 0 && v < 1) v += by;
    }
  return mesh;
}

/// The block of a file, pressed along its last axis; `motion` is what the file's vertices went through.
template <int D>
SceneText punch(const std::string& file, const Motion<D>& motion) {
  Point<D> top{}, down{};
  top[D - 1] = 1 - strain;
  down[D - 1] = -1;
  std::vector<std::string> walls{"bottom", "left", "right"}, fixes;
  if (D == 3) walls.insert(walls.end(), {"front", "back"});
  for (const std::string& wall : walls)
    fixes.push_back(
        fmt::format("on = \"{}\"\nframe = \"normal\"\nvalue = [0, \"free\"{}]", wall, D == 3 ? ", \"free\"" : ""));
  return {.body = fmt::format("mesh = \"{}\"\norder = 1\nyoung = 1.0\npoisson = {}", file, nu),
          .fixes = fixes,
          .obstacle = fmt::format("type = \"contact\"\non = \"top\"\nshape = \"plane\"\npoint = {}\nnormal = {}",
                                  text(motion.moved(top)), text(motion.turned(down))),
          .refinements = 2};
}

/// The normal stress along the last axis of the block and the mean of the others, which belong to uniaxial strain.
constexpr double axial = -strain * (1 - nu) / ((1 + nu) * (1 - 2 * nu)),
                 lateral = -strain * nu / ((1 + nu) * (1 - 2 * nu));

template <int D>
void expect_uniform(const std::string& what, const Mesh<D>& mesh, const Motion<D>& motion) {
  SCOPED_TRACE(what);
  const TemporaryFolder folder;
  const auto r = run<D, D>(punch(folder.write("block.msh", msh(mesh, motion)), motion), {"solver.tolerance=1e-12"});
  Point<D> axis{};
  axis[D - 1] = 1;
  axis = motion.turned(axis);
  // sigma = lateral I + (axial - lateral) axis x axis
  const auto exact = [&](int i, int j) {
    const double a = i < D ? axis[i] : 0, b = j < D ? axis[j] : 0;
    return (i == j ? lateral : 0) + (axial - lateral) * a * b;
  };
  for (const Stress& s : nodal_stress(r.nodes(), r.model, r.u())) {
    const double difference[6] = {s[0] - exact(0, 0), s[1] - exact(1, 1), s[2] - exact(2, 2),
                                  s[3] - exact(0, 1), s[4] - exact(1, 2), s[5] - exact(0, 2)};
    for (const double d : difference) ASSERT_LE(std::abs(d), 1e-9 * -axial);
  }
  for (const auto& node : r.results.contact.nodes) {
    ASSERT_TRUE(node.contact);
    ASSERT_NEAR(node.pressure, -axial, 1e-9 * -axial);
    ASSERT_NEAR(node.recovered, -axial, 1e-8 * -axial);
  }
  EXPECT_NEAR(r.contact().area, std::pow(motion.scale, D - 1), 1e-9);
  for (int i = 0; i < D; ++i) EXPECT_NEAR(r.contact().force[i], axial * axis[i], 1e-9 * -axial);
}

TEST(Punch, UniformStressOnAStructuredMesh) {
  expect_uniform<2>("rectangle", block<2>(3), {});
  expect_uniform<3>("box", block<3>(3), {});
}

TEST(Punch, UniformStressOnAnIrregularMesh) {
  expect_uniform<2>("rectangle", irregular(block<2>(4), 4), {});
  expect_uniform<3>("box", irregular(block<3>(3), 3), {});
}

TEST(Punch, UniformStressOfATurnedBlock) {
  Motion<2> plane = rotation2(0.7);
  plane.shift = {3, -2};
  expect_uniform<2>("rectangle", irregular(block<2>(4), 4), plane);
  Motion<3> space = rotation3(0.4, 1.1, -2.3);
  space.shift = {3, -2, 5};
  expect_uniform<3>("structured box", block<3>(2), space);
  expect_uniform<3>("irregular box", irregular(block<3>(3), 3), space);
}

/// A solid has no part but its boundary, so that faces may be picked that the obstacle cannot push against.
TEST(Punch, UniformPressureUnderASolid) {
  const TemporaryFolder folder;
  const std::string file = folder.write("cube.off", cube(0, 1).off());
  const SceneText scene{
      .body = fmt::format("shape = \"solid\"\nfile = \"{}\"\nsize = 0.4\norder = 1\nyoung = 1\npoisson = 0", file),
      .fixes = {"where = \"z > 0.999\"\nvalue = [0, 0, -0.01]"},
      .obstacle = R"(
type = "contact"
on = "boundary"
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1])",
      .refinements = 1};
  const auto r = run<3, 3>(scene, {"solver.tolerance=1e-12"});
  EXPECT_NEAR(r.contact().area, 1, 1e-9);
  EXPECT_GT(r.contact().nodes, 30);
  for (const auto& node : r.results.contact.nodes) {
    if (!node.contact) continue;
    ASSERT_NEAR(node.pressure, 0.01, 1e-11);
    ASSERT_NEAR(node.recovered, 0.01, 1e-10);
  }
}

// A smooth rigid punch of width 1 with sharp corners, on a body that is wider: p = F / (pi sqrt(1/4 - x^2)) on a half
// plane, M. Sadowsky 1928. Infinite at the corners, the pressure stays one that the nodes there have.
TEST(Punch, SingularPressureAtTheCornersOfAPunch) {
  const SceneText scene{
      .body =
          "shape = \"rectangle\"\nfrom = [-4, 0]\nto = [4, 4]\ncells = [16, 8]\norder = 1\nyoung = 1\npoisson = 0.3",
      .fixes = {"on = \"top\"\nvalue = [0, -0.01]"},
      .obstacle =
          "type = \"contact\"\non = \"bottom\"\nshape = \"expression\"\n"
          "distance = \"abs(x) < 0.501 ? y : y + 1\"\nnormal = [0, 1]"};
  for (const int k : {2, 3, 4, 5}) {
    const auto r = run<2, 2>(scene, {uniform(k)});
    const double h = 0.5 / (1 << k), F = r.contact().force[1];
    double largest = 0, error = 0;
    for (const auto& node : r.results.contact.nodes) {
      const double x = r.nodes().at(node.vertex)[0];
      largest = std::max(largest, node.pressure);
      EXPECT_GE(node.recovered, 0);
      if (node.contact && std::abs(x) < 0.3)
        error = std::max(error, std::abs(node.recovered * pi * std::sqrt(0.25 - x * x) / F - 1));
    }
    show("punch: largest {} of {} at nodes, width {}, error within {}\n", r.contact().max_pressure, largest,
         r.contact().area, error);
    EXPECT_LE(r.contact().max_pressure, 1.25 * largest);
    EXPECT_GE(r.contact().max_pressure, 0.99 * largest);
    EXPECT_NEAR(r.contact().area, 1, 1.01 * h);
    EXPECT_LE(error, k < 4 ? 0.1 : 0.04);
  }
}

}  // namespace
}  // namespace signorini::test
