#pragma once
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "apps/signorini/commands.hpp"

namespace signorini {

/// What the program was started with, by command.
struct Arguments {
  SolveArguments solve;
  QpArguments qp;
  HelpArguments help;
  std::string list_kinds, words_after;
};

/// All commands with their options and what --help says of them.
/// @param arguments is filled when they are parsed, and outlives the result
std::unique_ptr<CLI::App> command_line(Arguments& arguments);

/// What --help prints, of the program or one of its commands.
std::string help_of(const CLI::App& command);

/// The manual page, for man.
std::string manual_page(const CLI::App& program);

/// `signorini help`.
void help_command(const CLI::App& program, const HelpArguments& arguments);

/// What may follow a command in a command line, or "set" what follows --set, one a line; of "" the commands.
void words_command(const CLI::App& program, const std::string& after);

}  // namespace signorini
