// Bodies that an obstacle carries and nothing else holds: solutions are unique up to motions without energy, along
// which rounding must neither drive them nor be taken for a load.
#include <functional>

#include "core/base/error.hpp"
#include "core/fem/elements/select.hpp"
#include "core/mesh/simplex.hpp"
#include "core/mesh/structured.hpp"
#include "mesh_file.hpp"
#include "run.hpp"
#include "tests/support/nightly.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

constexpr double pressure = 0.01, poisson = 0.3;

/// A displacement by its values at a point.
template <int D>
using Field = std::function<Point<D>(const Point<D>&)>;

template <int D>
Field<D> translation(const Point<D>& by) {
  return [=](const Point<D>&) { return by; };
}

template <int D>
Point<D> unit_vector(int k) {
  Point<D> e{};
  e[k] = 1;
  return e;
}

/// The linearised rotations about a point.
template <int D>
std::vector<Field<D>> rotations(const Point<D>& center) {
  std::vector<Field<D>> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < i; ++j)
      out.push_back([=](const Point<D>& x) {
        Point<D> u{};
        u[i] = x[j] - center[j];
        u[j] = center[i] - x[i];
        return u;
      });
  return out;
}

/// A block on a plane in a scene that is turned as a whole and given in other units.
template <int D>
class Resting {
 public:
  Resting(const Motion<D>& motion, int cells) : motion_(motion) {
    const auto mesh = [cells] {
      if constexpr (D == 2)
        return rectangle({0, 0}, {1, 1}, {cells, cells});
      else
        return box({0, 0, 0}, {1, 1, 1}, {cells, cells, cells});
    };
    file_ = folder_.write("block.msh", msh<D>(mesh(), motion));
  }

  /// Carries its own weight.
  /// @param aside load along the plane over the weight
  std::string heavy(double aside = 0) const { return scene(aside, pressure / motion_.scale, ""); }
  /// Pressed from above, without weight.
  std::string pressed() const { return scene(0, pressure, "on = \"top\"\n"); }

  /// What the plane does not resist: translations along it and, in 3D, rotations about its normal.
  std::vector<Field<D>> motions() const {
    std::vector<Field<D>> out;
    for (int k = 0; k + 1 < D; ++k) out.push_back(turned(translation<D>(unit_vector<D>(k))));
    if constexpr (D == 3) out.push_back(turned(rotations<3>({}).front()));
    return out;
  }

  /// A field that is given in the block's own directions, in those of the scene.
  Field<D> turned(const Field<D>& field) const {
    return [field, m = motion_](const Point<D>& x) {
      Point<D> own{};
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) own[j] += m.rows[i][j] * x[i];
      return m.turned(field(own));
    };
  }

 private:
  std::string scene(double aside, double size, const char* where) const {
    Point<D> load{};
    load[0] = size * aside;
    load[D - 1] = -size;
    return fmt::format(R"(
title = "resting"
[[body]]
name = "b"
mesh = "{}"
order = 1
young = 1
poisson = {}
[[load]]
body = "b"
value = {}
{}
[[obstacle]]
type = "contact"
body = "b"
where = "1"
shape = "plane"
point = {}
normal = {}
)",
                       file_, poisson, text(motion_.turned(load)), where, text(Point<D>{}),
                       text(motion_.turned(unit_vector<D>(D - 1))));
  }

  Motion<D> motion_;
  TemporaryFolder folder_;
  std::string file_;
};

/// The values of a field in the solver's coordinates.
template <int D>
Eigen::VectorXd local(const Run<D, D>& r, const Field<D>& field) {
  Eigen::VectorXd out(r.problem().A.size() * D);
  for (Index p = 0; p < r.problem().A.size(); ++p) {
    const Point<D> u = field(r.mesh().points[p]);
    const double* N = r.problem().frames.dual_at(p);
    for (int k = 0; k < D; ++k) {
      double value = 0;
      for (int i = 0; N && i < D; ++i) value += N[i * D + k] * u[i];
      out[p * D + k] = N ? value : u[k];
    }
  }
  return out;
}

/// What of v is no such motion. Their energy norms are zero but for rounding, whose square root would hide all else.
template <int D>
Eigen::VectorXd without(const std::vector<Field<D>>& motions, const Run<D, D>& r, const Eigen::VectorXd& v) {
  Eigen::MatrixXd M(v.size(), static_cast<Eigen::Index>(motions.size()));
  for (Eigen::Index k = 0; k < M.cols(); ++k) M.col(k) = local<D>(r, motions[static_cast<std::size_t>(k)]);
  return v - M * M.colPivHouseholderQr().solve(v);
}

