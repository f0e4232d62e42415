#pragma once
#include <optional>
#include <vector>

#include "core/fem/recovery/contact.hpp"
#include "core/mesh/chords.hpp"

namespace signorini {

/// How one obstacle and the body lie to each other after the solve. Lengths; of scalar unknowns differences of them.
struct DeformedContact {
  double penetration = 0;   ///< of the deformed boundary's vertices, the largest
  double opening = 0;       ///< the largest distance of vertices where contact is claimed
  double displacement = 0;  ///< largest of a vertex in contact or inside the obstacle, or difference of any two
  /// By how much more some vertices in contact have come along the obstacle's normal than others, but for a motion of
  /// all of them: what contact flattens; 0: nothing but rounding.
  double depth = 0;
  Index beyond = 0;         ///< vertices where contact is claimed and the other body is no longer in front
  double sagitta = 0;       ///< largest of a triangulated obstacle where the body touches it, see FacetedDistance
  SmoothedOver smoothed{};  ///< likewise
  /// The obstacle's normal turns at once where the vertex moves of the largest of these distances.
  bool over_edge = false;
  /// How far off linear conditions are, in parts of what is noticeable: of a hundredth of the displacements, and of a
  /// twentieth of what contact flattens, by about which the largest pressure is wrong. That is at most what deforms the
  /// faces that may touch, and this where hardly a vertex touches: a body may come from far to where it is then pressed
  /// in by little.
  double off = 0;
};

/// How many of the vertices that touch have slid past the other body, in parts of what is noticeable: of a tenth.
double noticeably_beyond(Index beyond, Index touching);

/// Contact conditions are linear in the displacement, obstacles and boundaries seldom are: the true distances between
/// rigid shapes and the boundary where it has come to. Nothing where the obstacle cannot tell them there; NaN where
/// nothing of the other body is in front. Obstacles without a shape have no other conditions than those that were
/// solved: of these what is left is their violation.
/// @param u global coordinates, B per vertex
template <int D, int B>
std::optional<DeformedContact> deformed_contact(const Nodes<D>& nodes, const Model<B>& model, Index obstacle,
                                                const ContactState<B>& state, const std::vector<double>& u);

/// Of every obstacle; nothing of bodies that are tied.
template <int D, int B>
std::vector<std::optional<DeformedContact>> deformed_contacts(const Nodes<D>& nodes, const Model<B>& model,
                                                              const ContactState<B>& state,
                                                              const std::vector<double>& u);

/// The worst of DeformedContact::off and noticeably_beyond(): above 1 it is noticeable.
template <int B>
double noticeably_off(const std::vector<std::optional<DeformedContact>>& deformed, const ContactState<B>& state);

/// How far the undeformed body is inside a rigid obstacle.
struct StartDepth {
  double depth = 0;        ///< of the deepest vertex
  double extent = 0;       ///< of the body along the normal there
  bool completely = true;  ///< no vertex of the boundary lies outside; then `depth` is that of any vertex
};

/// Nothing where it is not rigid, or fails.
/// @param everywhere asks the whole boundary, not just the part the obstacle acts on
template <int D>
std::optional<StartDepth> start_depth(const Nodes<D>& nodes, const Model<D>& model, Index obstacle, bool everywhere);

}  // namespace signorini
