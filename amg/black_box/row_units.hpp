#pragma once
#include <vector>

#include "core/algebra/sparse_rows.hpp"

namespace signorini {

/// Units in which the rows of a matrix seem to be meant, s: levels by the matrix take what is smooth to be about
/// constant, and in other units it is not. Whoever scales the unknowns of a Laplacian, one in millimetres and the next
/// in metres, gives D A D with a diagonal D: here s_i = 1 / sqrt(a_ii), with which (s_i a_ij s_j) has a unit diagonal
/// again. Empty where constants have less energy than s, or not much more: where couplings vary, as with different
/// materials, the diagonal varies as well, but what is smooth is constant.
/// @param matrix with both triangles; whatever is wrong with it, the answer is empty then
std::vector<double> recognised_units(const SparseRows& matrix);

/// s_i a_ij s_j.
SparseRows in_units(SparseRows matrix, const std::vector<double>& units);

}  // namespace signorini
