#include "amg/coarsening/tentative.hpp"

#include "core/base/rounding.hpp"

#include <cmath>

namespace signorini {
namespace {

constexpr double dependent = rounding_of_bases;  // part of a mode that others leave of it

/// The nodes of each aggregate, in compressed rows.
struct Members {
  std::vector<Offset> row;
  std::vector<Index> node;

  explicit Members(const Aggregates& aggregates) : row(aggregates.root.size() + 1, 0) {
    for (const Index a : aggregates.of)
      if (a >= 0) ++row[static_cast<std::size_t>(a) + 1];
    for (std::size_t a = 1; a < row.size(); ++a) row[a] += row[a - 1];
    node.resize(static_cast<std::size_t>(row.back()));
    std::vector<Offset> next(row.begin(), row.end() - 1);
    for (std::size_t p = 0; p < aggregates.of.size(); ++p)
      if (const Index a = aggregates.of[p]; a >= 0) node[next[a]++] = static_cast<Index>(p);
  }
};

/// The factorisation of a tall matrix, by columns: N = Q R with orthonormal columns of Q, or zero ones where those
/// before it leave nothing of a column.
class Factors {
 public:
  Factors(std::size_t rows, Index columns)
      : rows_(rows), columns_(columns), Q_(rows * columns), R_(static_cast<std::size_t>(columns) * columns, 0.0) {}

  double& entry(std::size_t row, Index column) { return Q_[column * rows_ + row]; }
  double& R(Index row, Index column) { return R_[static_cast<std::size_t>(row) * columns_ + column]; }

  void orthonormalise() {
    for (Index c = 0; c < columns_; ++c) {
      const double before = norm(c);
      for (int again = 0; again < 2; ++again)
        for (Index d = 0; d < c; ++d) {
          const double part = product(d, c);
          R(d, c) += part;
          for (std::size_t i = 0; i < rows_; ++i) entry(i, c) -= part * entry(i, d);
        }
      const double left = norm(c);
      R(c, c) = left > dependent * before ? left : 0;
      for (std::size_t i = 0; i < rows_; ++i) entry(i, c) = R(c, c) > 0 ? entry(i, c) / left : 0;
    }
  }

 private:
  double product(Index c, Index d) {
    double sum = 0;
    for (std::size_t i = 0; i < rows_; ++i) sum += entry(i, c) * entry(i, d);
    return sum;
  }
  double norm(Index c) { return std::sqrt(product(c, c)); }

  std::size_t rows_;
  Index columns_;
  std::vector<double> Q_, R_;
};

}  // namespace

template <int B>
Tentative tentative_interpolation(const NearNullSpace& fine, Index group, const Aggregates& aggregates) {
  const Index modes = fine.modes, per_node = group * B;
  const Members members(aggregates);
  Tentative out;
  out.per_aggregate = (modes + B - 1) / B;
  out.block.assign(aggregates.of.size() * group * out.per_aggregate * B * B, 0.0);
  out.coarse.modes = modes;
  out.coarse.value.assign(aggregates.root.size() * out.per_aggregate * B * modes, 0.0);
  for (Index a = 0; a < aggregates.size(); ++a) {
    const Offset first = members.row[a], count = members.row[a + 1] - first;
    Factors factors(static_cast<std::size_t>(count * per_node), modes);
    for (Offset k = 0; k < count * per_node; ++k) {
      const Offset unknown = Offset{members.node[first + k / per_node]} * per_node + k % per_node;
      for (Index mode = 0; mode < modes; ++mode) factors.entry(k, mode) = fine.at(unknown)[mode];
    }
    factors.orthonormalise();
    const double scale = std::sqrt(static_cast<double>(count));
    for (Offset k = 0; k < count * per_node; ++k) {
      const Offset unknown = Offset{members.node[first + k / per_node]} * per_node + k % per_node;
      for (Index mode = 0; mode < modes; ++mode) {
        const Offset block = unknown / B * out.per_aggregate + mode / B;
        out.block[(block * B + unknown % B) * B + mode % B] = scale * factors.entry(k, mode);
      }
    }
    for (Index i = 0; i < modes; ++i)
      for (Index mode = 0; mode < modes; ++mode)
        out.coarse.at(Offset{a} * out.per_aggregate * B + i)[mode] = factors.R(i, mode) / scale;
  }
  return out;
}

template Tentative tentative_interpolation<1>(const NearNullSpace&, Index, const Aggregates&);
template Tentative tentative_interpolation<2>(const NearNullSpace&, Index, const Aggregates&);
template Tentative tentative_interpolation<3>(const NearNullSpace&, Index, const Aggregates&);

}  // namespace signorini
