#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/component/settings.hpp"
#include "core/constraints/bound.hpp"
#include "core/fem/elements/nodes.hpp"
#include "core/fem/model/model.hpp"
#include "core/fem/model/obstacle_motion.hpp"

namespace signorini {

/// The obstacles of a model, at nodes of a mesh; both are kept references to.
template <int D, int B>
class ModelPlaces final : public ObstaclePlaces<B> {
 public:
  ModelPlaces(const Nodes<D>& nodes, const Model<B>& model) : nodes_(nodes), model_(model) {}

  Index count() const override { return static_cast<Index>(model_.obstacles.size()); }
  const std::shared_ptr<const Obstacle<B>>& obstacle(Index k) const override { return model_.obstacles[k].obstacle; }
  std::string origin(Index k) const override { return model_.obstacles[k].origin; }
  /// Plugins name the place themselves.
  std::string origin_at(Index k, Index) const override { return origin(k); }
  std::string place(Index p) const override { return fmt::format("({})", fmt::join(nodes_.at(p), ", ")); }
  double size() const override {
    double size = 0;
    for (const Point<D>& x : nodes_.mesh().points)
      for (const double c : x) size = std::max(size, std::fabs(c));
    return size;
  }

  std::array<double, B> motion(Index k, const SurfaceVertex& at, Status& status) const override {
    return obstacle_motion(model_.obstacles[k], at, status);
  }
  bool on_axis(Index p) const override { return B == D && model_.plane == Plane::axisymmetric && nodes_.at(p)[0] == 0; }
  void check_asked(Index k) const override {
    if (const auto& term = model_.obstacles[k]; term.settings) signorini::check_asked(*term.settings, term.origin);
  }

 private:
  const Nodes<D>& nodes_;
  const Model<B>& model_;
};

}  // namespace signorini
