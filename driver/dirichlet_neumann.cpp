#include "driver/dirichlet_neumann.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/dot.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fem/pairs/paired_bodies.hpp"
#include "core/fem/pairs/paired_sides.hpp"
#include "core/fem/recovery/contact.hpp"
#include "core/mesh/join.hpp"
#include "core/solver/admissible.hpp"
#include "core/solver/convergence.hpp"
#include "driver/scene/build_model.hpp"
#include "driver/scene/problem.hpp"

namespace signorini {
namespace {

/// The first damping, and the bounds of later ones.
constexpr double first_damping = 0.5, least_damping = 1e-4, most_damping = 1;
/// A step after which nothing touches any more was too long: it is cut to this part, so many times in a row at most.
constexpr double cut = 0.1;
constexpr int most_cuts = 4;
/// Turns end where in so many of them the surfaces' motion has not come below this part of the least one before.
constexpr int patience_of_turns = 20;
constexpr double progress_of_turns = 0.9;

Scene scene_of_parts(const Scene& scene, std::size_t body) {
  Scene out = scene;
  out.bodies = scene.bodies[body].parts;
  out.solver.bodies = "jumps";
  return out;
}

/// Of a body's own mesh the part that has the joint name.
Selection of_own(Selection selection) {
  if (!selection.part) return selection;
  selection.part = selection.part->substr(body_of(*selection.part).size() + 1);
  return selection;
}

/// Makes of what each step finds what the next one takes: a vector extrapolation with one number (B. M. Irons, R. C.
/// Tuck, Int. J. Numer. Meth. Engng. 1, 1969).
class Damping {
 public:
  /// @param change what has been found, less what was taken
  double factor(const std::vector<double>& change) {
    if (!last_.empty()) {
      double along = 0, square = 0;
      for (std::size_t k = 0; k < change.size(); ++k) {
        const double difference = change[k] - last_[k];
        along += last_[k] * difference;
        square += difference * difference;
      }
      if (square > 0) factor_ = std::clamp(-factor_ * along / square, least_damping, most_damping);
    }
    last_ = change;
    return factor_;
  }
  /// Of the last step only a part is taken.
  double shorter() { return factor_ *= cut; }

 private:
  double factor_ = first_damping;
  std::vector<double> last_;
};

/// Tells when turns lead nowhere.
class Patience {
 public:
  bool lost(double change) {
    since_ = change < progress_of_turns * least_ ? 0 : since_ + 1;
    least_ = std::min(least_, change);
    return since_ >= patience_of_turns;
  }

