#include "amg/coarsening/quadratic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "amg/coarsening/strength.hpp"

namespace signorini {
namespace {

constexpr double without_zeros = 0.7;  // part of the couplings of a midpoint that its ends have, too
constexpr double of_no_end = 0.3;      // coupling of a midpoint to what is no end over that to an end
constexpr double zero = 1e-8;          // of couplings over the diagonal
constexpr double mostly = 0.6;         // vectors that are midpoints, were it quadratic elements
constexpr double sure = 0.3;           // midpoints between two ends, away from all that is prescribed
constexpr double most_coarse = 0.4;    // vectors
constexpr Index tried = 500;           // vectors, before all are looked at

template <int B>
double trace(const double* block) {
  double sum = 0;
  for (int i = 0; i < B; ++i) sum += block[i * B + i];
  return sum;
}

/// The vertices among the vectors of a matrix, and the ends of what lies between them.
template <int B>
class Elements {
 public:
  Elements(const BlockMatrix<B>& A, const std::vector<Flags>& off)
      : A_(A), off_(off), is_vertex_(static_cast<std::size_t>(A.size())) {
    for (Index p = 0; p < A.size(); ++p) {
      for (Offset k = A.row[p] + 1; k < A.row[p + 1]; ++k)
        if (counts(p, k)) to_.push_back(A.column[k]);
      row_.push_back(static_cast<Offset>(to_.size()));
    }
  }

  /// Finds vertices and ends. In the plane, and where meshes are structured, some of what an element couples is zero:
  /// then the ends are coupled to most only of what a midpoint is coupled to.
  /// @return whether these are quadratic elements
  bool find() {
    for (const double part : {1.0, without_zeros}) {
      contained_ = part;
      if (part_like_midpoints() < mostly) continue;
      find_ends();
      if (are_quadratic()) return true;
    }
    return false;
  }

  Prolongation interpolation() const {
    std::vector<Index> number(ends_.size(), none);
    Prolongation P;
    for (Index p = 0; p < A_.size(); ++p)
      if (ends_[p].kind == Kind::coarse) {
        number[p] = P.coarse++;
        P.twin.push_back(p);
      }
    for (Index p = 0; p < A_.size(); ++p) {
      if (number[p] != none) append(number[p], 1, P);
      for (const Index end : ends_[p].vertex)
        if (end != none) append(number[end], 0.5, P);
      P.row.push_back(static_cast<Offset>(P.column.size()));
    }
    return P;
  }

 private:
  static constexpr Index none = -1;
  static constexpr Flags every_component = (1u << B) - 1;

  enum class Kind { fine, coarse, unclear };
  struct Ends {
    Kind kind;
    std::array<Index, 2> vertex{none, none};  ///< of a midpoint, ascending; a prescribed one is none
  };
  /// A vertex that is coupled to all that a vector is coupled to.
  struct Candidate {
    Index vertex;
    double coupling;  ///< over the diagonal
  };

  static void append(Index column, double weight, Prolongation& P) {
    P.column.push_back(column);
    P.weight.push_back(weight);
  }

  bool is_off(Index p) const { return off_[p] == every_component; }
  /// Whether an entry of row p is a coupling, and more than rounding.
  bool counts(Index p, Offset k) const {
    return !is_off(p) && !is_off(A_.column[k]) && square<B>(A_.at(k)) > zero * zero * square<B>(A_.diagonal(p));
  }
  std::span<const Index> couplings(Index p) const {  // ascending, without itself
    return {to_.data() + row_[p], to_.data() + row_[p + 1]};
  }

  double part_like_midpoints() const {
    const Index step = std::max<Index>(1, A_.size() / tried);
    double alike = 0, looked_at = 0;
    for (Index p = 0; p < A_.size(); p += step) {
      alike += !is_off(p) && is_within_another(p);
      looked_at += !is_off(p);
    }
    return looked_at > 0 ? alike / looked_at : 0;
  }

  /// Whether q is coupled to all that p is coupled to, but for a few.
  bool contains(Index q, Index p) const {
    const auto of_p = couplings(p), of_q = couplings(q);
    auto missing = static_cast<Offset>((1 - contained_) * static_cast<double>(of_p.size() + 1));
    auto at = of_q.begin();
    for (const Index r : of_p) {
      at = std::lower_bound(at, of_q.end(), r);
      if (r != q && (at == of_q.end() || *at != r) && --missing < 0) return false;
    }
    return true;
  }

  bool is_within_another(Index p) const {
    return std::ranges::any_of(couplings(p),
                               [&](Index q) { return couplings(q).size() > couplings(p).size() && contains(q, p); });
  }

