// The same scene turned in space, in other units, and with its vertices numbered otherwise: the same answer.
#include <functional>
#include <map>

#include "core/geometry/geometry.hpp"
#include "core/mesh/structured.hpp"
#include "mesh_file.hpp"
#include "run.hpp"
#include "scene_text.hpp"
#include "tests/core/geometry/surfaces.hpp"
#include "tests/support/nightly.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

Mesh<2> square() { return rectangle({-1, -1}, {1, 1}, {6, 6}); }
Mesh<3> half_ball() {
  return geometry::engine<3>().mesh(geometry::Ball{{0, 0, 0}, 1, true}, [](const Point<3>&) { return 0.4; });
}

/// What a scene is written with: the mesh file, and where vectors, lengths and moduli go.
template <int D>
struct Frame {
  std::string file;
  Motion<D> motion;
  double modulus = 1;

  std::string point(const Point<D>& x) const { return text(motion.moved(x)); }
  std::string direction(const Point<D>& x) const { return text(motion.turned(x)); }
  std::string length(const Point<D>& x) const {
    Point<D> y = motion.turned(x);
    for (double& v : y) v *= motion.scale;
    return text(y);
  }
  std::string traction(const Point<D>& x) const {
    Point<D> y = motion.turned(x);
    for (double& v : y) v *= modulus;
    return text(y);
  }
  std::string body() const {
    return fmt::format("mesh = \"{}\"\norder = 1\nyoung = {:.17g}\npoisson = 0.3", file, modulus);
  }
};

/// A half ball pushed obliquely on a sphere, with a load on its flat side's rim.
SceneText ball_on_sphere(const Frame<3>& f) {
  return {
      .body = f.body(),
      .fixes = {"on = \"flat\"\nvalue = " + f.length({0.02, -0.01, -0.05})},
      .obstacle = fmt::format("type = \"contact\"\non = \"curved\"\nshape = \"sphere\"\ncenter = {}\nradius = {:.17g}",
                              f.point({0.1, 0.05, -2.99}), 2 * f.motion.scale),
      .refinements = 1};
}

/// A block pressed on the ridge of a roof that a surface file holds, and pushed across it. Up to rounding, rows of
/// nodes lie on the ridge and over diagonals of the roof's faces.
SceneText block_on_ridge(const Frame<3>& f) {
  Surface roof;
  for (const double y : {-2.0, 2.0})
    for (const Point<3>& p : {Point<3>{-2, y, -0.8}, Point<3>{0, y, 0}, Point<3>{2, y, -0.8}})
      roof.points.push_back(f.motion.moved(p));
  roof.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
  std::ofstream(f.file + ".off") << roof.off();
  return {
      .body = f.body(),
      .fixes = {"on = \"top\"\nvalue = " + f.length({0.01, 0, -0.1})},
      .obstacle = fmt::format("type = \"contact\"\non = \"bottom\"\nshape = \"surface\"\nfile = \"{}.off\"", f.file),
      .refinements = 2};
}

/// A square that slides along two walls in normal direction and is pressed on an incline by a traction and its weight.
SceneText square_on_incline(const Frame<2>& f) {
  Point<2> weight{0.02 * f.modulus / f.motion.scale, -0.1 * f.modulus / f.motion.scale};
  return {.body = f.body(),
          .fixes = {"on = \"left\"\nframe = \"normal\"\nvalue = [0, \"free\"]"},
          .loads = {"on = \"top\"\nvalue = " + f.traction({0.01, -0.05}), "value = " + text(f.motion.turned(weight))},
          .obstacle = fmt::format("type = \"contact\"\non = \"bottom\"\nshape = \"plane\"\npoint = {}\nnormal = {}",
                                  f.point({0, -1.01}), f.direction({-0.02, 1})),
          .refinements = 3};
}

/// A block pressed on a plane and pushed along it: most of what touches slips, some of it sticks.
template <int D>
SceneText block_with_friction(const Frame<D>& f) {
  Point<D> way{}, point{}, normal{};
  way[0] = 0.02;
  way[D - 1] = -0.06;
  if (D == 3) way[1] = -0.01;
  point[D - 1] = -1;
  normal[D - 1] = 1;
  return {.body = f.body(),
          .fixes = {"on = \"top\"\nvalue = " + f.length(way)},
          .obstacle = fmt::format("type = \"coulomb\"\nfriction = 0.3\non = \"bottom\"\nshape = \"plane\"\n"
                                  "point = {}\nnormal = {}",
                                  f.point(point), f.direction(normal)),
          .refinements = D == 2 ? 3 : 1};
}

