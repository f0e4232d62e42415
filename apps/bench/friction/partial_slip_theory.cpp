#include "apps/bench/friction/partial_slip_theory.hpp"

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace signorini::bench {
namespace {
using std::numbers::pi;

double effective_modulus(const RoundContact& contact) {
  return contact.young / (1 - contact.poisson * contact.poisson);
}

double ellipse(double r, double radius) { return r < radius ? std::sqrt(1 - r * r / (radius * radius)) : 0; }

}  // namespace

PartialSlipTheory::PartialSlipTheory(const RoundContact& contact, double normal)
    : contact_(contact), limit_(contact.friction * normal), ways_{{1, 0, 0}} {
  const double modulus = effective_modulus(contact);
  if (contact.dimension == 2) {
    radius_ = std::sqrt(4 * normal * contact.radius / (pi * modulus));
    peak_ = 2 * normal / (pi * radius_);
  } else {
    radius_ = std::cbrt(3 * normal * contact.radius / (4 * modulus));
    peak_ = 3 * normal / (2 * pi * radius_ * radius_);
  }
}

void PartialSlipTheory::move_to(double tangential) {
  if (!(std::abs(tangential) < limit_)) throw Error(Exit::input, "all of the contact slips: there is no partial slip");
  Way& way = ways_.back();
  if ((tangential - way.to) * (way.to - way.from) >= 0)
    way.to = tangential;
  else
    ways_.push_back({2, Way(way).to, tangential});
}

// c / a for a force that has not turned.
double PartialSlipTheory::stick_part(double force) const {
  return std::pow(1 - std::abs(force) / limit_, 1.0 / contact_.dimension);
}

double PartialSlipTheory::stick_radius(const Way& way) const {
  return radius_ * stick_part((way.to - way.from) / way.weight);
}

double PartialSlipTheory::stick_radius() const { return stick_radius(ways_.back()); }

double PartialSlipTheory::traction(double r) const {
  double sum = 0;
  for (const Way& way : ways_) {
    const double c = stick_radius(way);
    sum += std::copysign(way.weight, way.to - way.from) * (ellipse(r, radius_) - c / radius_ * ellipse(r, c));
  }
  return contact_.friction * peak_ * sum;
}

double PartialSlipTheory::peak_traction() const {
  return contact_.friction * peak_ * ellipse(stick_part(ways_.front().to), 1);
}

// The tangential motion of distant points is mu times the difference of the approaches for two pressing forces, with
// the tangential compliance in place of the normal one. In 2D these are the same, and what is linear in the force is
// left out: it depends on what is held and dissipates nothing.
double PartialSlipTheory::displacement(double tangential) const {
  const double left = 1 - tangential / limit_;
  if (contact_.dimension == 2) return limit_ / (pi * effective_modulus(contact_)) * left * std::log(left);
  const double shear = contact_.young / (2 * (1 + contact_.poisson));
  return 3 * limit_ * (2 - contact_.poisson) / (16 * shear * radius_) * (1 - std::pow(left, 2.0 / 3));
}

double PartialSlipTheory::integrated_displacement(double tangential) const {
  const double left = 1 - tangential / limit_;
  if (contact_.dimension == 2)
    return limit_ * limit_ / (pi * effective_modulus(contact_)) *
           (left * left / 4 - left * left * std::log(left) / 2 - 0.25);
  const double shear = contact_.young / (2 * (1 + contact_.poisson));
  return 3 * limit_ * (2 - contact_.poisson) / (16 * shear * radius_) *
         (tangential - 0.6 * limit_ * (1 - std::pow(left, 5.0 / 3)));
}

double PartialSlipTheory::loop(double amplitude) const {
  return 4 * amplitude * displacement(amplitude) - 8 * integrated_displacement(amplitude);
}

}  // namespace signorini::bench
