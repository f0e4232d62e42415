#pragma once

/// What rounding leaves of numbers that would be equal, or zero, without it, over the largest of the terms that went
/// into them. Each operation adds 2^-53 = 1.1e-16 at most, and errors add up; three classes are told apart by how many
/// operations that may have been. What is compared is said where the class is taken.
namespace signorini {

/// Sums of products, as of an element or a row of the matrix: up to 90 operations one after the other.
inline constexpr double rounding_of_sums = 1e-14;
/// Differences of numbers that were computed in several ways, or differ by what files and expressions cut off:
/// positions, normals, weights, forces that cancel. Up to 9000 operations.
inline constexpr double rounding_of_differences = 1e-12;
/// What is left of vectors that depend on each other, once a basis was taken from them: differences as above, divided
/// by how much the vectors of the basis differ, a hundredth at least.
inline constexpr double rounding_of_bases = 1e-10;

}  // namespace signorini
