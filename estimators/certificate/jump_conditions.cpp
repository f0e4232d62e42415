#include "estimators/certificate/jump_conditions.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"

namespace signorini {
namespace {

/// Factors of less are rounding.
constexpr double no_factor = 1e-12;

}  // namespace

template <int D, int B>
void JumpConditions<D, B>::build(const Mesh<D>& mesh, const Incidence<D>& incidence, const std::vector<Index>& outer,
                                 const std::vector<ContactInterface<D>>& interfaces) {
  vertices_ = mesh.vertices();
  constexpr auto ends = simplex_edges<D - 1>();
  for (const ContactInterface<D>& interface : interfaces) {
    first_of_interface_.push_back(static_cast<Index>(rows_.size()));
    std::array<double, B> normal{};
    for (int i = 0; i < std::min(B, D); ++i) normal[i] = interface.normal[i];
    for (const FacingPiece<D>& piece : interface.pieces) {
      const auto add = [&](int P, int Q) {
        rows_.push_back({normal, (piece.gap[P] + piece.gap[Q]) / 2, static_cast<Offset>(terms_.size())});
        add_side(incidence, mesh, outer[piece.slave], piece.on_slave[P], piece.on_slave[Q], 1);
        add_side(incidence, mesh, outer[piece.master], piece.on_master[P], piece.on_master[Q], -1);
      };
      for (int P = 0; P < D; ++P) add(P, P);
      for (const auto [P, Q] : ends) add(P, Q);
    }
  }
  for (const Term& term : terms_) dofs_.push_back(term.dof);
  std::ranges::sort(dofs_);
  dofs_.erase(std::unique(dofs_.begin(), dofs_.end()), dofs_.end());
  const auto number = [&](Index dof) { return std::ranges::lower_bound(dofs_, dof) - dofs_.begin(); };
  first_part_.assign(dofs_.size() + 1, 0);
  for (const Term& term : terms_) ++first_part_[number(term.dof) + 1];
  for (std::size_t k = 1; k < first_part_.size(); ++k) first_part_[k] += first_part_[k - 1];
  parts_.resize(terms_.size());
  std::vector<Offset> next(first_part_.begin(), first_part_.end() - 1);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto last = r + 1 < rows_.size() ? rows_[r + 1].first : static_cast<Offset>(terms_.size());
    for (Offset k = rows_[r].first; k < last; ++k)
      parts_[next[number(terms_[k].dof)]++] = {static_cast<Index>(r), terms_[k].factor};
  }
}

/// The polar form of the side's function at two points: of phi_i the mean of its values, of a bubble 4 phi_a phi_b
/// twice what is symmetric.
template <int D, int B>
void JumpConditions<D, B>::add_side(const Incidence<D>& incidence, const Mesh<D>& mesh, Index face,
                                    const std::array<double, D>& P, const std::array<double, D>& Q, double sign) {
  const auto& sides = incidence.sides[face];
  const auto v = face_vertices<D>(mesh, sides);
  const auto add = [&](Index dof, double factor) {
    if (std::fabs(factor) > no_factor) terms_.push_back({dof, sign * factor});
  };
  for (int i = 0; i < D; ++i) add(v[i], (P[i] + Q[i]) / 2);
  const auto edge = edges_of_face(mesh, incidence, face);
  constexpr auto ends = simplex_edges<D - 1>();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const auto [a, b] = ends[k];
    add(vertices_ + edge[k], 2 * (P[a] * Q[b] + P[b] * Q[a]));
  }
}

template <int D, int B>
std::vector<double> JumpConditions<D, B>::left(const std::vector<double>& at_vertex,
                                               const std::vector<double>& of_edge) const {
  std::vector<double> out;
  out.reserve(rows_.size());
  for (std::size_t r = 0; r < rows_.size(); ++r)
    out.push_back(rows_[r].gap - dot(rows_[r].normal, jump(static_cast<Index>(r), at_vertex, of_edge)));
  return out;
}

template <int D, int B>
std::array<double, B> JumpConditions<D, B>::jump(Index row, const std::vector<double>& at_vertex,
                                                 const std::vector<double>& of_edge) const {
  std::array<double, B> out{};
  const std::size_t next = static_cast<std::size_t>(row) + 1;
  const auto last = next < rows_.size() ? rows_[next].first : static_cast<Offset>(terms_.size());
  for (Offset k = rows_[row].first; k < last; ++k) {
    const Term& term = terms_[k];
    const bool vertex = term.dof < vertices_;
    if (!vertex && of_edge.empty()) continue;
    const double* value =
        vertex ? at_vertex.data() + Offset{term.dof} * B : of_edge.data() + Offset{term.dof - vertices_} * B;
    for (int i = 0; i < B; ++i) out[i] += term.factor * value[i];
  }
  return out;
}

template <int D, int B>
auto JumpConditions<D, B>::parts(Index dof) const -> std::pair<const Part*, const Part*> {
  const auto found = std::ranges::lower_bound(dofs_, dof);
  if (found == dofs_.end() || *found != dof) return {nullptr, nullptr};
  const auto k = found - dofs_.begin();
  return {parts_.data() + first_part_[k], parts_.data() + first_part_[k + 1]};
}

template class JumpConditions<2, 1>;
template class JumpConditions<3, 1>;
template class JumpConditions<2, 2>;
template class JumpConditions<3, 3>;

}  // namespace signorini
