#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/component/registry.hpp"
#include "core/fem/recovery/strain.hpp"
#include "core/fem/recovery/stress.hpp"
#include "core/io/report.hpp"
#include "core/io/warning.hpp"
#include "core/sdk/stepping.hpp"
#include "driver/dirichlet_neumann.hpp"
#include "driver/levels/adaptation.hpp"
#include "driver/levels/nested_solver.hpp"
#include "driver/reports/results.hpp"
#include "driver/scene/memory.hpp"
#include "driver/scene/progress.hpp"
#include "estimators/estimate.hpp"

namespace signorini {

/// Why a step may be too long for friction, and where to cut it.
struct FrictionDoubt {
  const char* reason = nullptr;  ///< null: it is not
  const char* why = "";
  double cut_at = 0.5;  ///< of the step
};

/// One body of a scene: its meshes, the solver that is kept for all steps, and the results of the last one.
template <int D, int B>
class BodyRun {
 public:
  /// Builds the meshes. Keeps references to all but the warnings, to which it adds what is odd about the meshes, and
  /// adds to `times` what everything takes. Error(Exit::input) as read_scene() has them.
  /// @param promised memory of the bodies before it; null: it is alone
  /// @param adaptation whose present mesh is taken; null: that of the scene
  BodyRun(const Scene& scene, std::size_t body, const Registry& registry, const Progress& progress, Times& times,
          Warnings& warnings, PromisedMemory* promised = nullptr, std::shared_ptr<Adaptation<D>> adaptation = nullptr);

  /// The same body on a mesh that is finer where the last solve has its error; starts from its solution. In scenes that
  /// ask for that.
  /// @param growth of the number of elements, about
  std::unique_ptr<BodyRun> refined(double growth, Warnings& warnings) const;

  /// Those of all steps, which may be others than before. Error(Exit::input) for one outside the body.
  void find_probes();
  /// The next step, at t, is the first one of its steps: friction counts from the undeformed body.
  void begin(double t);
  /// Tries the step, from the last solution that was accepted where there is one, and says what came out. Errors: see
  /// NestedSolver.
  StepReport solve(const LoadStep& step, Warnings& warnings);
  /// What the last solve() found is where the next step starts, and what its friction counts from.
  void accept();
  /// Whether a step depends on the way before it, as with friction.
  bool remembers() const;
  /// Whether an obstacle depends on the step itself, beside what depends on t.
  bool depends_on_step() const;
  /// The place in the scene of an obstacle that does not admit that the last step is cut; null: there is none.
  const std::string* veto_against_cutting() const;
  /// Whether the last solve(), of this step, is in doubt.
  /// @param end of the planned step
  /// @param followed by another step
  FrictionDoubt doubt_of_friction(const LoadStep& step, double end, bool followed) const;
  /// The next step starts from u (global coordinates, B per vertex of the finest mesh). Error(Exit::usage) where that
  /// has another length or is not finite.
  void start_from(const std::vector<double>& u);
  /// What is odd about the scene as it is at t, before it is solved.
  void add_warnings(double t, Warnings& warnings) const;
  /// What is odd about the results.
  void add_result_warnings(const Report& report, Warnings& warnings) const;

  const Scene::Body& body() const { return scene_.bodies[body_]; }
  const MeshHierarchy<D>& hierarchy() const { return hierarchy_; }
  const Mesh<D>& mesh() const { return hierarchy_.finest(); }
  /// Of that mesh: results are numbered as these.
  const Nodes<D>& nodes() const { return solver_.nodes(); }
  /// Of the last step, accepted or not, per node.
  const Results<D, B>& results() const { return results_; }
  /// Of a solution: displacements or values at the nodes, prescribed ones included.
  std::size_t numbers() const { return static_cast<std::size_t>(nodes().size()) * B; }
  /// Displacements or values of the last step, B per vertex.
  std::vector<double> solution() const { return nodes().at_vertices(results_.u, B); }
  /// Per vertex, computed when it is asked for; empty for a scalar body.
  std::vector<Stress> stress() const;
  /// The energy error of the last step by an estimator, whether or not the scene asks for it; by default bounds.
  Estimate estimate(bool cheap = false, const std::string& estimator = "certificate") const;
  /// The shares of elements in that of the last step, per element of nodes(); empty: there is none.
  const std::vector<double>& estimate_of_element() const { return estimate_of_element_; }
  /// Whether all levels below the finest mesh are chosen by its matrix.
  bool by_matrix() const { return solver_.by_matrix(); }
  /// See Driver::forget_matrices().
  void forget_matrices() { solver_.forget_matrices(); }

 private:
  Model<B> model(const LoadStep& step) const;
  double shortening_of(Index obstacle, const std::string& origin) const;
  Solution<B> solve(const Model<B>& model, const LoadStep& step);
  Solution<B> solve_or_take_turns(const Model<B>& model, const LoadStep& step);
  void take(Solution<B>& solution);
  double off(const Solution<B>& solution) const;
  double slid() const;
  void look_where_it_came(Solution<B>& solution);
  void add_estimate(StepReport& report, const Discretization<B>& discretization, Warnings& warnings);
  void add_goal(StepReport& report, const Discretization<B>& discretization);

  const Scene& scene_;
  std::size_t body_;
  const Registry& registry_;
  const Progress& progress_;
  Times& times_;
  std::shared_ptr<Adaptation<D>> adaptation_;  // null: the scene asks for none
  MeshHierarchy<D> hierarchy_;
  Probes<D> probes_;
  NestedSolver<D, B> solver_;
  std::unique_ptr<DirichletNeumann<D>> turns_;  // in place of it, where the scene says so; null: none yet
  std::vector<SlaveChoice> slaves_;             // of all steps
  Model<B> model_;                              // of the last step
  std::vector<double> accepted_;                // displacements or values; empty: none yet
  ContactState<B> accepted_contact_;            // where friction depends on it
  std::vector<BoltState> accepted_bolts_;
  bool follows_ = false;
  double t_ = 0, accepted_t_ = 0;  // of the last step, and of the last one accepted
  Results<D, B> results_;
  StrainSizes<D> strains_;                                     // of an elastic body, once converged
  double algebraic_error_ = 0;                                 // of the last solve
  std::vector<double> rest_;                                   // of friction, in it
  std::vector<double> estimate_of_element_, goal_of_element_;  // the latter of the goal's error; empty: not known
};

}  // namespace signorini
