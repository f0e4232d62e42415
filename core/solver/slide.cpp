#include "core/solver/slide.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/algebra/products.hpp"
#include "core/solver/functional.hpp"

namespace signorini {

namespace {

constexpr int doublings = 40, halvings = 50;  // of the length of a fall

/// A coarse motion on the finest level; what is truncated stays.
template <int B>
std::vector<double> on_finest(std::vector<Level<B>>& levels, const std::vector<std::unique_ptr<Transfer<B>>>& transfers,
                              const double* motion) {
  Level<B>& coarsest = levels.front();
  std::copy_n(motion, static_cast<std::size_t>(coarsest.vectors) * B, coarsest.x);
  std::vector<double> out(static_cast<std::size_t>(levels.back().vectors) * B, 0.0);
  for (std::size_t k = 1; k < levels.size(); ++k) {
    Level<B>& level = levels[k];
    double* x = level.x;
    if (k + 1 == levels.size()) level.x = out.data();
    std::fill_n(level.x, static_cast<std::size_t>(level.vectors) * B, 0.0);
    Constraints<B> bounds = std::exchange(level.constraints, {});  // those of the iterate are not those of a motion
    transfers[k - 1]->begin_prolongation(levels[k - 1]);
    transfers[k - 1]->prolongate(levels[k - 1], level, 0, level.vectors);
    level.constraints = std::move(bounds);
    level.x = x;
  }
  return out;
}

/// The energy along x + t d for one level.
template <int B>
class Fall {
 public:
  Fall(const Level<B>& level, std::vector<double> d)
      : level_(level), d_(std::move(d)), start_(level.x, level.x + d_.size()), at_(start_) {
    std::vector<double> r(d_.size()), Ad(d_.size());
    residual<B>(*level.A, level.x, level.b, 0, level.vectors, r.data());
    product<B>(*level.A, d_.data(), Ad.data());
    for (std::size_t i = 0; i < d_.size(); ++i) {
      slope_ -= r[i] * d_[i];
      energy_ += Ad[i] * d_[i];
    }
    if (derivative(0) < 0) return;
    slope_ = -slope_;
    for (double& v : d_) v = -v;
  }

  /// To where the energy is least, or to the first bound.
  void run() {
    if (!(derivative(0) < 0)) return;
    const double most = room();
    double low = 0, high = std::min(begin(), most);
    for (int k = 0; k < doublings && high < most && derivative(high) < 0; ++k) {
      low = high;
      high = std::min(2 * high, most);
    }
    const double last = derivative(high);
    if (high < most && last < 0) return;  // nothing ends it
    if (last < 0) low = high;
    for (int k = 0; k < halvings && low < high; ++k) {
      const double middle = 0.5 * (low + high);
      (derivative(middle) > 0 ? high : low) = middle;
    }
    for (std::size_t i = 0; i < d_.size(); ++i) level_.x[i] = start_[i] + low * d_[i];
    const Constraints<B>& c = level_.constraints;
    for (Index slot = 0; slot < c.size(); ++slot) c.project(slot, level_.x + Offset{c.vector[slot]} * B);
  }

 private:
  double derivative(double t) {
    for (const Index p : level_.constraints.vector)
      for (Offset i = Offset{p} * B; i < (Offset{p} + 1) * B; ++i) at_[i] = start_[i] + t * d_[i];
    return slope_ + t * energy_ + functional::slope(level_, at_.data(), d_.data());
  }

  /// A length that takes a vector to where it was last.
  double begin() const {
    const Constraints<B>& c = level_.constraints;
    double way = 0, most = 0;
    for (Index slot = 0; slot < c.size(); ++slot)
      for (int k = 0; k < B; ++k) {
        const Offset i = Offset{c.vector[slot]} * B + k;
        way = std::max(way, std::abs(start_[i] - c.last[Offset{slot} * B + k]));
        most = std::max(most, std::abs(d_[i]));
      }
    return most > 0 && way > 0 ? way / most : 1;
  }

  /// What the bounds leave; facets end no fall before its end.
  double room() const {
    const Constraints<B>& c = level_.constraints;
    double out = infinity;
    for (Index slot = 0; slot < c.size(); ++slot)
      for (int k = 0; k < B; ++k) {
        const Offset at = Offset{slot} * B + k, i = Offset{c.vector[slot]} * B + k;
        if (d_[i] == 0) continue;
        const double left = d_[i] > 0 ? c.upper[at] - start_[i] : start_[i] - c.lower[at];
        out = std::min(out, std::max(left, 0.0) / std::abs(d_[i]));
      }
    return out;
  }

  const Level<B>& level_;
  std::vector<double> d_, start_, at_;
  double slope_ = 0, energy_ = 0;
};

}  // namespace

template <int B>
void slide(std::vector<Level<B>>& levels, const std::vector<std::unique_ptr<Transfer<B>>>& transfers,
           const Eigen::MatrixXd& motions) {
  for (Eigen::Index k = 0; k < motions.cols(); ++k)
    Fall<B>(levels.back(), on_finest(levels, transfers, motions.col(k).data())).run();
}

template void slide(std::vector<Level<1>>&, const std::vector<std::unique_ptr<Transfer<1>>>&, const Eigen::MatrixXd&);
template void slide(std::vector<Level<2>>&, const std::vector<std::unique_ptr<Transfer<2>>>&, const Eigen::MatrixXd&);
template void slide(std::vector<Level<3>>&, const std::vector<std::unique_ptr<Transfer<3>>>&, const Eigen::MatrixXd&);

}  // namespace signorini
