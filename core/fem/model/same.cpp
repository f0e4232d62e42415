#include "core/fem/model/same.hpp"

#include <algorithm>

#include "core/fem/model/material.hpp"

namespace signorini {
namespace {

bool same(const Selection& a, double ta, const Selection& b, double tb) {
  if (a.part != b.part || a.other != b.other || a.at != b.at || a.where.has_value() != b.where.has_value())
    return false;
  return !a.where || a.where->same(ta, *b.where, tb);
}

template <class Fields>
bool same_fields(const Fields& a, double ta, const Fields& b, double tb) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](const Field& x, const Field& y) { return x.same(ta, y, tb); });
}

template <int B>
bool same(const Resultant<B>& a, double ta, const Resultant<B>& b, double tb) {
  return same_fields(a.force, ta, b.force, tb) && same_fields(a.torque, ta, b.torque, tb) && a.about == b.about;
}

template <int B>
bool same(const Load<B>& a, double ta, const Load<B>& b, double tb) {
  if (a.where_open || b.where_open) return a.where_open.has_value() == b.where_open.has_value();  // no part of b
  if (a.on.has_value() != b.on.has_value() || (a.on && !same(*a.on, ta, *b.on, tb))) return false;
  if (a.regions != b.regions) return false;
  if (a.total.has_value() != b.total.has_value() || (a.total && !same(*a.total, ta, *b.total, tb))) return false;
  return same_fields(a.value, ta, b.value, tb);
}

template <int B>
bool same(const Spring<B>& a, double ta, const Spring<B>& b, double tb) {
  return same(a.on, ta, b.on, tb) && same_fields(a.stiffness, ta, b.stiffness, tb) && a.total == b.total &&
         a.frame == b.frame;
}

template <int B>
bool same_springs(const Model<B>& a, const Model<B>& b) {
  return std::equal(a.springs.begin(), a.springs.end(), b.springs.begin(), b.springs.end(),
                    [&](const Spring<B>& x, const Spring<B>& y) { return same(x, a.t, y, b.t); });
}

/// Their loads, and what these act on.
template <int B>
bool same(const RigidPart<B>& a, double ta, const RigidPart<B>& b, double tb) {
  const auto alike = [&](const Field& x, const Field& y) { return x.same(ta, y, tb); };
  return same(a.on, ta, b.on, tb) && a.point == b.point && std::ranges::equal(a.force, b.force, alike) &&
         std::ranges::equal(a.torque, b.torque, alike);
}

/// What bolts are pulled by.
template <int B>
bool same_pretension(const ObstacleTerm<B>& a, double ta, const ObstacleTerm<B>& b, double tb) {
  const auto pulls = [](const ObstacleTerm<B>& term) { return term.pretension && !term.pretension->locked; };
  if (pulls(a) != pulls(b)) return false;
  return !pulls(a) || a.pretension->force.same(ta, b.pretension->force, tb);
}

template <int B>
bool same_orthotropy(const Model<B>& a, const Model<B>& b) {
  return std::ranges::equal(a.orthotropic, b.orthotropic,
                            [](const auto& x, const auto& y) { return x == y || (x && y && *x == *y); });
}

template <int B>
bool same_material(const Model<B>& a, const Model<B>& b) {
  const auto same = [&](Field Model<B>::*field) { return (a.*field).same(a.t, b.*field, b.t); };
  return same_orthotropy(a, b) && same(&Model<B>::young) && same(&Model<B>::poisson) &&
         (B == 3 || a.plane == b.plane) && a.pressure == b.pressure;
}

/// Thermal stress is a load, and depends on the material.
template <int B>
bool same_thermal_stress(const Model<B>& a, const Model<B>& b) {
  if (B == 1 || (ThermalStrain<B>(a).none() && ThermalStrain<B>(b).none())) return true;
  return same_material(a, b) && a.expansion.same(a.t, b.expansion, b.t) && a.temperature.same(a.t, b.temperature, b.t);
}

}  // namespace

template <int B>
bool same_stiffness(const Model<B>& a, const Model<B>& b) {
  if (!same_springs(a, b)) return false;
  const auto of_revolution = [](const Model<B>& model) { return model.plane == Plane::axisymmetric; };
  if (B == 1) return a.diffusion.same(a.t, b.diffusion, b.t) && of_revolution(a) == of_revolution(b);
  return same_material(a, b);
}

template <int B>
bool same_loads(const Model<B>& a, const Model<B>& b) {
  return same_thermal_stress(a, b) &&
         std::equal(a.loads.begin(), a.loads.end(), b.loads.begin(), b.loads.end(),
                    [&](const Load<B>& x, const Load<B>& y) { return same(x, a.t, y, b.t); }) &&
         std::equal(a.rigid.begin(), a.rigid.end(), b.rigid.begin(), b.rigid.end(),
                    [&](const RigidPart<B>& x, const RigidPart<B>& y) { return same(x, a.t, y, b.t); }) &&
         std::equal(
             a.obstacles.begin(), a.obstacles.end(), b.obstacles.begin(), b.obstacles.end(),
             [&](const ObstacleTerm<B>& x, const ObstacleTerm<B>& y) { return same_pretension(x, a.t, y, b.t); });
}

#define SIGNORINI_INSTANTIATE(B)                                  \
  template bool same_stiffness(const Model<B>&, const Model<B>&); \
  template bool same_loads(const Model<B>&, const Model<B>&);
SIGNORINI_INSTANTIATE(1)
SIGNORINI_INSTANTIATE(2)
SIGNORINI_INSTANTIATE(3)
#undef SIGNORINI_INSTANTIATE

}  // namespace signorini
