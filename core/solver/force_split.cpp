#include "core/solver/force_split.hpp"

#include <Eigen/Core>

#include "core/base/dense.hpp"
#include "core/base/rounding.hpp"

namespace signorini {
namespace {

constexpr double dependent = rounding_of_differences;
constexpr double zero = rounding_of_differences;  // parts, relative to the force
constexpr double equal_ways = rounding_of_bases;  // residuals, relative to the force

/// One way to divide a force.
struct Way {
  std::vector<int> directions;
  Eigen::VectorXd part;
  double residual;
};

template <int B>
class Splitter {
 public:
  Splitter(const std::vector<std::array<double, B>>& directions, const std::array<double, B>& force)
      : directions_(directions), force_(Eigen::Map<const Vector>(force.data())), best_(force_.norm()) {}

  ForceSplit run() {
    try_all(0);
    ForceSplit out{std::vector<double>(directions_.size()), std::vector<char>(directions_.size())};
    std::vector<int> taken(directions_.size());
    int count = 0;
    for (const Way& way : ways_) {
      if (way.residual > best_ + equal_ways * force_.norm()) continue;
      ++count;
      for (std::size_t k = 0; k < way.directions.size(); ++k) {
        const int at = way.directions[k];
        out.part[at] += way.part[static_cast<Eigen::Index>(k)];
        ++taken[at];
      }
    }
    if (count > 1)
      for (std::size_t k = 0; k < taken.size(); ++k) {
        out.part[k] /= count;
        out.unknown[k] = taken[k] > 0;
      }
    return out;
  }

 private:
  using Vector = Eigen::Matrix<double, B, 1>;

  /// All sets of up to B directions that go on from those chosen.
  void try_all(int next) {
    if (!chosen_.empty() && !try_chosen()) return;
    if (chosen_.size() == B) return;
    for (int k = next; k < static_cast<int>(directions_.size()); ++k) {
      chosen_.push_back(k);
      try_all(k + 1);
      chosen_.pop_back();
    }
  }

  /// False where they are dependent.
  bool try_chosen() {
    Eigen::Matrix<double, B, Eigen::Dynamic> N(B, std::ssize(chosen_));
    for (std::size_t k = 0; k < chosen_.size(); ++k)
      N.col(static_cast<Eigen::Index>(k)) = Eigen::Map<const Vector>(directions_[chosen_[k]].data());
    const auto [part, rank, range] = least_squares(N, force_, dependent);
    if (rank < N.cols()) return false;
    if (!(part.minCoeff() > zero * force_.norm())) return true;
    ways_.push_back({chosen_, part, (force_ - N * part).norm()});
    best_ = std::min(best_, ways_.back().residual);
    return true;
  }

  const std::vector<std::array<double, B>>& directions_;
  const Vector force_;
  double best_;
  std::vector<int> chosen_;
  std::vector<Way> ways_;
};

}  // namespace

template <int B>
ForceSplit split_force(const std::vector<std::array<double, B>>& directions, const std::array<double, B>& force) {
  return Splitter<B>(directions, force).run();
}

template ForceSplit split_force<1>(const std::vector<std::array<double, 1>>&, const std::array<double, 1>&);
template ForceSplit split_force<2>(const std::vector<std::array<double, 2>>&, const std::array<double, 2>&);
template ForceSplit split_force<3>(const std::vector<std::array<double, 3>>&, const std::array<double, 3>&);

}  // namespace signorini
