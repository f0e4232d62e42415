#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/component/registry.hpp"
#include "core/fem/assembly/discretize.hpp"
#include "core/io/report.hpp"
#include "core/mesh/mesh.hpp"
#include "core/scene/scene.hpp"
#include "core/solver/summary.hpp"
#include "driver/levels/level_matrices.hpp"
#include "driver/levels/level_pairs.hpp"
#include "driver/levels/mesh_levels.hpp"
#include "driver/scene/progress.hpp"
#include "methods/configuration.hpp"
#include "methods/solve.hpp"
#include "methods/stages.hpp"

namespace signorini {

template <int D, int B>
class LooseBody;

/// A problem on the finest level with its solution in local coordinates.
template <int B>
struct Solution {
  Discretization<B> discretization;
  std::vector<double> x;
  std::vector<double> pressure;  ///< of NestedSolver::pressure_space()
  Summary summary;
  std::vector<std::string> undetermined;  ///< motions that nothing decides, see LooseBody
  JointLoad<B> joints;                    ///< what pressure in joints exerts, counted in the discretization's load
  Index pressed_shut = 0;                 ///< nodes that it acts on, and that are in contact
  bool slides_on = false;                 ///< bodies have slid past each other since they were last paired
};

/// Solves models on one hierarchy of meshes: by nested iteration from the coarsest level up, or on the finest level
/// only.
template <int D, int B>
class NestedSolver {
 public:
  /// Keeps references to all but options and nodes; adds to `times` what is spent on assembly, setup and solve.
  /// @param nodes of each mesh; none: of linear elements, numbered as the vertices
  NestedSolver(const MeshHierarchy<D>& hierarchy, const Scene::Solver& options, const Registry& registry,
               const Progress& progress, Times& times, std::vector<Nodes<D>> nodes = {});

  /// Of the finest mesh: solutions have B numbers for each.
  const Nodes<D>& nodes() const { return levels_.finest().nodes; }

  /// Between solves the hierarchy may become another one, see MeshLevels; elements are set aside no more.
  void append(const Mesh<D>& mesh, const Refinement& refinement, Nodes<D> nodes);
  void drop_finest();
  void replace_finest(const Mesh<D>& mesh, const Refinement& refinement, Nodes<D> nodes);

  /// Of the last solve on the finest mesh; null where no pressure has unknowns of its own.
  const PressureOf<D, B>* pressure_space() const {
    const std::optional<PressureOf<D, B>>& space = levels_.finest().pressure_space;
    return space ? &*space : nullptr;
  }

  /// Starts as `solver.start` says. Error(Exit::interrupted) when the user asked to end, Error(Exit::no_solution) where
  /// none exists; without convergence the summary says so.
  Solution<B> solve(const Model<B>& model);
  /// The same after another step: with start "nested" from what has least energy, its solution u (global coordinates),
  /// a start as for the first step, or u and the change that coarser meshes see; with "zero" from u. What coarser
  /// meshes know of that step is what the last accept() was about.
  Solution<B> solve_after(const Model<B>& model, const std::vector<double>& u);
  /// What solve() has found holds near where bodies were drawn: looks at them where it has taken them, solves again,
  /// and so on until they rest. Where conditions of contact are not truer by that it stays as it is.
  /// @param was, off how far they are off, in any unit, with what was found, and with another solution
  void follow(const Model<B>& model, double was, const std::function<double(const Solution<B>&)>& off,
              Solution<B>& solution);
  /// The next step comes after the last solve; until then every solve comes after the same one.
  void accept();

  /// Of one body that touches others: from now on these pairs on each mesh, without jumps, and forces at the nodes of
  /// each mesh, B per node, beside the model's loads, if there are any.
  void take_contact(std::vector<std::shared_ptr<const PairedBodies<B>>> pairs, std::vector<std::vector<double>> forces);

  /// While cycles on the finest mesh run, these meshes, which it was made for, may be without their elements.
  void may_set_elements_aside(MeshHierarchy<D>& meshes) { spared_ = &meshes; }

  /// Of all methods together, in one solve from now on.
  void limit_iterations(int most) { options_.max_iterations = most; }

  /// From now on: DiscreteProblem::spent.
  void set_spent(bool spent) { spent_ = spent; }

  /// Interpolation between the meshes `level` and `level` + 1.
  const Prolongation& from_mesh(std::size_t level) const { return matrices_.above(level); }

