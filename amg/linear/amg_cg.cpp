#include "amg/linear/amg_cg.hpp"

#include "core/solver/masked_cg.hpp"

namespace signorini {

namespace {

constexpr int most_iterations = 300;
constexpr double reduction = 1e-8;

/// The whole matrix, without zeros and scaling, from the lower triangle in compressed columns.
BlockMatrix<1> mirrored(const std::vector<Offset>& start, const std::vector<Index>& row,
                        const std::vector<double>& value, const std::vector<double>& scale) {
  const auto n = static_cast<Index>(scale.size());
  BlockMatrix<1> A;
  A.row.assign(static_cast<std::size_t>(n) + 1, 0);
  const auto visit = [&](Index column, auto&& off_diagonal) {
    for (Offset k = start[column]; k < start[column + 1]; ++k)
      if (row[k] != column && value[k] != 0) off_diagonal(row[k], value[k] / (scale[row[k]] * scale[column]));
  };
  for (Index column = 0; column < n; ++column) {
    ++A.row[column + 1];
    visit(column, [&](Index r, double) {
      ++A.row[r + 1];
      ++A.row[column + 1];
    });
  }
  for (Index p = 0; p < n; ++p) A.row[p + 1] += A.row[p];
  A.column.resize(static_cast<std::size_t>(A.row[n]));
  A.value.resize(A.column.size());
  std::vector<Offset> next(A.row.begin(), A.row.end() - 1);
  const auto add = [&](Index p, Index q, double v) {
    A.column[next[p]] = q;
    A.value[next[p]++] = v;
  };
  for (Index p = 0; p < n; ++p) add(p, p, 1 / (scale[p] * scale[p]));
  for (Index column = 0; column < n; ++column)
    visit(column, [&](Index r, double v) {
      add(r, column, v);
      add(column, r, v);
    });
  return A;
}

}  // namespace

void AmgConjugateGradients::analyse(const std::vector<Offset>& start, const std::vector<Index>& row) {
  start_ = start;
  row_ = row;
}

bool AmgConjugateGradients::factorise(const std::vector<double>& value, const std::vector<double>& scale) {
  scale_ = scale;
  cycle_.reset();  // its memory is needed
  cycle_ = std::make_unique<AlgebraicCycle<1>>(components_(), mirrored(start_, row_, value, scale), 1);
  return true;
}

bool AmgConjugateGradients::solve(std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] /= scale_[i];
  std::vector<double> found;
  const std::vector<Flags> nothing_masked(x.size(), 0);
  const CgResult cg = masked_cg<1>(
      cycle_->matrix(), nothing_masked,
      [&](const std::vector<double>& r, std::vector<double>& z) { cycle_->apply(r.data(), z.data()); },
      {.reduction = reduction, .iterations = most_iterations}, x, found);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = found[i] / scale_[i];
  return cg.converged;
}

}  // namespace signorini
