#include "core/fem/prescribed_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/sdk/block.hpp"

namespace signorini {
namespace {

constexpr double rounding = 1e-12;  // of terms that cancel

}  // namespace

template <int B>
void PrescribedRows<B>::add(const BlockMatrix<B>& A, const std::vector<double>& b, Index p) {
  vertex.push_back(p);
  column.insert(column.end(), A.column.begin() + A.row[p], A.column.begin() + A.row[p + 1]);
  value.insert(value.end(), A.at(A.row[p]), A.at(A.row[p]) + (A.row[p + 1] - A.row[p]) * B * B);
  load.insert(load.end(), b.begin() + Offset{p} * B, b.begin() + Offset{p + 1} * B);
  first.push_back(static_cast<Offset>(column.size()));
}

template <int B>
Index PrescribedRows<B>::at(Index p) const {
  return static_cast<Index>(std::lower_bound(vertex.begin(), vertex.end(), p) - vertex.begin());
}

template <int B>
double PrescribedRows<B>::force(Index k, const double* along, const std::vector<double>& x) const {
  double sum = 0, size = 0;
  const auto add = [&](double term) {
    sum += term;
    size += std::fabs(term);
  };
  for (int i = 0; i < B; ++i) add(-along[i] * load[Offset{k} * B + i]);
  for (Offset at = first[k]; at < first[k + 1]; ++at) {
    double entry[B];
    block::transposed_product<B>(value.data() + at * B * B, along, entry);
    for (int i = 0; i < B; ++i) add(entry[i] * x[Offset{column[at]} * B + i]);
  }
  return std::fabs(sum) > rounding * size ? sum : 0;
}

template struct PrescribedRows<1>;
template struct PrescribedRows<2>;
template struct PrescribedRows<3>;

}  // namespace signorini