  /// Gives back the problem of the last solve, whose matrix and load the next one takes over as far as they stay the
  /// same; those of coarser levels are kept anyway. Without it the finest level's are assembled again.
  void take_back(const Model<B>& model, Discretization<B> last);

  /// Gives the memory of all matrices back: the next solve assembles them again.
  void forget_matrices();

  /// The model as the last solve had it: its rigid obstacles are seen from where the body has moved to.
  Model<B> moved(const Model<B>& model) const { return pairs_.moved(model); }
  /// In the last solve, per obstacle by how much slaves were taken to have moved past masters, or the body past a rigid
  /// obstacle; empty: not.
  const std::vector<Point<B>>& shift() const { return pairs_.shift(); }

  /// Whether all levels below the finest mesh are chosen by its matrix.
  bool by_matrix() const { return first_ > 0; }

 private:
  struct Place;
  struct Found;

  void choose_levels();
  void forget_way();
  bool may_fall_back() const;
  bool newton_may_do(const Solution<B>& solution) const;
  Found solve_safely(const Model<B>& model);
  Solution<B> solve_sliding(const Model<B>& model);
  void follow_on(const Model<B>& model, Found& found);
  Solution<B> discretize_level(const Model<B>& model, std::size_t level);
  Solution<B> start_and_solve(const Model<B>& model);
  bool begin_near(const Model<B>& model, std::optional<Solution<B>>& solution);
  Solution<B> begin_level(const Model<B>& model, std::size_t level, Solution<B>& coarse,
                          std::optional<Solution<B>> begun = {});
  std::vector<double> extrapolated(const Model<B>& model) const;
  void start_after_step(const Model<B>& model, std::size_t level, const Solution<B>& coarse,
                        Solution<B>& solution) const;
  void pair_levels(const Model<B>& model);
  void pair_near_contact(const Model<B>& model, std::size_t level, const Solution<B>& coarse);
  void come_near(const Model<B>& model, Solution<B>& solution);
  void narrow_first(const Model<B>& model, Solution<B>& coarse);
  void drop_algebraic_levels();
  void connect_jumps(std::size_t level);
  bool pair_more(const Model<B>& model, Solution<B>& solution);
  std::optional<Discretization<B>> renew_level(const Model<B>& model, std::size_t level);
  static void add_force(const std::vector<double>& force, double sign, std::vector<double>& load);
  void keep(const Model<B>& model, MeshLevel<D, B>& level, Solution<B>& coarse);
  void find_pressure_space(const Model<B>& model, std::size_t level);
  std::vector<double> refined_pressure(std::size_t level, const std::vector<double>& coarse) const;
  void continue_algebraically(DiscreteProblem<B>& coarsest);
  void choose_levels_below(const Model<B>& model);
  void rest_on_springs(const Model<B>& model, const SolverOptions& options, const LooseBody<D, B>& body,
                       Solution<B>& solution);
  JointLoad<B> fill_joints(const JointPressure<D, B>& joints, const Wetted& wetted, Discretization<B>* discretization);
  void solve_finest(const Model<B>& model, SolverOptions options, Solution<B>& solution);
  void solve_open(const Model<B>& model, const JointPressure<D, B>& joints, Spreading& spreading,
                  Solution<B>& solution);
  void solve_level(const Model<B>& model, std::size_t level, const SolverOptions& options, const LooseBody<D, B>* body,
                   Solution<B>& solution);  // without a body it is not moved first
  Solution<B> solve_coarser_meshes(const Model<B>& model);

  MeshHierarchy<D>* spared_ = nullptr;  // where its elements may be set aside
  MeshLevels<D, B> levels_;
  Scene::Solver options_;
  std::string chosen_for_;      // the option `hierarchy` of what follows; empty: not chosen yet
  std::size_t first_ = 0;       // the coarsest mesh that gives a level, or a start
  std::size_t factorised_ = 0;  // the number of meshes that have no coarser level
  LevelPairs<D, B> pairs_;
  const Registry& registry_;
  const Progress& progress_;
  Times& times_;
  const Monitor monitor_;
  LevelMatrices<B> matrices_;
  std::vector<double> earlier_;  // the solution before the last one that was accepted; empty: the body as it is drawn
  double earlier_t_ = 0;
  bool followed_ = false;  // the last solve was one of a step that follows another one
  bool spent_ = false;
  bool continued_ = false;      // algebraic levels have been looked for
  std::vector<Stage> dropped_;  // starts that coarser levels did not give, and rough ones
};

}  // namespace signorini
