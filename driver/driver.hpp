#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/component/registry.hpp"
#include "core/io/report.hpp"
#include "core/scene/scene.hpp"
#include "core/sdk/stepping.hpp"
#include "driver/body_run.hpp"
#include "driver/scene/progress.hpp"

namespace signorini {

/// Solves a scene, and again when loads, fixes, obstacles or the start have changed:
///
///     Driver driver(read_scene("ball.toml"));
///     double force = driver.solve().last().contact[0].force[2];
///     driver.scene().loads[0].value[2] = -0.2;
///     force = driver.solve().last().contact[0].force[2];
///
/// Meshes, levels and matrices are kept between steps and solves as far as they stay the same.
/// Bodies that may touch each other are solved as one, and count as one here: see with_touching_bodies().
/// Errors are Error, with the program's exit status and a message that names the place in the scene.
class Driver {
 public:
  /// Loads the plugins that the scene names; Error(Exit::plugin) where one is missing. What [contact] finds is among
  /// the scene's obstacles then, see add_found_pairs().
  /// @param progress is told how work goes on, and may end it; it outlives the driver
  explicit Driver(Scene scene, const Progress& progress = waiting());
  ~Driver();
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  /// May be changed between solves, but for the bodies' meshes, [solver] and [refine], which are taken from it once.
  /// The next solve checks names, lengths and constants as read_scene() does, and loads further plugins.
  Scene& scene() { return scene_; }
  const Scene& scene() const { return scene_; }

  /// Solves all steps. The first one starts from the last solution where there is one. A step of a body with friction
  /// that fails is solved in parts (docs/scene.md, "[steps]"); where that fails, too, it is the last one in the report,
  /// and the next solve starts from the step before it. Where the work is ended after the first of several steps, by an
  /// interrupt or by an error, which is thrown, the report has those that were finished, and is marked so. An interrupt
  /// of a single step is thrown, too; where there was an iterate on the finest mesh the report has it, and is marked
  /// so.
  /// Where the scene asks for adaptive meshes it is solved on one after the other; what there is then is of the last.
  /// @param done is called after each step or part, when report() and bodies have its results
  const Report& solve(const std::function<void()>& done = {});
  /// Gives the memory of all matrices back, such as before results are written: the next solve assembles them again.
  void forget_matrices();
  /// The next solve starts from u: B per vertex of the body's finest mesh, see BodyRun.
  void start_from(std::size_t body, std::vector<double> u);

  /// Of the last solve.
  const Report& report() const { return report_; }
  Report& report() { return report_; }
  /// Displacements, or values of a scalar body, at the vertices of its finest mesh, one vertex after the other.
  std::vector<double> solution(std::size_t body = 0) const;
  /// Coordinates of these vertices, likewise.
  std::vector<double> points(std::size_t body = 0) const;

  /// Calls visit(run) with the BodyRun<D, B> of a body; there is one once a solve has begun. Error(Exit::usage) for a
  /// body that is not there, here and above.
  template <class Visit>
  decltype(auto) visit(std::size_t body, Visit&& visit) const {
    require_body(body);
    return std::visit([&](const auto& run) -> decltype(auto) { return visit(std::as_const(*run)); }, bodies_[body]);
  }
  template <class Visit>
  decltype(auto) visit(std::size_t body, Visit&& visit) {
    require_body(body);
    return std::visit([&](auto& run) -> decltype(auto) { return visit(*run); }, bodies_[body]);
  }
  std::size_t bodies() const { return bodies_.size(); }

 private:
  template <int D, int B>
  using Run = std::unique_ptr<BodyRun<D, B>>;
  using AnyRun = std::variant<Run<2, 1>, Run<3, 1>, Run<2, 2>, Run<3, 3>>;

  static const Progress& waiting();
  void prepare();
  void check_adaptive() const;
  void solve_steps(const std::function<void()>& done);
  std::string why_not_refined(const AdaptiveReport& past) const;
  bool refine(double seconds);
  void require_body(std::size_t body) const;
  void build_bodies();
  void begin();
  bool advance(const LoadStep& by, const std::function<void()>& done);
  bool keep_iterate(StepReport report, Warnings warnings);
  StepReport solve_step(const LoadStep& by, Warnings& warnings);
  bool is_stuck(const StepReport& report) const;
  const std::string* veto_against_cutting() const;
  FrictionDoubt doubt_of_friction(const LoadStep& by, std::size_t body) const;
  bool may_be_cut(const LoadStep& by, const StepReport& report) const;
  void note_failure(const LoadStep& by, const char* what, int iterations, const std::string& reason);
  void accept();
  void add_step(StepReport report);
  void finish();
  template <int D>
  void add_unheld_overlaps();

  Scene scene_;
  Scene solved_;  // the same with_touching_bodies()
  const Progress& progress_;
  Registry registry_;
  Warnings mesh_warnings_;
  Report report_;
  std::vector<AnyRun> bodies_;
};

}  // namespace signorini
