#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/signorini/commands.hpp"

namespace signorini {

/// What the program was started with, by command.
struct Arguments {
  SolveArguments solve;
  ChartArguments chart;
  QpArguments qp;
  PluginCheckArguments plugin_check;
  PluginNewArguments plugin_new;
  HelpArguments help;
  std::string list_kinds, words_after;
};

/// All commands with their options and what --help says of them.
/// @param arguments is filled when they are parsed, and outlives the result
std::unique_ptr<CLI::App> command_line(Arguments& arguments);

/// What --help prints, of the program or one of its commands.
std::string help_of(const CLI::App& command);

/// The command of a name, as "plugin check"; null: there is none.
const CLI::App* find_command(const CLI::App& program, std::string_view name);

/// The commands below one that are shown, each before those below it; without those that others are below.
std::vector<const CLI::App*> shown_commands(const CLI::App& program);

/// As it is called: "signorini plugin check".
std::string full_name(const CLI::App& command);

/// The manual page, for man.
std::string manual_page(const CLI::App& program);

/// `signorini help`.
void help_command(const CLI::App& program, const HelpArguments& arguments);

/// What may follow a command in a command line, or "set" what follows --set, one a line; of "" the commands.
void words_command(const CLI::App& program, const std::string& after);

}  // namespace signorini
