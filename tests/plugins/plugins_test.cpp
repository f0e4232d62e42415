// The plugins of apps/plugins against closed forms, and a binomial tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <vector>

#include "conformance/check.hpp"
#include "driver/driver.hpp"

namespace signorini::test {
namespace {

namespace fs = std::filesystem;

const fs::path built = SIGNORINI_PLUGINS;

fs::path library(const std::string& id) { return built / ("libsignorini_obstacle_" + id + ".so"); }
fs::path scene(const std::string& file) { return fs::path(SIGNORINI_SOURCE_DIR "/apps/plugins") / file; }

// Values at the vertices of a scene's body, and its report.
struct Solved {
  Solved(const std::string& file, const std::vector<std::string>& overrides) {
    Scene read = read_scene(scene(file), overrides);
    read.plugin_path = {built};
    Driver driver(std::move(read));
    report = driver.solve();
    EXPECT_TRUE(report.converged());
    u = driver.solution();
    points = driver.points();
    driver.visit(0, [&]<int D, int B>(const BodyRun<D, B>&) {
      dimension = D;
      components = B;
    });
  }

  std::size_t size() const { return u.size() / components; }
  // The number of the vertex at a place.
  std::size_t at(std::vector<double> place) const {
    for (std::size_t v = 0; v < size(); ++v) {
      bool here = true;
      for (std::size_t k = 0; k < dimension; ++k) here = here && std::fabs(points[v * dimension + k] - place[k]) < 1e-9;
      if (here) return v;
    }
    ADD_FAILURE() << "there is no vertex";
    return 0;
  }

