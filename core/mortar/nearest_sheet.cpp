#include "core/mortar/nearest_sheet.hpp"

#include "core/base/dot.hpp"
#include "core/mesh/simplex.hpp"

namespace signorini::mortar {
namespace {

// Of what the master turns by at an edge the slave is inclined to the sheet that it lies along by no more: where it
// looks at the edge itself it may touch both sides of that.
constexpr double along_sheet = 0.25;

}  // namespace

template <int D>
void NearestSheet<D>::choose(std::vector<SeenPart>& parts, const Point<D>& direction, double size) {
  numbers_.clear();
  for (const SeenPart& p : parts) numbers_.push_back(p.part);
  sheets_.find(master_.side(), numbers_, &master_);
  apart_ = false;
  nearest_ = parts.empty() ? 0 : sheets_.of(0);
  for (SeenPart& p : parts) p.kept = true;
  if (sheets_.count() < 2) return;
  seen_.assign(parts.size(), {});
  for (std::size_t k = 0; k < parts.size(); ++k) seen_[sheets_.of(static_cast<Index>(k))].add(parts[k].seen);
  const auto away = [this](Index sheet) { return seen_[sheet].nearest + seen_[sheet].farthest; };
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (const Index sheet = sheets_.of(static_cast<Index>(k)); away(sheet) < away(nearest_)) nearest_ = sheet;
  follow_edges(direction);
  const double far = seen_[nearest_].farthest + steepest * size;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Index sheet = sheets_.of(static_cast<Index>(k));
    parts[k].kept = state_[sheet] == State::unknown ? !(seen_[sheet].nearest > far) : state_[sheet] == State::kept;
    apart_ = apart_ || (state_[sheet] == State::unknown && parts[k].kept);
  }
}

/// Sheets that hang together with the nearest one by edges: kept as far as none of these leads down. What is beyond one
/// that is not is not either.
template <int D>
void NearestSheet<D>::follow_edges(const Point<D>& direction) {
  state_.assign(seen_.size(), State::unknown);
  state_[nearest_] = State::kept;
  const auto step = [&](const Seat& from, const Seat& to) {
    const State state = state_[sheets_.of(from.face)];
    State& there = next_[sheets_.of(to.face)];
    if (state == State::unknown || state_[sheets_.of(to.face)] != State::unknown || there == State::behind)
      return false;
    there = state == State::behind || falls_back(from, to, direction) ? State::behind : State::kept;
    return true;
  };
  for (bool changed = true; changed; state_ = next_) {
    changed = false;
    next_ = state_;
    for (const auto& [a, b] : sheets_.neighbours()) {
      changed |= step(a, b);
      changed |= step(b, a);
    }
  }
}

/// Whether the side of an edge that a face of the slave lies along has the other one behind it.
template <int D>
bool NearestSheet<D>::falls_back(const Seat& from, const Seat& to, const Point<D>& direction) const {
  const Point<D> own = slope(from, direction), other = slope(to, direction);
  if (length<D>(difference<D>(own, direction)) > along_sheet * length<D>(difference<D>(own, other))) return false;
  const auto& corner = master_.side().corner[numbers_[to.face]];
  const Point<D> way = difference<D>(corner[to.opposite], corner[(to.opposite + 1) % D]);
  return dot(way, master_.side().normal[numbers_[from.face]]) < 0;
}

template <int D>
Point<D> NearestSheet<D>::slope(const Seat& seat, const Point<D>& direction) const {
  return slope_along<D>(master_.normal(numbers_[seat.face], seat.opposite), direction);
}

template <int D>
double NearestSheet<D>::kink(const std::vector<SeenPart>& parts, const Point<D>& direction) const {
  double largest = 0;
  for (const auto& [a, b] : sheets_.neighbours())
    if (parts[a.face].kept && parts[b.face].kept)
      largest = std::max(largest, length<D>(difference<D>(slope(a, direction), slope(b, direction))));
  return largest;
}

template class NearestSheet<2>;
template class NearestSheet<3>;

}  // namespace signorini::mortar