 private:
  double least_ = infinity;
  int since_ = 0;
};

/// Rounding of one turn is none of the next one: before bodies press a master may be moved as it is.
bool may_go_on(Outcome outcome) {
  return outcome == Outcome::converged || outcome == Outcome::rounding || outcome == Outcome::inaccurate;
}

}  // namespace

template <int D>
void check_turns(const Scene& scene, std::size_t body, const Model<D>& model) {
  if (scene.solver.bodies != "dirichlet-neumann" || !is_paired(model)) return;
  for (const Scene::Body& part : scene.bodies[body].parts)
    if (part.order != 1)
      input_error(part.source.of(part.source.given("order") ? "order" : "pressure"),
                  "quadratic elements are not available with bodies = \"dirichlet-neumann\"; expected order = 1");
  if (!model.rigid.empty())
    input_error(model.rigid.front().on.origin,
                "rigid parts are not available with bodies = \"dirichlet-neumann\"; expected \"jumps\"");
  for (const ObstacleTerm<D>& term : model.obstacles) {
    if (!term.other) continue;
    if (term.tied)
      input_error(term.origin,
                  "bodies that are tied to each other are not available with bodies = \"dirichlet-neumann\"; expected "
                  "\"jumps\"");
    if (term.obstacle->functional())
      input_error(term.origin,
                  "friction between bodies is not available with bodies = \"dirichlet-neumann\"; "
                  "expected \"jumps\"");
    if (of_one_body(term))
      input_error(term.origin,
                  "a body that touches itself is not available with bodies = \"dirichlet-neumann\"; "
                  "expected \"jumps\"");
  }
}

template void check_turns(const Scene&, std::size_t, const Model<2>&);
template void check_turns(const Scene&, std::size_t, const Model<3>&);

template <int D>
DirichletNeumann<D>::Part::Part(const Scene& scene, std::size_t number, const Registry& registry,
                                const Progress& progress, Times& times)
    : hierarchy([&] {
        const Stopwatch watch;
        auto meshes = build_hierarchy<D>(scene, D, nullptr, progress, number);
        times.mesh += watch.elapsed();
        return meshes;
      }()),
      solver(std::make_unique<NestedSolver<D, D>>(hierarchy, scene.solver, registry, progress, times)) {}

template <int D>
DirichletNeumann<D>::DirichletNeumann(const Scene& scene, std::size_t body, const MeshHierarchy<D>& joint,
                                      const Registry& registry, const Progress& progress, Times& times)
    : scene_(scene_of_parts(scene, body)),
      joint_(joint),
      registry_(registry),
      progress_(progress),
      times_(times),
      nodes_(nodes_of(joint)) {
  scene_.solver.hierarchy = "meshes";
  for (std::size_t k = 0; k < scene_.bodies.size(); ++k)
    parts_.push_back(std::make_unique<Part>(scene_, k, registry, progress, times));
  number_nodes(joint);
}

/// Coarsest meshes are joined one after the other; finer vertices are known by the ends of the edge that they halve.
template <int D>
void DirichletNeumann<D>::number_nodes(const MeshHierarchy<D>& joint) {
  levels_.resize(joint.levels.size());
  Index first = 0;
  for (const auto& part : parts_) {
    std::vector<Index>& numbers = part->joint.emplace_back();
    for (Index v = 0; v < part->hierarchy.levels.front().vertices(); ++v) numbers.push_back(first + v);
    first += static_cast<Index>(numbers.size());
  }
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    std::map<std::array<Index, 2>, Index> by_parents;
    const auto& parents = joint.refinements[l - 1].parents;
    for (std::size_t v = 0; v < parents.size(); ++v)
      by_parents[{std::min(parents[v][0], parents[v][1]), std::max(parents[v][0], parents[v][1])}] =
          static_cast<Index>(v);
    for (const auto& part : parts_) {
      std::vector<Index> numbers;
      for (const auto& [a, b] : part->hierarchy.refinements[l - 1].parents) {
        const auto [low, high] = std::minmax({part->joint[l - 1][a], part->joint[l - 1][b]});
        numbers.push_back(by_parents.at({low, high}));
      }
      part->joint.push_back(std::move(numbers));
    }
  }
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    levels_[l].part.resize(joint.levels[l].points.size());
    levels_[l].node.resize(joint.levels[l].points.size());
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (Index p = 0; p < std::ssize(parts_[k]->joint[l]); ++p) {
        levels_[l].part[parts_[k]->joint[l][p]] = static_cast<Index>(k);
        levels_[l].node[parts_[k]->joint[l][p]] = p;
      }
  }
}

/// A pair is an obstacle of the slave alone.
template <int D>
void DirichletNeumann<D>::build_models(const Model<D>& model, const LoadStep& step) {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Part& part = *parts_[k];
    part.model = build_model<D>(scene_, D, registry_, step, k);
    std::erase_if(part.model.obstacles, [](const ObstacleTerm<D>& term) { return term.other.has_value(); });
    part.pairs.clear();
    part.is_slave = part.is_master = false;
    for (Index j = 0; j < std::ssize(model.obstacles); ++j) {
      const ObstacleTerm<D>& term = model.obstacles[j];
      if (!term.other) continue;
      const std::string slave = body_of(*term.on->part), master = body_of(*term.other->part);
      part.is_master = part.is_master || master == scene_.bodies[k].name;
      if (slave != scene_.bodies[k].name) continue;
      part.is_slave = true;
      part.pairs.push_back(j);
      ObstacleTerm<D>& own = part.model.obstacles.emplace_back(term);
      own.on = of_own(*term.on);
    }
  }
  order_.clear();
  for (const bool masters : {false, true})
    for (Index k = 0; k < std::ssize(parts_); ++k)
      if (parts_[k]->is_master == masters) order_.push_back(k);
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    levels_[l].pairs = pair_bodies<D>(nodes_[l], model, collect_fixes<D, D>(nodes_[l], model));
    refuse_shared_nodes(model, levels_[l]);
  }
  refuse_lost<D>(nodes_.back(), model, *levels_.back().pairs);
}

