// Rows of what is prescribed, planes that fixes make planes of symmetry, and numbers that no solver can compute with.
#include <gmock/gmock.h>

#include <limits>

#include "core/base/error.hpp"
#include "core/fem/assembly/magnitude.hpp"
#include "core/fem/conditions/prescribed_rows.hpp"
#include "core/fem/conditions/walls.hpp"
#include "core/solver/local_coordinates.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// An elastic body, or a membrane, of which some components are to be prescribed; nothing is eliminated.
template <int D, int B>
DiscreteProblem<B> free_problem() {
  const Mesh<D> mesh = distorted_mesh<D>(2);
  Model<B> model;
  model.poisson = 0.3;
  DiscreteProblem<B> out;
  out.A = stiffness(mesh, model);
  const std::size_t n = mesh.points.size();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  for (std::size_t i = 0; i < n * B; ++i) out.b.push_back(any(random));
  out.start.assign(n * B, 0);
  for (Index p = 0; p < mesh.vertices(); ++p) {
    const bool left = mesh.points[p][0] == 0, bottom = mesh.points[p][D - 1] == 0;
    out.fixed.push_back(static_cast<Flags>(left ? (1u << B) - 1 : bottom ? 1u << (B - 1) : 0u));
    for (int k = 0; k < B; ++k)
      if (out.fixed.back() >> k & 1u) out.start[p * B + k] = any(random);
  }
  return out;
}

template <int B>
PrescribedRows<B> rows_of(const DiscreteProblem<B>& problem) {
  PrescribedRows<B> out;
  for (Index p = 0; p < problem.A.size(); ++p)
    if (problem.fixed[p]) out.add(problem.A, p);
  out.take_load(problem.b);
  return out;
}

template <int D, int B>
void expect_forces() {
  const DiscreteProblem<B> problem = free_problem<D, B>();
  PrescribedRows<B> rows = rows_of(problem);
  const Eigen::MatrixXd A = dense(problem.A);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(A.rows(), -1, 2).array().sin();
  const Eigen::VectorXd force = A * x - Eigen::Map<const Eigen::VectorXd>(problem.b.data(), A.rows());
  double along[B];
  for (int i = 0; i < B; ++i) along[i] = 0.3 + i;
  const auto expect_them = [&](const std::vector<double>& unknowns) {
    for (Index k = 0; k < static_cast<Index>(rows.vertex.size()); ++k) {
      EXPECT_EQ(rows.at(rows.vertex[k]), k);
      double wanted = 0;
      for (int i = 0; i < B; ++i) wanted += along[i] * force[rows.vertex[k] * B + i];
      EXPECT_NEAR(rows.force(k, along, unknowns), wanted, 1e-13);
    }
  };
  ASSERT_FALSE(rows.vertex.empty());
  expect_them(to_std(x));
  if constexpr (B > 1) {  // other coordinates of the columns change no force
    Frames<B> frames;
    const Eigen::Matrix<double, B, B, Eigen::RowMajor> Q = rotation<B>();
    for (Index p = 0; p < problem.A.size(); p += 2) {
      frames.add(problem.fixed.size(), p, Q.data(), Q.data());
      x.segment<B>(p * B) = (Q.transpose() * x.segment<B>(p * B)).eval();
    }
    rows.rotate_columns(frames);
    expect_them(to_std(x));
  }
}

TEST(PrescribedRows, TellTheForcesWhatIsPrescribedTakes) {
  expect_forces<2, 1>();
  expect_forces<2, 2>();
  expect_forces<3, 3>();
}

TEST(PrescribedRows, TellNoForceWhereTermsCancel) {
  DiscreteProblem<1> problem = free_problem<2, 1>();
  std::fill(problem.b.begin(), problem.b.end(), 0);
  const PrescribedRows<1> rows = rows_of(problem);
  const double along[] = {1};
  for (Index k = 0; k < static_cast<Index>(rows.vertex.size()); ++k)
    EXPECT_EQ(rows.force(k, along, std::vector<double>(problem.b.size(), 1 / 3.0)), 0);  // constants have no gradient
}

