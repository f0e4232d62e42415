#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace signorini {

/// `signorini solve`.
struct SolveArguments {
  std::filesystem::path scene;
  std::filesystem::path out;  ///< empty: the scene's name in the current folder
  std::vector<std::string> overrides;
  bool quiet = false;
  std::optional<double> accuracy;  ///< elements and mesh are chosen for it
  std::string of = "energy";       ///< of what
};

/// Error(Exit::not_converged) where what was written is no solution.
void solve_command(const SolveArguments& arguments);

/// `signorini qp`. Paths of files that are not given are empty.
struct QpArguments {
  std::filesystem::path matrix, load, lower, upper, start, near_null, coordinates;
  std::filesystem::path out, report;
  int block = 0;  // recognised in the matrix
  bool one_triangle = false;
  std::vector<std::string> settings;  ///< "solver.cycle=W"
  std::optional<double> tolerance;    ///< go before those
  std::optional<std::string> method;
};

/// Error(Exit::not_converged) as above.
void qp_command(const QpArguments& arguments);

/// `signorini check`: says what would be solved.
void check_command(const std::filesystem::path& scene, const std::vector<std::string>& overrides);

/// `signorini chart`.
struct ChartArguments {
  std::filesystem::path scene;
  std::filesystem::path out;  ///< empty: the scene's name in the current folder
  std::vector<std::string> overrides;
  std::string of = "energy", against = "seconds";
  std::vector<double> exact;  ///< of what is shown; empty: not known
  double budget = 20;         ///< seconds that a run may take
  std::optional<double> accuracy;
  bool quiet = false;
};

/// Error(Exit::not_converged) where no setting has the accuracy that is asked for.
void chart_command(const ChartArguments& arguments);

/// `signorini list`: the components of a kind ("obstacles", "smoothers"...), or all when `kinds` is empty.
void list_command(const std::string& kinds);

/// What `signorini list` can be asked for.
const std::vector<std::string>& listable_kinds();

/// `signorini plugin check`.
struct PluginCheckArguments {
  std::filesystem::path file;
  std::vector<std::string> settings;  ///< "friction=0.3"
  bool no_solves = false, json = false;
};

/// Error(Exit::plugin) where the plugin fails a check.
void plugin_check_command(const PluginCheckArguments& arguments);

/// `signorini plugin new`.
struct PluginNewArguments {
  std::string name, kind = "box";
  std::filesystem::path folder;  ///< empty: the name, in the current folder
};

void plugin_new_command(const PluginNewArguments& arguments);

/// What `signorini plugin new` can begin with.
const std::vector<std::string>& plugin_kinds();

/// `signorini help`.
struct HelpArguments {
  std::string name;  ///< of a command, a table or a key; empty: the program
  bool manual = false;
};

}  // namespace signorini