template <int D>
using Scenes = SceneText (*)(const Frame<D>&);

/// Solves the scene as it is and moved, and compares the displacements after moving back.
template <int D>
void expect_invariant(const Mesh<D>& mesh, Scenes<D> scene, const Motion<D>& motion, double modulus, int order = 1) {
  const TemporaryFolder folder;
  const std::vector<std::string> settings{"solver.tolerance=1e-10", fmt::format("body.0.order={}", order)};
  const auto here = run<D, D>(scene({folder.write("here.msh", msh(mesh)), {}}), settings);
  const auto there = run<D, D>(scene({folder.write("there.msh", msh(mesh, motion)), motion, modulus}), settings);
  EXPECT_NEAR(there.summary().iterations, here.summary().iterations, 1);
  ASSERT_EQ(there.u().size(), here.u().size());
  EXPECT_GT(here.contact().nodes, 3);
  EXPECT_EQ(there.contact().nodes, here.contact().nodes);
  EXPECT_EQ(there.contact().slip_nodes, here.contact().slip_nodes);
  EXPECT_EQ(there.contact().stick_nodes, here.contact().stick_nodes);
  double difference = 0, size = 0;
  for (std::size_t p = 0; p < here.mesh().points.size(); ++p) {
    Point<D> u;
    std::copy_n(here.u().begin() + static_cast<std::ptrdiff_t>(p) * D, D, u.begin());
    u = motion.turned(u);
    for (int i = 0; i < D; ++i) {
      difference = std::max(difference, std::abs(there.u()[p * D + i] - motion.scale * u[i]));
      size = std::max(size, std::abs(motion.scale * u[i]));
    }
  }
  EXPECT_LE(difference, 1e-8 * size);
  const double force = modulus * std::pow(motion.scale, D - 1);
  const auto expected = motion.turned(here.contact().force);
  for (int i = 0; i < D; ++i)
    EXPECT_NEAR(there.contact().force[i], force * expected[i], 1e-8 * force * norm<D>(expected));
  EXPECT_NEAR(there.contact().max_pressure, modulus * here.contact().max_pressure,
              1e-8 * modulus * here.contact().max_pressure);
  EXPECT_NEAR(there.contact().area, std::pow(motion.scale, D - 1) * here.contact().area,
              1e-8 * std::pow(motion.scale, D - 1));
  EXPECT_NEAR(there.contact().dissipated, force * motion.scale * here.contact().dissipated,
              1e-8 * force * motion.scale * norm<D>(expected));
  show("{} nodes in contact, {} slip, {} and {} cycles, difference {:.1e}\n", here.contact().nodes,
       here.contact().slip_nodes, here.summary().iterations, there.summary().iterations, difference / size);
}

TEST(Invariance, RotationAndTranslation) {
  Motion<2> plane = rotation2(0.7);
  plane.shift = {3, -2};
  expect_invariant<2>(square(), square_on_incline, plane, 1);
  for (const auto& [a, b, c] : {std::array{0.4, 1.1, -2.3}, std::array{pi / 2, 0.0, pi / 2}}) {
    Motion<3> space = rotation3(a, b, c);
    space.shift = {3, -2, 5};
    expect_invariant<3>(half_ball(), ball_on_sphere, space, 1);
  }
}

TEST(Invariance, OfQuadraticElements) {
  Motion<2> plane = rotation2(0.7);
  plane.shift = {3, -2};
  Motion<3> space = rotation3(0.4, 1.1, -2.3);
  space.shift = {3, -2, 5};
  space.scale = 1e3;
  expect_invariant<2>(square(), square_on_incline, plane, 1, 2);
  expect_invariant<2>(square(), block_with_friction<2>, plane, 1, 2);
  expect_invariant<3>(half_ball(), ball_on_sphere, space, 2.1e11, 2);
}

Mesh<3> cube_on_floor() { return signorini::box({-1, -1, -1}, {1, 1, 1}, {3, 3, 3}); }

TEST(Invariance, OfFriction) {
  for (const double length : {1.0, 1e-3, 1e6})
    for (const double modulus : {1.0, 1e-6, 2.1e11})
      for (const double angle : {0.0, 0.7}) {
        SCOPED_TRACE(fmt::format("lengths by {}, moduli by {}, turned by {}", length, modulus, angle));
        Motion<2> plane = rotation2(angle);
        plane.shift = {3 * length * angle, -2 * length * angle};
        plane.scale = length;
        expect_invariant<2>(square(), block_with_friction<2>, plane, modulus);
        Motion<3> space = rotation3(angle, 1.1 * angle, -2.3 * angle);
        space.shift = {3 * length * angle, -2 * length * angle, 5 * length * angle};
        space.scale = length;
        expect_invariant<3>(cube_on_floor(), block_with_friction<3>, space, modulus);
      }
}

