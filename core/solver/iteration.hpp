#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/solver/convergence.hpp"
#include "core/solver/level.hpp"
#include "core/solver/options.hpp"
#include "core/solver/summary.hpp"

namespace signorini {

/// The loop around the steps of a method: what is recomputed from the iterate after each of them, and when to stop.
template <int B>
class Iteration {
 public:
  virtual ~Iteration() = default;
  /// Iterates until the problem is solved, or there is another reason to stop: a summary of one stage.
  /// @param before steps that other methods have made: they count for the limit and in the numbers of the steps
  Summary run(const Monitor& monitor, int before = 0);

 protected:
  /// What a method says about its step.
  struct Step {
    std::vector<LevelReport> levels;  ///< coarsest first
    double error = 0;                 ///< estimate of ||x - x*||_A
    double rate = unknown_rate;       ///< Summary::rate
    bool carried = false;             ///< the residual was carried along, not computed from the iterate alone
    bool bounded = true;              ///< false: the energy has no minimum
    bool gaining = false;             ///< more energy than rounding explains was gained
    bool exact = false;  ///< a linear solve has left nothing but rounding, of which the error is what it moved
    std::string stuck;   ///< why the method cannot go on, if so
  };

  /// Everything that is recomputed from an iterate, and what was gained since x_before_.
  struct Sums {
    double natural_residual = 0;
    /// J(before) - J with the functionals, the squared energy norm of the step, and the size of their terms.
    double gain = 0, correction = 0, size = 0;
    FreeProducts products;
    double largest = 0;  // |x|
    double moved = 0;    // the largest |step|
  };

  /// Keeps references to all of them.
  Iteration(const DiscreteProblem<B>& problem, std::vector<double>& x, const SolverOptions& options)
      : problem_(problem), options_(options), x_(x), r_(x.size()), x_before_(x.size()), r_before_(x.size()) {
    if (follows_solution(problem.segments)) data_ = problem.constraints.data;
  }

  virtual const Level<B>& finest() const = 0;
  virtual std::vector<Index> unknowns() const = 0;
  /// The one that "auto" stands for.
  virtual std::string method() const = 0;
  /// One step: from x_ to the next iterate, with x_before_, r_ and sums_; r_before_ is the residual of x_.
  virtual Step advance() = 0;
  /// Adds the linear solver and what it has done, on the finest level.
  virtual void add_work(Stage&) const {}
  /// Response of the components of x_ that no bound holds.
  virtual std::optional<double> response(const std::vector<double>& forces, double enough) = 0;

  /// Whether functionals depend on the solution.
  bool follows() const { return !data_.empty(); }
  /// r = b - A x and what follows from it.
  Sums evaluate(std::vector<double>& x, std::vector<double>& r);
  /// The same at the vectors first <= p < last.
  void evaluate(std::vector<double>& x, std::vector<double>& r, Index first, Index last, Sums& sums);
  /// Adds what follows from a residual at the vectors first <= p < last, one piece of them (in_pieces()).
  void add_sums(std::vector<double>& x, const std::vector<double>& r, Index first, Index last, Sums& sums);
  /// Error(Exit::input) where a residual is not finite.
  static void refuse_nan(double residual);
  Index free_unknowns(const Level<B>& level) const;
  /// x'Ax of what rounding does to the iterate x by storing it.
  double storage_energy() const;
  /// Whether the natural residual is a small multiple of machine precision times the largest unknown.
  bool is_rounding_of_unknowns() const;
  /// The natural residual over that of the projected zero.
  double relative_residual() const;
  /// Whether the residual is so small that it says nothing.
  bool rests_at_rounding() const;
  /// How many times the residual or the error after the last step was larger than the tolerance.
  double excess() const { return std::max(summary_.residual, summary_.algebraic_error) / options_.tolerance; }

  const DiscreteProblem<B>& problem_;
  const SolverOptions& options_;
  std::vector<double>& x_;
  std::vector<double> r_, x_before_, r_before_;
  Sums sums_;
  bool careful_ = false;  ///< residuals are rounded once: what is left is that iterates are rounded themselves
  /// What functionals that follow the solution are frozen with at the iterate evaluated last, see Constraints::data:
  /// the natural residual and the energy are those of this phi, gains those of what was frozen. Empty where none
  /// follows.
  std::vector<double> data_;
  double residual_of_load_ = 0;  ///< of a load that follows: the last relative change of what it depends on
  double largest_before_ = 0;    ///< of the vectors at slots with functionals, after the last load step

 private:
  bool step(const Monitor& monitor);
  void add_natural_residual(std::vector<double>& x, Index first, Index last, const std::vector<double>& r,
                            double& largest) const;
  void leave_out_facets(const std::vector<double>& x, const std::vector<double>& r, Index first, Index last,
                        Sums& sums);
  void measure(double error);
  void record(Step step);
  double rounding_energy() const;
  double energy_of_diagonal() const;
  double rounding_error();
  bool within_tolerance() const;
  bool finished(bool gaining, bool exact);
  bool has_risen() const;
  bool end(Outcome outcome, std::string reason);
  void finish_energies();
  void finish_stage(double begin);
  double residual_at_projected_zero();
  double displacement_by_forces(const std::vector<double>& r) const;

  int before_ = 0;              // steps of other methods
  bool moves_rigidly_ = false;  // the iterate, but for rounding
  double trace_ = 0;            // of A
  double size_ = 0;             // ||x||_A
  Summary summary_;
  std::vector<double> across_;  // of the step at facets that it stays on
  std::vector<double> gains_;   // one for each step
  double reference_ = 0;
  bool zero_solves_ = false;  // the projected zero does
  double least_ = infinity;
  int stalled_ = 0;
  std::vector<double> zero_;              // empty without functionals
  std::optional<double> rounding_error_;  // in the energy norm, once it was asked for
};

}  // namespace signorini
