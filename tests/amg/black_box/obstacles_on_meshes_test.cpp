// Friction at blocks of a matrix is what finite elements on a mesh make of it, and takes as many cycles on finer
// meshes.
#include <gtest/gtest.h>

#include <cmath>

#include "amg/black_box.hpp"
#include "amg/registration.hpp"
#include "amg/tabulated_obstacle.hpp"
#include "core/fem/assembly/assemble.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "core/mesh/structured.hpp"
#include "core/sdk/coulomb_law.hpp"
#include "methods/solve.hpp"

namespace signorini::test {
namespace {

template <int D>
Mesh<D> block(Index cells) {
  if constexpr (D == 2)
    return rectangle({0, 0}, {2, 1}, {2 * cells, cells});
  else
    return box({0, 0, 0}, {2, 1, 1}, {2 * cells, cells, cells});
}

/// A block that is lowered onto a rough plane and pushed aside.
template <int D>
class Pushed {
 public:
  explicit Pushed(Index cells) : mesh_(block<D>(cells)), nodes_(mesh_) {
    model_.poisson = 0.3;
    ObstacleTable<D> table;
    table.width = 2;
    for (Index p = 0; p < mesh_.vertices(); ++p) {
      if (mesh_.points[p][D - 1] != 0) continue;
      table.blocks.push_back(p);
      for (int k = 0; k < D; ++k) table.direction.push_back(k == D - 1 ? 1 : 0);
      table.lower.push_back(0);
      table.data.insert(table.data.end(), {0, 0.3});
    }
    blocks_ = table.blocks;
    floor_ = std::make_shared<const TabulatedObstacle<D, CoulombLaw<D>>>(std::move(table));
  }

  BlackBox::Result by_matrix(double tolerance) const {
    const BlockMatrix<D> A = stiffness<D, D>(nodes_, model_);
    std::vector<double> coordinates;
    for (const Point<D>& x : mesh_.points) coordinates.insert(coordinates.end(), x.begin(), x.end());
    SolverOptions options;
    options.tolerance = tolerance;
    BlackBox solver(rows(A), D, options, rigid_body_modes<D>(coordinates));
    solver.set_obstacles<D>({{floor_, blocks_, {blocks_.size(), SurfaceVertex{{}, {}, 1}}, "floor"}});
    std::vector<double> lower(coordinates.size(), -infinity), upper(coordinates.size(), infinity);
    for (Index p = 0; p < mesh_.vertices(); ++p)
      for (int k = 0; k < D && mesh_.points[p][D - 1] == 1; ++k)
        lower[Offset{p} * D + k] = upper[Offset{p} * D + k] = way(k);
    return solver.solve(std::vector<double>(coordinates.size(), 0.0), lower, upper);
  }

  /// As scenes are solved: on the mesh, here by a single level.
  std::vector<double> by_mesh() const {
    Model<D> model = model_;
    Fix<D> fix{Selection{"top", {}, ""}, {}};
    for (int k = 0; k < D; ++k) fix.value[k] = Field(way(k));
    model.fixes = {fix};
    model.obstacles = {{floor_, Selection{"bottom", {}, ""}, "floor"}};
    const Discretization<D> discretization = discretize<D, D>(nodes_, model);
    std::vector<double> x = discretization.problem.start;
    SolverOptions options;
    options.tolerance = 1e-12;
    const Summary summary = signorini::solve<D>(discretization.problem, {}, x, options, solver_components());
    EXPECT_TRUE(summary.converged()) << summary.reason;
    return to_global(discretization.problem, x);
  }

  std::size_t on_floor() const { return blocks_.size(); }

 private:
  static double way(int k) { return k == D - 1 ? -0.03 : k == 0 ? 0.01 : 0.005; }

  static SparseRows rows(const BlockMatrix<D>& A) {
    std::vector<Eigen::Triplet<double>> entries;
    for (Index p = 0; p < A.size(); ++p)
      for (Offset k = A.row[p]; k < A.row[p + 1]; ++k)
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j) entries.emplace_back(p * D + i, A.column[k] * D + j, A.at(k)[i * D + j]);
    Eigen::SparseMatrix<double> out(A.size() * D, A.size() * D);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  Mesh<D> mesh_;
  Nodes<D> nodes_;
  Model<D> model_;
  std::vector<Index> blocks_;
  std::shared_ptr<const Obstacle<D>> floor_;
};

template <int D>
void expect_as_on_the_mesh(Index cells) {
  const Pushed<D> pushed(cells);
  const auto result = pushed.by_matrix(1e-12);
  ASSERT_TRUE(result.summary.converged()) << result.summary.reason;
  const std::vector<double> u = pushed.by_mesh();
  for (std::size_t i = 0; i < u.size(); ++i) ASSERT_NEAR(result.x[i], u[i], 1e-10) << i;
}

TEST(BlackBoxObstacles, AreThoseOfMeshesInThePlane) { expect_as_on_the_mesh<2>(8); }
TEST(BlackBoxObstacles, AreThoseOfMeshesInSpace) { expect_as_on_the_mesh<3>(4); }

/// Also in the file that --gtest_output=xml writes.
template <int D>
void expect_few_cycles(Index cells) {
  const BlackBox::Result result = Pushed<D>(cells).by_matrix(1e-8);
  ASSERT_TRUE(result.summary.converged()) << result.summary.reason;
  EXPECT_GT(result.summary.level_unknowns.size(), 1u);
  EXPECT_EQ(result.summary.stages.size(), 1u);  // cycles alone
  EXPECT_LE(result.summary.iterations, 20) << cells;
  ::testing::Test::RecordProperty("cycles_" + std::to_string(D) + "d_" + std::to_string(cells),
                                  result.summary.iterations);
}

TEST(BlackBoxObstacles, TakeAsManyCyclesOnFinerMeshes) {
  for (const Index cells : {16, 32, 64}) expect_few_cycles<2>(cells);
  for (const Index cells : {8, 12, 16}) expect_few_cycles<3>(cells);
}

}  // namespace
}  // namespace signorini::test