  Report report;
  std::vector<double> u, points;
  std::size_t dimension = 0, components = 0;
};

void expect_conforms(const std::string& id, std::vector<std::string> settings = {}) {
  conformance::Options options;
  options.settings = std::move(settings);
  const conformance::Verdict verdict = conformance::check_plugin(library(id), options);
  EXPECT_TRUE(verdict.conforms()) << text_of(verdict);
}

TEST(Plugins, DoWhatEveryPluginHasTo) {
  expect_conforms("winkler");
  expect_conforms("porous_medium", {"start=0.1"});
  expect_conforms("american_put");
  expect_conforms("stefan");
  expect_conforms("elliptic_friction", {"grooves=[1, 0.3, 0.2]", "bound=0.1", "bound_across=0.3"});
}

// On coarse meshes of soft bodies, for which Gauss-Seidel steps are enough.
TEST(Plugins, GiveWhatGaussSeidelStepsAloneLeadTo) {
  for (const auto& [id, file] : {std::pair{"winkler", "footing.toml"}, {"elliptic_friction", "dragged.toml"}}) {
    std::ifstream in(scene(std::string(id) + "/" + file));
    std::string text((std::istreambuf_iterator<char>(in)), {});
    text = std::regex_replace(text, std::regex("young = \\w+"), "young = 10");
    text = std::regex_replace(text, std::regex("uniform = \\d"), "uniform = 0");
    const fs::path coarse = built / file;
    std::ofstream(coarse) << text;
    const auto found = conformance::compare_with_gauss_seidel(coarse, library(id));
    EXPECT_LT(found.difference, 1e-5) << id;
  }
}

// A rigid footing under a force P at e = 1/4: three quarters bear, the pressure grows linearly to 2 P / (3/4). Errors
// are those of a trapezoidal rule at the end of what bears, and of the block's own stiffness.
TEST(Plugins, AFootingOnWinklersFoundationLiftsOffOverAQuarter) {
  double last = INFINITY;
  for (const int refinements : {1, 3}) {
    const Solved r("winkler/footing.toml", {"refine.uniform=" + std::to_string(refinements), "body.0.young=1e6"});
    EXPECT_NEAR(r.report.last().contact[0].force[1], 1e-3, 1e-9);
    const double P = 1e-3, largest = -r.u[2 * r.at({0.5, 0}) + 1], lifted = r.u[2 * r.at({-0.5, 0}) + 1];
    const double error = std::fabs(largest / (2 * P / 0.75) - 1);
    EXPECT_LT(error, 5e-3);
    EXPECT_LT(error, last);
    last = error;
    // Depths are linear along the bottom: no depth at -1/4.
    EXPECT_NEAR(-0.5 + lifted / (lifted + largest), -0.25, 2e-3);
  }
  EXPECT_LT(last, 5e-4);
}

TEST(Plugins, WinklersFoundationBearsAColumnByItsStiffness) {
  const Solved r("winkler/footing.toml", {"load.0.value=[0, -0.001]", "obstacle.0.stiffness=0.25", "body.0.young=10",
                                          "refine.uniform=1", "solver.tolerance=1e-12"});
  for (std::size_t v = 0; v < r.size(); ++v) {
    if (r.points[2 * v + 1] == 0) {
      EXPECT_NEAR(r.u[2 * v + 1], -0.004, 4e-11);
    }
  }
}

// Everything slips along (0.6, 0.8): the traction is (g1^2 d1, g2^2 d2) / |(g1 d1, g2 d2)|.
TEST(Plugins, EllipticFrictionPullsAskew) {
  const double g1 = 0.1, g2 = 0.3, size = std::hypot(0.6 * g1, 0.8 * g2);
  const Solved r("elliptic_friction/dragged.toml", {"body.0.young=1e7", "solver.tolerance=1e-10"});
  const auto& force = r.report.last().contact[0].force;
  EXPECT_NEAR(force[0], -0.6 * g1 * g1 / size, 1e-6);
  EXPECT_NEAR(force[1], -0.8 * g2 * g2 / size, 1e-6);
}

// Below the bound in its direction nothing slips: inside the ellipse, though beyond its smaller half axis.
TEST(Plugins, EllipticFrictionSticksWithinTheEllipse) {
  const Solved r("elliptic_friction/dragged.toml", {"fix.0.value=[0, 0.00005, -0.001]"});  // traction 0.05 across
  const Solved slips("elliptic_friction/dragged.toml", {"fix.0.value=[0.0006, 0, -0.001]", "refine.uniform=1"});
  double moved = 0, slipped = 0;
  for (std::size_t v = 0; v < r.size(); ++v)
    if (r.points[3 * v + 2] == 0) moved = std::fmax(moved, std::hypot(r.u[3 * v], r.u[3 * v + 1]));
  for (std::size_t v = 0; v < slips.size(); ++v)
    if (slips.points[3 * v + 2] == 0) slipped = std::fmax(slipped, std::hypot(slips.u[3 * v], slips.u[3 * v + 1]));
  EXPECT_EQ(moved, 0);
  EXPECT_GT(slipped, 0);
}

// Barenblatt's solution for m = 2 in the plane from time 1 to 2: u = t^(-1/2) max(0, 0.03 - r^2 / (16 sqrt t)).
struct Spreading {
  double error = 0, amount_error = 0;
};

Spreading spread(int refinements, int steps) {
  const Solved r("porous_medium/spreading.toml", {"refine.uniform=" + std::to_string(refinements),
                                                  "steps.count=" + std::to_string(steps), "solver.tolerance=1e-12"});
  const double t = 2, h = 0.25 / (1 << refinements);
  double amount = 0, start = 0;
  Spreading found;
  for (std::size_t v = 0; v < r.size(); ++v) {
    const double x = r.points[2 * v], y = r.points[2 * v + 1], square = x * x + y * y;
    const double u = std::sqrt(std::fmax(r.u[v], 0)),
                 exact = std::fmax(0, 0.03 - square / (16 * std::sqrt(t))) / std::sqrt(t);
    // The integral of a node's basis function on the grid: of corners it does not depend on the diagonals but there.
    const double weight = h * h * (x == 0 ? 0.5 : 1) * (y == 0 ? 0.5 : 1);
    if (x > 0 || y > 0) found.error += weight * std::fabs(u - exact);
    amount += weight * u;
    start += weight * std::fmax(0, 0.03 - square / 16);
  }
  const double whole = 8 * 0.03 * 0.03 * std::acos(-1.0) / 4;  // C^2 / (2 k) pi / 2, of a quarter, k = 1/16
  found.error /= whole;
  found.amount_error = std::fabs(amount - start) / whole;
  return found;
}

TEST(Plugins, GasSpreadsAsBarenblattSays) {
  const Spreading coarse = spread(2, 5), fine = spread(4, 40);
  EXPECT_LT(coarse.error, 0.06);
  EXPECT_LT(fine.error, coarse.error / 4) << "order 1 in time, and at the edge in space";
  // At the corner the weight depends on the diagonal there.
  EXPECT_LT(fine.amount_error, 2e-3);
}

// Where the ice begins: behind its edge w grows as L/2 times the square of the distance.
double edge_error(int refinements, int steps) {
  const Solved r("stefan/melting.toml",
                 {"refine.uniform=" + std::to_string(refinements), "steps.count=" + std::to_string(steps)});
  double lambda = 0.5;  // the root of a growing function, by Newton's method
  for (int k = 0; k < 20; ++k) {
    const double root = std::sqrt(std::acos(-1.0)), e = std::exp(lambda * lambda),
                 f = root * lambda * e * std::erf(lambda);
    lambda -= (f - 1) / (root * e * (1 + 2 * lambda * lambda) * std::erf(lambda) + 2 * lambda);
  }
  EXPECT_NEAR(lambda, 0.6201, 5e-5) << "published";
  double last = 0, edge = 0;
  for (std::size_t v = 0; v < r.size(); ++v) {
    if (r.points[2 * v + 1] != 0 || !(r.u[v] > 0) || r.points[2 * v] < last) continue;
    last = r.points[2 * v];
    edge = last + std::sqrt(2 * r.u[v]);
  }
  return std::fabs(edge / (2 * lambda * std::sqrt(0.1)) - 1);
}

TEST(Plugins, IceMeltsAsNeumannSays) {
  const double coarse = edge_error(1, 10), fine = edge_error(3, 80);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, coarse / 3);
  EXPECT_LT(fine, 0.008);
}

// Cox, Ross and Rubinstein's binomial tree; the mean of n and n + 1 steps, between which it oscillates.
double american_put(double S, double K, double rate, double volatility, double maturity, int n) {
  const auto tree = [&](int steps) {
    const double dt = maturity / steps, up = std::exp(volatility * std::sqrt(dt));
    const double p = (std::exp(rate * dt) - 1 / up) / (up - 1 / up), discount = std::exp(-rate * dt);
    std::vector<double> value(steps + 1);
    const auto payoff = [&](int step, int ups) { return std::fmax(K - S * std::pow(up, 2 * ups - step), 0); };
    for (int k = 0; k <= steps; ++k) value[k] = payoff(steps, k);
    for (int step = steps - 1; step >= 0; --step)
      for (int k = 0; k <= step; ++k)
        value[k] = std::fmax(discount * (p * value[k + 1] + (1 - p) * value[k]), payoff(step, k));
    return value[0];
  };
  return (tree(n) + tree(n + 1)) / 2;
}

double put_error(int refinements, int steps) {
  const Solved r("american_put/put.toml",
                 {"refine.uniform=" + std::to_string(refinements), "steps.count=" + std::to_string(steps)});
  double error = 0;
  for (const double x : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
    const double price = american_put(100 * std::exp(x), 100, 0.05, 0.2, 1, 1000);
    error = std::fmax(error, std::fabs(r.u[r.at({x, 0})] - price));
  }
  return error;
}

TEST(Plugins, AnAmericanPutCostsWhatABinomialTreeSays) {
  EXPECT_NEAR(american_put(100, 100, 0.05, 0.2, 1, 1000), 6.0904, 1e-3) << "published: 6.090";
  const double coarse = put_error(0, 25), fine = put_error(1, 100);
  EXPECT_LT(fine, coarse / 2.5);
  EXPECT_LT(fine, 0.02) << "of 100";
}

}  // namespace
}  // namespace signorini::test
