// Selections by an expression: faces of the coarsest mesh are picked, once, and all finer meshes inherit it.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/select.hpp"
#include "core/fem/recovery/cut_faces.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/refine.hpp"
#include "support.hpp"

namespace signorini::testing {
namespace {

Selection where(std::function<double(const Site&)> f) { return {{}, expression(std::move(f), "f"), "load.0"}; }

template <int D>
double measure(const Mesh<D>& mesh, const std::vector<Index>& faces) {
  double sum = 0;
  for (const Index f : faces) {
    const Point<D> n = area_normal(mesh, mesh.boundary[f]);
    sum += std::sqrt(dot(n, n));
  }
  return sum;
}

template <int D>
Mesh<D> cells(Index n) {
  if constexpr (D == 2)
    return rectangle({0, 0}, {1, 1}, {n, n});
  else
    return box({0, 0, 0}, {1, 1, 1}, {n, n, n});
}

template <int D>
void expect_inherited(const Selection& selection, double expected) {
  const MeshHierarchy<D> h = hierarchy(cells<D>(4), D == 2 ? 5 : 2);
  for (const Mesh<D>& mesh : h.levels)
    EXPECT_NEAR(measure(mesh, select_faces(mesh, selection, 1)), expected, 1e-12) << mesh.refinements;
}

// Cells end at 0.5; finer ones would end at 0.5078.
TEST(Select, FinerMeshesInheritWhatIsPickedOnTheCoarsest) {
  for (const double at : {0.5, 0.51, 0.74}) {
    expect_inherited<2>(where([=](const Site& s) { return s.x[0] <= at && s.n[1] > 0.5; }), 0.5);
    expect_inherited<3>(where([=](const Site& s) { return s.x[0] <= at && s.n[2] > 0.5; }), 0.5);
    expect_inherited<2>({"top", expression([=](const Site& s) { return s.x[0] <= at; }), "load.0"}, 0.5);
    expect_inherited<3>({"top", expression([=](const Site& s) { return s.x[0] <= at; }), "load.0"}, 0.5);
  }
}

// No face of the coarsest mesh, though finer ones have some.
TEST(Select, NothingIsPickedOnFinerMeshesAlone) {
  const MeshHierarchy<2> h = hierarchy(cells<2>(4), 4);
  const Selection narrow = where([](const Site& s) { return s.x[0] < 0.2 && s.n[1] > 0.5; });
  for (const Mesh<2>& mesh : h.levels) EXPECT_THROW(select_faces(mesh, narrow, 1), Error);
}

TEST(Select, FollowsTheStepParameter) {
  const MeshHierarchy<2> h = hierarchy(cells<2>(4), 3);
  const Selection moving = where([](const Site& s) { return s.x[0] <= s.t && s.n[1] > 0.5; });
  for (const double t : {0.25, 0.5, 1.0})
    for (const Mesh<2>& mesh : h.levels) EXPECT_NEAR(measure(mesh, select_faces(mesh, moving, t)), t, 1e-12);
}

TEST(Select, CurvedFacesInheritToo) {
  Mesh<2> coarse = cells<2>(1);  // a square that becomes a disk
  coarse.curves = {{.center = {0.5, 0.5}, .radius = std::sqrt(0.5)}};
  for (auto& face : coarse.boundary) face.curve = 0;
  const MeshHierarchy<2> h = hierarchy(coarse, 6);
  // The lower edge becomes a quarter of the circle, whose normals point everywhere between its corners.
  const Selection lower = where([](const Site& s) { return s.n[1] < -0.99; });
  EXPECT_NEAR(measure(h.finest(), select_faces(h.finest(), lower, 1)), M_PI / 2 * std::sqrt(0.5), 1e-3);
}

template <int D>
std::vector<CutSelection> cuts(const Mesh<D>& mesh, const Model<1>& model) {
  return cut_selections(mesh, model);
}

TEST(Select, SaysHowMuchIsCutOff) {
  Model<1> model;
  model.loads.push_back({where([](const Site& s) { return s.x[0] < 0.51 && s.n[1] > 0.5; }), {1.0}});
  model.fixes.push_back({where([](const Site& s) { return s.x[0] <= 0.5 && s.n[1] > 0.5; }), {0.0}});
  for (const Mesh<2>& mesh : hierarchy(cells<2>(4), 3).levels) {
    const auto found = cuts<2>(mesh, model);
    ASSERT_EQ(found.size(), 1u) << "only the load's expression cuts through a face";
    EXPECT_EQ(found[0].selection, &*model.loads[0].on);
    EXPECT_NEAR(found[0].picked, 0.5, 1e-12);
    EXPECT_NEAR(found[0].missed, 0.01, 0.25 / 256);
  }
  model.loads[0].on = where([](const Site& s) { return s.x[0] < 0.6 && s.n[2] > 0.5; });
  model.fixes.clear();
  for (const Mesh<3>& mesh : hierarchy(cells<3>(2), 1).levels) {
    const auto found = cuts<3>(mesh, model);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].picked, 0.5, 1e-12);
    EXPECT_NEAR(found[0].missed, 0.1, 0.01);
  }
}

