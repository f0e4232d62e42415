#pragma once
#include <string>
#include <vector>

#include "estimators/estimator.hpp"

namespace signorini {

/// Bounds of J(v) - J(u) for the energy J of a model, its solution u, and v, a finite element function near its
/// discrete solution, made admissible between nodes. From above by a flux tau in equilibrium with the loads (Prager and
/// Synge 1947; Repin 2000; docs/theory/certificate.md), from below by the energy that bubbles of edges win:
///     1/2 |u - v|^2 <= J(v) - J(u) <= 1/2 |grad v - A^-1 tau|_A^2 + int p (v - bound).
/// What it does not cover is said in `reasons`.
/// @param u global coordinates, B per node
template <int D, int B>
Estimate certificate(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
                     const EstimateOptions<B>& options = {});

/// Why a model cannot have a certificate, one sentence each; none: it can.
template <int D, int B>
std::vector<std::string> not_certified(const Nodes<D>& nodes, const Model<B>& model);

}  // namespace signorini
