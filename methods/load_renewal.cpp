#include "methods/load_renewal.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/dot.hpp"

namespace signorini {
namespace {

constexpr double hardly = 0.7;  // so much is left of a force that a cycle hardly changes
constexpr int patience = 2;     // such cycles

double largest(const std::vector<double>& values) {
  double out = 0;
  for (const double value : values) out = std::max(out, std::abs(value));
  return out;
}

}  // namespace

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
  out.squared = dot(change_, S_change_);
  const double moved = largest(change_), size = largest(load_.values());
  out.change = size > 0 ? moved / size : moved > 0 ? infinity : 0;
  watch(x, accelerated);
  return out;
}

template <int B>
bool LoadRenewal<B>::combine(std::vector<double>& x) {
  std::vector<double> p = load_.values();
  if (!acceleration_.combine(x, p)) return false;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] -= load_.values()[k];
  unused_.resize(x.size());
  load_.add(p, unused_);
  return true;
}

// What is found holds until many phases change.
template <int B>
void LoadRenewal<B>::watch(const std::vector<double>& x, bool resting) {
  for (std::size_t e = 0; e < watched_.size(); ++e) {
    Watched& watched = watched_[e];
    if (!resting) {
      if (watched.known) load_.set_resistance(e, 0), acceleration_.reset();
      watched = {};
      continue;
    }
    const double along = load_.along(e);
    watched.slow = watched.along != 0 && std::abs(along) > hardly * std::abs(watched.along) ? watched.slow + 1 : 0;
    watched.along = along;
    if (watched.known || watched.slow < patience) continue;
    watched.known = true;
    find_resistance(e, x);
  }
}

// By a few linear cycles, with what is held now.
template <int B>
void LoadRenewal<B>::find_resistance(std::size_t e, const std::vector<double>& x) {
  const double own = load_.own(e);
  if (const auto found = multigrid_.response(x, load_.load_along(e), std::sqrt(own)))
    load_.set_resistance(e, own + *found * *found);
  acceleration_.reset();  // it is another iteration now
}

template class LoadRenewal<1>;
template class LoadRenewal<2>;
template class LoadRenewal<3>;

}  // namespace signorini
