// Aggregates by METIS: connected sets that cover whatever is coupled, the same every time, on which problems are solved
// in about as many cycles as on greedy ones.
#include "amg/coarsening/metis_aggregates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "amg/black_box.hpp"
#include "amg/black_box/nested_start.hpp"
#include "amg/coarsening/hierarchy.hpp"
#include "core/base/error.hpp"
#include "methods/solve.hpp"
#include "tests/amg/matrices.hpp"
#include "tests/support/pdas.hpp"
#include "tests/support/problems.hpp"
#include "tests/support/random.hpp"

namespace signorini::test {
namespace {

StrengthGraph couplings(const Eigen::SparseMatrix<double>& A) {
  const DiscreteProblem<1> problem = problem_of(A);
  return strong_couplings(problem.A, problem.fixed);
}

/// The Laplacian of a graph on n vertices with edges of given weights.
Eigen::SparseMatrix<double> graph_laplacian(int n, const std::vector<Eigen::Triplet<double>>& edges) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& e : edges) {
    entries.emplace_back(e.row(), e.col(), -e.value());
    entries.emplace_back(e.col(), e.row(), -e.value());
    entries.emplace_back(e.row(), e.row(), e.value());
    entries.emplace_back(e.col(), e.col(), e.value());
  }
  Eigen::SparseMatrix<double> A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

Eigen::SparseMatrix<double> path(int n) {
  std::vector<Eigen::Triplet<double>> edges;
  for (int i = 1; i < n; ++i) edges.emplace_back(i - 1, i, 1.0);
  return graph_laplacian(n, edges);
}

Eigen::SparseMatrix<double> star(int n) {
  std::vector<Eigen::Triplet<double>> edges;
  edges.reserve(static_cast<std::size_t>(n));
  for (int i = 0; i < n - 1; ++i) edges.emplace_back(i, n - 1, 1.0);
  return graph_laplacian(n, edges);
}

Eigen::SparseMatrix<double> complete(int n) {
  std::vector<Eigen::Triplet<double>> edges;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < i; ++j) edges.emplace_back(i, j, 1.0);
  return graph_laplacian(n, edges);
}

/// A tree and some further edges, with weights over many decades.
Eigen::SparseMatrix<double> random_graph(int n, double decades, Random& random) {
  std::vector<Eigen::Triplet<double>> edges;
  const auto weight = [&] { return std::pow(10, random.between(0, decades)); };
  for (int i = 1; i < n; ++i) edges.emplace_back(i, random.below(i), weight());
  for (int k = 0; k < n / 2; ++k)
    if (const int i = random.below(n), j = random.below(n); i != j) edges.emplace_back(i, j, weight());
  return graph_laplacian(n, edges);
}

/// Whether a path along couplings of either direction leads from the root to every vector of its aggregate.
void expect_connected(const StrengthGraph& graph, const Aggregates& found) {
  std::vector<bool> reached(found.of.size(), false);
  for (const Index root : found.root) reached[root] = true;
  for (bool more = true; more;) {
    more = false;
    for (Index p = 0; p < graph.size(); ++p)
      for (const Coupling& c : graph.of(p))
        if (found.of[p] == found.of[c.to] && reached[p] != reached[c.to]) more = reached[p] = reached[c.to] = true;
  }
  for (std::size_t p = 0; p < reached.size(); ++p) EXPECT_TRUE(reached[p] || found.of[p] < 0) << p;
}

Aggregates expect_aggregates(const StrengthGraph& graph) {
  Aggregates found = MetisAggregator().aggregate(graph);
  EXPECT_EQ(static_cast<Index>(found.of.size()), graph.size());
  EXPECT_TRUE(std::ranges::is_sorted(found.root));
  for (Index a = 0; a < found.size(); ++a) EXPECT_EQ(found.of[found.root[a]], a);
  std::vector<bool> coupled(found.of.size(), false);
  for (Index p = 0; p < graph.size(); ++p)
    for (const Coupling& c : graph.of(p)) coupled[p] = coupled[c.to] = true;
  for (std::size_t p = 0; p < coupled.size(); ++p) {
    EXPECT_EQ(found.of[p] >= 0, coupled[p]) << p;
    EXPECT_LT(found.of[p], found.size());
  }
  expect_connected(graph, found);
  return found;
}

