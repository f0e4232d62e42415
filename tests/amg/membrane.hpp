#pragma once
#include "tests/amg/matrices.hpp"

namespace signorini::test {

/// A membrane between a floor and a ceiling, pressed to one here and to the other there; some values are prescribed by
/// equal bounds.
struct Membrane {
  Eigen::SparseMatrix<double> A = laplacian(40);
  std::size_t n = static_cast<std::size_t>(A.rows());
  std::vector<double> b = std::vector<double>(n), lower = std::vector<double>(n, -0.01),
                      upper = std::vector<double>(n, 0.01);

  Membrane() {
    for (std::size_t i = 0; i < n; ++i) b[i] = (i < n / 2 ? -1.0 : 1.0) / 1600;
    for (const std::size_t i : {100, 500, 1400}) lower[i] = upper[i] = 0.005;
  }
};

}  // namespace signorini::test
