#pragma once
#include <functional>

#include "core/fem/model.hpp"
#include "core/fem/nodes.hpp"
#include "core/solver/discrete_problem.hpp"
#include "estimators/estimate.hpp"

namespace signorini {

/// Solves A x = b of a problem without obstacles, whose prescribed values are zero, roughly: to a residual of
/// about 1e-4. False: it could not.
template <int B>
using LinearSolve = std::function<bool(const DiscreteProblem<B>& problem, std::vector<double>& x)>;

template <int B>
struct CertificateOptions {
  LinearSolve<B> solve;        ///< for a sharper bound of elastic bodies; none: they do without
  double algebraic_error = 0;  ///< of the solution, relative, in the energy norm: for parts.algebra alone
};

/// Bounds of J(v) - J(u) for the energy J of a model, its solution u, and v, a finite element function near its
/// discrete solution, made admissible between nodes. From above by a flux tau in equilibrium with the loads (Prager and
/// Synge 1947; Repin 2000; docs/theory/certificate.md), from below by the energy that bubbles of edges win:
///     1/2 |u - v|^2 <= J(v) - J(u) <= 1/2 |grad v - A^-1 tau|_A^2 + int p (v - bound).
/// What it does not cover is said in `reasons`.
/// @param u global coordinates, B per node
template <int D, int B>
Estimate certificate(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                     const CertificateOptions<B>& options = {});

/// Why a model cannot have a certificate, one sentence each; none: it can.
template <int D, int B>
std::vector<std::string> not_certified(const Nodes<D>& nodes, const Model<B>& model);

}  // namespace signorini
