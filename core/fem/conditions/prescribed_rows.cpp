#include "core/fem/conditions/prescribed_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/rounding.hpp"
#include "core/sdk/block.hpp"
#include "core/solver/local_coordinates.hpp"

namespace signorini {

template <int B>
void PrescribedRows<B>::add(const BlockMatrix<B>& A, Index p) {
  vertex.push_back(p);
  column.insert(column.end(), A.column.begin() + A.row[p], A.column.begin() + A.row[p + 1]);
  value.insert(value.end(), A.at(A.row[p]), A.at(A.row[p]) + (A.row[p + 1] - A.row[p]) * B * B);
  first.push_back(static_cast<Offset>(column.size()));
}

template <int B>
void PrescribedRows<B>::take_load(const std::vector<double>& b) {
  load.clear();
  for (const Index p : vertex) load.insert(load.end(), b.begin() + Offset{p} * B, b.begin() + Offset{p + 1} * B);
}

template <int B>
void PrescribedRows<B>::rotate_columns(const Frames<B>& frames) {
  for (std::size_t at = 0; at < column.size(); ++at)
    if (const double* Q = frames.at(column[at])) {
      double M[B * B];
      block::multiply<B>(value.data() + at * B * B, Q, M);
      std::copy_n(M, B * B, value.data() + at * B * B);
    }
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
  return std::fabs(sum) > rounding_of_differences * size ? sum : 0;
}

namespace {

/// A v for prescribed values v, row by row.
template <int B>
class Couplings {
 public:
  explicit Couplings(const DiscreteProblem<B>& problem) : slot_(problem.fixed.size(), -1) {}

  double* at(Index p) {
    if (slot_[p] < 0) {
      slot_[p] = static_cast<Index>(vectors_.size());
      vectors_.push_back(p);
      Av_.resize(Av_.size() + B);
    }
    return Av_.data() + Offset{slot_[p]} * B;
  }

  /// Calls use(p, Av) by ascending p.
  template <class Use>
  void each(const Use& use) {
    std::sort(vectors_.begin(), vectors_.end());
    for (const Index p : vectors_) use(p, at(p));
  }

 private:
  std::vector<Index> slot_, vectors_;
  std::vector<double> Av_;
};

}  // namespace

template <int B>
void prescribe(DiscreteProblem<B>& problem, const PrescribedRows<B>& rows) {
  Couplings<B> coupled(problem);
  const auto values = [&](Index q) { return problem.start.data() + Offset{q} * B; };
  for (std::size_t k = 0; k < rows.vertex.size(); ++k)
    for (Offset at = rows.first[k]; at < rows.first[k + 1]; ++at) {
      const Index p = rows.vertex[k], q = rows.column[at];
      const double* M = rows.value.data() + at * B * B;
      if (problem.fixed[q]) {
        block::add_product<B>(M, values(q), coupled.at(p));
        continue;
      }
      double Mv[B];
      block::transposed_product<B>(M, values(p), Mv);
      for (int i = 0; i < B; ++i) coupled.at(q)[i] += Mv[i];
    }
  problem.prescribed_energy = problem.prescribed_work = 0;
  problem.coupled.clear();
  problem.coupling.clear();
  coupled.each([&](Index p, const double* Av) { prescribe(problem, p, Av); });
}

template struct PrescribedRows<1>;
template struct PrescribedRows<2>;
template struct PrescribedRows<3>;
template void prescribe(DiscreteProblem<1>&, const PrescribedRows<1>&);
template void prescribe(DiscreteProblem<2>&, const PrescribedRows<2>&);
template void prescribe(DiscreteProblem<3>&, const PrescribedRows<3>&);

}  // namespace signorini
