#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "apps/signorini/chart/search.hpp"
#include "apps/signorini/commands.hpp"
#include "apps/signorini/console.hpp"
#include "apps/signorini/output.hpp"
#include "apps/signorini/text.hpp"
#include "core/base/error.hpp"
#include "core/base/heap.hpp"
#include "core/base/stopwatch.hpp"
#include "core/io/output_place.hpp"
#include "driver/driver.hpp"
#include "driver/reports/error_estimate.hpp"
#include "driver/reports/goals.hpp"
#include "driver/scene/numbers.hpp"
#include "driver/scene/touching_bodies.hpp"

namespace signorini {
namespace {

/// At the vertices of a body.
struct Fields {
  std::vector<Stress> stress;
  ContactFields contact;
};

/// The files of one run of `signorini solve`, staged as the driver goes on.
class ResultFiles {
 public:
  /// Keeps references to both.
  ResultFiles(Driver& driver, AtomicFiles& files)
      : driver_(driver), files_(files), vtu_(files, with_touching_bodies(scene()).bodies.size()) {}

  /// After a step or a part of one. The last one, after which none follows, is written in finish().
  void add_step() {
    if (driver_.report().last().t == scene().steps.at.back()) return;
    const Stopwatch watch;
    read_fields();
    write_solution();
    driver_.report().time.output += watch.elapsed();
  }

  void finish() {
    const Stopwatch watch;
    driver_.forget_matrices();
    give_freed_memory_back();
    Report& report = driver_.report();
    const bool unwritten = vtu_.steps() < report.steps.size();
    if (scene().output.pictures || unwritten) read_fields();
    if (scene().output.convergence) write_tables(files_, report);
    if (unwritten) write_solution();
    vtu_.finish();
    // Last, so that on a full disk they are what is missing.
    if (scene().output.pictures) draw();
    report.time.output += watch.elapsed();
  }

  /// Where the disk has no place for the report beside the pictures these are given up.
  void write_report() {
    const std::filesystem::path file = files_.stage("report.json");
    const auto write = [&] { write_text(file, to_json(driver_.report()).dump(2) + '\n'); };
    try {
      write();
    } catch (const Error& error) {
      if (!give_pictures_up(files_, driver_.report(), error.what())) throw;
      write();
    }
  }

 private:
  const Scene& scene() const { return driver_.scene(); }

  void read_fields() {
    if (!scene().output.vtu && !scene().output.pictures) return;
    fields_.clear();
    for (std::size_t body = 0; body < driver_.bodies(); ++body)
      fields_.push_back(driver_.visit(body, [](const auto& run) {
        return Fields{run.stress(), contact_fields(run.nodes(), run.results())};
      }));
  }

  void draw() {
    draw_convergence(files_, driver_.report());
    draw_steps(files_, driver_.report());
    for (std::size_t body = 0; body < driver_.bodies(); ++body)
      driver_.visit(body, [&](const auto& run) {
        draw_result(files_, run.hierarchy(), run.nodes(), run.results(), fields_[body].stress, fields_[body].contact,
                    numbers_of(scene().obstacles, run.body()), body_suffix(body, driver_.bodies()), driver_.report());
      });
  }

  /// Takes away the fields of contact, but for pictures.
  void write_solution() {
    if (!scene().output.vtu) return;
    for (std::size_t body = 0; body < driver_.bodies(); ++body)
      driver_.visit(body, [&]<int D, int B>(const BodyRun<D, B>& run) {
        // Problems with few unknowns per vertex are solved in the time that it takes to pack all of their meshes.
        constexpr double worthwhile = B == 3 ? 0.6 : 0.25;
        ContactFields& contact = fields_[body].contact;
        vtu_.add(run.nodes(),
                 point_fields(run.nodes(), run.results(), fields_[body].stress,
                              scene().output.pictures ? contact : std::move(contact)),
                 cell_fields(run.estimate_of_element()), driver_.report(), body, {worthwhile, scene().solver.threads});
      });
  }

