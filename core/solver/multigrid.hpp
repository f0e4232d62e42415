#pragma once
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/solver/components.hpp"
#include "core/solver/summary.hpp"

namespace signorini {

/// What one cycle did.
struct CycleReport {
  std::vector<LevelReport> levels;  ///< coarsest first
  double rounding = 0;              ///< rounding_of_work() on the finest level
  bool bounded = true;              ///< false: what the coarsest level minimised has no minimum
  bool cut_off = false;             ///< bounds met a correction that knew none of them

  const LevelReport& finest() const { return levels.back(); }
  /// Coarse matrix rows recomputed, on all levels.
  Index renewed() const {
    Index sum = 0;
    for (const LevelReport& level : levels) sum += level.renewed;
    return sum;
  }
};

/// Visits of a coarser level: one, two, or one like that and then a V.
enum class Cycle { V, W, F };

/// What is taken out of the interpolation of a vector in contact.
enum class Truncation { none, normal, tangential };

/// Truncated monotone multigrid (Krause, Alg. 1): nonlinear smoothing on the true constraints, then corrections from
/// coarser levels within monotonically restricted bounds. Knows no kind of obstacle, mesh or dimension.
template <int B>
class MonotoneMultigrid {
 public:
  struct Settings {
    int pre = 1, post = 1;
    Cycle cycle = Cycle::V;
    Truncation truncate = Truncation::normal;
    Rotate rotate = Rotate::all;
    bool reassemble = true;   ///< also algebraic levels' matrices; else corrections from there are searched along
    double relaxation = 1.2;  ///< of the sweeps on all levels
    int threads = 1;          ///< results do not depend on it
  };

  /// Keeps references to the problem and the prolongations (coarsest first).
  MonotoneMultigrid(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                    Components<B> components, Settings settings);

  /// One cycle on x (B per vector, admissible). The energy never grows. `before` and `after` see disjoint ranges of
  /// vectors that cover all: before the cycle touches them, and when they and all that they are coupled to are final.
  CycleReport cycle(double* x, const Passes::Run& before = {}, const Passes::Run& after = {});

  /// Takes the phases of x for those that the cycle before the next one has left.
  void begin_at(double* x);

  /// From now on the correction from the coarser levels has no bounds there, but goes as far along the projected
  /// direction as lowers the energy most (Graeser and Kornhuber 2009, section 5); or no longer so. Needs truncation.
  void search_lines(bool on) { line_search_ = on; }

  /// From now on a correction with bounds is not only added but goes as far along its direction as lowers the energy
  /// most, until it meets a bound of the finest level; or no longer so. Coarse bounds allow parts of the way only.
  void extend_steps(bool on) { extended_ = on; }

  /// From now on directions with at most this distance left are truncated too.
  void cut_below(double distance) { near_ = distance; }

  /// About ||d||_A for A d = forces on the components of x that no bound holds, by cycles without any bounds; nothing
  /// where nothing holds what the forces move.
  /// @param enough smaller ones need not be known exactly
  std::optional<double> response(const std::vector<double>& x, const std::vector<double>& forces, double enough);

  /// What functionals keep frozen during cycles, see Constraints::data: to be renewed between them.
  std::vector<double>& frozen() { return levels_.back().constraints.data; }

  /// Subtracts the gradient of the functionals at x, where these are smooth.
  void subtract_gradient(const double* x, double* r);

  /// Two vectors that it needs in cycles and not between them.
  std::pair<std::vector<double>&, std::vector<double>&> spare() { return {start_, step_}; }

  /// Whether the interpolation to the finest level is smooth, as operators of fourth order need it (and nothing adds to
  /// the energy). Their residuals are tiny beside their terms: on that level they are rounded once. What no force
  /// presses against its bound interpolates there, on all levels: contact that is too wide would only retreat from its
  /// edge.
  bool of_fourth_order() const { return fourth_order_; }

  const Level<B>& finest() const { return levels_.back(); }
  const std::vector<Level<B>>& levels() const { return levels_; }

 private:
  static constexpr Flags every_component = (1u << B) - 1;

  void descend(std::size_t k, Cycle cycle, const Passes::Run& before, const Passes::Run& after);
  double correct(std::size_t k, Cycle cycle);
  bool searches(std::size_t k) const;
  void search(std::size_t k);
  void search_nonlinear(Level<B>& level, double energy, double work);
  void search_by_coarse_level(Level<B>& level);
  bool is_careful(const Level<B>& level) const { return fourth_order_ && &level == &levels_.back(); }
  void find_residual(const Level<B>& level, Index first, Index last);
  void find_products(const Level<B>& level, Index p, double* Ad, double* r) const;
  double rounding_of_residual(const Level<B>& level, Index first, Index last) const;
  void update_phases(Level<B>& level, Index first, Index last, const double* r);
  bool hold_facets(Level<B>& level, Index slot, Flags& removed);
  void renew_curvature(Level<B>& level, Index slot);
  bool rests(const Level<B>& level, Index from, Index to, LevelReport& report) const;
  Flags truncated(const Level<B>& level, Index slot, Flags critical) const;
  bool is_pressed(const Level<B>& level, Index slot, double force) const;
  void restrict_residual(std::size_t k, Index first, Index last);
  void assemble_once();

  std::vector<Level<B>> levels_;                              // coarsest first
  std::vector<std::unique_ptr<LevelSmoother<B>>> smoothers_;  // per level; none on the coarsest
  std::vector<std::unique_ptr<Transfer<B>>> transfers_;
  std::size_t lasting_ = 0;  // number of levels whose matrices do not follow the phases: the coarsest ones
  Components<B> components_;
  Settings settings_;
  Crew crew_;
  CycleReport report_;
  bool line_search_ = false, extended_ = false;
  bool knows_frames_ = true;   // the interpolation to the finest level
  bool fourth_order_ = false;  // see of_fourth_order()
  double near_ = 0;
  std::vector<double> r_;                       // residual of one chunk
  std::vector<double> start_, step_;            // of a line search
  double coarse_work_ = 0, coarse_energy_ = 0;  // b'c and c'Ac of the last correction c of a level with functionals
};

/// Levels for block size B on the finest matrix alone.
template <int B>
Level<B> finest_level(const DiscreteProblem<B>& problem);

}  // namespace signorini
