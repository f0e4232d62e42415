#include "methods/renewal_control.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace signorini {

void RenewalControl::next(const std::vector<double>& follows, std::vector<double>& frozen) {
  relax(follows, frozen);
  const double part = std::min(part_, relaxation_);
  for (std::size_t i = 0; i < frozen.size(); ++i)
    frozen[i] = part == 1 ? follows[i] : frozen[i] + part * (follows[i] - frozen[i]);
}

// Where the bounds swing, friction that pulls back the force which caused it, part of the way is nearer to the fixed
// point than all of it. Its length by Aitken's formula for vectors: Kuettler and Wall, Comput. Mech. 43 (2008) 61-72.
void RenewalControl::relax(const std::vector<double>& follows, const std::vector<double>& frozen) {
  const bool first = difference_.empty();
  if (first) difference_.resize(frozen.size());
  double before = 0, both = 0, now = 0;
  for (std::size_t i = 0; i < frozen.size(); ++i) {
    const double d = follows[i] - frozen[i];
    before += difference_[i] * difference_[i];
    both += difference_[i] * d;
    now += d * d;
    difference_[i] = d;
  }
  if (first) return;
  const double apart = now - 2 * both + before, next = relaxation_ * (before - both) / apart;
  relaxation_ = next > least_relaxation && next < 1    ? next
                : next <= least_relaxation && both < 0 ? least_relaxation
                                                       : 1;
}

void RenewalControl::add(double natural_residual) {
  if (natural_residual <= enough * least_) {
    least_ = natural_residual;
    idle_ = 0;
  } else if (++idle_ == patience) {
    part_ *= 0.5;
    idle_ = 0;
  }
}

std::string RenewalControl::stuck() const {
  if (part_ >= least_part) return "";
  return fmt::format(
      "friction does not come to rest, though its bound was damped down to a part of {:g}: it may be too weak to hold "
      "the body against the loads, or its coefficient so large that there is no solution, or several",
      2 * part_);
}

}  // namespace signorini
