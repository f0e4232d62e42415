#pragma once
#include <span>
#include <string>
#include <variant>

#include "core/solver/options.hpp"

namespace signorini {

/// One member of a struct of options. Its type is that of the member, its default what a new struct has.
template <class Options>
struct OptionRow {
  const char* name;
  std::variant<bool Options::*, int Options::*, double Options::*, std::string Options::*> member;
  const char* range;  ///< as OptionSpec::range
  const char* help;
  bool of_levels = false;  ///< concerns levels that are chosen by the matrix
  const char* more = "";   ///< what docs/solver_options.md adds, in sentences; it names pages from docs/ on
};

/// The options of the solver. This table is the only place that knows them: keys of `[solver]` and of --set, ranges,
/// `signorini list`, --help and the documentation come from here.
std::span<const OptionRow<SolverOptions>> option_table();

/// Error(Exit::input) "solver.NAME: ..." where an option lies outside its range.
void check_ranges(const SolverOptions& options);

/// The position of a text among the choices of its range. Error as above where it is none of them.
int position_among_choices(const SolverOptions& options, std::string SolverOptions::*member);

/// What a text stands for: the enumerators are in the order of the choices.
template <class Enumeration>
Enumeration choice(const SolverOptions& options, std::string SolverOptions::*member) {
  return static_cast<Enumeration>(position_among_choices(options, member));
}

}  // namespace signorini
