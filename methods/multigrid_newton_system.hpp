#pragma once
#include <memory>
#include <span>
#include <vector>

#include "core/component/registry.hpp"
#include "core/solver/multigrid.hpp"
#include "core/solver/options.hpp"
#include "methods/newton_system.hpp"

namespace signorini {

/// With FGMRES, and a cycle on what the matrix has of symmetry: components whose force is asked for by a row are free
/// in A, with the curvature of friction where that slips, and the others are held. Left out is only what friction
/// takes from the pressure. The number of iterations does not grow with the size.
///
/// A row of contact or stick says v alone, one of slip with direction s, pressure p and coefficient mu, in units of its
/// own: f_t - mu p s + (mu p / |slip|) (I - s s') v_t.
template <int B>
class MultigridNewtonSystem final : public NewtonSystem<B> {
 public:
  /// Keeps references to all. Errors as of components_of().
  MultigridNewtonSystem(const DiscreteProblem<B>& problem, std::span<const Prolongation> prolongations,
                        const SolverOptions& options, const Registry& registry);

  const char* name() const override { return "multigrid"; }
  Offset size() const override { return Offset{problem_.A.size()} * B; }
  void set_row(Index p, const double* by_force, const double* by_value) override;
  bool factorise() override;
  bool solve(std::vector<double>& b) override;
  int factorisations() const override { return factorisations_; }
  int solves() const override { return solves_; }

 private:
  using Vector = std::vector<double>;

  /// What the rows of a slot are: of the components that are not held, in units in which F is the identity there.
  struct Rows {
    double force[B * B], value[B * B], units[B * B];
    Flags held;
  };
  static Rows rows_of(const double* F, const double* V, Flags off);
  void free_below(const Rows& rows, Index slot);
  void prepare();
  void apply(const Vector& v, Vector& out) const;
  void precondition(const Vector& r, Vector& out);
  void hold(Vector& b, Vector& known) const;

  const DiscreteProblem<B>& problem_;
  std::span<const Prolongation> prolongations_;
  SolverOptions options_;
  const Registry& registry_;
  std::vector<double> F_, V_;  // B * B per slot, as they were set
  std::vector<Rows> rows_;     // per slot
  std::vector<double> root_;   // per unknown: of the diagonal of A
  DiscreteProblem<B> own_;     // of the cycle
  std::unique_ptr<MonotoneMultigrid<B>> multigrid_;
  int factorisations_ = 0, solves_ = 0;
};

}  // namespace signorini