// What is meant is the top; the sides are picked where they are meant, too.
TEST(Select, ToleranceAroundAFaceIsNoCut) {
  Model<1> model;
  model.loads.push_back({where([](const Site& s) { return s.x[1] > 0.99; }), {1.0}});
  EXPECT_TRUE(cuts<2>(cells<2>(4), model).empty());
  model.loads[0].on = where([](const Site& s) { return s.x[2] > 0.99; });
  EXPECT_TRUE(cuts<3>(cells<3>(2), model).empty());
  model.loads[0].on = where([](const Site& s) { return s.x[2] > 0.5; });  // not on the vertices at 0.5
  const auto found = cuts<3>(cells<3>(2), model);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].missed, 4 * 0.5, 0.1);
}

TEST(Select, SaysOnHowMuchOfThePickedItDoesNotHold) {
  Model<1> model;
  // Holds at all corners, not from 0.05 to 0.2 nor from 0.55 to 0.7.
  model.loads.push_back(
      {where([](const Site& s) { return std::abs(std::fmod(s.x[0], 0.5) - 0.125) > 0.075 && s.x[1] == 1; }), {1.0}});
  model.fixes.push_back({where([](const Site& s) { return s.x[1] == 0; }), {0.0}});
  for (const Mesh<2>& mesh : hierarchy(cells<2>(4), 3).levels) {
    const auto found = cuts<2>(mesh, model);
    ASSERT_EQ(found.size(), 1u) << "only the load's expression cuts through faces";
    EXPECT_NEAR(found[0].picked, 1, 1e-12);
    EXPECT_NEAR(found[0].wrong, 0.3, 4 * 0.25 / 256);
    EXPECT_EQ(found[0].missed, 0);
  }
  model.loads[0].on = where([](const Site& s) { return std::abs(s.x[0] - 0.25) > 0.1 && s.x[2] == 1; });
  model.fixes[0].on = where([](const Site& s) { return s.x[2] == 0; });
  for (const Mesh<3>& mesh : hierarchy(cells<3>(2), 1).levels) {
    const auto found = cuts<3>(mesh, model);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0].picked, 1, 1e-12);
    EXPECT_NEAR(found[0].wrong, 0.2, 0.02);
    EXPECT_EQ(found[0].missed, 0);
  }
}

// On a turned square, at coordinates that rounding leaves next to its sides.
TEST(Select, RoundingIsNoCut) {
  Mesh<2> mesh = cells<2>(4);
  for (Point<2>& x : mesh.points) x = {0.6 * x[0] - 0.8 * x[1], 0.8 * x[0] + 0.6 * x[1]};
  const auto height = [](const Site& s) { return 0.6 * s.x[1] - 0.8 * s.x[0]; };
  double top = 1;
  for (const Point<2>& x : mesh.points)
    if (const double h = 0.6 * x[1] - 0.8 * x[0]; h > 0.9) top = std::min(top, h);
  Model<1> model;
  model.fixes.push_back({where([=](const Site& s) { return height(s) >= top; }), {0.0}});
  EXPECT_TRUE(cuts<2>(mesh, model).empty());
}

// A circle that the mesh knows by its chords alone.
TEST(Select, FacetsOfACurveAreNotCutByIt) {
  Mesh<2> mesh;
  constexpr int corners = 24;
  mesh.points.push_back({0, 0});
  for (int k = 0; k < corners; ++k) {
    mesh.points.push_back({std::cos(2 * M_PI * k / corners), std::sin(2 * M_PI * k / corners)});
    mesh.elements.push_back({0, k + 1, (k + 1) % corners + 1});
  }
  mesh.boundary = find_boundary<2>(corners + 1, mesh.elements);
  Model<1> model;
  model.fixes.push_back({where([](const Site& s) { return std::hypot(s.x[0], s.x[1]) > 0.999; }), {0.0}});
  EXPECT_TRUE(cuts<2>(mesh, model).empty());
}

// Chords lie inside the circle; what is asked for are points on it.
TEST(Select, CurvedFacesAreNotCutByTheirCurve) {
  Mesh<2> coarse = cells<2>(1);
  coarse.curves = {{.center = {0.5, 0.5}, .radius = std::sqrt(0.5)}};
  for (auto& face : coarse.boundary) face.curve = 0;
  Model<1> model;
  model.fixes.push_back({where([](const Site& s) {
                           return std::hypot(s.x[0] - 0.5, s.x[1] - 0.5) > 0.7 && s.x[1] < 0.1 && s.n[1] < -0.5;
                         }),
                         {0.0}});
  for (const Mesh<2>& mesh : hierarchy(coarse, 2).levels) EXPECT_TRUE(cuts<2>(mesh, model).empty());
}

}  // namespace
}  // namespace signorini::testing