// Other prescribed values of an eliminated problem are as if it had been eliminated with them.
template <int D, int B>
void expect_prescribed() {
  const DiscreteProblem<B> whole = free_problem<D, B>();
  const PrescribedRows<B> rows = rows_of(whole);
  DiscreteProblem<B> wanted = whole, found = whole;
  for (std::size_t i = 0; i < wanted.start.size(); ++i) wanted.start[i] *= 1 + 0.1 * static_cast<double>(i);
  eliminate(wanted);
  eliminate(found);
  found.b = whole.b;
  found.start = wanted.start;
  prescribe(found, rows);
  ASSERT_EQ(found.coupled, wanted.coupled);
  for (std::size_t i = 0; i < wanted.b.size(); ++i) EXPECT_NEAR(found.b[i], wanted.b[i], 1e-12);
  for (std::size_t i = 0; i < wanted.coupling.size(); ++i) EXPECT_NEAR(found.coupling[i], wanted.coupling[i], 1e-12);
  EXPECT_NEAR(found.prescribed_energy, wanted.prescribed_energy, 1e-11);
  EXPECT_NEAR(found.prescribed_work, wanted.prescribed_work, 1e-11);
  const Eigen::Map<const Eigen::VectorXd> g(wanted.start.data(), std::ssize(wanted.start));
  EXPECT_NEAR(found.prescribed_energy, g.dot(dense(whole.A) * g), 1e-11);
}

TEST(PrescribedRows, RenewWhatIsPrescribed) {
  expect_prescribed<2, 1>();
  expect_prescribed<2, 2>();
  expect_prescribed<3, 3>();
}

/// A side that slides along itself.
template <int D>
Fix<D> sliding(const std::string& part, double value = 0) {
  Fix<D> out = fix<D>(part, {}, Frame::normal);
  out.value[0] = value;
  return out;
}

template <int D>
std::vector<Flat<D>> walls_of(const Mesh<D>& mesh, std::vector<Fix<D>> fixes) {
  Model<D> model;
  model.fixes = std::move(fixes);
  const Nodes<D> nodes(mesh);
  std::vector<Index> all(mesh.points.size());
  std::iota(all.begin(), all.end(), 0);
  return walls(nodes, model, all);
}

template <int D>
void expect_wall() {
  Mesh<D> mesh = distorted_mesh<D>(2);
  EXPECT_DOUBLE_EQ(extent(mesh), 1);
  rotate_mesh(mesh);
  const auto found = walls_of<D>(mesh, {sliding<D>("left")});
  ASSERT_EQ(found.size(), 1u);
  const Flat<D>& wall = found[0];
  const Eigen::Matrix<double, D, 1> outwards = -rotation<D>().col(0);
  EXPECT_LT((vector<D>(wall.normal) - outwards).norm(), 1e-14);
  EXPECT_NEAR(vector<D>(wall.point).dot(outwards), 0, 1e-14);
  int on = 0, left = 0;
  for (const Point<D>& x : mesh.points) {
    on += lies_on<D>(wall, x, 1);
    left += std::abs(vector<D>(x).dot(outwards)) < 1e-12;
    const Point<D> image = reflected<D>(wall, x);
    EXPECT_NEAR(vector<D>(image).dot(outwards), -vector<D>(x).dot(outwards), 1e-14);
    EXPECT_LT((vector<D>(reflected<D>(wall, image)) - vector<D>(x)).norm(), 1e-14);
  }
  EXPECT_EQ(on, left);
  EXPECT_GT(left, 2);
  EXPECT_EQ(walls_of<D>(mesh, {sliding<D>("left"), sliding<D>("bottom")}).size(), 2u);
}

TEST(Walls, ArePlanesAlongWhichASideSlides) {
  expect_wall<2>();
  expect_wall<3>();
}

template <int D>
void expect_no_walls() {
  const Mesh<D> mesh = unit_mesh<D>(4);
  std::array<std::optional<Field>, D> clamped;
  clamped.fill(0);
  EXPECT_TRUE(walls_of<D>(mesh, {sliding<D>("left", 0.01)}).empty()) << "it is moved";
  EXPECT_TRUE(walls_of<D>(mesh, {fix<D>("left", clamped)}).empty()) << "nothing slides";
  Fix<D> half = sliding<D>("left");
  half.on.where = expression([](const Site& s) { return s.x[D - 1] < 0.7; });
  EXPECT_TRUE(walls_of<D>(mesh, {half}).empty()) << "part of the side is free";
  EXPECT_TRUE(walls_of<D>(mesh, {}).empty());
  Model<D> model;
  model.fixes = {sliding<D>("left")};
  EXPECT_TRUE(walls(Nodes<D>(mesh), model, std::vector<Index>{}).empty()) << "none was asked about";
  Model<1> membrane;
  membrane.fixes = {fix<1>("left", {0.0})};
  EXPECT_TRUE((walls<D, 1>(Nodes<D>(mesh), membrane, {0, 1, 2}).empty()));
}

