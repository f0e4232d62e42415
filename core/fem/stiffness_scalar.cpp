#include "core/fem/stiffness_scalar.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/fem/checked_element.hpp"
#include "core/fem/material.hpp"

namespace signorini {
namespace {

// Assembles the rows of a scalar problem one after the other, each as soon as the last element around its vertex has
// been visited. Until then the terms of its entries above the diagonal wait in a ring buffer, which holds no more than
// the bandwidth of the matrix asks for: no search for an entry, and little memory that is not in a cache.
template <int D>
class ScalarAssembler {
 public:
  ScalarAssembler(const Mesh<D>& mesh, const Model<1>& model)
      : mesh_(mesh), model_(model), first_(mesh.points.size() + 1), last_(mesh.points.size(), -1) {
    count_terms();
    const std::size_t n = mesh.points.size(), most = n + 2 * estimated_edges(mesh);
    diagonal_.resize(n);
    lower_.resize(n);
    slot_.assign(n, -1);
    A_.row.reserve(n + 1);
    A_.column.reserve(most);
    A_.value.reserve(most);
  }

  BlockMatrix<1> assemble() {
    const MaterialLaw<1> law(model_);
    double diffusion = law.constant() ? law.at({}).diffusion : 0;
    Index row = 0, highest = 0;
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      const Simplex<D>& vertices = mesh_.elements[e];
      const LinearElement<D> s = checked_element(mesh_, vertices, model_.origin);
      if (!law.constant()) diffusion = law.at(site<D>(centroid<D>(mesh_, vertices), model_.t)).diffusion;
      for (const Index p : vertices) highest = std::max(highest, p);
      make_room(first_[row], first_[highest]);
      add(vertices, s, s.measure * diffusion);
      while (row < mesh_.vertices() && last_[row] <= static_cast<Index>(e)) append_row(row++);
    }
    mirror();
    return std::move(A_);
  }

 private:
  struct Term {
    Index column;
    double value;
  };

  // Those of row p are numbered from first_[p] on.
  void count_terms() {
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
      const Simplex<D>& v = mesh_.elements[e];
      for (const auto [a, b] : simplex_edges<D>()) ++first_[std::min(v[a], v[b]) + 1];
      for (const Index p : v) last_[p] = static_cast<Index>(e);
    }
    const auto most = static_cast<std::size_t>(*std::max_element(first_.begin(), first_.end()));
    column_.resize(most + 1);
    value_.resize(most + 1);
    for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
    next_.assign(first_.begin(), first_.end() - 1);
  }

  Term& term(Offset k) { return ring_[k & (static_cast<Offset>(ring_.size()) - 1)]; }

  void make_room(Offset begin, Offset end) {
    const auto size = static_cast<Offset>(ring_.size());
    if (end - begin <= size) return;
    std::vector<Term> larger(std::bit_ceil(static_cast<std::size_t>(end - begin)));
    std::swap(ring_, larger);
    for (Offset k = begin; k < begin + size; ++k) term(k) = larger[k & (size - 1)];
  }

  void add(const Simplex<D>& v, const LinearElement<D>& s, double weight) {
    for (int a = 0; a <= D; ++a) diagonal_[v[a]] += weight * dot(s.gradient[a], s.gradient[a]);
    for (const auto [a, b] : simplex_edges<D>())
      term(next_[std::min(v[a], v[b])]++) = {std::max(v[a], v[b]), weight * dot(s.gradient[a], s.gradient[b])};
  }

  void append_row(Index p) {
    const Index count = drop_zeros(p, sum_terms(p));
    std::sort(column_.begin(), column_.begin() + count);
    A_.column.push_back(p);
    A_.value.push_back(diagonal_[p]);
    A_.column.resize(A_.column.size() + lower_[p]);
    A_.value.resize(A_.column.size());
    for (Index i = 0; i < count; ++i) {
      const Index q = column_[i];
      A_.column.push_back(q);
      A_.value.push_back(std::exchange(value_[std::exchange(slot_[q], -1)], 0));
      ++lower_[q];
    }
    A_.row.push_back(static_cast<Offset>(A_.column.size()));
  }

  // The columns of row p above the diagonal go to column_, their sums to where slot_ says. Returns how many.
  Index sum_terms(Index p) {
    Index* const slot = slot_.data();
    Index* const column = column_.data();
    Index count = 0;
    for (Offset k = first_[p]; k < first_[p + 1]; ++k) {
      const auto [q, value] = term(k);
      const Index known = slot[q], here = known < 0 ? count : known;  // without a branch that nobody could predict
      column[count] = q;
      count += known < 0;
      slot[q] = here;
      value_[here] += value;
    }
    return count;
  }

  // Leaves out what vanishes but for rounding: right angles uncouple many neighbours. All elements that contribute to
  // an entry have been added to both diagonal entries.
  Index drop_zeros(Index p, Index count) {
    constexpr double zero = 1e-15;
    const double scale = std::sqrt(diagonal_[p]) * zero;
    Index kept = 0;
    for (Index i = 0; i < count; ++i) {
      const Index q = column_[i];
      double& value = value_[slot_[q]];
      column_[kept] = q;
      if (std::abs(value) > scale * std::sqrt(diagonal_[q])) {
        ++kept;
      } else {
        value = 0;
        slot_[q] = -1;
      }
    }
    return kept;
  }

  // What lies below the diagonal is what lies above it. Rows ascend, so row q meets its lower columns p in order.
  void mirror() {
    std::copy(A_.row.begin(), A_.row.end() - 1, next_.begin());
    for (Index p = 0; p < A_.size(); ++p)
      for (Offset k = A_.row[p] + 1 + lower_[p]; k < A_.row[p + 1]; ++k) {
        const Offset below = ++next_[A_.column[k]];
        A_.column[below] = p;
        A_.value[below] = A_.value[k];
      }
  }

  const Mesh<D>& mesh_;
  const Model<1>& model_;
  std::vector<Offset> first_, next_;  // per row: number of its first term, and of the next one to come
  std::vector<Index> last_;           // per vertex: the last element around it
  std::vector<Term> ring_;            // term k at k modulo the size, a power of two
  std::vector<double> diagonal_;
  std::vector<Index> lower_;  // per row: entries below the diagonal so far
  std::vector<Index> slot_, column_;
  std::vector<double> value_;
  BlockMatrix<1> A_;
};

}  // namespace

template <int D>
BlockMatrix<1> scalar_stiffness(const Mesh<D>& mesh, const Model<1>& model) {
  return ScalarAssembler<D>(mesh, model).assemble();
}

template BlockMatrix<1> scalar_stiffness(const Mesh<2>&, const Model<1>&);
template BlockMatrix<1> scalar_stiffness(const Mesh<3>&, const Model<1>&);

}  // namespace signorini