/// Sizes, ascending.
std::vector<int> sizes(const Aggregates& aggregates) {
  std::vector<int> size(aggregates.root.size(), 0);
  for (const Index a : aggregates.of)
    if (a >= 0) ++size[a];
  std::ranges::sort(size);
  return size;
}

TEST(MetisAggregates, AreConnectedAroundTheirRootsAndLikeGreedyOnesInSize) {
  const auto elastic = discretize<3, 3>(cube<3>(0, 1, 9), Model<3>{}).problem;
  for (const StrengthGraph& graph :
       {couplings(laplacian(64)), couplings(neumann_laplacian(40)), strong_couplings(elastic.A, elastic.fixed),
        strong_couplings_of_groups(elastic.A, elastic.fixed, 2)}) {
    const Aggregates found = expect_aggregates(graph), greedy = aggregate(graph);
    EXPECT_GE(found.size(), greedy.size() * 9 / 10);
    EXPECT_LE(found.size(), greedy.size() * 11 / 10);
    EXPECT_LE(sizes(found).back(), 2 * graph.size() / greedy.size());
  }
}

TEST(MetisAggregates, CoverRandomGraphsWithWeightsOverManyDecades) {
  Random random(12);
  for (const int n : {30, 300, 3000})
    for (const double decades : {0, 2, 8}) expect_aggregates(couplings(random_graph(n, decades, random)));
}

