#include "smoothers/surface_first.hpp"

#include <algorithm>

namespace signorini {

template <int B>
std::pair<Runs, Runs> surface_and_interior(const Level<B>& level) {
  const BlockMatrix<B>& A = *level.A;
  std::vector<char> leads(static_cast<std::size_t>(level.vectors), 0);
  for (const Index p : level.constraints.vector)
    for (Offset k = A.row[p]; k < A.row[p + 1]; ++k) leads[A.column[k]] = 1;
  std::pair<Runs, Runs> out;
  for (Index first = 0, last; first < level.vectors; first = last) {
    for (last = first; last < level.vectors && leads[last] == leads[first]; ++last) {
    }
    (leads[first] ? out.first : out.second).emplace_back(first, last);
  }
  return out;
}

namespace {

template <int B>
class SurfaceSweeps final : public LevelSmoother<B> {
 public:
  explicit SurfaceSweeps(const Level<B>& level) : level_(level), runs_(surface_and_interior(level)) {}

  void add_passes(int steps, Side, Passes& passes) override {
    for (int step = 0; step < steps; ++step)
      for (const Runs* runs : {&runs_.first, &runs_.second})
        if (!runs->empty())
          passes.add(Order::forward, [this, runs](Index first, Index last) { sweep(*runs, first, last); });
  }

 private:
  // What the runs have in common with first <= p < last.
  void sweep(const Runs& runs, Index first, Index last) const {
    auto run = std::partition_point(runs.begin(), runs.end(), [&](const auto& r) { return r.second <= first; });
    for (; run != runs.end() && run->first < last; ++run)
      level_.sweep(Order::forward, std::max(first, run->first), std::min(last, run->second));
  }

  const Level<B>& level_;
  std::pair<Runs, Runs> runs_;
};

}  // namespace

template <int B>
std::unique_ptr<LevelSmoother<B>> SurfaceFirst<B>::on(const Level<B>& level) const {
  return std::make_unique<SurfaceSweeps<B>>(level);
}

template std::pair<Runs, Runs> surface_and_interior(const Level<1>&);
template std::pair<Runs, Runs> surface_and_interior(const Level<2>&);
template std::pair<Runs, Runs> surface_and_interior(const Level<3>&);
template class SurfaceFirst<1>;
template class SurfaceFirst<2>;
template class SurfaceFirst<3>;

}  // namespace signorini