/// The same problem with springs along the obstacle at two of its vertices. They take up the motions without energy and
/// bear no force: the solution is the same up to such a motion.
template <int D>
DiscreteProblem<D> held(DiscreteProblem<D> problem) {
  const auto spring = [&](Index p, int k) { problem.A.at(problem.A.row[p])[k * (D + 1)] *= 2; };
  for (int k = 1; k < D; ++k) spring(problem.constraints.vector.front(), k);
  if (D == 3) spring(problem.constraints.vector.back(), 1);
  return problem;
}

/// Solved as the reference solver does it, and without a drift: what nothing decides is of the size of what is decided.
template <int D>
void expect_solved(const std::string& scene, const std::vector<std::string>& settings,
                   const std::vector<Field<D>>& motions, int cycles) {
  const auto r = run<D, D>(scene, settings);
  const Reference exact = reference(held(r.problem()));
  const Eigen::VectorXd x = vector(r.solution.x);
  const auto& A = r.problem().A;
  const double error = energy_norm<D>(A, without<D>(motions, r, x - exact.x)) / energy_norm<D>(A, exact.x);
  EXPECT_LE(error, 1e-8);
  EXPECT_LE(x.template lpNorm<Eigen::Infinity>(), 10 * exact.x.template lpNorm<Eigen::Infinity>());
  EXPECT_LE(r.summary().iterations, cycles);
  show("{}: {} unknowns, {} cycles, error {:.1e}, estimated {:.1e}\n",
       testing::UnitTest::GetInstance()->current_test_info()->name(), x.size(), r.summary().iterations, error,
       r.summary().algebraic_error);
}

template <int D>
void expect_resting(Motion<D> motion, const std::vector<int>& refinements) {
  for (const double unit : {1.0, 1e3, 1e-6}) {
    motion.scale = unit;
    const Resting<D> block(motion, 2);
    for (const int refinement : refinements)
      for (const char* start : {"nested", "zero"}) {
        SCOPED_TRACE(fmt::format("unit {}, {} refinements, {}", unit, refinement, start));
        expect_solved<D>(block.heavy(), {uniform(refinement), fmt::format("solver.start={}", start)}, block.motions(),
                         20);
      }
  }
}

TEST(LooseBody, RestsOnAPlane2D) {
  expect_resting<2>({}, {0, 2, nightly(5, 4)});
  expect_resting<2>(rotation2(0.7), {2, nightly(4, 3)});
}
TEST(LooseBody, RestsOnAPlane3D) {
  expect_resting<3>({}, nightly<std::vector<int>>({0, 1, 2}, {0, 1}));
  expect_resting<3>(rotation3(0.7, 0.4, 2), nightly<std::vector<int>>({1, 2}, {1}));
}

/// Free at its sides it is under uniaxial stress, uniform: linear elements are exact.
template <int D>
void expect_uniform_stress(Motion<D> motion, int refinements) {
  motion.scale = 1e3;
  const Resting<D> block(motion, 2);
  const auto r = run<D, D>(block.pressed(), {uniform(refinements)});
  // Plane strain in 2D.
  const double down = pressure * (D == 2 ? 1 - poisson * poisson : 1);
  const double aside = pressure * (D == 2 ? poisson * (1 + poisson) : poisson);
  const Field<D> exact = block.turned([=](const Point<D>& x) {
    Point<D> u{};
    for (int k = 0; k + 1 < D; ++k) u[k] = aside * x[k];
    u[D - 1] = -down * x[D - 1];
    return u;
  });
  const Eigen::VectorXd u = local<D>(r, exact), x = vector(r.solution.x);
  EXPECT_LE(without<D>(block.motions(), r, x - u).template lpNorm<Eigen::Infinity>(),
            1e-7 * u.template lpNorm<Eigen::Infinity>());
  EXPECT_NEAR(r.summary().energy / (-0.5 * pressure * down * std::pow(1e3, D)), 1, 1e-10);
  EXPECT_NEAR(r.contact().max_pressure, pressure, 1e-7 * pressure);
  EXPECT_LE(r.summary().iterations, 20);
}

TEST(LooseBody, IsUnderUniformStressWhenPressedOnAPlane) {
  expect_uniform_stress<2>({}, 4);
  expect_uniform_stress<2>(rotation2(0.7), 4);
  expect_uniform_stress<3>({}, 2);
  expect_uniform_stress<3>(rotation3(0.7, 0.4, 2), 2);
}

