#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/signorini/command_line.hpp"
#include "core/base/version.hpp"

namespace signorini {
namespace {

/// As text of roff.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string item(std::string_view term, std::string_view text) {
  return fmt::format(".TP\n.B {}\n{}\n", escaped(term), escaped(text));
}

/// Paragraphs, and lines such as "  3    the iteration limit was reached".
std::string paragraphs(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t term = line.find_first_not_of(' ');
    if (term == std::string_view::npos) continue;
    const std::size_t gap = line.find("  ", term);
    out += term == 0 || gap == std::string_view::npos
               ? fmt::format(".PP\n{}\n", escaped(line.substr(term)))
               : item(line.substr(term, gap - term), line.substr(line.find_first_not_of(' ', gap)));
  }
  return out;
}

std::string term_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  if (option.get_positional()) names.push_back(option.get_single_name());
  const bool typed = !option.get_positional() && option.get_expected_max() > 0;
  return fmt::format("{}{}{}", fmt::join(names, ", "), typed ? " " : "", typed ? option.get_type_name() : "");
}

std::string options_of(const CLI::App& command) {
  std::string out;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    const std::string fallback = option->get_default_str();
    out += item(term_of(*option),
                option->get_description() + (fallback.empty() ? "" : fmt::format("; default: {}", fallback)));
  }
  return out;
}

std::string synopsis(const CLI::App& command) {
  std::string line = full_name(command) + " [options]";
  for (const CLI::Option* option : command.get_options())
    if (option->get_positional() && !option->get_group().empty())
      line += fmt::format(fmt::runtime(option->get_required() ? " {}" : " [{}]"), option->get_single_name());
  return line;
}

constexpr const char* files =
    "  DIR/report.json    all results; its keys are in docs/report.md, and in the schema report.schema.json of "
    "share/signorini\n"
    "  DIR/solution.vtu    the solution, for ParaView; of several steps solution.pvd lists the files\n"
    "  DIR/convergence.csv, DIR/phases.csv    the cycles of the solver\n"
    "  DIR/steps.csv    forces in each step, where there are several\n"
    "  DIR/result.png, DIR/convergence.png, DIR/steps.png    pictures\n";

constexpr const char* environment =
    "  SIGNORINI_PLUGIN_PATH    folders that are searched for plugins, separated by colons, before the installed one\n"
    "  COLUMNS    how wide text is printed; default: as the terminal, else 80\n";

constexpr const char* example =
    ".nf\n"
    "signorini check ball_on_plane.toml\n"
    "signorini solve ball_on_plane.toml \\-\\-set refine.uniform=3 \\-\\-out finer\n"
    "signorini help obstacle.friction\n"
    ".fi\n";

}  // namespace

std::string manual_page(const CLI::App& program) {
  std::string page = fmt::format(
      ".\\\" Written by manual_page(); a test compares. Do not edit.\n"
      ".TH SIGNORINI 1 \"\" \"signorini {}\" \"User Commands\"\n.nh\n.SH NAME\nsignorini \\- "
      "obstacle and contact problems by monotone multigrid\n.SH SYNOPSIS\n",
      version);
  std::string commands;
  for (const CLI::App* command : shown_commands(program)) {
    page += fmt::format(".B {}\n.br\n", escaped(synopsis(*command)));
    commands += fmt::format(".SS {}\n{}\n{}{}", escaped(synopsis(*command)), escaped(command->get_description()),
                            options_of(*command), paragraphs(command->get_footer()));
  }
  page += fmt::format(".SH EXAMPLES\n{}.SH COMMANDS\n{}.SH FILES\n{}.SH ENVIRONMENT\n{}", example, commands,
                      paragraphs(files), paragraphs(environment));
  return page;
}

}  // namespace signorini
