// That constraints turn and move with what they are about, and that numbers grow with the surface.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "conformance/vertex_checks.hpp"
#include "core/sdk/block.hpp"

namespace signorini::conformance {
namespace {

/// A rotation and what it moves by.
struct Motion {
  double turn[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double by[3] = {};

  void turned(const double* from, double* to) const {
    for (int i = 0; i < 3; ++i) to[i] = turn[i][0] * from[0] + turn[i][1] * from[1] + turn[i][2] * from[2];
  }
  void turned_back(const double* from, double* to) const {
    for (int i = 0; i < 3; ++i) to[i] = turn[0][i] * from[0] + turn[1][i] * from[1] + turn[2][i] * from[2];
  }
};

Motion motion_in(int dimension) {
  Motion out;
  const double c = std::cos(0.7), s = std::sin(0.7);
  out.turn[0][0] = out.turn[1][1] = c;
  out.turn[0][1] = -s;
  out.turn[1][0] = s;
  if (dimension == 3) {  // and about the x-axis
    Motion whole = out;
    for (int i = 0; i < 3; ++i) {
      whole.turn[i][1] = c * out.turn[i][1] + s * out.turn[i][2];
      whole.turn[i][2] = -s * out.turn[i][1] + c * out.turn[i][2];
    }
    out = whole;
    out.by[2] = -0.4;
  }
  out.by[0] = 0.25;
  out.by[1] = 1.5;
  return out;
}

class MovedShape final : public DistanceFunction {
 public:
  MovedShape(std::shared_ptr<const DistanceFunction> shape, const Motion& motion)
      : shape_(std::move(shape)), motion_(motion) {}

  Distance at(const double* point, const double* normal, Status& status) const noexcept override {
    double from[3], back[3], own_normal[3];
    for (int i = 0; i < 3; ++i) from[i] = point[i] - motion_.by[i];
    motion_.turned_back(from, back);
    motion_.turned_back(normal, own_normal);
    const Distance there = shape_->at(back, own_normal, status);
    Distance out{there.value, {}};
    motion_.turned(there.normal, out.normal);
    return out;
  }

 private:
  std::shared_ptr<const DistanceFunction> shape_;
  Motion motion_;
};

SurfaceVertex moved_vertex(const SurfaceVertex& v, const Motion& motion) {
  SurfaceVertex out = v;
  motion.turned(v.position, out.position);
  for (int i = 0; i < 3; ++i) out.position[i] += motion.by[i];
  motion.turned(v.normal, out.normal);
  motion.turned(v.away, out.away);
  return out;
}

/// Nothing but the shape, or the other body, says where it is: no direction or expression among its options.
template <int B>
bool is_about_a_shape(const Subject& subject, const Made<B>& made) {
  if (B == 1 || (!subject.type().takes_shape && !subject.type().takes_body)) return false;
  for (std::size_t k = 0; k < subject.type().option_count; ++k) {
    const OptionSpec& option = subject.type().options[k];
    if (option.type == OptionType::vector) return false;
    double value = 0;
    const bool set = made.settings->has(option.name) || *option.fallback;
    if (option.type == OptionType::field && set && !made.settings->constant(option.name, value)) return false;
  }
  return true;
}

template <int B>
std::string does_not_turn(const Subject& subject, const Made<B>& made, std::span<const SurfaceVertex> vertices) {
  const Motion motion = motion_in(B);
  std::shared_ptr<const DistanceFunction> shape = subject.shape<B>(made.values);
  if (shape) shape = std::make_shared<MovedShape>(shape, motion);
  const Made<B> other = subject.make<B>(made.values, shape);
  for (const SurfaceVertex& v : vertices) {
    const SurfaceVertex there = moved_vertex(v, motion);
    const Assembled<B> a = assemble_at<B>(*made.obstacle, {&v, 1}), b = assemble_at<B>(*other.obstacle, {&there, 1});
    if (!a.status.ok() || !b.status.ok()) continue;
    const LocalConstraint<B>&p = a.constraints[0], &q = b.constraints[0];
    if (p.directions != q.directions)
      return fmt::format("it has {} directions, and turned and moved {}", p.directions, q.directions);
    if (p.directions == 0) continue;
    double from[3] = {}, expected[3];
    std::copy_n(p.direction[0], B, from);
    motion.turned(from, expected);
    double off = 0;
    for (int i = 0; i < B; ++i) off = std::fmax(off, std::fabs(expected[i] - q.direction[0][i]));
    if (!(off <= 1e-9))
      return fmt::format("its direction ({:.6g}) is turned to ({:.6g}), and it gives ({:.6g})",
                         fmt::join(p.direction[0], ", "), fmt::join(expected, expected + B, ", "),
                         fmt::join(q.direction[0], ", "));
    const auto same = [](double x, double y) { return x == y || std::fabs(x - y) <= 1e-9 * (1 + std::fabs(x)); };
    if (!same(p.lower[0], q.lower[0]) || !same(p.upper[0], q.upper[0]))
      return fmt::format("its bounds are {:.6g} to {:.6g}, and turned and moved {:.6g} to {:.6g}", p.lower[0],
                         p.upper[0], q.lower[0], q.upper[0]);
  }
  return {};
}

template <int B>
bool has_a_scaling(const Subject&, const Made<B>& made) {
  return made.obstacle->functional() && made.obstacle->scaling();
}

template <int B>
std::string does_not_grow(const Subject&, const Made<B>& made, std::span<const SurfaceVertex> vertices) {
  for (const SurfaceVertex& v : vertices) {
    SurfaceVertex large = v;
    large.measure *= 3;
    const Assembled<B> a = assemble_at<B>(*made.obstacle, {&v, 1}), b = assemble_at<B>(*made.obstacle, {&large, 1});
    if (!a.status.ok() || !b.status.ok()) continue;
    LocalConstraint<B> scaled = a.constraints[0];
    made.obstacle->scaling()->scale(3, scaled.data);
    for (int k = 0; k < made.obstacle->descriptor().data; ++k)
      if (const double found = b.constraints[0].data[k];
          !(std::fabs(found - scaled.data[k]) <= 1e-9 * (std::fabs(found) + std::fabs(scaled.data[k]))))
        return fmt::format("number {} is {:.6g}, by scale(3) {:.6g}, and with three times the measure {:.6g}", k,
                           a.constraints[0].data[k], scaled.data[k], found);
  }
  return {};
}

}  // namespace

template <int B>
std::vector<VertexCheck<B>> checks_of_equivariance() {
  return {{"equivariant", is_about_a_shape<B>, does_not_turn<B>}, {"measure", has_a_scaling<B>, does_not_grow<B>}};
}

template std::vector<VertexCheck<1>> checks_of_equivariance<1>();
template std::vector<VertexCheck<2>> checks_of_equivariance<2>();
template std::vector<VertexCheck<3>> checks_of_equivariance<3>();

}  // namespace signorini::conformance