TEST(Invariance, OfNodesOnTheEdgesOfASurface) {
  const Mesh<3> block = signorini::box({-1, -1, 0}, {1, 1, 1}, {4, 4, 2});
  Motion<3> far, turned = rotation3(0.4, 1.1, -2.3), large = turned;
  far.shift = turned.shift = {300, -2700, 0};
  large.scale = 1e3;
  for (const Motion<3>& motion : {far, turned, large}) expect_invariant<3>(block, block_on_ridge, motion, 1);
}

TEST(Invariance, Units) {
  for (const double length : {1e-3, 1e3, 1e6})
    for (const double modulus : {1e-6, 1e3, 1e6, 2.1e11}) {
      SCOPED_TRACE(fmt::format("lengths by {}, moduli by {}", length, modulus));
      Motion<2> plane;
      plane.scale = length;
      expect_invariant<2>(square(), square_on_incline, plane, modulus);
      if (modulus == 2.1e11 || (!nightly() && modulus == 1e3)) continue;
      Motion<3> space;
      space.scale = length;
      expect_invariant<3>(half_ball(), ball_on_sphere, space, modulus);
    }
}

/// A body that the program meshes itself, in a scene whose lengths are all multiples of l: held where it is high, and
/// pressed on a plane under its lowest point.
struct MeshedShape {
  std::string name;
  std::function<std::string(double l)> keys;
  double low, held;  ///< heights, in units of l
};

template <int D>
SceneText pressed(const MeshedShape& shape, double l) {
  const char up = D == 2 ? 'y' : 'z';
  Point<D> down{}, point{}, normal{};
  down[D - 1] = -0.02 * l;
  point[D - 1] = shape.low * l;
  normal[D - 1] = 1;
  // Small below the body.
  const std::string size = fmt::format("\"{:.17g} + 0.3*sqrt({}({} + {:.17g})^2)\"", (D == 2 ? 0.03 : 0.15) * l,
                                       D == 2 ? "x^2 + " : "x^2 + y^2 + ", up, -shape.low * l);
  return {.body = fmt::format("shape = \"{}\"\n{}\nsize = {}\norder = 1\nyoung = 2e5\npoisson = 0.3", shape.name,
                              shape.keys(l), size),
          .fixes = {fmt::format("where = \"{} > {:.17g}\"\nvalue = {}", up, shape.held * l, text(down))},
          .obstacle = fmt::format("type = \"contact\"\non = \"boundary\"\nshape = \"plane\"\npoint = {}\nnormal = {}",
                                  text(point), text(normal)),
          .refinements = 1};
}

/// The mesh has the same elements, and the solution is the same.
template <int D>
void expect_independent_of_units(const MeshedShape& shape) {
  const std::vector<std::string> settings{"solver.tolerance=1e-11"};
  const auto one = run<D, D>(pressed<D>(shape, 1), settings);
  EXPECT_GT(one.contact().nodes, 3);
  for (const double l : {1e-3, 1e3, 1e6}) {
    SCOPED_TRACE(fmt::format("{}, lengths by {}", shape.name, l));
    const auto other = run<D, D>(pressed<D>(shape, l), settings);
    ASSERT_TRUE(other.mesh().elements == one.mesh().elements);
    EXPECT_NEAR(other.summary().iterations, one.summary().iterations, 1);
    EXPECT_EQ(other.contact().nodes, one.contact().nodes);
    const double area = std::pow(l, D - 1) * one.contact().area,
                 force = std::pow(l, D - 1) * one.contact().force[D - 1];
    EXPECT_NEAR(other.contact().area, area, 1e-8 * area);
    EXPECT_NEAR(other.contact().force[D - 1], force, 1e-8 * force);
    EXPECT_NEAR(other.contact().max_pressure, one.contact().max_pressure, 1e-8 * one.contact().max_pressure);
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < one.u().size(); ++i) {
      difference = std::max(difference, std::abs(other.u()[i] / l - one.u()[i]));
      size = std::max(size, std::abs(one.u()[i]));
    }
    EXPECT_LE(difference, 1e-8 * size);
    show("{} by {}: {} vertices, difference {:.1e}\n", shape.name, l, one.mesh().points.size(), difference / size);
  }
}