// One coarsest level has more vectors than are factorised; the finest mesh is the same.
TEST(LooseBody, RestsAlikeOnALargeAndASmallCoarsestLevel) {
  const auto large = run<3, 3>(Resting<3>({}, 16).heavy(), {uniform(1), "solver.max_iterations=20"});
  const auto small = run<3, 3>(Resting<3>({}, 2).heavy(), {uniform(4), "solver.max_iterations=20"});
  EXPECT_NEAR(large.summary().energy / small.summary().energy, 1, 1e-12);
  EXPECT_NEAR(large.contact().force[2], pressure, 1e-9 * pressure);
}

// Motions without energy bring rounding into the gains of the last cycles; the acceleration must not go by that.
TEST(LooseBody, RestsToATightTolerance) {
  const auto r = run<3, 3>(Resting<3>({}, 2).heavy(), {uniform(4), "solver.tolerance=1e-10"});
  EXPECT_EQ(r.summary().outcome, Outcome::converged);
  EXPECT_LE(r.summary().iterations, 25);
}

/// Lifted off the plane, from contact or from above it.
template <int D>
std::string lifted(double load, double gap) {
  Point<D> up{}, origin{}, normal{}, far;
  up[D - 1] = load;
  origin[D - 1] = -gap;
  normal[D - 1] = 1;
  far.fill(1);
  return fmt::format(R"(
title = "lifted"
[[body]]
name = "b"
shape = "{}"
from = {}
to = {}
cells = {}
order = 1
young = 1
poisson = 0.3
[[load]]
body = "b"
on = "top"
value = {}
[[obstacle]]
type = "contact"
body = "b"
on = "bottom"
shape = "plane"
point = {}
normal = {}
)",
                     D == 2 ? "rectangle" : "box", text(Point<D>{}), text(far), D == 2 ? "[4, 4]" : "[2, 2, 2]",
                     text(up), text(origin), text(normal));
}

template <int D>
void expect_lifts_off(const std::vector<int>& refinements) {
  for (const int refinement : refinements)
    for (const char* coarse : {"newton"})
      for (const double load : {1e-6, 0.1, 100.0})
        for (const double gap : {0.0, 0.1}) {
          SCOPED_TRACE(fmt::format("{} refinements, {}, load {}, gap {}", refinement, coarse, load, gap));
          try {
            run<D, D>(lifted<D>(load, gap), {uniform(refinement), fmt::format("solver.coarse={}", coarse)});
            ADD_FAILURE() << "held";
          } catch (const Error& error) {
            EXPECT_EQ(error.status(), Exit::no_solution) << error.what();
          }
        }
}

TEST(LooseBody, LiftsOff) {
  expect_lifts_off<2>({0, 1, 3});
  expect_lifts_off<3>({0, 1, 2});
}

/// What a fall onto the plane has to do with the deformation there: nothing.
template <int D>
void expect_lands_alike(int refinements) {
  const auto near = run<D, D>(lifted<D>(-1e-6, 0), {uniform(refinements)});
  for (const double gap : {1.0, 1e3}) {
    SCOPED_TRACE(fmt::format("{}D, gap {}", D, gap));
    const auto far = run<D, D>(lifted<D>(-1e-6, gap), {uniform(refinements)});
    EXPECT_TRUE(far.summary().converged());  // as far as rounding of stiffness times way lets the forces be known
    EXPECT_LE(far.summary().algebraic_error, 1e-6 * gap);
    EXPECT_LE(far.summary().iterations, near.summary().iterations + 1);
    double off = 0;
    for (Index p = 0; p < near.mesh().vertices(); ++p)
      off = std::max(off, std::abs(far.u()[D * p + D - 1] + gap - near.u()[D * p + D - 1]));
    EXPECT_LE(off, 1e-15 * gap + 1e-14);
  }
}

TEST(LooseBody, LandsAlikeFromAnyHeight) {
  expect_lands_alike<2>(2);
  expect_lands_alike<3>(1);
}

template <int D>
void expect_slips(const Motion<D>& motion, int refinements) {
  const Resting<D> block(motion, 2);
  for (const double aside : {1.0, 1e-2, 1e-6, 1e-9}) {
    try {
      run<D, D>(block.heavy(aside), {uniform(refinements)});
      ADD_FAILURE() << "held against " << aside;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::no_solution) << aside;
    }
  }
}

TEST(LooseBody, SlipsUnderTheLeastLoadAlongThePlane) {
  expect_slips<2>({}, 3);
  expect_slips<2>(rotation2(0.7), 3);
  expect_slips<3>({}, 2);
  expect_slips<3>(rotation3(0.7, 0.4, 2), 2);
}