  Driver& driver_;
  AtomicFiles& files_;
  SolutionFiles vtu_;
  std::vector<Fields> fields_;  // of the last step, per body
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

void print_contact(const ContactReport& contact) {
  if (contact.tied) {
    fmt::print("obstacle {}: {} nodes tied, area {:.6g}, force ({:.6g})\n", contact.obstacle, contact.nodes,
               contact.area, fmt::join(contact.force, ", "));
    fmt::print("  force on {}; the slave is {} ({})\n", contact.body, contact.pair->slave, contact.pair->reason);
    if (const auto& bolt = contact.bolt)
      fmt::print("  bolt: force {:.6g}, shortening {:.6g}{}\n", bolt->force, bolt->shortening,
                 bolt->locked ? ", locked" : "");
    return;
  }
  fmt::print("obstacle {}: {} nodes in contact, area {:.6g}, force ({:.6g}), largest pressure {:.6g}\n",
             contact.obstacle, contact.nodes, contact.area, fmt::join(contact.force, ", "), contact.max_pressure);
  if (const auto& pair = contact.pair)
    fmt::print("  force on {}; the slave is {} ({})\n", contact.body, pair->slave, pair->reason);
  if (contact.slip_nodes + contact.stick_nodes == 0 && !(contact.dissipated > 0)) return;
  fmt::print("  friction: {} nodes slip, {} stick; tangential force ({:.6g}), dissipated {:.6g}\n", contact.slip_nodes,
             contact.stick_nodes, fmt::join(contact.tangential_force, ", "), contact.dissipated);
}

/// Which step is shown, where there are several.
void print_steps(const Report& report) {
  if (!report.has_steps()) return;
  int iterations = 0;
  for (const StepReport& step : report.steps) iterations += step.summary.iterations;
  const StepReport& last = report.last();
  fmt::print("step {} of {}, to t = {}, the last of {} solves with {} iterations{}\n", last.step, report.planned_steps,
             last.t, report.steps.size(), iterations,
             report.failed.empty() ? "" : fmt::format("; {} more failed and were cut in two", report.failed.size()));
}

/// Of a run that refines for the energy.
void print_errors(const AdaptiveReport& meshes) {
  const auto bounds = [](const AdaptiveStep& mesh) { return std::isfinite(mesh.error.upper); };
  const bool some = std::ranges::any_of(meshes.steps, bounds);
  fmt::print("{:>4} {:>10} {:>10} {:>15} {:>15} {:>9}\n", "mesh", "unknowns", "iterations",
             some ? "error at least" : "", some ? "at most" : "error estimated", "seconds");
  for (int number = 1; const AdaptiveStep& mesh : meshes.steps)
    fmt::print("{:>4} {:>10} {:>10} {:>15} {:>13.3g} % {:>9.2f}\n", number++, mesh.unknowns, mesh.iterations,
               bounds(mesh) ? fmt::format("{:.3g} %", 100 * mesh.error.relative_lower())
               : some       ? "about"
                            : "",
               100 * mesh.error.relative_estimated(), mesh.seconds);
}

/// Of one that does so for another goal.
void print_goals(const AdaptiveReport& meshes) {
  fmt::print("{:>4} {:>10} {:>10} {:>15} {:>15} {:>9}\n", "mesh", "unknowns", "iterations",
             meshes.steps.front().error.goal->name, "error estimated", "seconds");
  for (int number = 1; const AdaptiveStep& mesh : meshes.steps)
    fmt::print("{:>4} {:>10} {:>10} {:>15.6g} {:>13.3g} % {:>9.2f}\n", number++, mesh.unknowns, mesh.iterations,
               mesh.error.goal->value, 100 * mesh.error.goal->relative_error(), mesh.seconds);
}

/// The meshes of a run that refines where its error is.
void print_meshes(const Report& report) {
  if (!report.adaptive) return;
  if (report.adaptive->steps.front().error.goal)
    print_goals(*report.adaptive);
  else
    print_errors(*report.adaptive);
  fmt::print("refined {} times: {}\n", report.adaptive->steps.size() - 1, report.adaptive->reason);
}

void print_result(const Console& console, const Report& report, const std::vector<std::filesystem::path>& written) {
  const StepReport& last = report.last();
  console.print_title();
  print_meshes(report);
  print_steps(report);
  print_summary(console, last.summary, report.converged(), report.reason());
  for (const BodyReport& body : last.bodies)
    fmt::print("elements{}: {}\n", last.bodies.size() > 1 ? fmt::format(" of {}", body.name) : "",
               elements_text(body.order, body.order_chosen));
  for (const ContactReport& contact : last.contact) print_contact(contact);
  for (const RigidReport& rigid : last.rigid)
    fmt::print("rigid {}: displacement ({:.6g}), rotation ({:.6g}), force ({:.6g}), torque ({:.6g})\n", rigid.number,
               fmt::join(rigid.displacement, ", "), fmt::join(rigid.rotation, ", "), fmt::join(rigid.force, ", "),
               fmt::join(rigid.torque, ", "));
  if (last.estimate) fmt::print("{}\n", error_text(*last.estimate));
  if (last.estimate && last.estimate->goal) fmt::print("{}\n", error_text(*last.estimate->goal));
  for (const ProbeReport& probe : last.probes) fmt::print("{}: ({:.9g})\n", probe.name, fmt::join(probe.value, ", "));
  const Times& time = report.time;
  fmt::print(
      "seconds: mesh {:.2f}, assemble {:.2f}, setup {:.2f}, solve {:.2f}, output {:.2f}, total {:.2f}; {:.0f} MB\n",
      time.mesh, time.assemble, time.setup, time.solve, time.output, time.total, report.peak_memory_mb);
  for (const auto& file : written) fmt::print("wrote {}\n", file.string());
}
/// "2 of 4 steps were finished and are written"
std::string what_is_written(const Scene& scene, const Report& report) {
  if (!report.has_steps()) return "the last iterate is written, marked \"converged\": false";
  const StepReport& last = report.last();
  const bool within = last.t < scene.steps.at[last.step - 1];
  return fmt::format("{} of {} steps were finished and are written{}", last.step - within, report.planned_steps,
                     within ? ", and a part of the next" : "");
}

/// Of the steps that are finished.
class StepsTable {
 public:
  explicit StepsTable(const Console& console) : console_(console) {}