/// A displacement of the finest joint mesh at the nodes of all meshes.
template <int D>
std::vector<std::vector<double>> DirichletNeumann<D>::on_all_meshes(Vector u) const {
  std::vector<Vector> out(levels_.size());
  out.back() = std::move(u);
  for (std::size_t l = levels_.size() - 1; l-- > 0;) {
    out[l].resize(nodes_[l].size() * std::size_t{D});
    const auto& parents = joint_.refinements[l].parents;
    for (Index v = 0; v < std::ssize(parents); ++v)
      if (const auto [a, b] = parents[v]; a == b)
        std::copy_n(out[l + 1].begin() + Offset{v} * D, D, out[l].begin() + Offset{a} * D);
  }
  return out;
}

/// What a slave's node sees has to be the master's own displacement: of no other slave, nor of its own body.
template <int D>
void DirichletNeumann<D>::refuse_shared_nodes(const Model<D>& model, const Level& level) const {
  const Jumps<D>& jumps = *level.pairs->jumps;
  for (const PairedNode<D>& pair : level.pairs->nodes) {
    const auto s = std::ranges::lower_bound(jumps.vector, pair.node) - jumps.vector.begin();
    for (Offset k = jumps.inverse.row[s]; k < jumps.inverse.row[s + 1]; ++k) {
      const Index q = jumps.inverse.column[k];
      if (q == pair.node) continue;
      if (level.part[q] != level.part[pair.node] && !std::ranges::binary_search(jumps.vector, q)) continue;
      input_error(model.obstacles[pair.obstacle].origin,
                  "nodes that touch several bodies, or a rigid obstacle beside a body, are not available with bodies = "
                  "\"dirichlet-neumann\"; expected \"jumps\"");
    }
  }
}

/// Per slave's node the mean displacement of the master in front of it.
template <int D>
std::vector<double> DirichletNeumann<D>::mean_of_masters(const Level& level, const Vector& u) const {
  Vector x(u.size());
  for (std::size_t k = 0; k < u.size(); ++k) x[k] = u[k];
  to_jumps(*level.pairs->jumps, x);
  Vector out;
  for (const Index p : level.pairs->jumps->vector)
    for (int i = 0; i < D; ++i) out.push_back(u[Offset{p} * D + i] - x[Offset{p} * D + i]);
  return out;
}

/// Of one body: pairs whose gaps are those to where the masters have come.
/// @param moved per joint mesh what mean_of_masters() says
template <int D>
std::vector<std::shared_ptr<const PairedBodies<D>>> DirichletNeumann<D>::obstacles(
    Index number, const std::vector<Vector>& moved) const {
  const Part& part = *parts_[number];
  const Index own = static_cast<Index>(part.model.obstacles.size() - part.pairs.size());
  std::vector<std::shared_ptr<const PairedBodies<D>>> out;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    PairedBodies<D> pairs;
    for (PairedNode<D> node : levels_[l].pairs->nodes) {
      if (levels_[l].part[node.node] != number) continue;
      const auto& vectors = levels_[l].pairs->jumps->vector;
      const auto at = std::ranges::lower_bound(vectors, node.node) - vectors.begin();
      for (int i = 0; i < D; ++i) node.gap -= node.away[i] * moved[l][at * D + i];
      node.node = levels_[l].node[node.node];
      node.obstacle = own + static_cast<Index>(std::ranges::find(part.pairs, node.obstacle) - part.pairs.begin());
      pairs.nodes.push_back(node);
    }
    std::ranges::sort(pairs.nodes, {}, [](const PairedNode<D>& n) { return std::pair(n.obstacle, n.node); });
    pairs.jumps = std::make_shared<const Jumps<D>>();
    out.push_back(std::make_shared<const PairedBodies<D>>(std::move(pairs)));
  }
  return out;
}

/// Forces on the nodes of one body's finest mesh, on all its meshes.
template <int D>
std::vector<std::vector<double>> DirichletNeumann<D>::forces_on(Part& part, Vector forces) const {
  std::vector<Vector> out(levels_.size());
  out.back() = std::move(forces);
  for (std::size_t l = levels_.size() - 1; l-- > 0;) {
    const auto& parents = part.hierarchy.refinements[l].parents;
    out[l].resize(part.hierarchy.levels[l].points.size() * std::size_t{D});
    for (std::size_t v = 0; v < parents.size(); ++v)
      for (const Index a : parents[v])
        for (int i = 0; i < D; ++i) out[l][Offset{a} * D + i] += 0.5 * out[l + 1][v * D + i];
  }
  return out;
}

