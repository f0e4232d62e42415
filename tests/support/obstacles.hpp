#pragma once
#include <functional>
#include <memory>

#include "core/sdk/box_obstacle.hpp"

/// Obstacles defined by a function, so that tests of the solver need no plugin.
namespace signorini::test {

/// Bounds that are given with the problem.
template <int B>
class Box : public BoxObstacle<B> {
 public:
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"box", B, 2}}}; }
  void assemble(const SurfaceVertex*, std::size_t, LocalConstraint<B>*, Status& status) const noexcept override {
    status.fail(1, "the bounds of this obstacle are given with the problem");
  }
};

/// A constraint as a function of the vertex.
template <int B>
class Obstruction final : public Box<B> {
 public:
  using Constraint = std::function<LocalConstraint<B>(const SurfaceVertex&)>;
  explicit Obstruction(Constraint constraint) : constraint_(std::move(constraint)) {}
  void assemble(const SurfaceVertex* vertices, std::size_t count, LocalConstraint<B>* out,
                Status&) const noexcept override {
    for (std::size_t k = 0; k < count; ++k) out[k] = constraint_(vertices[k]);
  }

 private:
  Constraint constraint_;
};

using Bound1 = std::function<double(const double* position)>;

/// lower(x) <= u(x) <= upper(x)
inline std::shared_ptr<const Obstacle<1>> between(const Bound1& lower, const Bound1& upper) {
  return std::make_shared<Obstruction<1>>([=](const SurfaceVertex& v) {
    LocalConstraint<1> c;
    c.directions = 1;
    c.direction[0][0] = 1;
    c.lower[0] = lower ? lower(v.position) : -infinity;
    c.upper[0] = upper ? upper(v.position) : infinity;
    return c;
  });
}

/// -u.n <= (x - point).n for a unit normal n.
template <int B>
std::shared_ptr<const Obstacle<B>> plane(Point<B> point, Point<B> normal) {
  return std::make_shared<Obstruction<B>>([=](const SurfaceVertex& v) {
    LocalConstraint<B> c;
    c.directions = 1;
    double distance = 0;
    for (int i = 0; i < B; ++i) {
      c.direction[0][i] = normal[i];
      distance += (v.position[i] - point[i]) * normal[i];
    }
    c.lower[0] = -distance;
    c.upper[0] = infinity;
    return c;
  });
}

/// A rigid ball: normals differ from vertex to vertex.
template <int B>
std::shared_ptr<const Obstacle<B>> sphere(Point<B> center, double radius) {
  return std::make_shared<Obstruction<B>>([=](const SurfaceVertex& v) {
    LocalConstraint<B> c;
    c.directions = 1;
    double length = 0;
    for (int i = 0; i < B; ++i) {
      c.direction[0][i] = v.position[i] - center[i];
      length += c.direction[0][i] * c.direction[0][i];
    }
    length = std::sqrt(length);
    for (int i = 0; i < B; ++i) c.direction[0][i] /= length;
    c.lower[0] = radius - length;
    c.upper[0] = infinity;
    return c;
  });
}

}  // namespace signorini::test
