// Pressures from means: exact means in, the pressure at nodes out.
#include "core/fem/pressure_recovery.hpp"

#include <gtest/gtest.h>

#include "core/mesh/refine.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

/// The bottom of a unit square or cube under a pressure.
template <int D>
class Bottom {
 public:
  Bottom(Index cells, int order, const std::function<double(const Point<D>&)>& pressure) : pressure_(pressure) {
    if (order == 1)
      mesh_ = distorted_mesh<D>(cells);
    else
      refine_uniformly(distorted_mesh<D>(cells / 2), mesh_);
    nodes_.emplace(mesh_, order);
    Model<D> model;
    Selection on;
    on.where = expression([](const Site& s) { return s.x[D - 1] < 1e-9 ? 1.0 : 0.0; });
    model.obstacles = {{nullptr, on, ""}};
    const ContactSurface<D, D> surface(*nodes_, model, 0);
    for (Index p = 0; p < nodes_->size(); ++p) {
      if (nodes_->at(p)[D - 1] > 1e-9) continue;
      ContactNode<D> node{};
      node.vertex = p;
      node.direction[D - 1] = 1;
      node.area = surface.area(node);
      node.pressure = surface.mean(node, pressure);
      node.contact = node.pressure > 1e-12;
      contact_.push_back(node);
    }
    resolved_ = recover_pressure(*nodes_, surface, 0, 0, contact_).resolved;
  }

  bool resolved() const { return resolved_; }

  /// Of the recovered pressure over the mean, at nodes that bear at least half of the largest mean.
  double least_part() const {
    double largest = 0, out = infinity;
    for (const ContactNode<D>& node : contact_) largest = std::max(largest, node.pressure);
    for (const ContactNode<D>& node : contact_)
      if (node.pressure > 0.5 * largest) out = std::min(out, node.recovered / node.pressure);
    return out;
  }

  /// The largest difference at nodes up to a distance from the middle.
  double error(double radius) const {
    double out = 0;
    for (const ContactNode<D>& node : contact_) {
      const Point<D>& x = nodes_->at(node.vertex);
      if (distance(x) < radius) out = std::max(out, std::abs(node.recovered - pressure_(x)));
    }
    return out;
  }
  static double distance(const Point<D>& x) {
    double sum = 0;
    for (int i = 0; i < D - 1; ++i) sum += (x[i] - 0.5) * (x[i] - 0.5);
    return std::sqrt(sum);
  }

 private:
  std::function<double(const Point<D>&)> pressure_;
  Mesh<D> mesh_;
  std::optional<Nodes<D>> nodes_;
  std::vector<ContactNode<D>> contact_;
  bool resolved_ = false;
};

template <int D>
void expect_hertz(int order, double most) {
  const auto hertz = [](const Point<D>& x) {
    return std::sqrt(std::max(0.16 - std::pow(Bottom<D>::distance(x), 2), 0.0)) / 0.4;
  };
  const double error = Bottom<D>(12, order, hertz).error(0.1);
  EXPECT_LE(error, most) << D << "D, order " << order;
}

/// With five nodes from the middle to the edge. Means alone are too small by up to 1 %, for they know the curvature.
TEST(PressureRecovery, KnowsThatMeansOfCurvedPressuresAreSmaller) {
  expect_hertz<2>(2, 0.002);
  expect_hertz<3>(2, 0.003);
}

template <int D>
void expect_sane_on_coarse_meshes() {
  const auto hertz = [](const Point<D>& x) {
    return std::sqrt(std::max(0.16 - std::pow(Bottom<D>::distance(x), 2), 0.0)) / 0.4;
  };
  for (const int order : {1, 2})
    for (const int cells : {2, 4, 6, 8, 12}) {
      const Bottom<D> bottom(cells, order, hertz);
      EXPECT_GT(bottom.least_part(), 0.3) << D << "D, order " << order << ", " << cells << " cells";
      if (cells == 12) EXPECT_TRUE(bottom.resolved());
    }
  const auto narrow = [](const Point<D>& x) {
    return std::sqrt(std::max(0.01 - std::pow(Bottom<D>::distance(x), 2), 0.0));
  };
  EXPECT_FALSE(Bottom<D>(8, 1, narrow).resolved()) << "about one element from the middle to the edge";
}

/// What is fitted inside may be zero at a node that bears much.
TEST(PressureRecovery, NodesThatBearMuchHavePressure) {
  expect_sane_on_coarse_meshes<2>();
  expect_sane_on_coarse_meshes<3>();
}

template <int D>
void expect_exact(int order) {
  const auto linear = [](const Point<D>& x) { return 2 + x[0] - (D == 3 ? 0.5 * x[1] : 0); };
  EXPECT_LE((Bottom<D>(8, order, linear).error(0.3)), 1e-12) << D << "D, order " << order;
}

TEST(PressureRecovery, LinearPressuresAreExact) {
  for (const int order : {1, 2}) {
    expect_exact<2>(order);
    expect_exact<3>(order);
  }
}

}  // namespace
}  // namespace signorini::testing