/// A body in a bowl, at its bottom or across it: it may turn about the bowl's centre. Its centre of mass is exactly
/// below that.
template <int D>
void expect_in_bowl(const std::string& shape, double unit, double turn, const std::vector<int>& refinements) {
  Point<D> load{}, center{};
  load[0] = 0.01 / unit * std::sin(turn);
  load[D - 1] = -0.01 / unit * std::cos(turn);
  center[0] = -0.5 * unit * std::sin(turn);
  center[D - 1] = 0.5 * unit * std::cos(turn);
  const auto scene = fmt::format(R"(
title = "bowl"
[[body]]
name = "b"
{}
order = 1
young = 1
poisson = {}
[[load]]
body = "b"
value = {}
[[obstacle]]
type = "contact"
body = "b"
where = "1"
shape = "sphere"
center = {}
radius = {}
inside = true
)",
                                 shape, poisson, text(load), text(center), unit);
  for (const int refinement : refinements) {
    SCOPED_TRACE(fmt::format("unit {}, turned by {}, {} refinements", unit, turn, refinement));
    expect_solved<D>(scene, {uniform(refinement)}, rotations<D>(center), 40);
  }
}

TEST(LooseBody, RestsInABowl) {
  for (const double unit : {1.0, 1e3, 1e-6}) {
    const auto disk = fmt::format("shape = \"disk\"\ncenter = [0, 0]\nradius = {}\nsize = {}", 0.5 * unit, 0.25 * unit);
    for (const double turn : {0.0, 0.7})
      expect_in_bowl<2>(disk, unit, turn, nightly<std::vector<int>>({1, 3, 4}, {1, 3}));
    const auto cube =
        fmt::format("shape = \"box\"\nfrom = [-{0}, -{0}, -{0}]\nto = [{0}, {0}, {0}]\ncells = [2, 2, 2]", 0.3 * unit);
    expect_in_bowl<3>(cube, unit, 0, nightly<std::vector<int>>({0, 1, 2}, {0, 1}));
  }
}

template <int D>
Index mirrored_vertex(const Mesh<D>& mesh, Index p) {
  for (Index q = 0; q < mesh.vertices(); ++q)
    if (std::hypot(mesh.points[q][0] + mesh.points[p][0], mesh.points[q][1] - mesh.points[p][1]) < 1e-9) return q;
  return -1;
}

/// A mesh whose right half, x > 0, is the mirror image of the left one.
Mesh<2> symmetric_beam() {
  Mesh<2> mesh = rectangle({-2, 0}, {2, 0.5}, {16, 2});
  std::vector<Simplex<2>> elements;
  for (const Simplex<2>& e : mesh.elements) {
    if (mesh.points[e[0]][0] + mesh.points[e[1]][0] + mesh.points[e[2]][0] > 0) continue;
    elements.push_back(e);
    elements.push_back({mirrored_vertex(mesh, e[0]), mirrored_vertex(mesh, e[2]), mirrored_vertex(mesh, e[1])});
  }
  mesh.elements = elements;
  return mesh;
}

/// Under its own weight on two rounds.
std::string beam_on_rounds(const std::string& mesh) {
  std::string text = fmt::format(R"(
[[body]]
name = "beam"
mesh = "{}"
order = 1
young = 1
poisson = 0.3
[[load]]
body = "beam"
value = [0, -0.001]
)",
                                 mesh);
  for (const int side : {-1, 1})
    text += fmt::format(R"(
[[obstacle]]
type = "contact"
body = "beam"
where = "y < 1e-9"
shape = "sphere"
center = [{}, -0.5]
radius = 0.5
)",
                        side);
  return text;
}

TEST(LooseBody, IsSymmetricWhereTheSceneIs) {
  const TemporaryFolder folder;
  const std::string file = folder.write("beam.msh", msh<2>(symmetric_beam(), {}));
  for (const int refinement : {0, 1, 2, 3}) {
    const auto r = run<2, 2>(beam_on_rounds(file), {uniform(refinement), "solver.tolerance=1e-10"});
    double largest = 0, off = 0;
    for (Index p = 0; p < r.mesh().vertices(); ++p) {
      const Index q = mirrored_vertex(r.mesh(), p);
      ASSERT_GE(q, 0);
      largest = std::max(largest, std::abs(r.u()[2 * p + 1]));
      off = std::max({off, std::abs(r.u()[2 * p] + r.u()[2 * q]), std::abs(r.u()[2 * p + 1] - r.u()[2 * q + 1])});
    }
    EXPECT_LE(off, 1e-8 * largest) << refinement << " refinements";
    show("{} refinements: {} cycles, asymmetry {:.1e} of {:.2e}, {} undetermined\n", refinement, r.summary().iterations,
         off, largest, r.solution.undetermined.size());
  }
}

