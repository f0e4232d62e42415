#pragma once
#include "estimators/certificate/contact_interface.hpp"
#include "estimators/certificate/quadratic_function.hpp"

namespace signorini {

/// That two bodies do not overlap, between nodes of any meshes: on each piece of an interface the distance that is left
/// is quadratic, and not negative where no Bernstein coefficient of it is. Each is linear in the values at vertices and
/// the coefficients of edges, of both sides:
///     left = gap - normal . sum over dofs of factor * value.
/// Dofs are vertices, then edges.
template <int D, int B>
class JumpConditions {
 public:
  static constexpr int per_piece = D * (D + 1) / 2;  ///< corners, then edges in the order of simplex_edges

  /// @param outer per outer face its number in Incidence::sides
  void build(const Mesh<D>& mesh, const Incidence<D>& incidence, const std::vector<Index>& outer,
             const std::vector<ContactInterface<D>>& interfaces);

  bool none() const { return rows_.empty(); }
  const std::vector<Index>& dofs() const { return dofs_; }  ///< that have a part in them, ascending
  Index row(Index interface, std::size_t piece, int k) const {
    return first_of_interface_[interface] + static_cast<Index>(piece) * per_piece + k;
  }

  /// What is left, per row.
  std::vector<double> left(const std::vector<double>& at_vertex, const std::vector<double>& of_edge) const;

  /// By how much the slave of a row moves more than the master: the values at corners of pieces, between them the
  /// Bernstein coefficients.
  std::array<double, B> jump(Index row, const std::vector<double>& at_vertex, const std::vector<double>& of_edge) const;

  struct Part {
    Index row;
    double factor;
  };
  /// Where a dof has a part, by ascending row; none: nowhere.
  std::pair<const Part*, const Part*> parts(Index dof) const;
  const std::array<double, B>& normal(Index row) const { return rows_[row].normal; }

 private:
  struct Row {
    std::array<double, B> normal;
    double gap;
    Offset first;  // in terms_
  };
  struct Term {
    Index dof;
    double factor;
  };
  void add_side(const Incidence<D>& incidence, const Mesh<D>& mesh, Index face, const std::array<double, D>& P,
                const std::array<double, D>& Q, double sign);

  Index vertices_ = 0;
  std::vector<Index> first_of_interface_;
  std::vector<Row> rows_;
  std::vector<Term> terms_;
  std::vector<Index> dofs_;
  std::vector<Offset> first_part_;
  std::vector<Part> parts_;
};

}  // namespace signorini
