#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace signorini::conformance {

/// What the kit asks of a plugin. The table of these drives the checks, what is printed, and the page that explains
/// them.
struct Check {
  std::string_view id;
  std::string_view expected;  ///< what a plugin without faults does
  std::string_view page;      ///< of the documentation, where that is explained
};

/// All checks, in the order in which they run.
const std::vector<Check>& all_checks();

/// A check that failed: what was found in place of what was expected, and the smallest example of it that there is.
struct Failure {
  Check check;
  std::string found, example;
};

struct Options {
  std::vector<std::string> settings;  ///< "friction=0.3": keys of [[obstacle]] as --set takes them, behind obstacle.0.
  bool solves = true;                 ///< also solves scenes with it, which takes most of the time
  double patience = 10;               ///< seconds that a check may take; solves may take some minutes
};

struct Verdict {
  std::string type;           ///< the id of the obstacle that was checked
  std::vector<Check> passed;  ///< and those that have nothing to ask of an obstacle of this kind are in none of both
  std::vector<Failure> failures;   ///< in the order of all_checks()
  std::vector<std::string> notes;  ///< what was not checked, and why
  bool conforms() const { return failures.empty(); }
};

/// Checks the plugin in a compiled library, of which nothing but its file is known: the obstacle that scenes find by
/// the file's name. All that it does happens in copies of the process, each for a limited time.
/// @throws Error(Exit::input) where there is no such file, or where settings are wrong or missing
Verdict check_plugin(const std::filesystem::path& library, const Options& options = {});

/// The verdict as people read it, with a paragraph per failure.
std::string text_of(const Verdict& verdict);

/// A scene solved by Gauss-Seidel steps alone, and by what the scene asks for.
struct Comparison {
  double difference = 0;  ///< the largest of an unknown, over the largest of these
  int iterations = 0;     ///< of the scene's own method
  int gauss_seidel = 0;   ///< steps of the other
};
/// @param library whose folder is searched for plugins first
/// @throws Error as the solves do, Error(Exit::not_converged) where one of them does not come to its end
Comparison compare_with_gauss_seidel(const std::filesystem::path& scene, const std::filesystem::path& library);

}  // namespace signorini::conformance
