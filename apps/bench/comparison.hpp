#pragma once
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace signorini::bench {

using Overrides = std::vector<std::string>;  ///< as `--set` takes them

Overrides joined(Overrides all, const Overrides& more);

/// What one solve took.
struct Trial {
  int cycles = 0;
  bool converged = false;
  double seconds = std::numeric_limits<double>::infinity();  ///< of processor time
};

/// The default settings of one problem beside the best of those picked by hand.
class Comparison {
 public:
  using Run = std::function<Trial(const Overrides&)>;

  /// @param run solves with these settings; what throws an Error has not converged
  explicit Comparison(Run run);

  /// Tries a method with each of the lists, with none of them where it is far from the best alone.
  void try_method(const Overrides& method, const std::vector<Overrides>& lists);

  /// The least of many noisy times was lucky, too: the default and the best are measured again, in turns.
  void confirm();

  /// A row of a table: cycles of the default, best settings, their cycles, settings that failed, ratio of times.
  std::string row() const;
  /// Default over best; infinity where the default fails, 0 where nothing else solves the problem.
  double ratio() const;

 private:
  Trial fastest(const Overrides& settings, double limit) const;
  Trial try_settings(const Overrides& settings);

  Run run_;
  Trial automatic_, best_;
  Overrides best_settings_;
  int failed_ = 0;
};

}  // namespace signorini::bench