/// Those of the slave's contact in the last obstacles of its model, and back on the masters; on the finest joint mesh.
template <int D>
void DirichletNeumann<D>::take_forces(Index number, const Solution<D>& solution, Vector& forces) {
  const Part& part = *parts_[number];
  const auto state = contact_state<D, D>(part.nodes(), part.model, solution.discretization, solution.x);
  const Index own = static_cast<Index>(part.model.obstacles.size() - part.pairs.size());
  for (const ContactNode<D>& node : state.nodes) {
    if (node.obstacle < own) continue;
    const Index p = part.joint.back()[node.vertex];
    in_contact_[p] = node.contact;
    std::copy(node.force.begin(), node.force.end(), forces.begin() + Offset{p} * D);
  }
}

/// From the last turn. A master's own fixes have to hold it.
template <int D>
Solution<D> DirichletNeumann<D>::solve_alone(Index number) {
  Part& part = *parts_[number];
  try {
    return part.u.empty() ? part.solver->solve(part.model) : part.solver->solve_after(part.model, part.u);
  } catch (const Error& error) {
    if (error.status() != Exit::no_solution || !part.is_master) throw;
    input_error(scene_.bodies[number].source.table,
                fmt::format("by itself the body has no solution, and it is a master: bodies = \"dirichlet-neumann\" "
                            "expects fixes that hold masters, \"jumps\" does not ({})",
                            error.what()));
  }
}

template <int D>
void DirichletNeumann<D>::solve_part(Index number, const std::vector<Vector>& moved, Vector& forces, Summary& all) {
  Part& part = *parts_[number];
  const int left = most_cycles() - all.iterations;
  if (left < 1) {
    all.outcome = Outcome::iteration_limit;
    return;
  }
  part.solver->limit_iterations(left);
  // What slaves press with comes back on the masters.
  Vector back = forces;
  transform_forces(*levels_.back().pairs->jumps, back);
  Vector own(part.nodes().size() * std::size_t{D});
  for (Index p = 0; part.is_master && p < part.nodes().size(); ++p)
    for (int i = 0; i < D; ++i) {
      const Offset at = Offset{part.joint.back()[p]} * D + i;
      own[Offset{p} * D + i] = forces[at] - back[at];
    }
  part.solver->take_contact(
      part.is_slave ? obstacles(number, moved) : std::vector<std::shared_ptr<const PairedBodies<D>>>(levels_.size()),
      part.is_master ? forces_on(part, std::move(own)) : std::vector<Vector>{});
  Solution<D> solution = solve_alone(number);
  part.u = to_global(solution.discretization.problem, solution.x);
  if (part.is_slave) take_forces(number, solution, forces);
  all.iterations += solution.summary.iterations;
  if (!solution.summary.converged() && may_go_on(all.outcome)) {
    all.outcome = solution.summary.outcome;
    all.reason = fmt::format("body '{}': {}", scene_.bodies[number].name, solution.summary.reason);
  }
  part.solver->accept();
  part.solver->take_back(part.model, std::move(solution.discretization));
}

/// In the terms of the joint problem; nodes that touch lie on their bounds exactly.
template <int D>
Solution<D> DirichletNeumann<D>::joint_solution(const Model<D>& model, const Vector& u) const {
  Solution<D> out;
  out.discretization = discretize<D, D>(nodes_.back(), model, levels_.back().pairs);
  DiscreteProblem<D>& problem = out.discretization.problem;
  out.x = to_local(problem, u);
  const Constraints<D>& c = problem.constraints;
  for (Index slot = 0; slot < c.size(); ++slot) {
    if (!in_contact_[c.vector[slot]]) continue;
    double& along = out.x[Offset{c.vector[slot]} * D];
    const double low = c.lower[Offset{slot} * D], high = c.upper[Offset{slot} * D];
    along = along - low < high - along ? low : high;
  }
  make_admissible(problem, out.x);
  return out;
}

