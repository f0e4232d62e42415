// Which meshes are levels, which matrices they have, and where unknowns between bodies are jumps.
#include <gtest/gtest.h>

#include <set>

#include "core/fem/elements/nested.hpp"
#include "core/mesh/join.hpp"
#include "core/mesh/refine.hpp"
#include "driver/levels/level_choice.hpp"
#include "driver/levels/level_matrices.hpp"
#include "driver/levels/level_pairs.hpp"
#include "driver/levels/mesh_level.hpp"
#include "driver/levels/near_null_space.hpp"
#include "tests/support/problems.hpp"

namespace signorini::test {
namespace {

template <int D>
std::size_t first(const Mesh<D>& coarsest, const Scene::Solver& options, int block, int order = 1) {
  const MeshHierarchy<D> meshes = hierarchy(coarsest, 2);
  return first_mesh<D>(meshes_of(meshes), options, block, order);
}

Scene::Solver with(const std::string& by, bool algebraic = true) {
  Scene::Solver out;
  out.hierarchy = by;
  out.algebraic = algebraic;
  return out;
}

TEST(LevelChoice, IsWhatTheSceneSays) {
  EXPECT_EQ(first(cube<2>(0, 1, 3), with("meshes"), 2), 0u);
  EXPECT_EQ(first(cube<2>(0, 1, 3), with("matrix"), 2), 2u);
  EXPECT_EQ(first(cube<2>(0, 1, 3), with("matrix"), 2, 2), 1u);  // below quadratic elements there are linear ones
}

TEST(LevelChoice, LeavesStretchedCellsToTheMatrix) {
  const Mesh<2> square = cube<2>(0, 1, 4), flat = rectangle({0, 0}, {4, 1}, {4, 10});
  const Mesh<3> thick = cube<3>(0, 1, 3), thin = box({0, 0, 0}, {1, 1, 0.02}, {2, 2, 2});
  for (const int block : {1, 2}) {
    EXPECT_FALSE(is_stretched(square, block));
    EXPECT_TRUE(is_stretched(flat, block));
  }
  for (const int block : {1, 3}) {
    EXPECT_FALSE(is_stretched(thick, block));
    EXPECT_TRUE(is_stretched(thin, block));
  }
  EXPECT_EQ(first(square, with("auto"), 1), 0u);
  EXPECT_EQ(first(flat, with("auto"), 1), 2u);
  EXPECT_EQ(first(thin, with("auto"), 1), 2u);
  EXPECT_EQ(first(flat, with("auto"), 1, 2), 1u);
  EXPECT_EQ(first(flat, with("auto", false), 1), 0u);  // no levels by the matrix at all
}

TEST(LevelChoice, CoarsensLargeCoarsestMeshes) {
  EXPECT_FALSE(coarsening_below(with("auto"), 2, 1000));
  EXPECT_EQ(coarsening_below(with("auto"), 2, 1001), Coarsening::aggregation);
  EXPECT_EQ(coarsening_below(with("auto"), 1, 1001), Coarsening::classical);
  EXPECT_FALSE(coarsening_below(with("auto", false), 1, 100000));
  Scene::Solver wanted = with("auto");
  wanted.coarsening = "classical";
  EXPECT_EQ(coarsening_below(wanted, 2, 1001), Coarsening::classical);
}

template <int D>
std::size_t factorised(const Mesh<D>& coarsest, const Scene::Solver& options, int block) {
  const MeshHierarchy<D> meshes = hierarchy(coarsest, 2);
  const auto all = meshes_of(meshes);
  EXPECT_EQ(all.size(), 3u);
  EXPECT_EQ(all.back(), &meshes.finest());
  return factorised_meshes<D>(all, options, block);
}

TEST(LevelChoice, FactorisesSlenderBodies) {
  const Mesh<2> beam = rectangle({0, 0}, {100, 1}, {100, 1}), square = cube<2>(0, 1, 4);
  EXPECT_EQ(factorised(beam, with("auto"), 2), 2u);  // one and two cells across, not four
  EXPECT_EQ(factorised(square, with("auto"), 2), 0u);
  EXPECT_EQ(factorised(beam, with("auto"), 1), 0u);  // nothing of a scalar bends
  EXPECT_EQ(factorised(beam, with("meshes"), 2), 0u);
  Scene::Solver other = with("auto");
  other.coarse = "pgs";
  EXPECT_EQ(factorised(beam, other, 2), 0u);
  EXPECT_EQ(factorised(box({0, 0, 0}, {100, 1, 1}, {100, 1, 1}), with("auto"), 3), 2u);
}

/// So many levels of a membrane, and what is between them.
struct Membrane {
  explicit Membrane(int refinements) : nested(discretize_all<2, 1>(cube<2>(0, 1, 2), refinements, model())) {}
  static Model<1> model() {
    Model<1> out;
    out.fixes.push_back({on("boundary"), {Field(0)}});
    out.loads.push_back({{}, {Field(1)}});
    return out;
  }
  Nested<1> nested;
};

TEST(LevelMatrices, AreThoseBelowTheFinest) {
  Membrane m(3);
  const std::vector<Prolongation>& P = m.nested.prolongations;
  LevelMatrices<1> matrices(0, 0, P);
  EXPECT_EQ(matrices.below(3).size(), 3u);
  EXPECT_EQ(matrices.below(0).size(), 0u);
  EXPECT_EQ(matrices.above(1).coarse, P[1].coarse);
  EXPECT_EQ(matrices.between_meshes().size(), 3u);
  EXPECT_EQ(matrices.of(0), nullptr);
  EXPECT_TRUE(matrices.matrices_below(3).empty());
  std::vector<DiscreteProblem<1>> levels = m.nested.levels;
  const Index coarsest = levels[0].A.size();
  matrices.share(levels[0], 1, levels[1], true);
  ASSERT_NE(matrices.of(0), nullptr);
  EXPECT_EQ(matrices.of(0)->A.size(), coarsest);
  EXPECT_TRUE(levels[0].A.value.empty());  // it is given away
  EXPECT_EQ(matrices.products_below(1).size(), 1u);
  EXPECT_TRUE(matrices.products_below(2).empty());  // one is missing
  matrices.share(levels[1], 2, levels[2], true);
  EXPECT_EQ(matrices.products_below(2).size(), 2u);
  matrices.forget_products();
  EXPECT_TRUE(matrices.products_below(2).empty());
  EXPECT_EQ(matrices.matrices_below(2).size(), 2u);
}

// A coarser mesh with another coefficient has no product of the finer one's matrix; nor has any above it.
TEST(LevelMatrices, KnowWhichAreProducts) {
  Membrane m(2);
  Model<1> stiff = Membrane::model();
  stiff.diffusion = 3;
  std::vector<DiscreteProblem<1>> levels = m.nested.levels;
  levels[0] = discretize<2, 1>(cube<2>(0, 1, 2), stiff).problem;
  LevelMatrices<1> matrices(0, 0, m.nested.prolongations);
  matrices.share(levels[0], 1, levels[1], true);
  EXPECT_TRUE(matrices.products_below(1).empty());
  EXPECT_EQ(matrices.matrices_below(1).size(), 1u);
  matrices.share(levels[1], 2, levels[2], true);
  EXPECT_TRUE(matrices.products_below(2).empty());
}

TEST(LevelMatrices, LeaveOutMeshesThatAreFactorised) {
  Membrane m(3);
  const LevelMatrices<1> matrices(0, 2, m.nested.prolongations);
  EXPECT_EQ(matrices.below(3).size(), 2u);
  EXPECT_EQ(matrices.below(3).front().coarse, m.nested.prolongations[1].coarse);
  EXPECT_EQ(matrices.below(1).size(), 0u);
  EXPECT_EQ(matrices.below(0).size(), 0u);
}

TEST(LevelMatrices, GoOnBelowTheCoarsestMesh) {
  Membrane m(2);
  const std::vector<Prolongation>& P = m.nested.prolongations;
  LevelMatrices<1> matrices(1, 0, {P[1]});  // the first mesh is no level of its own
  matrices.continue_below({P[0]}, std::vector<GalerkinMatrix<1>>(1));
  EXPECT_EQ(matrices.between_algebraic().size(), 1u);
  EXPECT_EQ(matrices.between_meshes().size(), 1u);
  EXPECT_EQ(matrices.below(2).size(), 2u);
  EXPECT_EQ(matrices.above(1).coarse, P[1].coarse);
  EXPECT_EQ(matrices.products_below(1).size(), 1u);
  matrices.drop_algebraic();
  EXPECT_EQ(matrices.below(2).size(), 1u);
  EXPECT_TRUE(matrices.between_algebraic().empty());
  EXPECT_EQ(matrices.of(1), nullptr);
}

/// K times each mode.
template <int D>
void expect_null(const Nodes<D>& nodes) {
  Model<D> model;
  model.poisson = 0.3;
  const NearNullSpace space = near_null_space<D, D>(nodes, nullptr);
  ASSERT_EQ(space.modes, D == 2 ? 3 : 6);
  const auto K = sparse(stiffness<D, D>(nodes, model));
  Eigen::MatrixXd V(K.rows(), space.modes);
  for (Index i = 0; i < K.rows(); ++i)
    for (Index m = 0; m < space.modes; ++m) V(i, m) = space.at(i)[m];
  EXPECT_LT((K * V).norm(), 1e-11 * V.norm());
  EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(V).rank(), space.modes);
}

TEST(NearNullSpace, IsThatOfRigidMotions) {
  Mesh<2> disk = cube<2>(0, 1, 2);
  const MeshHierarchy<2> meshes = hierarchy(disk, 1);
  expect_null(Nodes<2>(meshes.finest()));
  expect_null(Nodes<2>(meshes.finest(), 2));
  const MeshHierarchy<3> solid = hierarchy(cube<3>(0, 1, 1), 1);
  expect_null(Nodes<3>(solid.finest()));
  expect_null(Nodes<3>(solid.finest(), 2));
  EXPECT_EQ((near_null_space<2, 1>(Nodes<2>(meshes.finest()), nullptr).modes), 0);
}

/// A block over another one, which is held; the upper one is moved down from the top, or nothing holds it.
class Pairs : public testing::Test {
 protected:
  explicit Pairs(double gap = 0.1, bool held = true) {
    Mesh<2> up = rectangle({0, 1 + gap}, {1, 2 + gap}, {2, 2});
    meshes_ = hierarchy<2>(join<2>({cube<2>(0, 1, 3), std::move(up)}, {"low", "up"}, {0, 0}), 1);
    model_.fixes.push_back({on("low/bottom"), {Field(0), Field(0)}});
    if (held) model_.fixes.push_back({on("up/top"), {Field(0), Field(0)}});
    ObstacleTerm<2> term{std::make_shared<Obstruction<2>>([](const SurfaceVertex& v) {
                           LocalConstraint<2> c;
                           c.directions = 1;
                           std::copy_n(v.away, 2, c.direction[0]);
                           c.lower[0] = -v.gap;
                           c.upper[0] = infinity;
                           return c;
                         }),
                         on("up/bottom"), "obstacle.0"};
    term.other = on("low/top");
    model_.obstacles = {std::move(term)};
    levels_.emplace(meshes_, std::vector<Nodes<2>>(meshes_.levels.begin(), meshes_.levels.end()));
    pairs_.emplace(*levels_);
    pairs_->begin_at(0);
  }
  /// The upper block sinks by more on the left, or moves as a whole.
  std::vector<double> sunk(std::size_t level, double left, double right, double aside = 0) const {
    std::vector<double> u;
    for (const Point<2>& x : meshes_.levels[level].points) {
      const bool upper = x[1] > 1.05;
      u.insert(u.end(), {upper ? aside : 0, upper ? -left * (1 - x[0]) - right * x[0] : 0});
    }
    return u;
  }
  std::size_t jumps(std::size_t level) const { return pairs_->at(level)->nodes.size(); }