  void find_ends() {
    ends_.clear();
    for (Index p = 0; p < A_.size(); ++p) is_vertex_[p] = !is_off(p) && !is_within_another(p);
    for (Index p = 0; p < A_.size(); ++p) ends_.push_back(is_vertex_[p] ? Ends{Kind::coarse} : ends_of(p));
    // At corners a vertex may be within others.
    for (Index p = 0; p < A_.size(); ++p)
      if (ends_[p].kind == Kind::unclear && !is_midpoint(p)) is_vertex_[p] = true;
    for (Index p = 0; p < A_.size(); ++p)
      if (ends_[p].kind == Kind::unclear) {
        if (!is_vertex_[p]) ends_[p] = ends_of(p);
        if (ends_[p].kind == Kind::unclear) ends_[p].kind = Kind::coarse;
      }
  }

  /// Whether vertices push each other, and most is between two ends and keeps constants.
  bool are_quadratic() const {
    double between = 0, midpoints = 0, vertices = 0, push = 0;
    for (Index p = 0; p < A_.size(); ++p) {
      if (ends_[p].kind == Kind::coarse) {
        ++vertices;
        for (Offset k = A_.row[p] + 1; is_vertex_[p] && k < A_.row[p + 1]; ++k)
          if (is_vertex_[A_.column[k]]) push += trace<B>(A_.at(k)) / trace<B>(A_.diagonal(p));
      } else if (!is_off(p)) {
        ++midpoints;
        between += ends_[p].vertex[1] != none && keeps_constants(p);
      }
    }
    return push > 0 && between >= sure * midpoints && vertices <= most_coarse * (vertices + midpoints);
  }

  void find_candidates(Index p) {
    candidates_.clear();
    const double diagonal = trace<B>(A_.diagonal(p));
    for (Offset k = A_.row[p] + 1; k < A_.row[p + 1]; ++k)
      if (const Index q = A_.column[k];
          is_vertex_[q] && counts(p, k) && couplings(q).size() >= couplings(p).size() && contains(q, p))
        candidates_.push_back({q, trace<B>(A_.at(k)) / diagonal});
  }

  bool is_midpoint(Index p) {
    find_candidates(p);
    return std::ranges::any_of(candidates_, pulls);
  }

  Ends ends_of(Index p) {
    if (is_off(p)) return {Kind::fine};
    find_candidates(p);
    const bool free = keeps_constants(p);
    if (std::ranges::any_of(candidates_, pulls))
      leave_those_that_pull();
    else if (!free || is_corner(p))
      candidates_.clear();
    const std::size_t found = candidates_.size();
    if (found > 2 || (found < 2 && free)) return {Kind::unclear};
    Ends out{Kind::fine};
    for (std::size_t k = 0; k < found; ++k) out.vertex[k] = candidates_[k].vertex;
    return out;
  }

  /// Vertices push each other, midpoints and their ends pull; at right angles there is neither.
  static bool pulls(const Candidate& c) { return c.coupling < -zero; }

  /// At the boundary there are other vertices that are coupled to all around an edge.
  void leave_those_that_pull() {
    const double most = std::ranges::min(candidates_, {}, &Candidate::coupling).coupling;
    std::erase_if(candidates_, [&](const Candidate& c) { return c.coupling > of_no_end * most; });
  }

  /// Where a vertex is within another one, the midpoint between them is coupled to the same vectors as it is itself.
  bool is_corner(Index p) const {
    return std::ranges::any_of(couplings(p), [&](Index q) {
      return !is_vertex_[q] && couplings(q).size() == couplings(p).size() && contains(q, p);
    });
  }

  /// Whether nothing prescribed is near.
  bool keeps_constants(Index p) const {
    std::array<double, B * B> sum{};
    for (Offset k = A_.row[p]; k < A_.row[p + 1]; ++k)
      for (int i = 0; i < B * B; ++i) sum[i] += A_.at(k)[i];
    return square<B>(sum.data()) <= zero * zero * square<B>(A_.diagonal(p));
  }

  const BlockMatrix<B>& A_;
  const std::vector<Flags>& off_;
  std::vector<Offset> row_{0};  // couplings that are not zero
  std::vector<Index> to_;
  double contained_ = 1;  // part of the couplings of a midpoint that its ends have
  std::vector<bool> is_vertex_;
  std::vector<Ends> ends_;
  std::vector<Candidate> candidates_;
};

}  // namespace

template <int B>
std::optional<Prolongation> quadratic_interpolation(const BlockMatrix<B>& A, const std::vector<Flags>& off) {
  Elements<B> elements(A, off);
  if (!elements.find()) return {};
  return elements.interpolation();
}

template std::optional<Prolongation> quadratic_interpolation(const BlockMatrix<1>&, const std::vector<Flags>&);
template std::optional<Prolongation> quadratic_interpolation(const BlockMatrix<2>&, const std::vector<Flags>&);
template std::optional<Prolongation> quadratic_interpolation(const BlockMatrix<3>&, const std::vector<Flags>&);

}  // namespace signorini