TEST(Walls, AreNoneWhereNotAllOfThePlaneSlides) {
  expect_no_walls<2>();
  expect_no_walls<3>();
}

// Where the body goes on beyond the plane there is no image: a step whose lower half reaches farther to the left.
TEST(Walls, EndAllBodies) {
  const Mesh<2> mesh = distorted_mesh<2>(3);
  Mesh<2> step = mesh;
  for (Point<2>& x : step.points)
    if (x[0] == 0 && x[1] < 0.3) x[0] = -0.2;
  Fix<2> upper = fix<2>("left", {0.0, std::nullopt});
  upper.on.where = expression([](const Site& s) { return s.x[0] == 0; });
  EXPECT_EQ(walls_of<2>(mesh, {upper}).size(), 1u);
  EXPECT_TRUE(walls_of<2>(step, {upper}).empty());
}

template <class Work>
std::string complaint(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "";
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <int D, int B>
void expect_lengths() {
  Mesh<D> mesh = unit_mesh<D>(1);
  Model<B> model;
  model.origin = "scene.toml:3: body.0";
  EXPECT_EQ(complaint([&] { check_lengths(mesh, model); }), "");
  mesh.points.back()[D - 1] = -1e99;
  EXPECT_EQ(complaint([&] { check_lengths(mesh, model); }), "");
  for (const double x : {1e101, -1e101, infinity, nan}) {
    mesh.points.back()[D - 1] = x;
    EXPECT_THAT(complaint([&] { check_lengths(mesh, model); }),
                AllOf(HasSubstr("scene.toml:3: body.0"), HasSubstr("coordinate"), HasSubstr("(1, ")));
  }
}

TEST(Magnitude, TooLargeLengthsAreRefused) {
  expect_lengths<2, 1>();
  expect_lengths<2, 2>();
  expect_lengths<3, 3>();
}

TEST(Magnitude, StiffnessNeedsDiagonalsWithAnInverse) {
  const Mesh<2> mesh = unit_mesh<2>(1);
  Model<2> model;
  model.origin = "body.0";
  const auto good = stiffness(mesh, model);
  const auto told = [&](auto change) {
    auto A = good;
    change(A);
    return complaint([&] { check_stiffness(Nodes<2>(mesh), model, A); });
  };
  EXPECT_EQ(told([](auto&) {}), "");
  for (const double d : {0.0, infinity, nan, 1e-320})
    EXPECT_THAT(told([d](auto& A) { A.at(A.row[3])[3] = d; }), AllOf(HasSubstr("body.0"), HasSubstr("(1, 0.5)")));
  EXPECT_THAT(told([](auto& A) { A.column[A.row[3]] = 0; }), HasSubstr("(1, 0.5)"));  // not stored
  EXPECT_EQ(told([](auto& A) { A.at(A.row[3])[1] = 0; }), "");                        // which is not on it
}

TEST(Magnitude, LoadsNeedAFiniteEnergy) {
  const Mesh<2> mesh = unit_mesh<2>(1);
  Model<1> model;
  model.origin = "body.0";
  model.loads = {{{}, {1.0}}};
  const auto told = [&](double diffusion, double b) {
    model.diffusion = diffusion;
    auto problem = discretize(mesh, model).problem;
    problem.b[2] = b;
    return complaint([&] { check_load(Nodes<2>(mesh), model, problem); });
  };
  EXPECT_EQ(told(1, 1e150), "");
  EXPECT_THAT(told(1, 1e160), AllOf(HasSubstr("body.0"), HasSubstr("(0, 0.5)"), HasSubstr("load")));
  EXPECT_NE(told(1e-200, 1e100), "");  // the square is finite, the energy is not
}

}  // namespace
}  // namespace signorini::testing
