#pragma once
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/fem/conditions/fixes.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/material.hpp"
#include "core/fem/model/model.hpp"
#include "estimators/certificate/gaps.hpp"
#include "estimators/certificate/incidence.hpp"
#include "estimators/certificate/jump_conditions.hpp"
#include "estimators/certificate/quadratic_function.hpp"
#include "estimators/certificate/reasons.hpp"

namespace signorini {

/// What acts on a face where the mesh ends. Where nothing is prescribed the flux through it is that of `load`.
template <int D, int B>
struct OuterFace {
  Index face;                                   ///< in Incidence::sides
  Point<D> normal{};                            ///< outward, as long as the face is large
  FixedDirections<B> fixed;                     ///< directions along which the solution is prescribed
  std::array<std::array<double, B>, D> load{};  ///< integrals of the given flux times the face's hat functions

  bool held() const { return fixed.count == B; }
  bool open() const { return fixed.count == 0; }
};

/// The boundary value problem whose solution is compared with a finite element function: all that integrals over
/// elements, faces and edges need to know of it, and the reasons why what is computed here is not the model's problem
/// itself. Of quadratic elements the simplices are the children.
template <int D, int B>
struct TrueProblem {
  /// @param u the function, B coefficients per node
  /// @param rest where friction holds back nothing, likewise; empty: at zero
  TrueProblem(const Nodes<D>& nodes, const Model<B>& model, const std::vector<double>& u,
              const std::vector<double>& rest = {});

  const Mesh<D>& mesh;
  Nodes<D> linear;  ///< elements on the mesh
  Incidence<D> incidence;
  QuadraticFunction u, slip;                  ///< slip where there is friction: what u has moved since it was at rest
  std::vector<LinearElement<D>> element;      ///< measures and gradients
  std::vector<Material<B>> material;          ///< per element
  std::vector<std::array<double, B>> source;  ///< per element: the mean of the body force or source
  /// D + 1 per element: integrals of the source times each hat function; empty: those of its mean.
  std::vector<std::array<double, B>> source_moment;
  std::vector<std::array<double, B>> edge_load;  ///< per edge: integral of all loads times its bubble
  std::vector<double> oscillation;  ///< per element: its part of the oscillation in the energy norm; empty: none
  std::vector<OuterFace<D, B>> outer;
  std::vector<Index> outer_of_face;             ///< per face, -1: inside
  std::vector<FixedDirections<B>> edge_fixes;   ///< directions in which bubbles of edges on faces may not move
  std::vector<Index> edge_fix;                  ///< per edge: which of them, -1: none
  std::vector<Gaps<D, B>> gaps;                 ///< per rigid obstacle; their faces are numbers in `outer`
  std::vector<ContactInterface<D>> interfaces;  ///< of bodies that may touch each other; likewise
  JumpConditions<D, B> jumps;                   ///< at the interfaces
  Reasons reasons;

  bool friction() const {
    return std::ranges::any_of(gaps, [](const auto& of_one) { return of_one.friction; }) || friction_between();
  }
  bool friction_between() const {
    return std::ranges::any_of(interfaces, [](const auto& of_one) { return !of_one.law.empty(); });
  }
  Index elements() const { return static_cast<Index>(element.size()); }
  bool in_contact() const { return !gaps.empty() || !interfaces.empty(); }
  /// Integral of the source times the hat function of vertex a of an element.
  std::array<double, B> moment(Index e, int a) const {
    if (!source_moment.empty()) return source_moment[Offset{e} * (D + 1) + a];
    std::array<double, B> out = source[e];
    for (double& f : out) f *= element[e].measure / (D + 1);
    return out;
  }
};

}  // namespace signorini
