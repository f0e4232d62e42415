#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <system_error>
#include <utility>

#include "apps/signorini/commands.hpp"
#include "apps/signorini/interrupt.hpp"
#include "core/base/error.hpp"
#include "core/base/heap.hpp"
#include "core/base/version.hpp"
#include "core/component/crash.hpp"
#include "core/input/range.hpp"
#include "core/scene/solver_keys.hpp"
#include "core/solver/option_table.hpp"

namespace signorini {
namespace {

constexpr const char* exit_status = R"(Exit status:
  0    solved to the tolerance, or as far as rounding allows, which the results then say
  1    wrong usage
  2    bad input (file, scene, matrix), or too little memory; nothing is written but the message, see below
  3    the iteration limit was reached, friction does not come to rest, or rounding leaves an error above 1e-2;
       results are written, marked "converged": false
  4    no solution exists (infeasible bounds, unbounded energy)
  5    a plugin could not be loaded, or failed
  130  interrupted (Ctrl-C); nothing is written, see below
Where the steps of a scene end with 2, 4, 5 or 130 those that were finished are written, marked "converged": false,
with the reason)";

constexpr const char* solve_notes =
    "Progress goes to standard error, a line every ten seconds at least; the convergence table goes to standard "
    "output.\n\n";

constexpr const char* check_exit_status = R"(Exit status:
  0    nothing wrong was found
  1    wrong usage
  2    bad input (file, scene)
  4    no solution exists (infeasible bounds)
  5    a plugin could not be loaded, or failed
  130  interrupted (Ctrl-C))";

constexpr const char* qp_notes =
    R"(Files are Matrix Market files: coordinate or array, real or integer, general or symmetric, packed by gzip or not. A
file that says 'symmetric' in its first line holds the lower triangle of its matrix alone, and stands for the whole; one
that says 'general' holds all of it, unless --one-triangle says otherwise. Of a vector in coordinates what is left out is zero. inf and -inf in bounds mean none. Output files are replaced when all are
complete, links followed; devices and pipes are written through. What is read-only or an input is refused. Where an
output goes to standard output, the summary goes to standard error.

Exit status:
  0    solved to the tolerance, or as far as rounding allows, which the summary then says
  1    wrong usage
  2    bad input (file, matrix), or too little memory; nothing is written but the message
  3    the iteration limit was reached, or rounding leaves an error above 1e-2; results are written, marked
       "converged": false
  4    no solution exists (infeasible bounds, unbounded energy)
  130  interrupted (Ctrl-C); nothing is written)";

constexpr const char* list_exit_status = R"(Exit status:
  0    listed, with the plugins that were rejected
  1    wrong usage
  2    standard output cannot be written
  5    SIGNORINI_PLUGIN_PATH is wrong, or a plugin ended the program)";

struct Arguments {
  SolveArguments solve;
  QpArguments qp;
  std::string list_kinds;
};

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

void add_scene(CLI::App& command, Arguments& arguments) {
  command.add_option("SCENE", arguments.solve.scene, "the scene, a TOML file")->required();
  command
      .add_option("--set", arguments.solve.overrides,
                  "override a key of the scene by its dotted path, such as solver.tolerance=1e-6, "
                  "obstacle.0.point=[0,0,-1] or refine.uniform=3; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

CLI::App* add_solve(CLI::App& app, Arguments& arguments) {
  auto* command = app.add_subcommand("solve", "read a scene, solve it and write the results");
  add_scene(*command, arguments);
  command
      ->add_option("--out", arguments.solve.out,
                   "folder for report.json, solution.vtu, tables and pictures, in place of an earlier run's; "
                   "default: the scene's name in the current folder")
      ->type_name("DIR")
      ->check([](const std::string& folder) { return folder.empty() ? "expected the name of a folder" : ""; });
  command->add_flag("--quiet", arguments.solve.quiet, "print nothing but errors");
  command->footer(std::string(solve_notes) + exit_status);
  return command;
}

CLI::App* add_check(CLI::App& app, Arguments& arguments) {
  auto* command = app.add_subcommand(
      "check", "validate a scene and say what would be solved, with which plugins and how many unknowns");
  add_scene(*command, arguments);
  command->footer(check_exit_status);
  return command;
}

CLI::App* add_qp(CLI::App& app, Arguments& arguments) {
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
  return command;
}

CLI::App* add_list(CLI::App& app, Arguments& arguments) {
  auto* command = app.add_subcommand(
      "list", "show the solver's options, and registered components with theirs and the files they come from");
  command->add_option("KIND", arguments.list_kinds, "one kind of component only; default: all")
      ->check(one_of(listable_kinds()));
  command->footer(list_exit_status);
  return command;
}

int report_error(const std::string& message, Exit status) {
  std::fprintf(stderr, "signorini: error: %s\n", message.c_str());
  return static_cast<int>(status);
}

/// The status of a run that came to its end, unless what it printed did not reach its reader.
int flushed(int status) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
  return report_error("standard output: cannot be written: is the disk full?", Exit::input);
}

/// What is wrong with the first argument, if it is no option and no command.
std::string unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return {};
  return fmt::format("there is no command '{}'{}; see 'signorini --help'", argv[1], did_you_mean(argv[1], names));
}

/// What is wrong with options that nobody knows, if that is wrong with the arguments.
std::string unknown_option(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  std::vector<std::string> names;
  for (const CLI::Option* option : (commands.empty() ? &app : commands.front())->get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const std::string& found : app.remaining(true)) {
    const std::string option = found.substr(0, found.find('='));
    if (option.starts_with('-')) return fmt::format("there is no option '{}'{}", option, did_you_mean(option, names));
  }
  return {};
}

int run(int argc, char** argv) {
  CLI::App app("Obstacle and contact problems by monotone multigrid.", "signorini");
  Arguments arguments;
  app.set_version_flag("--version", std::string("signorini ") + version);
  app.require_subcommand(1);
  app.footer(exit_status);
  auto* solve = add_solve(app, arguments);
  auto* check = add_check(app, arguments);
  auto* qp = add_qp(app, arguments);
  auto* list = add_list(app, arguments);
  if (const std::string wrong = unknown_command(app, argc, argv); !wrong.empty())
    return report_error(wrong, Exit::usage);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    const std::string unknown = unknown_option(app);
    return report_error((unknown.empty() ? error.what() : unknown) + "; see 'signorini --help'", Exit::usage);
  }
  if (*solve) solve_command(arguments.solve);
  if (*check) check_command(arguments.solve.scene, arguments.solve.overrides);
  if (*qp) qp_command(arguments.qp);
  if (*list) list_command(arguments.list_kinds);
  return 0;
}

int guarded_run(int argc, char** argv) {
  catch_interrupts();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow any more is one on a full disk
  name_plugins_that_crash();
  keep_freed_memory();
  try {
    return flushed(run(argc, argv));
  } catch (const Error& error) {
    return report_error(error.what(), error.status());
  } catch (const std::bad_alloc&) {
    return report_error("there is not enough memory", Exit::input);
  } catch (const std::exception& error) {
    if (std::ferror(stdout)) return flushed(static_cast<int>(Exit::input));
    const auto* of_system = dynamic_cast<const std::system_error*>(&error);
    if (of_system && of_system->code() == std::errc::resource_unavailable_try_again)
      return report_error("there is not enough memory for another thread, or too many of them run", Exit::input);
    return report_error(std::string("internal: ") + error.what(), Exit::input);
  }
}
}  // namespace
}  // namespace signorini

int main(int argc, char** argv) { return signorini::guarded_run(argc, argv); }
