#pragma once

namespace signorini {

/// Sine of the angle below which two directions are one.
inline constexpr double same_direction = 1e-6;

/// A basis Q and its dual N = Q^-T, both row-major, for given directions of B entries each: the first columns of N are
/// the `leading` unit vectors, which are linearly independent, the last ones the `trailing` orthonormal vectors, which
/// are orthogonal to them; the columns between them, from Householder reflections, complete the basis orthonormally.
/// Both matrices are the identity when the given vectors are the coordinate axes in their places.
template <int B>
void local_basis(const double* leading, int leading_count, const double* trailing, int trailing_count, double* Q,
                 double* N);

/// Least distance of one of `count` unit vectors from the span of the others: 1 where they are orthogonal, 0 where they
/// are dependent. Its inverse is the length of the longest column of Q in a frame with these leading vectors.
template <int B>
double separation(const double* directions, int count);

}  // namespace signorini
