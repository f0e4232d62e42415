#include <fmt/format.h>
#include <fmt/ranges.h>

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
        vtu_(files, scene.output.vtu, scene.steps.count) {}

  void run() {
    prepare();
    NestedSolver<D, B> solver(hierarchy_, scene_.solver, registry_, progress_, report_.time);
    for (int step = 1; step <= scene_.steps.count; ++step) {
      const double t = static_cast<double>(step) / scene_.steps.count;
      at_step(scene_, t, [&] { solve_step(solver, step, t); });
    }
    finish();
  }

 private:
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

  void solve_step(NestedSolver<D, B>& solver, int step, double t) {
    if (scene_.steps.count > 1) progress_.phase(fmt::format("step {} of {}", step, scene_.steps.count));
    const Model<B> model = build_model<B>(scene_, D, registry_, t);
    if (step == 1)
      for (auto& warning : fix_warnings(scene_, hierarchy_.finest(), model))
        report_.warnings.push_back(std::move(warning));
    if (step == 1)
      for (auto& warning : start_warnings(hierarchy_.levels.front(), model))
        report_.warnings.push_back(std::move(warning));
    add_results(model, solve_model(solver, step, model));
  }

  /// Where there is no solution, perhaps the body was meant to be on the other side.
  Solution<B> solve_model(NestedSolver<D, B>& solver, int step, const Model<B>& model) {
    try {
      return step == 1 ? solver.solve(model) : solver.solve_from(model, results_.u);
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
    vtu_.add(mesh, scene_.output.vtu ? point_fields(mesh, results_) : std::vector<VtuField>(), model.t);
    report_.time.output += watch.elapsed();
  }

  void finish() {
    stop_if_interrupted();
    Stopwatch watch;
    progress_.phase("writing");
    for (auto& warning : contact_warnings(scene_, report_)) report_.warnings.push_back(std::move(warning));
    for (auto& warning : chord_warnings<D, B>(scene_, hierarchy_, results_))
      report_.warnings.push_back(std::move(warning));
    vtu_.finish();
    write_charts(files_, scene_.output, hierarchy_, results_, report_);
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
  AtomicFiles files(arguments.out.empty() ? std::filesystem::path(scene.name) : arguments.out);
  dispatch(scene, [&]<int D, int B>() { SolveRun<D, B>(scene, registry, progress, files, report).run(); });
  report.time.total = watch.elapsed();
  report.peak_memory_mb = peak_memory_mb();
  write_text(files.stage("report.json"), to_json(report).dump(2) + '\n');
  stop_if_interrupted();
  const auto written = files.commit(is_result_file);
  if (!arguments.quiet) {
    print_of_written([&] { print_result(report, written); });
    print_warnings(report.warnings);
  }
  return report.converged() ? Exit::solved : Exit::not_converged;
}

}  // namespace signorini
