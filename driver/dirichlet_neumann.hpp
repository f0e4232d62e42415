#pragma once
#include <memory>
#include <vector>

#include "core/component/registry.hpp"
#include "core/sdk/stepping.hpp"
#include "driver/levels/nested_solver.hpp"

namespace signorini {

/// Error(Exit::input) for what bodies = "dirichlet-neumann" does not know, where the scene has it: friction between
/// bodies, quadratic elements, a body that touches itself.
/// @param scene as it is solved
template <int D>
void check_turns(const Scene& scene, std::size_t body, const Model<D>& model);

/// Bodies that touch each other, solved in turns by what solves one body: a nonlinear Dirichlet-Neumann iteration (R.
/// Krause, B. Wohlmuth: A Dirichlet-Neumann type algorithm for contact problems with friction, Comput. Vis. Sci. 5,
/// 2002). A slave has the surface of its masters as an obstacle, where these have come to; a master feels the slave's
/// contact forces. What the obstacle moves by is damped (Aitken). Gaps, normals and forces go across by the mortar
/// coupling of the bodies' joint problem, so that the limit is its solution.
template <int D>
class DirichletNeumann {
 public:
  /// Builds the bodies' own meshes. Keeps references.
  /// @param scene as it is solved
  /// @param body one with parts; `joint` are its meshes
  DirichletNeumann(const Scene& scene, std::size_t body, const MeshHierarchy<D>& joint, const Registry& registry,
                   const Progress& progress, Times& times);

  /// All cycles of all bodies count for `max_iterations`. Turns that lead nowhere end before. Errors as of
  /// NestedSolver.
  /// @param model of all; of each pair `on` is the slave's side
  /// @param step that the model is of
  Solution<D> solve(const Model<D>& model, const LoadStep& step);

 private:
  /// One of the bodies.
  struct Part {
    Part(const Scene& scene, std::size_t number, const Registry& registry, const Progress& progress, Times& times);
    const Nodes<D>& nodes() const { return solver->nodes(); }

    MeshHierarchy<D> hierarchy;
    std::unique_ptr<NestedSolver<D, D>> solver;
    std::vector<std::vector<Index>> joint;  // per mesh and node: its number in the joint mesh
    Model<D> model;
    std::vector<Index> pairs;  // the last obstacles of the model: their numbers in the joint one
    std::vector<double> u;     // empty: none yet
    bool is_slave = false, is_master = false;
  };
  /// The sides of all pairs on one of the joint meshes.
  struct Level {
    std::shared_ptr<const PairedBodies<D>> pairs;
    std::vector<Index> part, node;  // per joint node
  };
  using Vector = std::vector<double>;

  void number_nodes(const MeshHierarchy<D>& joint);
  void build_models(const Model<D>& model, const LoadStep& step);
  void order_parts();
  void refuse_shared_nodes(const Model<D>& model, const Level& level) const;
  std::vector<Vector> on_all_meshes(Vector u) const;
  Vector mean_of_masters(const Level& level, const Vector& u) const;
  std::vector<std::shared_ptr<const PairedBodies<D>>> obstacles(Index part, const std::vector<Vector>& moved) const;
  std::vector<Vector> forces_on(Part& part, Vector forces) const;
  Solution<D> solve_alone(Index number);
  int most_cycles() const { return scene_.solver.max_iterations * static_cast<int>(parts_.size()); }
  void solve_part(Index number, const std::vector<Vector>& moved, Vector& forces, Summary& all);
  void take_forces(Index number, const Solution<D>& solution, Vector& forces);
  Solution<D> joint_solution(const Model<D>& model, const Vector& u) const;

  Scene scene_;  // its bodies are the parts
  const MeshHierarchy<D>& joint_;
  const Registry& registry_;
  const Progress& progress_;
  Times& times_;
  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<Index> order_;  // slaves first
  std::vector<Level> levels_;
  std::vector<Nodes<D>> nodes_;   // joint
  std::vector<char> in_contact_;  // per joint node of the finest mesh
};

}  // namespace signorini
