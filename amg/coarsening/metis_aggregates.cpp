#include "amg/coarsening/metis_aggregates.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <mutex>

#include "core/base/error.hpp"

namespace signorini {
namespace {

constexpr Index unassigned = -1;
constexpr const char* key = "solver.aggregates";

/// The sum of both directions: a coupling may be strong for one of its ends alone.
StrengthGraph symmetric(const StrengthGraph& graph) {
  const StrengthGraph in = reversed(graph), out = reversed(in);
  StrengthGraph both;
  std::vector<Coupling> found;
  for (Index p = 0; p < graph.size(); ++p) {
    found.clear();
    std::ranges::merge(in.of(p), out.of(p), std::back_inserter(found), {}, &Coupling::to, &Coupling::to);
    const std::size_t first = both.to.size();
    for (const Coupling& c : found)
      if (both.to.size() > first && both.to.back() == c.to)
        both.strength.back() += c.strength;
      else
        both.add(c);
    both.end_row();
  }
  return both;
}

/// The vectors that are coupled to any, as METIS takes them.
struct Vertices {
  std::vector<Index> vector;
  std::vector<idx_t> row{0}, column, weight;
};

/// Of integer weights over strengths, which are at most two: METIS adds up the weights of all couplings.
double scale(Offset couplings) {
  constexpr Offset most = std::numeric_limits<idx_t>::max();
  if (couplings > most / 3)
    input_error(key, fmt::format("found {} strong couplings, expected 'greedy' for more than {}, which METIS cannot "
                                 "count",
                                 couplings, most / 3));
  constexpr double fine_enough = 100;
  return std::min(fine_enough, (static_cast<double>(most) / static_cast<double>(couplings) - 1) / 2);
}

Vertices vertices_of(const StrengthGraph& graph) {
  Vertices out;
  std::vector<idx_t> number(static_cast<std::size_t>(graph.size()));
  for (Index p = 0; p < graph.size(); ++p) {
    number[p] = static_cast<idx_t>(out.vector.size());
    if (!graph.neighbours(p).empty()) out.vector.push_back(p);
  }
  const double unit = scale(static_cast<Offset>(graph.to.size()));
  for (const Index p : out.vector) {
    for (const Coupling& c : graph.of(p)) {
      out.column.push_back(number[c.to]);
      out.weight.push_back(1 + static_cast<idx_t>(unit * c.strength));
    }
    out.row.push_back(static_cast<idx_t>(out.column.size()));
  }
  return out;
}

/// Per vertex its part. By recursive bisection: METIS's k-way partition begins with it, takes four times as long, and
/// parts this small it leaves in up to five times as many pieces.
std::vector<idx_t> cut_into(idx_t parts, Vertices& graph) {
  auto vertices = static_cast<idx_t>(graph.vector.size());
  std::vector<idx_t> part(graph.vector.size(), 0);
  if (parts < 2) return part;  // nothing to cut, and METIS divides by the logarithm of their number
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  idx_t constraints = 1, cut = 0;
  static std::mutex alone;  // METIS draws from rand(), which the threads of a process share
  const std::lock_guard<std::mutex> lock(alone);
  const int status =
      METIS_PartGraphRecursive(&vertices, &constraints, graph.row.data(), graph.column.data(), nullptr, nullptr,
                               graph.weight.data(), &parts, nullptr, nullptr, options, &cut, part.data());
  if (status != METIS_OK)
    input_error(key, fmt::format("METIS {} for {} vectors, expected 'greedy'",
                                 status == METIS_ERROR_MEMORY ? "has not enough memory" : "failed", vertices));
  return part;
}

/// The connected pieces of parts.
struct Pieces {
  std::vector<Index> of;     // per vector, -1: none
  std::vector<Index> first;  // per piece the first vector
};

Pieces pieces(const StrengthGraph& graph, const std::vector<Index>& part) {
  Pieces out{std::vector<Index>(part.size(), unassigned), {}};
  std::vector<Index> reached;
  for (Index start = 0; start < graph.size(); ++start) {
    if (part[start] == unassigned || out.of[start] != unassigned) continue;
    const auto piece = static_cast<Index>(out.first.size());
    out.first.push_back(start);
    out.of[start] = piece;
    reached.assign(1, start);
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (const Coupling& c : graph.of(reached[k]))
        if (out.of[c.to] == unassigned && part[c.to] == part[start]) {
          out.of[c.to] = piece;
          reached.push_back(c.to);
        }
  }
  return out;
}

}  // namespace

Aggregates MetisAggregator::aggregate(const StrengthGraph& graph) const {
  const StrengthGraph both = symmetric(graph);
  Vertices vertices = vertices_of(both);
  const std::vector<idx_t> found = cut_into(signorini::aggregate(graph).size(), vertices);
  std::vector<Index> part(static_cast<std::size_t>(graph.size()), unassigned);
  for (std::size_t k = 0; k < found.size(); ++k) part[vertices.vector[k]] = static_cast<Index>(found[k]);
  Pieces found_pieces = pieces(both, part);
  return rooted_at_the_surface(both, std::move(found_pieces.of), std::move(found_pieces.first));
}

}  // namespace signorini