TEST(LooseBody, SaysWhatNothingDetermines) {
  using Names = std::vector<std::string>;
  EXPECT_EQ((run<2, 2>(Resting<2>({}, 2).heavy(), {uniform(2)}).solution.undetermined),
            (Names{"translation along (1, 0)"}));
  EXPECT_EQ((run<3, 3>(Resting<3>({}, 2).heavy(), {uniform(1)}).solution.undetermined),
            (Names{"translation along (1, 0, 0)", "translation along (0, 1, 0)",
                   "rotation about the axis through (0.5, 0.5, 0.5) along (0, 0, 1)"}));
  // Balanced loads and no obstacle in reach.
  const auto r = run<2, 2>(lifted<2>(0, 0.1) +
                           "[[load]]\nbody = \"b\"\non = \"bottom\"\nvalue = [0, -1e-3]\n"
                           "[[load]]\nbody = \"b\"\non = \"top\"\nvalue = [0, 1e-3]\n");
  EXPECT_EQ(r.solution.undetermined.size(), 3u);
}

// The mean displacement along what nothing determines is zero, and obstacles that are not pressed stay where they are.
TEST(LooseBody, MovesLeastAlongWhatNothingDetermines) {
  const auto mean = [](const auto& r) {
    const auto mass = node_volumes(r.nodes());
    double sum = 0, size = 0;
    for (std::size_t p = 0; p < mass.size(); ++p)
      sum += mass[p] * r.u()[2 * p], size += mass[p] * std::abs(r.u()[2 * p + 1]);
    return sum / size;
  };
  const Resting<2> resting({}, 2);
  const std::string block = resting.heavy();
  EXPECT_NEAR(mean(run<2, 2>(block, {uniform(2)})), 0, 1e-12);
  // A wall that reaches into it by a tenth moves it by that, and no further; then it bears no force.
  const auto wall = run<2, 2>(block +
                                  "[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\nwhere = \"1\"\n"
                                  "shape = \"plane\"\npoint = [0.1, 0]\nnormal = [1, 0]\n",
                              {uniform(2)});
  double least = infinity;
  for (Index p = 0; p < wall.mesh().vertices(); ++p)
    if (wall.mesh().points[p][0] == 0) least = std::min(least, wall.u()[2 * p]);
  EXPECT_NEAR(least, 0.1, 1e-9);
  EXPECT_NEAR(wall.contact(1).force[0], 0, 1e-9 * pressure);
}

// A beam guided at one end, and pressed on a wall by a force that is small beside its own weight: nothing determines
// how far it is along the wall, whichever way the scene is turned.
TEST(LooseBody, MovesLeastWhicheverWayTheSceneIsTurned) {
  const TemporaryFolder folder;
  const auto solved = [&](const Motion<3>& motion) {
    const std::string file =
        folder.write("beam.msh", msh<3>(box({-0.3, -0.27, -0.85}, {0.3, 0.27, 0.85}, {3, 2, 2}), motion));
    const auto r =
        run<3, 3>("[[body]]\nname = \"b\"\nmesh = \"" + file +
                  "\"\norder = 1\nyoung = 1\npoisson = 0.22\n"
                  "[[fix]]\nbody = \"b\"\non = \"top\"\nframe = \"normal\"\nvalue = [0, \"free\", \"free\"]\n"
                  "[[load]]\nbody = \"b\"\nvalue = " +
                  text(motion.turned({2e-9, 0, 2e-3})) +
                  "\n[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\nshape = \"sphere\"\ninside = true\n"
                  "on = \"front\"\nradius = 1.2\ncenter = " +
                  text(motion.turned({0, 0.1, 0})) +
                  "\n[[obstacle]]\ntype = \"contact\"\nbody = \"b\"\nshape = \"plane\"\non = \"boundary\"\npoint = " +
                  text(motion.turned({0.301, 0, 0})) + "\nnormal = " + text(motion.turned({-1, 0, 0})) + "\n");
    EXPECT_EQ(r.solution.undetermined.size(), 1u);
    return r.u();
  };
  const std::vector<double> expected = solved({});
  Random random(36);
  for (int turn = 0; turn < 24; ++turn) {
    const Motion<3> motion = rotation3(random.between(-3, 3), random.between(-1.5, 1.5), random.between(-3, 3));
    const std::vector<double> u = solved(motion);
    for (std::size_t p = 0; p < u.size(); p += 3) {
      const Point<3> turned = motion.turned({expected[p], expected[p + 1], expected[p + 2]});
      for (int i = 0; i < 3; ++i) ASSERT_NEAR(u[p + i], turned[i], 1e-9) << turn;
    }
  }
}

}  // namespace
}  // namespace signorini::test
