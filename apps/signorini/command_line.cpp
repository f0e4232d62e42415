#include "apps/signorini/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/version.hpp"
#include "core/input/range.hpp"
#include "core/scene/solver_keys.hpp"
#include "core/solver/option_table.hpp"

namespace signorini {
namespace {

// A line for each item: they are broken where they are shown.
constexpr const char* exit_status =
    "Exit status:\n"
    "  0    solved to the tolerance, or as far as rounding allows, which the results then say\n"
    "  1    wrong usage\n"
    "  2    bad input (file, scene, matrix), or too little memory; nothing is written but the message, see below\n"
    "  3    the iteration limit was reached, friction does not come to rest, or rounding leaves an error above 1e-2; "
    "results are written, marked \"converged\": false\n"
    "  4    no solution exists (infeasible bounds, unbounded energy)\n"
    "  5    a plugin could not be loaded, or failed\n"
    "  130  interrupted (Ctrl-C), see below\n"
    "Where the steps of a scene end with 2, 4, 5 or 130 those that were finished are written, marked \"converged\": "
    "false, with the reason. So is the last iterate where a single solve is interrupted on the finest mesh; before "
    "that "
    "nothing is written. A second Ctrl-C ends the program at once.";

constexpr const char* solve_notes =
    "Progress goes to standard error, in a line that is rewritten on a terminal and elsewhere a line every ten "
    "seconds; "
    "the convergence table, with several steps a table of these, goes to standard output as it is made.\n\n";

constexpr const char* check_exit_status =
    "Exit status:\n"
    "  0    nothing wrong was found\n"
    "  1    wrong usage\n"
    "  2    bad input (file, scene)\n"
    "  4    no solution exists (infeasible bounds)\n"
    "  5    a plugin could not be loaded, or failed\n"
    "  130  interrupted (Ctrl-C)";

constexpr const char* qp_notes =
    "Files are Matrix Market files: coordinate or array, real or integer, general or symmetric, packed by gzip or not. "
    "A file that says 'symmetric' in its first line holds the lower triangle of its matrix alone, and stands for the "
    "whole; one that says 'general' holds all of it, unless --one-triangle says otherwise. Of a vector in coordinates "
    "what is left out is zero. inf and -inf in bounds mean none. Output files are replaced when all are complete, "
    "links "
    "followed; devices and pipes are written through. What is read-only or an input is refused. Where an output goes "
    "to "
    "standard output, the summary goes to standard error.\n\n"
    "Exit status:\n"
    "  0    solved to the tolerance, or as far as rounding allows, which the summary then says\n"
    "  1    wrong usage\n"
    "  2    bad input (file, matrix), or too little memory; nothing is written but the message\n"
    "  3    the iteration limit was reached, or rounding leaves an error above 1e-2; results are written, marked "
    "\"converged\": false\n"
    "  4    no solution exists (infeasible bounds, unbounded energy)\n"
    "  130  interrupted (Ctrl-C); what is written is the last iterate, marked \"converged\": false";

constexpr const char* list_exit_status =
    "Exit status:\n"
    "  0    listed, with the plugins that were rejected\n"
    "  1    wrong usage\n"
    "  2    standard output cannot be written\n"
    "  5    SIGNORINI_PLUGIN_PATH is wrong, or a plugin ended the program";

/// Complains about other values and names the nearest one.
auto one_of(std::vector<std::string> names) {
  return [names = std::move(names)](const std::string& found) {
    if (std::find(names.begin(), names.end(), found) != names.end()) return std::string();
    return fmt::format("found '{}', expected one of {}{}", found, fmt::join(names, " | "), did_you_mean(found, names));
  };
}

/// An option with the range and the default of a key of [solver].
void as_in_table(CLI::Option& option, const char* key) {
  const KeySpec& spec = *find_key(solver_keys(), key);
  const Range range(spec.range);
  option.default_str(spec.fallback);
  if (!range.choices().empty())
    option.check(one_of(range.choices()));
  else
    option.check([range](const std::string& found) {
      const bool within = range.contains(std::strtod(found.c_str(), nullptr));
      return within ? "" : fmt::format("found '{}', expected {}", found, range.expected("a number"));
    });
}

/// The keys of [solver] that need no mesh, with range and default, one per line.
std::string solver_options_text() {
  std::string text = "\n\nOptions for --set, with range and default; `signorini list solver` explains them:";
  for (const auto& row : option_table()) {
    const KeySpec& key = *find_key(solver_keys(), row.name);
    text +=
        fmt::format("\n  solver.{:<15} {} ({})", key.name, *key.range ? key.range : type_name(key.type), key.fallback);
  }
  return text;
}

std::string is_folder_name(const std::string& found) { return found.empty() ? "expected the name of a folder" : ""; }

template <class OfCommand>
void add_scene(CLI::App& command, OfCommand& arguments) {
  command.add_option("SCENE", arguments.scene, "the scene, a TOML file")->required();
  command
      .add_option("--set", arguments.overrides,
                  "override a key of the scene by its dotted path, such as solver.tolerance=1e-6, "
                  "obstacle.0.point=[0,0,-1] or refine.uniform=3; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

CLI::Option* add_of(CLI::App& command, std::string& of) {
  return command.add_option("--of", of, "the error of what: energy, force, pressure, area or 'probe NAME'")
      ->type_name("WHAT")
      ->default_str(of);
}

void add_solve(CLI::App& app, Arguments& arguments) {
  auto* command = app.add_subcommand("solve", "read a scene, solve it and write the results");
  add_scene(*command, arguments.solve);
  command
      ->add_option("--out", arguments.solve.out,
                   "folder for report.json, solution.vtu, tables and pictures, in place of an earlier run's; "
                   "default: the scene's name in the current folder")
      ->type_name("DIR")
      ->check(is_folder_name);
  command
      ->add_option("--accuracy", arguments.solve.accuracy,
                   "choose elements and mesh such that the relative error is at most that, by solving on coarser ones "
                   "before")
      ->type_name("ERROR")
      ->check(CLI::PositiveNumber);
  add_of(*command, arguments.solve.of)->needs("--accuracy");
  command->add_flag("--quiet", arguments.solve.quiet, "print nothing but errors");
  command->footer(std::string(solve_notes) + exit_status);
}

void add_check(CLI::App& app, Arguments& arguments) {
  auto* command = app.add_subcommand(
      "check", "validate a scene and say what would be solved, with which plugins and how many unknowns");
  add_scene(*command, arguments.solve);
  command->footer(check_exit_status);
}

constexpr const char* chart_notes =
    "Settings are linear and quadratic elements on meshes that are refined uniformly, linear elements on meshes that "
    "are "
    "refined where the error is, and quadratic ones with a tolerance of 1e-4. Each is solved on finer and finer "
    "meshes, "
    "a process per run. What could not be had is listed with its reason. Without --exact runs are compared with the "
    "last one of quadratic elements; how far that may be off itself is said, and runs as near to it have no error.\n\n"
    "Files: chart.csv, chart.png, chart.svg, and chart.html, one page with picture, table and solution that needs no "
    "network.\n\n"
    "Exit status:\n"
    "  0    drawn\n"
    "  1    wrong usage\n"
    "  2    bad input, or too few runs were ready in time\n"
    "  3    no setting has the --accuracy\n"
    "  130  interrupted (Ctrl-C)";

void add_chart(CLI::App& app, Arguments& arguments) {
  ChartArguments& chart = arguments.chart;
  auto* command = app.add_subcommand("chart", "solve a scene in many ways, and draw error against time");
  add_scene(*command, chart);
  add_of(*command, chart.of);
  command->add_option("--against", chart.against, "what it costs")
      ->type_name("COST")
      ->default_str(chart.against)
      ->check(one_of({"seconds", "unknowns", "memory", "iterations"}));
  command->add_option("--exact", chart.exact, "what it is, a number or several with commas; default: not known")
      ->type_name("VALUE")
      ->delimiter(',');
  command->add_option("--seconds", chart.budget, "that a run may take")
      ->type_name("S")
      ->default_str(fmt::format("{:g}", chart.budget))
      ->check(CLI::PositiveNumber);
  command->add_option("--accuracy", chart.accuracy, "say which keys have at most this relative error at the least cost")
      ->type_name("ERROR")
      ->check(CLI::PositiveNumber);
  command->add_option("--out", chart.out, "folder for the files; default: the scene's name in the current folder")
      ->type_name("DIR")
      ->check(is_folder_name);
  command->add_flag("--quiet", chart.quiet, "show no progress");
  command->footer(chart_notes);
}

void add_qp(CLI::App& app, Arguments& arguments) {
  QpArguments& qp = arguments.qp;
  auto* command = app.add_subcommand("qp", "minimise 1/2 x'Ax - b'x over l <= x <= u, purely algebraically");
  command->add_option("MATRIX", qp.matrix, "A, symmetric and positive (semi)definite")->required();
  command->add_option("LOAD", qp.load, "b")->required();
  const auto file = [&](const char* name, std::filesystem::path& path, const char* help) {
    command->add_option(name, path, help)->type_name("FILE")->check([](const std::string& found) {
      return found.empty() ? "expected the name of a file" : "";
    });
  };
  file("--lower", qp.lower, "lower bounds l");
  file("--upper", qp.upper, "upper bounds u");
  file("--start", qp.start, "where to start; default: from coarser levels");
  file("--near-null", qp.near_null, "directions of little energy, one per column");
  file("--coordinates", qp.coordinates, "positions of elastic vectors, one row each, in place of --near-null");
  file("--out", qp.out, "file for the solution, '-' for standard output; default: print a summary only");
  file("--report", qp.report, "JSON file for what the solver did, '-' for standard output");
  command->add_flag("--one-triangle", qp.one_triangle,
                    "A is stored by its lower or its upper triangle alone, although its file says 'general'");
  command->add_option("--block", qp.block, "consecutive unknowns that belong together, as those of a mesh vertex")
      ->check(CLI::IsMember({1, 2, 3}))
      ->default_str("what the matrix looks like");
  as_in_table(
      *command->add_option("--tol", qp.tolerance, "bound for the residual and the algebraic error, both relative"),
      "tolerance");
  as_in_table(*command->add_option("--method", qp.method, "see docs/solver.md"), "method");
  command
      ->add_option("--set", qp.settings,
                   "further options of the solver, such as solver.reassemble=false; may be repeated; listed below")
      ->type_name("solver.KEY=VALUE")
      ->allow_extra_args(false);
  command->footer(std::string(solve_notes) + qp_notes + solver_options_text());
}

void add_list(CLI::App& app, Arguments& arguments) {
  auto* command = app.add_subcommand(
      "list", "show the solver's options, and registered components with theirs and the files they come from");
  command->add_option("KIND", arguments.list_kinds, "one kind of component only; default: all")
      ->check(one_of(listable_kinds()));
  command->footer(list_exit_status);
}

constexpr const char* plugin_exit_status =
    "Exit status:\n"
    "  0    every check passed\n"
    "  1    wrong usage\n"
    "  2    bad input: no such file, or options that the plugin refuses or lacks\n"
    "  5    a check failed, or the plugin could not be loaded\n"
    "  130  interrupted (Ctrl-C)";

constexpr const char* plugin_check_notes =
    "It knows nothing but the compiled library, and asks it at random places, in copies of the process with a limited "
    "time: what hangs or crashes is told as what is wrong. A failed check says what was expected, what was found, the "
    "simplest example of it, and the page of the documentation to read. Options that the plugin needs get values "
    "within their ranges where they are not set.\n\n";

constexpr const char* plugin_new_notes =
    "Kinds:\n"
    "  box              bounds along directions\n"
    "  functional       a scalar energy with a kink\n"
    "  friction         contact with a rigid shape, and a law of friction\n"
    "  between-bodies   contact of two elastic bodies\n"
    "The folder must not be there yet. Its README.md has the two commands that build and check what is in it.\n\n"
    "Exit status:\n"
    "  0    written\n"
    "  1    wrong usage, such as a name that is none\n"
    "  2    the folder cannot be written, or is there already";

void add_plugin_check(CLI::App& plugin, Arguments& arguments) {
  PluginCheckArguments& check = arguments.plugin_check;
  auto* command = plugin.add_subcommand("check", "ask a compiled plugin for what every plugin has to do");
  command->add_option("FILE", check.file, "the library, libsignorini_obstacle_ID.so")->required();
  command
      ->add_option("--set", check.settings,
                   "an option of the plugin or a key of [[obstacle]], such as friction=0.3 or shape=sphere; may be "
                   "repeated")
      ->type_name("OPTION=VALUE")
      ->allow_extra_args(false)
      ->check(
          [](const std::string& found) { return found.find('=') == std::string::npos ? "expected OPTION=VALUE" : ""; });
  command->add_flag("--no-solves", check.no_solves, "solve no scenes with it, which takes most of the time");
  command->add_flag("--json", check.json, "print the checks as JSON");
  command->footer(std::string(plugin_check_notes) + plugin_exit_status);
}

void add_plugin_new(CLI::App& plugin, Arguments& arguments) {
  PluginNewArguments& create = arguments.plugin_new;
  auto* command = plugin.add_subcommand("new", "write a plugin to begin with, its build, test, scene and README");
  command->add_option("NAME", create.name, "of the obstacle type: lower-case letters, digits and _")->required();
  command->add_option("DIR", create.folder, "folder to be made; default: NAME in the current folder");
  command->add_option("--kind", create.kind, "what it begins with, see below")
      ->type_name("KIND")
      ->default_str(create.kind)
      ->check(one_of(plugin_kinds()));
  command->footer(plugin_new_notes);
}

void add_plugin(CLI::App& app, Arguments& arguments) {
  auto* command = app.add_subcommand("plugin", "begin an obstacle plugin of your own, and check one");
  command->require_subcommand(1);
  command->footer(
      "`signorini plugin check --help` and `signorini plugin new --help` explain both; docs/plugins.md how "
      "plugins are written.");
  add_plugin_check(*command, arguments);
  add_plugin_new(*command, arguments);
}

void add_help(CLI::App& app, Arguments& arguments) {
  HelpArguments& help = arguments.help;
  auto* command = app.add_subcommand("help", "explain a command, a table of scenes or one of their keys");
  command->add_option("NAME", help.name, "such as solve, obstacle, solver.tolerance or radius; default: the commands");
  command->add_flag("--manual", help.manual, "the manual page")->group("");
}

/// For the completion of shells.
void add_words(CLI::App& app, Arguments& arguments) {
  app.add_subcommand("words", "what a command line may go on with")
      ->group("")
      ->add_option("AFTER", arguments.words_after);
}

}  // namespace

std::unique_ptr<CLI::App> command_line(Arguments& arguments) {
  auto app = std::make_unique<CLI::App>("Obstacle and contact problems by monotone multigrid.", "signorini");
  app->set_version_flag("--version", std::string("signorini ") + version);
  app->require_subcommand(1);
  app->footer(std::string("`signorini help NAME` explains a command or a key of scenes.\n\n") + exit_status);
  add_solve(*app, arguments);
  add_check(*app, arguments);
  add_chart(*app, arguments);
  add_qp(*app, arguments);
  add_list(*app, arguments);
  add_plugin(*app, arguments);
  add_help(*app, arguments);
  add_words(*app, arguments);
  return app;
}

std::string full_name(const CLI::App& command) {
  const CLI::App* above = command.get_parent();
  return above ? full_name(*above) + " " + command.get_name() : command.get_name();
}

std::string help_of(const CLI::App& command) {
  return command.get_formatter()->make_help(&command, full_name(command), CLI::AppFormatMode::Normal);
}

const CLI::App* find_command(const CLI::App& program, std::string_view name) {
  const std::size_t space = std::min(name.find(' '), name.size());
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    if (command->get_name() == name.substr(0, space))
      return space == name.size() ? command : find_command(*command, name.substr(space + 1));
  return nullptr;
}

std::vector<const CLI::App*> shown_commands(const CLI::App& program) {
  std::vector<const CLI::App*> out;
  for (const CLI::App* command :
       program.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); })) {
    const std::vector<const CLI::App*> below = shown_commands(*command);
    if (below.empty()) out.push_back(command);
    out.insert(out.end(), below.begin(), below.end());
  }
  return out;
}

}  // namespace signorini
