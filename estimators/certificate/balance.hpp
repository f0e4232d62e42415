#pragma once
#include "estimators/certificate/face_moments.hpp"

namespace signorini {

/// x x f: one number in the plane.
inline std::array<double, 1> moment_of(const Point<2>& x, const Point<2>& f) { return {x[0] * f[1] - x[1] * f[0]}; }
inline std::array<double, 3> moment_of(const Point<3>& x, const Point<3>& f) { return cross(x, f); }

/// What is missing for the equilibrium of an element: the sums of what acts on it, and of moments about its centroid
/// (elastic bodies; one in the plane).
template <int D, int B>
struct Imbalance {
  static constexpr int moments = B == D ? D * (D - 1) / 2 : 0;
  std::array<double, B> force{};
  std::array<double, moments> moment{};
};

/// @param values of a flux at the vertices of each face, times its measure
template <int D, int B>
Imbalance<D, B> imbalance(const TrueProblem<D, B>& problem, const ContactForces<D, B>& contact,
                          const FaceNumbers& values, Index e);

/// The largest force that is missing in an element, in units of the largest one that acts on any; a moment counts as a
/// force at the longest edge.
template <int D, int B>
double largest_imbalance(const TrueProblem<D, B>& problem, const ContactForces<D, B>& contact,
                         const FaceNumbers& values);

/// Makes the flux balance every element: what is missing is handed on from element to element down a spanning tree, as
/// a linear traction t = f + w x (x - c) through each face, to faces where all components are prescribed. Time and
/// memory are linear. Parts of the mesh without such a face keep what is missing at one element.
template <int D, int B>
void balance_along_tree(const TrueProblem<D, B>& problem, const ContactForces<D, B>& contact, FaceNumbers& values);

/// Where no face of a body is held in all directions: balances the body as a whole, by tractions along the directions
/// that are held, linear on each face, so that the tree has nothing left to keep. What these cannot carry, as contact
/// does, stays.
template <int D>
void balance_whole(const TrueProblem<D, D>& problem, const ContactForces<D, D>& contact, FaceNumbers& values);

}  // namespace signorini
