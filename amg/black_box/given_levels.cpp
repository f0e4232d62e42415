#include "amg/black_box/given_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "amg/black_box/block_rows.hpp"
#include "core/algebra/products.hpp"
#include "core/algebra/random_vector.hpp"
#include "core/base/error.hpp"
#include "core/base/rounding.hpp"
#include "core/solver/weights.hpp"

namespace signorini {
namespace {

// Of a component of the product with a random vector, relative to the sum of the moduli that it is made of.

std::string name(const char* what, std::size_t k, std::size_t count) {
  return fmt::format("{} {} of {}, coarsest first", what, k + 1, count);
}

Prolongation prolongation(const SparseRows& P) {
  Prolongation out;
  out.coarse = P.columns;
  for (Index p = 0; p < P.rows; ++p) {
    std::map<Index, double> weights;
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k) weights[P.column[k]] += P.value[k];
    for (const auto& [column, weight] : weights)
      if (weight != 0) {
        out.column.push_back(column);
        out.weight.push_back(weight);
      }
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  return out;
}

/// A matrix whose rows that are zero have a diagonal that was put there.
template <int B>
struct Given {
  const BlockMatrix<B>& A;
  const std::vector<Flags>& zero;  ///< per vector the components of these rows

  /// The product without these diagonals.
  std::vector<double> times(std::vector<double> z) const {
    for (std::size_t i = 0; i < z.size(); ++i)
      if (zero[i / B] >> (i % B) & 1u) z[i] = 0;
    std::vector<double> y(z.size());
    product(A, z.data(), y.data());
    return y;
  }
};

/// P'AP z
template <int B>
std::vector<double> galerkin_product(const Given<B>& A, const Prolongation& P, const std::vector<double>& z) {
  std::vector<double> fine(Offset{P.fine()} * B), y(z.size());
  const auto weight = [&](Offset k) { return weights::Scalar<B>{P.weight[k]}; };
  for (Index p = 0; p < P.fine(); ++p) weights::interpolate<B>(P, weight, p, z.data(), fine.data() + Offset{p} * B);
  const std::vector<double> image = A.times(std::move(fine));
  for (Index p = 0; p < P.fine(); ++p)
    for (Offset k = P.row[p]; k < P.row[p + 1]; ++k)
      weight(k).add_force(image.data() + Offset{p} * B, y.data() + Offset{P.column[k]} * B);
  return y;
}

template <class Values>
void replace_by_moduli(Values& values) {
  for (double& v : values) v = std::abs(v);
}

/// What bounds the rounding errors of galerkin_product().
template <int B>
std::vector<double> product_of_moduli(const Given<B>& matrix, Prolongation P, std::vector<double> z) {
  BlockMatrix<B> A = matrix.A;
  replace_by_moduli(A.value);
  replace_by_moduli(P.weight);
  replace_by_moduli(z);
  return galerkin_product<B>({A, matrix.zero}, P, z);
}

template <int B>
void require_galerkin(const Given<B>& A, const Prolongation& P, const Given<B>& coarse, const std::string& place) {
  const std::vector<double> z = random_vector(static_cast<std::size_t>(P.coarse) * B);
  const std::vector<double> found = coarse.times(z), expected = galerkin_product(A, P, z),
                            size = product_of_moduli(A, P, z);
  for (std::size_t i = 0; i < z.size(); ++i)
    if (!(std::abs(found[i] - expected[i]) <= rounding_of_bases * size[i]))
      input_error(place,
                  fmt::format("is not the Galerkin product P'AP of the next finer matrix, see row {}; leave coarse "
                              "matrices out, and the products are computed",
                              i + 1));
}

/// @param zero its rows that are zero
template <int B>
BlockMatrix<B> coarse_matrix(const SparseRows& matrix, const Prolongation& P, const std::string& place,
                             std::vector<Flags>& zero) {
  if (matrix.rows != P.coarse * B)
    input_error(place, fmt::format("found {} rows, expected {}, the number of columns of the interpolation{}",
                                   matrix.rows, P.coarse * B, B > 1 ? " times the block size" : ""));
  try {
    return block_matrix<B>(matrix, &zero);
  } catch (const Error& error) {
    throw Error(error.status(), fmt::format("{}: {}", place, error.what()));
  }
}

}  // namespace

std::vector<Prolongation> given_levels(std::span<const SparseRows> interpolations, Index vectors) {
  std::vector<Prolongation> out;
  for (std::size_t k = 0; k < interpolations.size(); ++k) {
    const SparseRows& P = interpolations[k];
    const std::string place = name("interpolation", k, interpolations.size());
    check_entries(P, place);
    const bool finest = k + 1 == interpolations.size();
    const Index expected = finest ? vectors : interpolations[k + 1].columns;
    if (P.rows != expected)
      input_error(place, fmt::format("found {} rows, expected {}, the number of {}", P.rows, expected,
                                     finest ? "rows of the matrix over the block size" : "columns of the next one"));
    if (P.columns == 0) input_error(place, "found no columns, expected at least one");
    out.push_back(prolongation(P));
  }
  return out;
}

template <int B>
std::vector<BlockMatrix<B>> given_matrices(const BlockMatrix<B>& A, const std::vector<Flags>& zero,
                                           std::span<const Prolongation> levels, std::span<const SparseRows> matrices) {
  if (matrices.empty()) return {};
  if (matrices.size() != levels.size())
    input_error("coarse matrices",
                fmt::format("found {}, expected {}, one for each interpolation", matrices.size(), levels.size()));
  std::vector<BlockMatrix<B>> out(levels.size());
  std::vector<std::vector<Flags>> zeros(levels.size());
  for (std::size_t k = 0; k < levels.size(); ++k)
    out[k] = coarse_matrix<B>(matrices[k], levels[k], name("coarse matrix", k, levels.size()), zeros[k]);
  for (std::size_t k = levels.size(); k-- > 0;) {
    const bool finest = k + 1 == levels.size();
    require_galerkin<B>({finest ? A : out[k + 1], finest ? zero : zeros[k + 1]}, levels[k], {out[k], zeros[k]},
                        name("coarse matrix", k, levels.size()));
  }
  // What has no energy is held in one way or another where products are computed.
  const bool any_zero = std::ranges::any_of(zeros, [](const std::vector<Flags>& level) {
    return std::ranges::any_of(level, [](Flags f) { return f != 0; });
  });
  if (any_zero) out.clear();
  return out;
}

template std::vector<BlockMatrix<1>> given_matrices(const BlockMatrix<1>&, const std::vector<Flags>&,
                                                    std::span<const Prolongation>, std::span<const SparseRows>);
template std::vector<BlockMatrix<2>> given_matrices(const BlockMatrix<2>&, const std::vector<Flags>&,
                                                    std::span<const Prolongation>, std::span<const SparseRows>);
template std::vector<BlockMatrix<3>> given_matrices(const BlockMatrix<3>&, const std::vector<Flags>&,
                                                    std::span<const Prolongation>, std::span<const SparseRows>);

}  // namespace signorini
