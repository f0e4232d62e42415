// Contact with a rigid shape and friction that holds better in one direction than across it: the tangential traction is
// within an ellipse. phi(v) = sqrt((g1 s1)^2 + (g2 s2)^2) with the slip s along the axes of the ellipse.
#include <cmath>
#include <iterator>

#include <signorini/sdk/given_friction.hpp>
#include <signorini/sdk/given_friction_solver.hpp>
#include <signorini/sdk/plugin.hpp>
#include <signorini/sdk/rigid_contact.hpp>

using namespace signorini;

namespace {

// Measured in units of 1/g1 and 1/g2 along the axes, this is friction with the bound 1, which the SDK has. Component 0
// is along the normal. Data: g1 and g2, times measure.
struct Scaled {
  explicit Scaled(const Slot<3>& slot) : unit{1, 1 / slot.data[0], 1 / slot.data[1]} {
    for (int k = 0; k < 3; ++k) {
      lower[k] = slot.lower[k] / unit[k];
      upper[k] = slot.upper[k] / unit[k];
      last[k] = slot.last[k] / unit[k];
    }
  }
  void operator()(const double* v, double* out) const {
    for (int k = 0; k < 3; ++k) out[k] = v[k] / unit[k];
  }
  Slot<3> slot() const { return {lower, upper, &bound, last, 6}; }

  double unit[3], lower[3], upper[3], last[3], bound = 1;
};

struct Phi {
  // Without cancellation: the difference of two roots is that of their squares over their sum.
  static double change(const Slot<3>& slot, const double* from, const double* to) {
    double work = 0, before = 0, after = 0;
    for (int k = 1; k < 3; ++k) {
      const double g = slot.data[k - 1], a = g * (from[k] - slot.last[k]), b = g * (to[k] - slot.last[k]);
      work += g * (to[k] - from[k]) * (a + b);
      before += a * a;
      after += b * b;
    }
    const double sum = std::sqrt(before) + std::sqrt(after);
    return sum > 0 ? work / sum : 0;
  }

  static double slope(const Slot<3>& slot, const double* at, const double* step) {
    const Scaled scaled(slot);
    double a[3], d[3];
    scaled(at, a);
    scaled(step, d);
    return GivenFriction<3>::slope(scaled.slot(), a, d);
  }

  static void minimise(const Slot<3>& slot, const double* M, const double* r, const double* x, double* y) {
    const Scaled scaled(slot);
    double stiffness[9], force[3], from[3];
    for (int i = 0; i < 3; ++i) {
      force[i] = r[i] * scaled.unit[i];
      for (int j = 0; j < 3; ++j) stiffness[i * 3 + j] = M[i * 3 + j] * scaled.unit[i] * scaled.unit[j];
    }
    scaled(x, from);
    GivenFrictionSolver<3>::minimise(scaled.slot(), stiffness, force, from, y);
    for (int k = 0; k < 3; ++k) {  // what rests or lies on a bound is there exactly
      const bool stuck = k > 0 && y[k] == scaled.last[k];
      y[k] = stuck                     ? slot.last[k]
             : y[k] == scaled.lower[k] ? slot.lower[k]
             : y[k] == scaled.upper[k] ? slot.upper[k]
                                       : y[k] * scaled.unit[k];
    }
  }

  static void linearise(const Slot<3>& slot, const double* x, const QuadraticModel<3>& out) {
    const Scaled scaled(slot);
    double from[3];
    scaled(x, from);
    GivenFrictionModel<3>::linearise(scaled.slot(), from, out);
    for (int i = 0; i < 3; ++i) {
      out.gradient[i] /= scaled.unit[i];
      for (int j = 0; j < 3; ++j) out.hessian[i * 3 + j] /= scaled.unit[i] * scaled.unit[j];
    }
  }
};

class EllipticFriction final : public FunctionalObstacle<3, Phi>, public Scaling {
 public:
  explicit EllipticFriction(const Settings& settings) : settings_(settings), contact_(settings, "elliptic_friction") {
    if (settings.length("grooves") != 3) throw Error(Exit::input, "'grooves' needs an entry per dimension");
  }

  ObstacleDescriptor descriptor() const noexcept override {
    return {3, {{"normal", 3, 1}, {"along", 3, 1}, {"across", 3, 1}}, 2};
  }

  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<3>* constraints,
                Status& status) const noexcept override {
    for (std::size_t k = 0; k < count && status.ok(); ++k) {
      const SurfaceVertex& v = vertices[k];
      LocalConstraint<3>& c = constraints[k];
      contact_.assemble(v, c, status);
      if (!(v.measure > 0)) continue;  // asked for the distance alone
      const auto value = [&](const char* name, std::size_t i) {
        return settings_.value(name, i, v.position, v.normal, status);
      };
      double axis[3] = {value("grooves", 0), value("grooves", 1), value("grooves", 2)};
      const double bounds[2] = {value("bound", 0), value("bound_across", 0)};
      if (!status.ok()) return;
      const double *n = c.direction[0], lifted = block::dot<3>(n, axis);
      for (int i = 0; i < 3; ++i) axis[i] -= lifted * n[i];
      const double length = block::norm<3>(axis);
      if (!(length > 1e-6)) return RigidContact<3>::fail(v, "'grooves' is along the normal", status);
      if (!(bounds[0] > 0 && bounds[1] > 0)) return RigidContact<3>::fail(v, "a bound is not positive", status);
      double* along = c.direction[1];
      for (int i = 0; i < 3; ++i) along[i] = axis[i] / length;
      for (int i = 0; i < 3; ++i)
        c.direction[2][i] = n[(i + 1) % 3] * along[(i + 2) % 3] - n[(i + 2) % 3] * along[(i + 1) % 3];
      c.directions = 3;
      for (int i = 1; i < 3; ++i) {
        c.lower[i] = -infinity;
        c.upper[i] = infinity;
        c.data[i - 1] = bounds[i - 1] * v.measure;
      }
    }
  }

  const Scaling* scaling() const noexcept override { return this; }
  void scale(double ratio, double* data) const noexcept override {
    data[0] *= ratio;
    data[1] *= ratio;
  }

 private:
  const Settings& settings_;
  RigidContact<3> contact_;
};

constexpr OptionSpec options[] = {
    RigidContact<3>::normal_option,
    {"bound", OptionType::field, "1", "(0, inf)", "largest traction along the grooves"},
    {"bound_across", OptionType::field, "1", "(0, inf)", "and across it"},
    {"grooves", OptionType::vector, "[1, 0, 0]", "", "their direction; what of it is along the normal does not count"},
};

void register_all(Registrar& registrar, Status& status) {
  registrar.obstacle({"elliptic_friction", "contact, and friction whose bound is an ellipse", options,
                      std::size(options), true, nullptr, nullptr, sdk::create<EllipticFriction, 3>},
                     status);
}

}  // namespace

SIGNORINI_PLUGIN("elliptic_friction", "1.0.0", "contact, and friction whose bound is an ellipse", register_all,
                 "BSD-3-Clause");
