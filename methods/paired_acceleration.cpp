#include "methods/paired_acceleration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/dot.hpp"

namespace signorini {
namespace {

// What it leads to is no more than so many times as far away as last time, or as the step: contact that shuts rubber in
// opens where its pressure is too low, which is to show in time.
constexpr double farther = 2;
constexpr double grown = 4;  // square of a step over that before: the iteration is not what the directions knew

void subtract(const std::vector<double>& from, const std::vector<double>& what, std::vector<double>& out) {
  out.resize(from.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = from[i] - what[i];
}

void add_times(double factor, const std::vector<double>& what, std::vector<double>& to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * what[i];
}

}  // namespace

template <int B>
void PairedAcceleration<B>::add_step(const std::vector<double>& x_before, const std::vector<double>& x,
                                     const std::vector<double>& r_before, const std::vector<double>& r,
                                     const std::vector<double>& change, const std::vector<double>& S_change) {
  std::swap(before_, now_);
  now_.squared = before_.squared;
  subtract(x, x_before, now_.step.x);
  subtract(r_before, r, now_.image.x);
  now_.step.p = change;
  now_.image.p = S_change;
}

template <int B>
void PairedAcceleration<B>::find_difference(Direction& out) {
  subtract(now_.step.x, before_.step.x, out.step.x);
  subtract(now_.step.p, before_.step.p, out.step.p);
  subtract(now_.image.x, before_.image.x, image_.x);
  subtract(now_.image.p, before_.image.p, image_.p);
  subtract(now_.result.x, before_.result.x, out.result.x);
  subtract(now_.result.p, before_.result.p, out.result.p);
}

template <int B>
void PairedAcceleration<B>::make_orthogonal(Direction& newest) {
  for (int k = 0; k < known_; ++k) {
    const Direction& other = directions_[k];
    if (&other == &newest) continue;
    const double part = -(dot(image_.x, other.step.x) + dot(image_.p, other.step.p)) / other.squared;
    add_times(part, other.step.x, newest.step.x);
    add_times(part, other.step.p, newest.step.p);
    add_times(part, other.result.x, newest.result.x);
    add_times(part, other.result.p, newest.result.p);
  }
  newest.squared = dot(image_.x, newest.step.x) + dot(image_.p, newest.step.p);
}

// What the step has put onto a bound stays there, if it is that but for what tolerances leave: the force there is the
// obstacle's. (The next cycle lets go what pulls.)
template <int B>
void PairedAcceleration<B>::project(std::vector<double>& x) const {
  const double largest = max_norm(x);
  for (Index slot = 0; slot < constraints_.size(); ++slot) {
    const Offset first = Offset{constraints_.vector[slot]} * B;
    for (int k = 0; k < B; ++k) {
      const double own = now_.result.x[first + k], lower = constraints_.lower[Offset{slot} * B + k],
                   upper = constraints_.upper[Offset{slot} * B + k];
      const bool on_bound = own == lower || own == upper;
      if (on_bound && std::abs(x[first + k] - own) <= tolerance_ * largest) x[first + k] = own;
    }
    if (!constraints_.admits(slot, x.data() + first)) constraints_.project(slot, x.data() + first);
  }
}

template <int B>
bool PairedAcceleration<B>::combine(std::vector<double>& x, std::vector<double>& p) {
  now_.result.x = x;
  now_.result.p = p;
  const double squared = dot(now_.image.x, now_.step.x) + dot(now_.image.p, now_.step.p);
  const bool grows = squared > grown * now_.squared;
  now_.squared = squared;
  if (grows) reset();
  if (steps_++ == 0) return false;
  Direction& newest = directions_[next_];
  find_difference(newest);
  make_orthogonal(newest);
  if (!(newest.squared > 0)) {
    reset();
    return false;
  }
  next_ = (next_ + 1) % depth;
  known_ = std::min(known_ + 1, depth);
  way_.x.assign(x.size(), 0);
  way_.p.assign(p.size(), 0);
  for (int k = 0; k < known_; ++k) {
    const Direction& direction = directions_[k];
    const double part =
        -(dot(now_.image.x, direction.step.x) + dot(now_.image.p, direction.step.p)) / direction.squared;
    add_times(part, direction.result.x, way_.x);
    add_times(part, direction.result.p, way_.p);
  }
  const double length = std::sqrt(dot(way_.p, way_.p)), own = std::sqrt(dot(now_.step.p, now_.step.p));
  const double allowed = farther * std::max(last_way_, own);
  const double part = length > allowed ? allowed / length : 1;
  last_way_ = part * length;
  add_times(part, way_.x, x);
  add_times(part, way_.p, p);
  project(x);
  return true;
}

template class PairedAcceleration<1>;
template class PairedAcceleration<2>;
template class PairedAcceleration<3>;

}  // namespace signorini
