#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "apps/signorini/chart/page.hpp"
#include "apps/signorini/chart/search.hpp"
#include "apps/signorini/commands.hpp"
#include "apps/signorini/console.hpp"
#include "apps/signorini/output.hpp"
#include "apps/signorini/text.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/io/atomic_files.hpp"
#include "driver/driver.hpp"

namespace signorini {
namespace {

using namespace chart;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

constexpr double most_drawn = 100000;  // unknowns of the solution that a page shows

/// Of the runs that have an error the most accurate one that a page can show.
const Run* shown_run(const std::vector<Run>& all) {
  const Run* best = nullptr;
  for (const Run& run : all)
    if (run.unknowns <= most_drawn && run.error && (!best || *run.error < *best->error)) best = &run;
  return best;
}

/// The picture of the solution of a run, solved once more.
Panel solution_of(const ChartArguments& arguments, const Run& run) {
  std::vector<std::string> keys = arguments.overrides;
  keys.insert(keys.end(), run.keys.begin(), run.keys.end());
  const Console quiet(true);
  Driver driver(read_scene(arguments.scene, keys), quiet);
  driver.solve();
  return solution_panel(driver).value_or(Panel{});
}

void print_run(const std::vector<Setting>& settings, const Run& run) {
  fmt::print("{:<28} {:<22} {:>9.0f} {:>10.0f} {:>9.3g}  {:.9g}\n", settings[run.setting].name, run.keys.back(),
             run.unknowns, run.iterations, run.seconds, fmt::join(run.value, ", "));
  std::fflush(stdout);
}

void print_errors(const ChartArguments& arguments, const std::vector<Setting>& settings, const Runs& runs,
                  const Reference& with) {
  fmt::print("\nerror of {}, compared with {}\n", arguments.of, with.text);
  fmt::print("{:<28} {:<22} {:>9} {:>9} {:>11}\n", "setting", "key", "unknowns", "seconds", "error");
  for (const Run& run : runs.all)
    fmt::print("{:<28} {:<22} {:>9.0f} {:>9.3g} {:>11}\n", settings[run.setting].name, run.keys.back(), run.unknowns,
               run.seconds, run.error ? fmt::format("{:.3e}", *run.error) : "-");
  if (!runs.certificate.empty()) say("{}\n", runs.certificate);
  for (const auto& [what, why] : runs.omitted) say("left out: {}: {}\n", what, why);
}

/// The keys of the run that is accurate enough and costs least.
void print_cheapest(const ChartArguments& arguments, const std::vector<Setting>& settings,
                    const std::vector<Run>& all) {
  const Run* best = nullptr;
  for (const Run& run : all)
    if (run.error && *run.error <= *arguments.accuracy &&
        (!best || run.cost(arguments.against) < best->cost(arguments.against)))
      best = &run;
  if (!best)
    throw Error(Exit::not_converged, fmt::format("no setting came to an error of {:g} of the {} within {:g} s each; "
                                                 "expected more --seconds, or less accuracy",
                                                 *arguments.accuracy, arguments.of, arguments.budget));
  fmt::print("\ncheapest for an error of at most {:g}: {}, {:.3g} s, error {:.2e}\n", *arguments.accuracy,
             settings[best->setting].name, best->seconds, *best->error);
  fmt::print("signorini solve {}", arguments.scene.string());
  for (const auto* keys : {&arguments.overrides, &best->keys})
    for (const std::string& key : *keys) fmt::print(" --set {}", key);
  fmt::print("\n");
}

bool is_chart_file(const std::string& name) {
  return name == "chart.csv" || name == "chart.png" || name == "chart.svg" || name == "chart.html";
}

}  // namespace

void chart_command(const ChartArguments& arguments) {
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  check_quantity(scene, arguments.of);
  const std::vector<Setting> all = settings(scene);
  AtomicFiles files(arguments.out.empty() ? arguments.scene.stem() : arguments.out, is_chart_file,
                    std::array{arguments.scene});
  const Console progress(arguments.quiet);
  fmt::print("{:<28} {:<22} {:>9} {:>10} {:>9}  {}\n", "setting", "key", "unknowns", "iterations", "seconds",
             arguments.of);
  Runs runs = run_all(
      arguments, all, [&](const std::string& what) { progress.phase(what); },
      [&](const Run& run) { print_run(all, run); });
  for (const auto& [what, why] : runs.omitted)
    if (runs.all.empty()) say("left out: {}: {}\n", what, why);
  const Reference with = reference(arguments, all, runs.all);
  compare(arguments.of, with, runs.all);
  progress.phase("drawing");
  const std::vector<Panel> picture = panels(arguments, all, runs.all);
  const std::filesystem::path svg = files.stage("chart.svg");
  painter().panels(svg, picture);
  painter().panels(files.stage("chart.png"), picture);
  write_text(files.stage("chart.csv"), csv(arguments, all, runs.all));
  Page page{scene.title.empty() ? arguments.scene.stem().string() : scene.title, with.text, text_of(svg), {}};
  if (const Run* run = shown_run(runs.all)) page.solution = solution_of(arguments, *run);
  write_text(files.stage("chart.html"), html(page, arguments, all, runs));
  const auto written = files.commit();
  progress.end();
  print_errors(arguments, all, runs, with);
  for (const auto& file : written) fmt::print("wrote {}\n", file.string());
  if (arguments.accuracy) print_cheapest(arguments, all, runs.all);
}

}  // namespace signorini
