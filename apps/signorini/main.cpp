#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>

#include "apps/signorini/command_line.hpp"
#include "apps/signorini/interrupt.hpp"
#include "apps/signorini/text.hpp"
#include "core/base/error.hpp"
#include "core/base/heap.hpp"
#include "core/component/crash.hpp"

namespace signorini {
namespace {

int report_error(const std::string& message, Exit status) {
  std::fprintf(stderr, "signorini: error: %s\n", message.c_str());
  return static_cast<int>(status);
}

/// The status of a run that came to its end, unless what it printed did not reach its reader.
int flushed(int status) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
  return report_error("standard output: cannot be written: is the disk full?", Exit::input);
}

/// What is wrong with the first argument, if it is no option and no command; after a command that others are below,
/// with the second one.
std::string unknown_command(const CLI::App& app, int argc, char** argv, int at = 1) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  if (argc <= at || argv[at][0] == '-' || commands.empty()) return {};
  std::vector<std::string> names;
  for (const CLI::App* command : commands) {
    if (command->get_name() == argv[at]) return unknown_command(*command, argc, argv, at + 1);
    names.push_back(command->get_name());
  }
  return fmt::format("there is no command '{}{}'{}; see '{} --help'", at > 1 ? app.get_name() + " " : "", argv[at],
                     did_you_mean(argv[at], names), full_name(app));
}

/// The command that was given, or the program.
const CLI::App& innermost(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : innermost(*commands.front());
}

/// What is wrong with options that nobody knows, if that is wrong with the arguments.
std::string unknown_option(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : innermost(app).get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const std::string& found : app.remaining(true)) {
    const std::string option = found.substr(0, found.find('='));
    if (option.starts_with('-')) return fmt::format("there is no option '{}'{}", option, did_you_mean(option, names));
  }
  return {};
}

/// --help, --version
int print_asked(const CLI::App& app, const CLI::ParseError& asked) {
  if (dynamic_cast<const CLI::CallForHelp*>(&asked)) {
    print_fitted(help_of(innermost(app)));
    return 0;
  }
  return app.exit(asked);
}

int run(int argc, char** argv) {
  Arguments arguments;
  const auto app = command_line(arguments);
  if (const std::string wrong = unknown_command(*app, argc, argv); !wrong.empty())
    return report_error(wrong, Exit::usage);
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return print_asked(*app, error);
    const std::string unknown = unknown_option(*app);
    return report_error((unknown.empty() ? error.what() : unknown) + "; see 'signorini --help'", Exit::usage);
  }
  if (app->got_subcommand("solve")) solve_command(arguments.solve);
  if (app->got_subcommand("check")) check_command(arguments.solve.scene, arguments.solve.overrides);
  if (app->got_subcommand("chart")) chart_command(arguments.chart);
  if (app->got_subcommand("qp")) qp_command(arguments.qp);
  if (app->got_subcommand("list")) list_command(arguments.list_kinds);
  if (const CLI::App& given = innermost(*app); full_name(given) == "signorini plugin check")
    plugin_check_command(arguments.plugin_check);
  else if (full_name(given) == "signorini plugin new")
    plugin_new_command(arguments.plugin_new);
  if (app->got_subcommand("help")) help_command(*app, arguments.help);
  if (app->got_subcommand("words")) words_command(*app, arguments.words_after);
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
