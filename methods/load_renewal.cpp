#include "methods/load_renewal.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"

namespace signorini {

template <int B>
double relative_change(const std::vector<double>& change, const FollowingLoad<B>& load) {
  const double moved = max_norm(change), size = std::max(max_norm(load.values()), load.size());
  return size > 0 ? moved / size : moved > 0 ? infinity : 0;
}

template <int B>
typename LoadRenewal<B>::Renewed LoadRenewal<B>::renew(const std::vector<double>& x_before,
                                                       const std::vector<double>& r_before, std::vector<double>& x,
                                                       std::vector<double>& r, bool accelerated) {
  load_.correct(x, change_, S_change_);
  if (accelerated)
    acceleration_.add_step(x_before, x, r_before, r, change_, S_change_);
  else
    acceleration_.reset();
  load_.add(change_, r);
  Renewed out;
  out.combined = accelerated && combine(x);
  if (out.combined) load_.correct(x, change_, S_change_);  // what is left now
  out.squared = squared_ = dot(change_, S_change_);
  if (squared_ > 0) least_ = std::min(least_, squared_);
  out.change = relative_change(change_, load_);
  return out;
}

template <int B>
bool LoadRenewal<B>::combine(std::vector<double>& x) {
  std::vector<double> p = load_.values();
  if (!acceleration_.combine(x, p)) return false;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] -= load_.values()[k];
  load_.add(p, no_residual_);
  return true;
}

template double relative_change(const std::vector<double>&, const FollowingLoad<1>&);
template double relative_change(const std::vector<double>&, const FollowingLoad<2>&);
template double relative_change(const std::vector<double>&, const FollowingLoad<3>&);
template class LoadRenewal<1>;
template class LoadRenewal<2>;
template class LoadRenewal<3>;

}  // namespace signorini
