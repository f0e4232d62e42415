#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/algebra/block_matrix.hpp"

namespace signorini {

/// How strongly a vector is coupled to another one, relative to the strongest coupling it has.
struct Coupling {
  Index to;
  float strength;
};

/// Those of one vector.
struct Couplings {
  struct Iterator {
    using difference_type = std::ptrdiff_t;
    using value_type = Coupling;
    const Index* to;
    const float* strength;

    Coupling operator*() const { return {*to, *strength}; }
    Iterator& operator++() {
      ++to;
      ++strength;
      return *this;
    }
    Iterator operator++(int) { return {to++, strength++}; }
    bool operator==(const Iterator& other) const { return to == other.to; }
  };
  Iterator first, last;

  Iterator begin() const { return first; }
  Iterator end() const { return last; }
};

/// The strong couplings of each vector, in compressed rows.
struct StrengthGraph {
  std::vector<Offset> row{0};
  std::vector<Index> to;
  std::vector<float> strength;
  /// Per vector, in [0, 1]: the part of a scalar's diagonal that its couplings to others balance, which is less than
  /// one next to prescribed values; one for blocks.
  std::vector<double> balanced;

  Index size() const { return static_cast<Index>(row.size()) - 1; }
  std::span<const Index> neighbours(Index p) const { return {to.data() + row[p], to.data() + row[p + 1]}; }
  Couplings of(Index p) const {
    return {{to.data() + row[p], strength.data() + row[p]}, {to.data() + row[p + 1], strength.data() + row[p + 1]}};
  }

  void reserve(Index vectors, std::size_t couplings) {
    row.reserve(static_cast<std::size_t>(vectors) + 1);
    to.reserve(couplings);
    strength.reserve(couplings);
  }
  void add(const Coupling& c) {
    to.push_back(c.to);
    strength.push_back(c.strength);
  }
  void end_row() { row.push_back(static_cast<Offset>(to.size())); }
};

/// The square of the Frobenius norm of a block.
template <int B>
double square(const double* block) {
  double sum = 0;
  for (int i = 0; i < B * B; ++i) sum += block[i] * block[i];
  return sum;
}

/// Whom the couplings of a graph come from, in rows that ascend; `balanced` is left out.
StrengthGraph reversed(const StrengthGraph& graph);

/// Couplings that are no small part of the largest one of their row. A scalar coupling counts where it is negative, a
/// block by its norm, so that local rotations change nothing.
/// @param off components prescribed; vectors without any other one are coupled to nothing
template <int B>
StrengthGraph strong_couplings(const BlockMatrix<B>& A, const std::vector<Flags>& off);

/// The same between groups of consecutive vectors, by the norms of all that couples two of them.
/// @param part per group, from NearNullSpace: none is coupled to those of other parts
/// @param at_both_ends strong only where it is for both groups: at the edges and ends of bodies of stretched cells all
///     strong couplings are halved, and the weak ones to where they are not would count
template <int B>
StrengthGraph strong_couplings_of_groups(const BlockMatrix<B>& A, const std::vector<Flags>& off, Index group,
                                         const std::vector<Index>& part = {}, bool at_both_ends = false);

}  // namespace signorini
