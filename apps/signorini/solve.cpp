#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "amg/registration.hpp"
#include "apps/signorini/build_model.hpp"
#include "apps/signorini/commands.hpp"
#include "apps/signorini/components.hpp"
#include "apps/signorini/contact_warnings.hpp"
#include "apps/signorini/interrupt.hpp"
#include "apps/signorini/nested_solver.hpp"
#include "apps/signorini/output.hpp"
#include "apps/signorini/problem.hpp"

namespace signorini {
namespace {

/// One run of `signorini solve`: from the scene to the report, its files staged.
template <int D, int B>
class SolveRun {
 public:
  SolveRun(const Scene& scene, const Registry& registry, const Progress& progress, AtomicFiles& files, Report& report)
      : scene_(scene),
        registry_(registry),
        progress_(progress),
        files_(files),
        report_(report),
        vtu_(files, scene.steps.count, {worthwhile, scene.solver.threads}) {}

  void run() {
    prepare();
    NestedSolver<D, B> solver(hierarchy_, scene_.solver, registry_, progress_, report_.time);
    solve_steps(solver);
    if (solver.by_matrix()) report_.hierarchy = "matrix";
    finish();
  }

 private:
  /// Problems with few unknowns per vertex are solved in the time that it takes to pack all of their meshes.
  static constexpr double worthwhile = B == 3 ? 0.6 : 0.25;

  void prepare() {
    Stopwatch watch;
    progress_.phase("meshing");
    report_.dimension = D;
    hierarchy_ = build_hierarchy<D>(scene_, B, &report_.warnings);
    probes_ = locate_probes(hierarchy_.finest(), scene_);
    for (auto& warning : scene_warnings(scene_, hierarchy_.levels.front()))
      report_.warnings.push_back(std::move(warning));
    report_.time.mesh = watch.elapsed();
  }

  /// Steps that are finished are kept when the user asks to end.
  void solve_steps(NestedSolver<D, B>& solver) {
    const int count = scene_.steps.count;
    try {
      for (int step = 1; step <= count; ++step) {
        const double t = static_cast<double>(step) / count;
        at_step(scene_, t, [&] { solve_step(solver, step, t); });
      }
      stop_if_interrupted();
    } catch (const Error& error) {
      if (error.status() != Exit::interrupted || count == 1 || report_.steps.empty()) throw;
      report_.interrupted = true;
    }
  }

  void solve_step(NestedSolver<D, B>& solver, int step, double t) {
    if (scene_.steps.count > 1) progress_.phase(fmt::format("step {} of {}", step, scene_.steps.count));
    const Model<B> model = build_model<B>(scene_, D, registry_, t);
    if (step == 1)
      for (auto& warning : model_warnings(scene_, hierarchy_.finest(), model))
        report_.warnings.push_back(std::move(warning));
    if (step == 1)
      for (auto& warning : start_warnings(hierarchy_.levels.front(), model))
        report_.warnings.push_back(std::move(warning));
    add_results(model, solve_model(solver, step, model));
  }

  /// Where there is no solution, perhaps the body was meant to be on the other side.
  Solution<B> solve_model(NestedSolver<D, B>& solver, int step, const Model<B>& model) {
    try {
      return step == 1 ? solver.solve(model) : solver.solve_after(model, results_.u);
    } catch (const Error& error) {
      if (error.status() != Exit::no_solution) throw;
      const auto reasons = start_warnings(hierarchy_.levels.front(), model, true);
      if (reasons.empty()) throw;
      throw Error(error.status(), fmt::format("{}; {}", error.what(), fmt::join(reasons, "; ")));
    }
  }

  void add_results(const Model<B>& model, const Solution<B>& solution) {
    Stopwatch watch;
    const Mesh<D>& mesh = hierarchy_.finest();
    results_ = results<D, B>(mesh, model, solution);
    report_.steps.push_back(step_report<D, B>(mesh, probes_, results_, model.t,
                                              judge<D, B>(mesh, model, solution, results_.u, scene_.solver.tolerance)));
    if (const auto steps = report_.steps.size(); steps > 1)  // what friction has dissipated since the first step
      for (std::size_t k = 0; k < report_.steps.back().contact.size(); ++k)
        report_.steps.back().contact[k].dissipated += report_.steps[steps - 2].contact[k].dissipated;
    add_undetermined(model, solution.undetermined);
    if (!is_last_step()) write_solution();
    report_.time.output += watch.elapsed();
  }

