#include "amg/coarsening/reach_from_twins.hpp"

#include <utility>

namespace signorini {

namespace {

/// Of one row, from `begin` on.
void truncate(const std::vector<char>& constrained, Offset begin, Prolongation& P) {
  double all = 0, kept = 0;
  auto to = static_cast<std::size_t>(begin);
  for (std::size_t k = to; k < P.column.size(); ++k) {
    all += P.weight[k];
    if (!constrained[P.column[k]]) continue;
    kept += P.weight[k];
    P.column[to] = P.column[k];
    P.weight[to++] = P.weight[k];
  }
  if (to == P.column.size()) return;
  const double scale = all / kept;  // of no use where weights of both signs cancel
  for (std::size_t k = static_cast<std::size_t>(begin); scale > 0 && scale < 1e3 && k < to; ++k) P.weight[k] *= scale;
  P.column.resize(to);
  P.weight.resize(to);
}

}  // namespace

void reach_from_twins(const std::vector<Index>& slot, Prolongation& P) {
  if (slot.empty()) return;
  const std::vector<Index> twin = P.twins();
  std::vector<char> constrained(twin.size());
  for (std::size_t q = 0; q < twin.size(); ++q) constrained[q] = twin[q] < 0 || slot[twin[q]] >= 0;
  Prolongation out = P;
  out.twin = twin;
  out.row.assign(1, 0);
  out.column.clear();
  out.weight.clear();
  for (Index p = 0; p < P.fine(); ++p) {
    out.column.insert(out.column.end(), P.column.begin() + P.row[p], P.column.begin() + P.row[p + 1]);
    out.weight.insert(out.weight.end(), P.weight.begin() + P.row[p], P.weight.begin() + P.row[p + 1]);
    if (slot[p] >= 0) truncate(constrained, out.row.back(), out);
    out.row.push_back(static_cast<Offset>(out.column.size()));
  }
  P = std::move(out);
}

}  // namespace signorini
