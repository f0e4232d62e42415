// Where the matrix of a coarser mesh is the Galerkin product of the finer one's, the solver takes it over.
#include "apps/scenes/tables.hpp"
#include "core/fem/elements/nested.hpp"
#include "core/solver/interpolate.hpp"
#include "core/solver/multigrid.hpp"
#include "methods/configuration.hpp"
#include "run.hpp"
#include "tests/support/dense.hpp"

namespace signorini::test {
namespace {

/// A scene's problems on its two finest meshes.
template <int D, int B>
struct TwoMeshes {
  Registry registry = solver_components();
  MeshHierarchy<D> meshes;
  DiscreteProblem<B> coarse, fine;
  std::vector<Prolongation> P;

  TwoMeshes(const char* file, std::vector<std::string> overrides) : TwoMeshes(shipped(file, std::move(overrides))) {}
  explicit TwoMeshes(const Scene& scene) {
    load_plugins(scene, registry);
    meshes = build_hierarchy<D>(scene, B);
    const Model<B> model = build_model<B>(scene, D, registry, 1);
    const auto& levels = meshes.levels;
    coarse = discretize<D, B>(levels[levels.size() - 2], model).problem;
    fine = discretize<D, B>(levels.back(), model).problem;
    P = {prolongation(meshes.refinements.back(), Nodes(levels[levels.size() - 2]), Nodes(levels.back()))};
  }

  bool galerkin() const { return is_galerkin(coarse, P.front(), fine); }
};

TEST(NestedMatrices, AreProductsOnPolyhedra) {
  EXPECT_TRUE((TwoMeshes<2, 1>("obstacle_radial_2d.toml", {"refine.uniform=3"}).galerkin()));
  EXPECT_TRUE((TwoMeshes<3, 1>("obstacle_cube_3d.toml", {"refine.uniform=2"}).galerkin()));
  EXPECT_TRUE((TwoMeshes<2, 2>("signorini_elastic_2d.toml", {"refine.uniform=3"}).galerkin()));
  EXPECT_TRUE((TwoMeshes<3, 3>("cube_on_bump.toml", {"refine.uniform=2"}).galerkin()));
}

TEST(NestedMatrices, AreNoneOnCurvedMeshesAndWithVaryingCoefficients) {
  EXPECT_FALSE((TwoMeshes<2, 1>("obstacle_torsion_disk.toml", {"refine.uniform=4"}).galerkin()));
  EXPECT_FALSE((TwoMeshes<3, 3>("ball_on_plane.toml", {"refine.uniform=1"}).galerkin()));
  EXPECT_FALSE(
      (TwoMeshes<3, 3>("cube_on_bump.toml", {"refine.uniform=2", "body.0.young='x < 0.3 ? 1 : 100'"}).galerkin()));
}

// Faces are picked on the coarsest mesh: common vertices have the same frames, but where those are others.
TEST(NestedMatrices, AreNoneInOtherFrames) {
  const auto picked = [](const std::string& where, const std::string& normal = "[0, 0, 1]") {
    const std::string cube =
        tables::block("cube", "[0, 0, 0]", "[1, 1, 1]", "[4, 4, 4]") + tables::fix("cube", "top", "[0, 0, -0.05]");
    return TwoMeshes<3, 3>(parse_scene(cube + fmt::format(R"(
[[obstacle]]
type = "contact"
body = "cube"
where = 'z < 1e-9 && ({})'
shape = "plane"
point = [0, 0, 0]
normal = {}
[refine]
uniform = 2)",
                                                          where, normal),
                                       "test.toml", ".", {}));
  };
  EXPECT_TRUE(picked("x < 0.6").galerkin());
  EXPECT_TRUE(picked("x < 0.26 || abs(x * 4 - floor(x * 4 + 0.5)) < 0.26").galerkin());
  const auto level = picked("x < 0.6"), tilted = picked("x < 0.6", "[0.1, 0, 1]");
  EXPECT_TRUE(tilted.galerkin());
  EXPECT_FALSE(is_galerkin(level.coarse, level.P.front(), tilted.fine));
}

/// The coarse matrix of a cycle in which contact truncates.
template <int B>
BlockMatrix<B> coarse_matrix(const DiscreteProblem<B>& problem, const std::vector<Prolongation>& P,
                             const Registry& registry) {
  MonotoneMultigrid<B> multigrid(problem, P, components_of<B>({}, registry), {});
  std::vector<double> x = problem.start;
  for (int k = 0; k < 2; ++k) multigrid.cycle(x.data());
  return multigrid.levels().front().own_matrix;
}

template <int D, int B>
void expect_same_matrix(const char* file, const char* refined) {
  TwoMeshes<D, B> meshes(file, {refined});
  const BlockMatrix<B> computed = coarse_matrix(meshes.fine, meshes.P, meshes.registry);
  const std::vector<GalerkinMatrix<B>> known{{meshes.coarse.A, meshes.coarse.fixed, false}};
  meshes.fine.galerkin = known;
  const BlockMatrix<B> shared = coarse_matrix(meshes.fine, meshes.P, meshes.registry);
  ASSERT_EQ(shared.column, computed.column);
  EXPECT_LT((vector(shared.value) - vector(computed.value)).norm(), 1e-13 * vector(computed.value).norm());
}

TEST(NestedMatrices, SharedOnesAreTruncatedLikeComputedOnes) {
  expect_same_matrix<2, 1>("obstacle_radial_2d.toml", "refine.uniform=3");
  expect_same_matrix<3, 1>("obstacle_cube_3d.toml", "refine.uniform=2");
  expect_same_matrix<3, 3>("cube_on_bump.toml", "refine.uniform=2");
}

}  // namespace
}  // namespace signorini::test