  void add(const Report& report) {
    if (!report.has_steps()) return;
    if (!std::exchange(begun_, true))
      console_.print_row(fmt::format("{:>9} {:>10} {:>10} {:>11} {:>8} {:>9}", "step", "t", "iterations", "residual",
                                     "contact", "seconds"));
    const StepReport& step = report.last();
    Index nodes = 0;
    for (const ContactReport& contact : step.contact) nodes += contact.nodes;
    console_.print_row(fmt::format("{:>4} of {:<2} {:>10.6g} {:>10} {:>11.3e} {:>8} {:>9.1f}", step.step,
                                   report.planned_steps, step.t, step.summary.iterations, step.summary.residual, nodes,
                                   lap_.lap()));
  }

 private:
  const Console& console_;
  Stopwatch lap_;
  bool begun_ = false;
};

/// The error that ended the steps after the first of them, or a single one at an iterate, if any.
std::optional<Error> solve_steps(Driver& driver, StepsTable table, ResultFiles& results) {
  const Report& report = driver.report();
  try {
    driver.solve([&] {
      table.add(report);
      results.add_step();
    });
  } catch (const Error& error) {
    if (report.error.empty() && !report.interrupted) throw;
    if (!report.interrupted) return error;
  }
  if (!report.interrupted) return {};
  const Summary& last = report.last().summary;
  return Error(Exit::interrupted, last.outcome == Outcome::interrupted ? last.reason : "interrupted");
}

/// Bodies that are solved one after the other, or in turns, and adaptive meshes have one table in the end.
Live live(const Scene& scene) {
  if (scene.refine.adaptive) return Live::nothing;
  const bool one = with_touching_bodies(scene).bodies.size() == 1 && scene.solver.bodies != "dirichlet-neumann";
  return one || scene.steps.count() > 1 ? Live::tables : Live::nothing;
}
/// The report of an earlier run in the folder is set aside, so that where this one ends without a report nobody takes
/// that for its own. What is no regular file, or may not be written, is refused later.
void set_aside(const std::filesystem::path& folder, const std::filesystem::path& scene) {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path report = folder / "report.json";
  if (!fs::is_regular_file(fs::symlink_status(report, none)) || is_read_only(report) || is_read_only(folder) ||
      fs::equivalent(report, scene, none))
    return;
  fs::rename(report, folder / old_report, none);
}

/// Those that are given, and those that an accuracy asks for.
std::vector<std::string> overrides_of(const SolveArguments& arguments) {
  std::vector<std::string> out = arguments.overrides;
  if (!arguments.accuracy) return out;
  const Stopwatch watch;
  const Console progress(arguments.quiet);
  const chart::Found found = chart::search(arguments.scene, arguments.overrides, arguments.of, *arguments.accuracy,
                                           [&](const std::string& what) { progress.phase(what); });
  progress.end();
  out.insert(out.end(), found.keys.begin(), found.keys.end());
  if (!arguments.quiet)
    say("accuracy: error of {} about {:.1e} with {}; found in {:.2g} s\n", arguments.of, found.error,
        fmt::join(found.keys, " "), watch.elapsed());
  return out;
}

}  // namespace

void solve_command(const SolveArguments& arguments) {
  Stopwatch watch;
  const std::filesystem::path folder = arguments.out.empty() ? arguments.scene.stem() : arguments.out;
  set_aside(folder, arguments.scene);
  const Scene scene = read_scene(arguments.scene, overrides_of(arguments));
  const Console progress(arguments.quiet, live(scene), scene.title);
  Driver driver(scene, progress);
  AtomicFiles files(folder, is_result_file, inputs(scene));
  ResultFiles results(driver, files);
  const std::optional<Error> ended = solve_steps(driver, StepsTable(progress), results);
  progress.phase("writing");
  results.finish();
  Report& report = driver.report();
  report.time.total = watch.elapsed();
  report.peak_memory_mb = peak_memory_mb();
  results.write_report();
  const auto written = files.commit();
  progress.end();
  if (ended) throw Error(ended->status(), fmt::format("{}; {}", ended->what(), what_is_written(scene, report)));
  if (!arguments.quiet) {
    print_of_written([&] { print_result(progress, report, written); });
    print_warnings(report.warnings);
  }
  fail_unless_solved(report.converged(), report.reason());
}

}  // namespace signorini
