#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "conformance/check.hpp"
#include "conformance/copy.hpp"
#include "conformance/subject.hpp"

namespace signorini::conformance {

/// What came of the checks so far, for problems of all sizes that an obstacle is for.
class Outcomes {
 public:
  void pass(std::string_view id);
  /// The first failure of a check is kept.
  void fail(std::string_view id, std::string found, std::string example);
  void note(std::string text);
  bool has_failed(std::string_view id) const { return failed_.contains(std::string(id)); }
  bool has_failures() const { return !failed_.empty(); }
  /// In the order of all_checks().
  Verdict verdict(std::string type) const;

 private:
  std::map<std::string, bool> passed_;
  std::map<std::string, Failure> failed_;
  std::vector<std::string> notes_;
};

/// Asks an obstacle for problems of B unknowns all that there is to ask.
/// @return what it says of the values that the user gave, where it takes none of them; else ""
template <int B>
std::string run_checks(const Subject& subject, const std::filesystem::path& folder, const Options& options,
                       Outcomes& outcomes);

}  // namespace signorini::conformance