  MeshHierarchy<2> meshes_;
  Model<2> model_;
  std::optional<MeshLevels<2, 2>> levels_;
  std::optional<LevelPairs<2, 2>> pairs_;
};

TEST_F(Pairs, AreFoundOnAllLevelsAndStay) {
  EXPECT_FALSE(pairs_->find(model_));  // there were none
  EXPECT_EQ(jumps(0), 3u);
  EXPECT_EQ(jumps(1), 5u);
  EXPECT_TRUE(pairs_->find(model_));
  EXPECT_TRUE(pairs_->may_narrow(1));
  pairs_->forget();
  EXPECT_EQ(pairs_->at(1), nullptr);
  EXPECT_FALSE(pairs_->find(model_));
}

TEST_F(Pairs, AreWhereADisplacementNearlyTouches) {
  pairs_->find(model_);
  EXPECT_TRUE(pairs_->narrow(model_, 1, sunk(1, 0.1, 0)));
  const std::size_t few = jumps(1);
  EXPECT_GT(few, 0u);
  EXPECT_LT(few, 5u);
  EXPECT_FALSE(pairs_->narrow(model_, 1, sunk(1, 0.1, 0)));
  EXPECT_TRUE(pairs_->find(model_));  // the same model leaves them
  EXPECT_EQ(jumps(1), few);
  const auto found = pairs_->found();
  EXPECT_FALSE(pairs_->widen(model_, sunk(1, 0.1, 0)));
  EXPECT_TRUE(pairs_->widen(model_, sunk(1, 0.1, 0.3)));
  EXPECT_EQ(jumps(1), 5u);
  EXPECT_FALSE(pairs_->widen(model_, sunk(1, 0.1, 0.3)));
  pairs_->put_back(found);
  EXPECT_EQ(jumps(1), few);
  pairs_->find(model_);
  pairs_->narrow_by_coarser(model_, 1, sunk(0, 0.1, 0));
  EXPECT_EQ(jumps(1), few);
}

// Interpolation between jumps is exact for what has none: both bodies move together.
TEST_F(Pairs, ConnectLevelsByTheirJumps) {
  pairs_->find(model_);
  std::vector<Prolongation> between{
      prolongation(meshes_.refinements[0], Nodes<2>(meshes_.levels[0]), Nodes<2>(meshes_.levels[1]))};
  const Prolongation plain = between[0];
  pairs_->connect(1, between);
  EXPECT_NE(between[0].column, plain.column);
  EXPECT_EQ(levels_->finest().connected[1], pairs_->at(1)->jumps);
  EXPECT_EQ(levels_->finest().connected[0], pairs_->at(0)->jumps);
  between[0] = plain;
  pairs_->connect(1, between);  // these are connected already
  EXPECT_EQ(between[0].column, plain.column);
}

// The block slides by more than a quarter of an element: bodies find each other there.
TEST_F(Pairs, FollowABodyThatSlides) {
  pairs_->find(model_);
  EXPECT_TRUE(pairs_->would_follow(model_, sunk(1, 0, 0, 0.05)));  // in a first step
  model_.follows = true;
  pairs_->accept();
  EXPECT_FALSE(pairs_->would_follow(model_, sunk(1, 0, 0, 0.05)));
  EXPECT_TRUE(pairs_->would_follow(model_, sunk(1, 0, 0, 0.2)));
  EXPECT_TRUE(pairs_->shift().empty());
  pairs_->find_about(pairs_->shift_after(model_, sunk(1, 0, 0, 0.2)));
  ASSERT_EQ(pairs_->shift().size(), 1u);
  EXPECT_NEAR(pairs_->shift()[0][0], 0.2, 1e-12);
  EXPECT_FALSE(pairs_->find(model_));               // others are in front of each other now
  pairs_->begin_step(model_, sunk(1, 0, 0, 0.05));  // from where it was accepted
  EXPECT_TRUE(pairs_->shift().empty());
  model_.obstacles[0].renew = false;
  EXPECT_FALSE(pairs_->would_follow(model_, sunk(1, 0, 0, 0.2)));
}

TEST_F(Pairs, ThatAreGivenStay) {
  std::vector<std::shared_ptr<const PairedBodies<2>>> own;
  for (const Mesh<2>& mesh : meshes_.levels)
    own.push_back(pair_bodies(Nodes<2>(mesh), model_, collect_fixes<2, 2>(Nodes<2>(mesh), model_)));
  EXPECT_FALSE(pairs_->given());
  pairs_->give(own);
  EXPECT_TRUE(pairs_->given());
  EXPECT_TRUE(pairs_->find(model_));
  EXPECT_EQ(pairs_->at(1), own[1]);
  pairs_->forget();
  EXPECT_EQ(pairs_->at(1), own[1]);
}

class LoosePairs : public Pairs {
 protected:
  LoosePairs() : Pairs(0.1, false) {}
};

TEST_F(LoosePairs, AreAllOverTheSlave) {
  pairs_->find(model_);
  EXPECT_FALSE(pairs_->may_narrow(0));
  EXPECT_FALSE(pairs_->may_narrow(1));
  EXPECT_EQ(jumps(1), 5u);
}

// In terms of jumps a side that faces another body is a part of its own.
TEST_F(Pairs, MakePartsOfTheNearNullSpace) {
  pairs_->find(model_);
  const Nodes<2> nodes(meshes_.finest());
  const NearNullSpace space = near_null_space<2, 2>(nodes, pairs_->at(1)->jumps.get());
  ASSERT_EQ(space.part.size(), meshes_.finest().points.size());
  std::set<Index> low, up, side;
  for (Index p = 0; p < nodes.size(); ++p) {
    const double y = nodes.at(p)[1];
    (y < 1.05 ? low : y < 1.11 ? side : up).insert(space.part[p]);
  }
  EXPECT_EQ(low.size(), 1u);
  EXPECT_EQ(up.size(), 1u);
  EXPECT_EQ(side.size(), 1u);
  EXPECT_NE(*low.begin(), *up.begin());
  EXPECT_NE(*side.begin(), *up.begin());
  EXPECT_NE(*side.begin(), *low.begin());
  EXPECT_TRUE((near_null_space<2, 2>(nodes, nullptr).part.empty()));
}

TEST_F(Pairs, BelongToALevel) {
  const MeshLevel<2, 2> level(meshes_.levels[1], &meshes_.refinements[0], Nodes<2>(meshes_.levels[1]));
  EXPECT_EQ(level.mesh, &meshes_.levels[1]);
  EXPECT_EQ(level.refinement, &meshes_.refinements[0]);
  EXPECT_FALSE(level.kept || level.changed || level.pairs || level.pressure_space);
}

}  // namespace
}  // namespace signorini::test