  void add_undetermined(const Model<B>& model, const std::vector<std::string>& motions) {
    report_.steps.back().undetermined = motions;
    if (motions.empty()) return;
    std::string warning = fmt::format(
        "{}: neither loads nor fixes nor obstacles determine these motions: {}; the solution moves least along them",
        model.origin, fmt::join(motions, "; "));
    if (std::ranges::find(report_.warnings, warning) == report_.warnings.end())
      report_.warnings.push_back(std::move(warning));
  }

  bool is_last_step() const { return static_cast<int>(report_.steps.size()) == scene_.steps.count; }

  void write_solution() {
    if (scene_.output.vtu) vtu_.add(hierarchy_.finest(), point_fields(hierarchy_.finest(), results_), report_.last().t);
  }

  /// The solution of the last step is written while the pictures are drawn.
  void finish() {
    Stopwatch watch;
    progress_.phase("writing");
    for (auto& warning : contact_warnings(scene_, report_)) report_.warnings.push_back(std::move(warning));
    for (auto& warning : chord_warnings<D, B>(scene_, hierarchy_, results_))
      report_.warnings.push_back(std::move(warning));
    if (scene_.output.convergence) write_tables(files_, report_);
    Pictures pictures(files_);
    if (scene_.output.pictures) pictures.start(hierarchy_, results_, report_);
    if (is_last_step()) write_solution();
    vtu_.finish();
    pictures.finish(report_);
    report_.time.output += watch.elapsed();
  }

  const Scene& scene_;
  const Registry& registry_;
  const Progress& progress_;
  AtomicFiles& files_;
  Report& report_;
  SolutionFiles vtu_;
  MeshHierarchy<D> hierarchy_;
  Probes<D> probes_;
  Results<D, B> results_;
};

/// The files that a scene reads.
std::vector<std::filesystem::path> inputs(const Scene& scene) {
  std::vector<std::filesystem::path> files{scene.file};
  for (const Scene::Body& body : scene.bodies) {
    if (const auto* mesh = std::get_if<Scene::MeshFile>(&body.shape)) files.push_back(mesh->file);
    if (const auto* solid = std::get_if<geometry::Solid>(&body.shape)) files.push_back(solid->file);
  }
  for (const Scene::Obstacle& obstacle : scene.obstacles)
    if (obstacle.shape)
      if (const auto* surface = std::get_if<Scene::SurfaceShape>(&*obstacle.shape)) files.push_back(surface->file);
  return files;
}

void print_result(const Report& report, const std::vector<std::filesystem::path>& written) {
  const StepReport& last = report.last();
  fmt::print("{}\n", report.title);
  print_summary(last.summary, report.converged());
  for (const ContactReport& contact : last.contact)
    fmt::print("obstacle {}: {} nodes in contact, area {:.6g}, force ({:.6g}), largest pressure {:.6g}\n",
               contact.obstacle, contact.nodes, contact.area, fmt::join(contact.force, ", "), contact.max_pressure);
  for (const ProbeReport& probe : last.probes) fmt::print("{}: ({:.9g})\n", probe.name, fmt::join(probe.value, ", "));
  const Times& time = report.time;
  fmt::print(
      "seconds: mesh {:.2f}, assemble {:.2f}, setup {:.2f}, solve {:.2f}, output {:.2f}, total {:.2f}; {:.0f} MB\n",
      time.mesh, time.assemble, time.setup, time.solve, time.output, time.total, report.peak_memory_mb);
  for (const auto& file : written) fmt::print("wrote {}\n", file.string());
}
}  // namespace

Exit solve_command(const SolveArguments& arguments) {
  Stopwatch watch;
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  const Progress progress(arguments.quiet);
  Report report;
  report.scene = arguments.scene.string();
  report.title = scene.title;
  Registry registry = solver_components();
  check_components(scene, registry);
  report.plugins = load_plugins(scene, registry);
  AtomicFiles files(arguments.out.empty() ? std::filesystem::path(scene.name) : arguments.out, is_result_file,
                    inputs(scene));
  dispatch(scene, [&]<int D, int B>() { SolveRun<D, B>(scene, registry, progress, files, report).run(); });
  report.time.total = watch.elapsed();
  report.peak_memory_mb = peak_memory_mb();
  write_text(files.stage("report.json"), to_json(report).dump(2) + '\n');
  if (scene.steps.count == 1) stop_if_interrupted();
  const auto written = files.commit();
  if (report.interrupted)
    throw Error(Exit::interrupted, fmt::format("interrupted; {} of {} steps were finished and are written",
                                               report.steps.size(), scene.steps.count));
  if (!arguments.quiet) {
    print_of_written([&] { print_result(report, written); });
    print_warnings(report.warnings);
  }
  return report.converged() ? Exit::solved : Exit::not_converged;
}

}  // namespace signorini
