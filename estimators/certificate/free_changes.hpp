#pragma once
#include "estimators/certificate/face_moments.hpp"

/// Changes of the values of a flux at faces that keep every element in equilibrium, and what is given: z = P g for a
/// gradient g, with P symmetric and roughly the inverse of the misfit's second derivative on some of these changes.
namespace signorini {

/// Scalars: a flux around each vertex in the plane, around each edge in space, and linear fluxes through each face
/// without total.
template <int D>
void around_edges(const TrueProblem<D, 1>& problem, const FaceNumbers& gradient, FaceNumbers& z);

/// Elastic bodies: linear tractions along each face, without force and moment.
template <int D>
void along_faces(const TrueProblem<D, D>& problem, const FaceNumbers& gradient, FaceNumbers& z);

}  // namespace signorini
