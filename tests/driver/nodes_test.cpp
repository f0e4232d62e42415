// The driver takes no node's number for that of a vertex, on any level: meshes torn apart and glued together by nodes
// with random numbers give what whole meshes do.
#include <gtest/gtest.h>

#include <cmath>

#include "amg/registration.hpp"
#include "apps/scenes/tables.hpp"
#include "core/mesh/refine.hpp"
#include "driver/components.hpp"
#include "driver/levels/nested_solver.hpp"
#include "driver/reports/results.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"
#include "tests/support/torn.hpp"

namespace signorini::test {
namespace {

/// A scene on its own meshes, and on the same ones torn and glued.
template <int D, int B>
class Glued {
 public:
  Glued(const std::string& text, const std::vector<std::string>& overrides, double middle)
      : scene_(parse_scene(text, "test.toml", ".", overrides)) {
    load_plugins(scene_, registry_);
    whole_ = build_hierarchy<D>(scene_, B);
    Mesh<D> coarsest = torn(whole_.levels.front(), middle);
    torn_ = hierarchy<D>(std::move(coarsest), scene_.refine.uniform);
  }

  /// Solves two steps, and compares each.
  void expect_same() {
    const Progress quiet;
    Times times;
    NestedSolver<D, B> whole(whole_, scene_.solver, registry_, quiet, times);
    NestedSolver<D, B> glued(torn_, scene_.solver, registry_, quiet, times, glued_at_random(torn_));
    ASSERT_LT(glued.nodes().size(), torn_.finest().vertices());
    const std::vector<Index> node = nodes_at(whole_.finest(), glued.nodes());
    std::vector<double> u, u_glued;
    for (const double t : {0.6, 1.0}) {
      const Model<B> model = build_model<B>(scene_, D, registry_, t);
      Solution<B> expected = u.empty() ? whole.solve(model) : whole.solve_after(model, u);
      Solution<B> found = u.empty() ? glued.solve(model) : glued.solve_after(model, u_glued);
      ASSERT_TRUE(expected.summary.converged());
      ASSERT_TRUE(found.summary.converged()) << found.summary.reason;
      EXPECT_LE(std::abs(found.summary.iterations - expected.summary.iterations), 2);
      EXPECT_EQ(found.undetermined, expected.undetermined);
      EXPECT_EQ(found.summary.level_unknowns.size(), expected.summary.level_unknowns.size());
      const auto wanted = results<D, B>(whole.nodes(), model, expected);
      const auto all = results<D, B>(glued.nodes(), model, found);
      u = wanted.u;
      u_glued = all.u;
      expect_same_report(report(whole.nodes(), wanted, expected, t), report(glued.nodes(), all, found, t));
      expect_near(u, u_glued, node);
      for (std::size_t k = 0; k < wanted.deformed.size(); ++k)
        EXPECT_NEAR(all.deformed[k]->penetration, wanted.deformed[k]->penetration, 1e-6 * largest_);
      whole.take_back(model, std::move(expected.discretization));
      glued.take_back(model, std::move(found.discretization));
    }
  }

 private:
  StepReport report(const Nodes<D>& nodes, const Results<D, B>& results, const Solution<B>& solution, double t) {
    return step_report<D, B>(scene_, nodes, locate_probes(nodes.mesh(), scene_, 0), results, t, solution.summary);
  }

  void expect_same_report(const StepReport& wanted, const StepReport& found) {
    double force = 0;
    largest_ = 0;
    for (const double f : wanted.contact[0].force) force = std::max(force, std::abs(f));
    for (const double v : wanted.probes[0].value) largest_ = std::max(largest_, std::abs(v));
    EXPECT_GT(force, 0);
    for (std::size_t i = 0; i < B; ++i) {
      EXPECT_NEAR(found.contact[0].force[i], wanted.contact[0].force[i], 1e-6 * force);
      EXPECT_NEAR(found.probes[0].value[i], wanted.probes[0].value[i], 1e-6 * largest_);
    }
    EXPECT_EQ(found.contact[0].nodes, wanted.contact[0].nodes);
  }

  void expect_near(const std::vector<double>& u, const std::vector<double>& u_glued, const std::vector<Index>& node) {
    for (std::size_t v = 0; v < node.size(); ++v)
      for (std::size_t i = 0; i < B; ++i)
        ASSERT_NEAR(u_glued[static_cast<std::size_t>(node[v]) * B + i], u[v * B + i], 1e-6 * largest_);
  }

  Registry registry_ = solver_components();
  Scene scene_;
  MeshHierarchy<D> whole_, torn_;
  double largest_ = 0;
};

const std::string accurate = "[solver]\ntolerance = 1e-11\n";
const std::string sinks = "'-0.03 * t'";

TEST(Nodes, GlueNestedMeshesOfAnElasticBody) {
  const std::string text = tables::block("block", "[0, 0]", "[1, 1]", "[4, 4]") +
                           tables::fix("block", "top", "[0.01, " + sinks + "]") +
                           tables::plane("block", "bottom", "[0, 0]", "[-0.03, 1]") +
                           tables::probe("probe", "block", "[0.3, 0.4]") + accurate;
  Glued<2, 2>(text, {"refine.uniform=3"}, 0.5).expect_same();
}

TEST(Nodes, GlueNestedMeshesOfAMembrane) {
  const std::string text = tables::block("cube", "[0, 0, 0]", "[1, 1, 1]", "[4, 3, 3]", "equation = 'diffusion'\n") +
                           tables::fix("cube", "boundary", "'0.1 * x * t'") + tables::load("cube", "'-5 - 3 * x'") +
                           tables::floor("cube", "'-0.02 - 0.05 * y'") +
                           tables::probe("probe", "cube", "[0.6, 0.4, 0.45]") + accurate;
  Glued<3, 1>(text, {"refine.uniform=2"}, 0.5).expect_same();
}

// Nothing holds the block but the plane, on which it may slide and turn.
TEST(Nodes, GlueALooseBody) {
  const std::string text = tables::block("block", "[0, 0, 0]", "[1, 1, 1]", "[2, 2, 2]") +
                           tables::load("block", "[0, 0, '-0.02 * t * (1 + 0.2 * x)']") +
                           tables::plane("block", "bottom", "[0, 0, -0.1]", "[0, 0, 1]") +
                           tables::probe("probe", "block", "[0.6, 0.4, 0.9]") + accurate;
  Glued<3, 3>(text, {"refine.uniform=2"}, 0.5).expect_same();
}

// Rigid motions of the nodes make the levels below.
TEST(Nodes, GlueABodyWhoseLevelsTheMatrixChooses) {
  const std::string text = tables::block("block", "[0, 0]", "[1, 1]", "[40, 40]") +
                           tables::fix("block", "top", "[0.01, " + sinks + "]") +
                           tables::plane("block", "bottom", "[0, 0]", "[-0.03, 1]") +
                           tables::probe("probe", "block", "[0.3, 0.4]") + accurate + "hierarchy = \"matrix\"\n";
  Glued<2, 2>(text, {}, 0.5).expect_same();
}

}  // namespace
}  // namespace signorini::test