TEST(MetisAggregates, OfFewVectorsAreSilent) {
  testing::internal::CaptureStdout();
  for (int n = 1; n <= 30; ++n)
    for (const auto& A : {path(n), star(n), complete(n), copies(3, path(n)), copies(n, complete(3))})
      expect_aggregates(couplings(A));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(MetisAggregates, HaveTheirRootsAtTheSurface) {
  EXPECT_EQ(expect_aggregates(couplings(star(9))).root, std::vector<Index>{0});
  constexpr int side = 51;
  const StrengthGraph graph = couplings(neumann_laplacian(side - 1));
  const Aggregates found = expect_aggregates(graph);
  const auto inside = [](Index p) {
    return std::min({p % side, side - 1 - p % side, p / side, side - 1 - p / side}) > 0;
  };
  std::vector<bool> at_surface(found.root.size(), false);
  for (Index p = 0; p < graph.size(); ++p)
    if (!inside(p)) at_surface[found.of[p]] = true;
  for (Index a = 0; a < found.size(); ++a) EXPECT_EQ(inside(found.root[a]), !at_surface[a]) << a;
}

// Bodies of five-point stencils with other numbers of nodes than parts are multiples of: some parts lie in two bodies.
TEST(MetisAggregates, LieInOneBody) {
  for (const int cells : {3, 4, 5}) {
    const Eigen::SparseMatrix<double> body = laplacian(cells);
    const Index n = static_cast<Index>(body.rows());
    const Aggregates found = expect_aggregates(couplings(copies(40, body)));
    for (Index p = 0; p < 40 * n; ++p) EXPECT_EQ(p / n, found.root[found.of[p]] / n);
  }
}

TEST(MetisAggregates, LeaveOutWhatIsCoupledToNothing) {
  Eigen::SparseMatrix<double> A = copies(2, path(20));
  for (Eigen::SparseMatrix<double>::InnerIterator entry(A, 7); entry; ++entry)
    if (entry.row() != 7) A.coeffRef(entry.row(), 7) = A.coeffRef(7, entry.row()) = 0;
  const Aggregates found = expect_aggregates(couplings(A));
  EXPECT_EQ(found.of[7], -1);
  EXPECT_EQ(std::ranges::count(found.of, -1), 1);
  Eigen::SparseMatrix<double> diagonal(5, 5);
  diagonal.setIdentity();
  EXPECT_EQ(expect_aggregates(couplings(diagonal)).size(), 0);
}

// As between a stiff and a soft part, where the coupling is strong for the soft one alone.
TEST(MetisAggregates, FollowCouplingsOfOneDirection) {
  StrengthGraph graph;
  for (Index p = 0; p < 60; ++p) {
    if (p % 2 == 1) graph.add({p - 1, 1});
    if (p % 2 == 1 && p < 59) graph.add({p + 1, 0.5f});
    graph.end_row();
  }
  expect_aggregates(graph);
}

TEST(MetisAggregates, AreTheSameWhateverWasDrawnBefore) {
  Random random(5);
  for (const StrengthGraph& graph : {couplings(laplacian(60)), couplings(random_graph(2000, 3, random))}) {
    const Aggregates first = MetisAggregator().aggregate(graph);
    for (const unsigned seed : {1u, 77u}) {
      std::srand(seed);
      const Aggregates again = MetisAggregator().aggregate(graph);
      EXPECT_EQ(again.of, first.of);
      EXPECT_EQ(again.root, first.root);
    }
  }
}

/// On levels by aggregation; energies fall.
template <int B>
std::pair<int, std::vector<double>> cycles_and_solution(DiscreteProblem<B> problem, const NearNullSpace& modes,
                                                        const std::string& aggregates) {
  const auto aggregator = registry().create<Aggregator>("aggregates", aggregates);
  const AlgebraicLevels<B> levels = algebraic_hierarchy<B>(
      problem, [] { return registry().create<Transfer<B>>("transfer", "min_merge"); }, 20,
      {.coarsening = Coarsening::aggregation}, modes, *aggregator);
  EXPECT_GE(levels.prolongations.size(), 2u);
  problem.galerkin = levels.matrices;
  std::vector<double> x = nested_start<B>(problem, levels.prolongations, {}, registry());
  const Summary s = solve<B>(problem, levels.prolongations, x, {}, registry());
  EXPECT_TRUE(s.converged()) << s.reason;
  for (std::size_t k = 1; k < s.history.size(); ++k)
    EXPECT_LE(s.history[k].energy, s.history[k - 1].energy + 1e-12 * std::abs(s.energy));
  return {s.iterations, x};
}

template <int B>
void expect_as_fast(const DiscreteProblem<B>& problem, const NearNullSpace& modes = {}) {
  const int greedy = cycles_and_solution(problem, modes, "greedy").first;
  const auto [metis, x] = cycles_and_solution(problem, modes, "metis");
  const Reference exact = reference(problem);
  EXPECT_GT(exact.active(), 0);
  EXPECT_LE((vector(x) - exact.x).norm(), 1e-5 * exact.x.norm());
  EXPECT_LE(metis, greedy + greedy / 2 + 2);
}

double valley(const double* x) { return -0.02 - 0.1 * (x[0] - 0.3) * (x[0] - 0.3); }

TEST(MetisAggregates, SolveObstacleProblems) {
  expect_as_fast(discretize<2, 1>(cube<2>(0, 1, 48), membrane(-1, valley, {})).problem);
  expect_as_fast(discretize<3, 1>(cube<3>(0, 1, 14), membrane(-1, valley, {})).problem);
}

template <int D>
NearNullSpace modes_of(const Mesh<D>& mesh) {
  std::vector<double> coordinates;
  for (const Point<D>& x : mesh.points) coordinates.insert(coordinates.end(), x.begin(), x.end());
  return rigid_body_modes<D>(coordinates);
}

TEST(MetisAggregates, SolveContactProblemsWithRigidBodyModes) {
  const Mesh<2> square = cube<2>(0, 1, 32);
  expect_as_fast(discretize<2, 2>(square, pressed_block<2>(sphere<2>({0.4, -2}, 2.0), 0.02)).problem, modes_of(square));
  const Mesh<3> block = cube<3>(0, 1, 9);
  expect_as_fast(discretize<3, 3>(block, pressed_block<3>(sphere<3>({0.4, 0.6, -2}, 2.0), 0.02)).problem,
                 modes_of(block));
}

/// A beam that its load bends onto a plane at one of its sides.
Model<3> cantilever(const char* side, int axis, double direction) {
  Model<3> model;
  model.poisson = 0.3;
  model.fixes.push_back({on("left"), {Field(0), Field(0), Field(0)}});
  Load<3> load{{}, {Field(0), Field(0), Field(0)}};
  load.value[axis] = Field(1e-4 * direction);
  model.loads.push_back(load);
  Point<3> point{}, normal{};
  point[axis] = direction > 0 ? 1.5 : -0.5;
  normal[axis] = -direction;
  model.obstacles.push_back({plane<3>(point, normal), on(side), "test"});
  return model;
}

// A start from coarser levels knows the obstacles of roots alone.
TEST(Aggregates, KnowObstaclesOnEverySide) {
  const Mesh<3> beam = box({0, 0, 0}, {10, 1, 1}, {48, 6, 6});
  for (const char* aggregates : {"greedy", "metis"})
    for (const auto& [side, axis, direction] :
         {std::tuple("bottom", 2, -1), {"top", 2, 1}, {"front", 1, -1}, {"back", 1, 1}}) {
      const DiscreteProblem<3> problem = discretize<3, 3>(beam, cantilever(side, axis, direction)).problem;
      EXPECT_LE(cycles_and_solution(problem, modes_of(beam), aggregates).first, 30) << side << ", " << aggregates;
    }
}

SolverOptions with_aggregates(const std::string& name) {
  SolverOptions options;
  options.coarsening = "aggregation";
  options.aggregates = name;
  return options;
}

TEST(BlackBoxWithMetis, SolvesOnOtherLevelsAlsoWithVectorsCoupledToNothing) {
  Eigen::SparseMatrix<double> A = laplacian(40);
  for (Eigen::SparseMatrix<double>::InnerIterator entry(A, 500); entry; ++entry)
    if (entry.row() != 500) A.coeffRef(entry.row(), 500) = A.coeffRef(500, entry.row()) = 0;
  A.prune(0.0);
  const auto n = static_cast<std::size_t>(A.rows());
  const std::vector<double> b(n, -1e-3), lower(n, -0.05);
  const auto greedy = BlackBox(A, 1, with_aggregates("greedy")).solve(b, lower);
  const auto metis = BlackBox(A, 1, with_aggregates("metis")).solve(b, lower);
  EXPECT_TRUE(metis.summary.converged()) << metis.summary.reason;
  EXPECT_LE((vector(metis.x) - vector(greedy.x)).norm(), 1e-6 * vector(greedy.x).norm());
  EXPECT_NE(metis.summary.history.front().energy, greedy.summary.history.front().energy);
}

std::string refusal(const SolverOptions& options) {
  try {
    const BlackBox solver(laplacian(8), 1, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "";
}

TEST(BlackBoxWithMetis, RefusesUnknownNamesAndLevelsWithoutAggregates) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal(with_aggregates("mets")),
              HasSubstr("there is no aggregates 'mets', did you mean 'metis'? (available: greedy, metis)"));
  SolverOptions options = with_aggregates("metis");
  EXPECT_EQ(refusal(options), "");
  options.coarsening = "auto";
  EXPECT_EQ(refusal(options), "");
  options.reach = "twins";
  EXPECT_THAT(refusal(options), HasSubstr("solver.aggregates: found 'metis', expected 'greedy' with"));
  options = with_aggregates("metis");
  options.coarsening = "classical";
  EXPECT_THAT(refusal(options), HasSubstr("solver.aggregates: found 'metis', expected 'greedy' with"));
}

}  // namespace
}  // namespace signorini::test