TEST(Invariance, UnitsOfAMeshedShape) {
  const auto round = [](double l) {
    return fmt::format("center = {}\nradius = {:.17g}", text(Point<2>{0, 0.2 * l}), l);
  };
  expect_independent_of_units<2>({"disk", round, -0.8, 0.9});
  expect_independent_of_units<2>({"half_disk", round, -0.8, 0.199});
  const auto quadrangle = [](double l) {
    return fmt::format("points = [{}, {}, {}, {}]", text(Point<2>{-0.9 * l, -0.7 * l}), text(Point<2>{l, -0.7 * l}),
                       text(Point<2>{1.3 * l, 0.2 * l}), text(Point<2>{-0.7 * l, 0.9 * l}));
  };
  expect_independent_of_units<2>({"polygon", quadrangle, -0.7, 0.5});
}

TEST(Invariance, UnitsOfAMeshedSolidShape) {
  const auto ball = [](double l) {
    return fmt::format("center = {}\nradius = {:.17g}", text(Point<3>{0, 0.1 * l, 0.2 * l}), l);
  };
  const auto cylinder = [](double l) {
    return fmt::format("center = {}\nradius = {:.17g}\nheight = {:.17g}", text(Point<3>{0, 0, 0.1 * l}), 0.7 * l,
                       1.6 * l);
  };
  expect_independent_of_units<3>({"ball", ball, -0.8, 0.9});
  expect_independent_of_units<3>({"half_ball", ball, -0.8, 0.199});
  expect_independent_of_units<3>({"cylinder", cylinder, -0.7, 0.899});
  const TemporaryFolder folder;
  const auto solid = [&](double l) {
    return "file = \"" + folder.write("cube.off", cube(-0.3 * l, 0.8 * l).off()) + '"';
  };
  expect_independent_of_units<3>({"solid", solid, -0.3, 0.799});
}

/// A position by which vertices of two files are matched.
template <int D>
Point<D> rounded(Point<D> x) {
  for (double& v : x) v = std::round(v * 0x1p36) + 0.0;
  return x;
}

template <int D>
void expect_independent_of_numbering(const Mesh<D>& mesh, Scenes<D> scene) {
  const TemporaryFolder folder;
  std::vector<Index> number(mesh.points.size());
  for (std::size_t p = 0; p < number.size(); ++p) number[p] = static_cast<Index>(p);
  Random random(3);
  for (std::size_t p = number.size(); p > 1; --p)
    std::swap(number[p - 1], number[static_cast<std::size_t>(random.below(static_cast<int>(p)))]);
  const std::vector<std::string> settings{"solver.tolerance=1e-10"};
  const auto one = run<D, D>(scene({folder.write("one.msh", msh(mesh)), {}}), settings);
  const auto other = run<D, D>(scene({folder.write("other.msh", msh<D>(mesh, {}, number)), {}}), settings);
  EXPECT_NEAR(other.summary().iterations, one.summary().iterations, 1);
  EXPECT_EQ(other.contact().nodes, one.contact().nodes);
  std::map<Point<D>, std::size_t> at;
  for (std::size_t p = 0; p < other.mesh().points.size(); ++p) at[rounded<D>(other.mesh().points[p])] = p;
  ASSERT_EQ(at.size(), one.mesh().points.size());
  double difference = 0, size = 0;
  for (std::size_t p = 0; p < one.mesh().points.size(); ++p) {
    const auto found = at.find(rounded<D>(one.mesh().points[p]));
    ASSERT_NE(found, at.end());
    for (int i = 0; i < D; ++i) {
      difference = std::max(difference, std::abs(other.u()[found->second * D + i] - one.u()[p * D + i]));
      size = std::max(size, std::abs(one.u()[p * D + i]));
    }
  }
  EXPECT_LE(difference, 1e-8 * size);
  for (int i = 0; i < D; ++i)
    EXPECT_NEAR(other.contact().force[i], one.contact().force[i], 1e-8 * norm<D>(one.contact().force));
  EXPECT_NEAR(other.contact().area, one.contact().area, 1e-8 * one.contact().area);
  EXPECT_NEAR(other.summary().energy, one.summary().energy, 1e-8 * std::abs(one.summary().energy));
}

TEST(Invariance, NumberingOfTheMeshFile) {
  expect_independent_of_numbering<2>(square(), block_with_friction<2>);
  expect_independent_of_numbering<3>(cube_on_floor(), block_with_friction<3>);
  expect_independent_of_numbering<2>(square(), square_on_incline);
  expect_independent_of_numbering<3>(half_ball(), ball_on_sphere);
}

}  // namespace
}  // namespace signorini::test