template <int D>
Solution<D> DirichletNeumann<D>::solve(const Model<D>& model, const LoadStep& of) {
  const Stopwatch watch;
  build_models(model, of);
  const SolverOptions& options = scene_.solver;
  Vector u(nodes_.back().size() * std::size_t{D}), forces(u.size()), taken = u;
  in_contact_.assign(nodes_.back().size(), 0);
  Damping damping;
  Patience patience;
  Summary all;
  all.options = options;
  all.options.method = "dirichlet-neumann";
  std::vector<double> changes;
  Vector start, step;  // of the masters, where they last touched
  int turn = 0, cuts = 0;
  double change = infinity;
  bool lost = false;
  all.outcome = Outcome::converged;
  while (change > options.tolerance && may_go_on(all.outcome) && !lost) {
    ++turn;
    progress_.phase(fmt::format("turn {}", turn));
    all.outcome = Outcome::converged;
    all.reason.clear();
    for (const Index k : order_) {
      std::vector<Vector> moved;
      const std::vector<Vector> on_all = on_all_meshes(taken);
      for (std::size_t l = 0; l < levels_.size(); ++l) moved.push_back(mean_of_masters(levels_[l], on_all[l]));
      solve_part(k, moved, forces, all);
      const Part& part = *parts_[k];
      for (Index p = 0; p < std::ssize(part.u) / D; ++p)
        std::copy_n(part.u.begin() + Offset{p} * D, D, u.begin() + Offset{part.joint.back()[p]} * D);
    }
    const Level& finest = levels_.back();
    const Vector found = mean_of_masters(finest, u), before = mean_of_masters(finest, taken);
    Vector difference = found;
    for (std::size_t k = 0; k < difference.size(); ++k) difference[k] -= before[k];
    const double size = std::max(max_norm(u), max_norm(taken));
    change = size > 0 ? max_norm(difference) / size : 0;
    changes.push_back(change);
    lost = patience.lost(change);
    const bool too_long = max_norm(forces) == 0 && !step.empty() && cuts < most_cuts;
    if (!too_long) {
      start = taken;
      step.resize(u.size());
      for (std::size_t k = 0; k < u.size(); ++k) step[k] = u[k] - taken[k];
    }
    cuts = too_long ? cuts + 1 : 0;
    const double factor = too_long ? damping.shorter() : damping.factor(difference);
    for (std::size_t k = 0; k < u.size(); ++k) taken[k] = start[k] + factor * step[k];
  }
  Solution<D> out = joint_solution(model, u);
  if (may_go_on(all.outcome) && change > options.tolerance) {
    all.outcome = Outcome::iteration_limit;
    all.reason.clear();
  }
  if (all.iterations >= most_cycles() && all.outcome == Outcome::iteration_limit)
    all.reason = fmt::format(
        "limit of {} cycles of all bodies ({} each, max_iterations), in turn {}, where the masters' surfaces "
        "have moved by {:.2g} of the largest displacement",
        most_cycles(), options.max_iterations, turn, change);
  if (all.reason.empty())
    all.reason = fmt::format(
        "in turn {} the masters' surfaces have moved by {:.2g} of the largest displacement, {} {:g}{}", turn, change,
        change <= options.tolerance ? "at most" : "above", options.tolerance,
        lost
            ? fmt::format(", and in {} turns it has not become less: turns do not come to rest where masters are soft; "
                          "expected the softer body as the slave ('slave'), or bodies = \"jumps\"",
                          patience_of_turns)
            : "");
  if (changes.size() > 1) all.rate = std::pow(changes.back() / changes.front(), 1.0 / double(changes.size() - 1));
  all.residual = all.algebraic_error = change;
  all.energy = energy(out.discretization.problem, out.x);
  all.level_unknowns = {static_cast<Index>(u.size())};
  all.finest_level = static_cast<int>(levels_.size()) - 1;
  all.solve_seconds = watch.elapsed();
  Stage& stage = all.stages.emplace_back();
  stage.method = all.options.method;
  stage.iterations = all.iterations;
  stage.seconds = all.solve_seconds;
  stage.outcome = all.outcome;
  stage.reason = all.reason;
  out.summary = std::move(all);
  return out;
}

template class DirichletNeumann<2>;
template class DirichletNeumann<3>;

}  // namespace signorini
