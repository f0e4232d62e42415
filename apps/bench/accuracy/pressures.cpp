#include "apps/bench/accuracy/pressures.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "apps/bench/problems.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fem/elements/element.hpp"
#include "core/fem/elements/polynomial_fit.hpp"
#include "core/fem/recovery/contact_surface.hpp"
#include "driver/driver.hpp"

namespace signorini::bench {
namespace {
using std::numbers::pi;

/// One run beside Hertz for the same force.
struct Measured {
  double unknowns = 0, seconds = 0;
  double force = 0;
  double radius = 0;  ///< relative difference, from the area of the report
  double nodal_radius = 0;
  /// Of pressures: relative differences of the largest one, and in the mean square over the contact.
  struct Pressure {
    double peak = 0, mean = 0;
  };
  Pressure nodal, averaged, mass, ring, recovered;
};

/// A ball or cylinder with radius, modulus E / (1 - nu^2) one and poles that are at the origin of `distance`.
struct Hertz {
  double radius, peak;

  Hertz(bool round, double force, double modulus) {
    radius = round ? std::cbrt(3 * force / (4 * modulus)) : std::sqrt(4 * force / (pi * modulus));
    peak = round ? 3 * force / (2 * pi * radius * radius) : 2 * force / (pi * radius);
  }
  double at(double distance) const {
    const double part = distance / radius;
    return part < 1 ? peak * std::sqrt(1 - part * part) : 0;
  }
};

/// What the nodes in contact tell, and other ways to make pressures of it.
template <int D>
class Recoveries {
 public:
  Recoveries(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& state)
      : nodes_(nodes), surface_(nodes, model, 0) {
    for (const ContactNode<D>& node : state.nodes)
      if (node.contact && node.pressure > 0) {
        number_[node.vertex] = static_cast<int>(node_.size());
        node_.push_back(&node);
      }
    assemble();
  }

  const std::vector<const ContactNode<D>*>& nodes() const { return node_; }

  /// One pass of averaging with the mass matrix of the boundary.
  Eigen::VectorXd averaged() const { return (mass_ * pressures()).cwiseQuotient(areas()); }

  /// The linear finite element function with these nodal forces.
  Eigen::VectorXd by_mass() const {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(mass_);
    return solver.solve(pressures().cwiseProduct(areas()));
  }

  /// A linear fit over the node and its neighbours in contact, at the centroids of hat functions.
  Eigen::VectorXd ring() const {
    Eigen::VectorXd out = pressures();
    for (int k = 0; k < out.size(); ++k) {
      std::vector<Sample<D - 1>> samples;
      for (Eigen::SparseMatrix<double>::InnerIterator other(mass_, k); other; ++other) {
        const ContactNode<D>& node = *node_[static_cast<std::size_t>(other.row())];
        const Point<D> from =
            difference<D>(surface_.middle(node), nodes_.at(node_[static_cast<std::size_t>(k)]->vertex));
        Sample<D - 1>& sample = samples.emplace_back();
        std::copy_n(from.begin(), D - 1, sample.x.begin());
        sample.value = {node.pressure};
      }
      if (samples.size() <= D) continue;
      if (const auto values = PolynomialFit<1, D - 1>(samples).at({})) out[k] = values->front();
    }
    return out;
  }

  Eigen::VectorXd pressures() const {
    return each([](const ContactNode<D>& node) { return node.pressure; });
  }
  Eigen::VectorXd recovered() const {
    return each([](const ContactNode<D>& node) { return node.recovered; });
  }
  Eigen::VectorXd areas() const {
    return each([](const ContactNode<D>& node) { return node.area; });
  }

 private:
  template <class Value>
  Eigen::VectorXd each(const Value& value) const {
    Eigen::VectorXd out(static_cast<Eigen::Index>(node_.size()));
    for (std::size_t k = 0; k < node_.size(); ++k) out[static_cast<Eigen::Index>(k)] = value(*node_[k]);
    return out;
  }

  void assemble() {
    std::vector<Eigen::Triplet<double>> entries;
    for (const ContactNode<D>* node : node_)
      for (const Index face : surface_.faces(*node))
        for (const Index other : nodes_.of_face(face)) {
          const auto found = number_.find(other);
          if (found == number_.end()) continue;
          const double share = face_share(nodes_, face, node->vertex) / (D + 1) * (other == node->vertex ? 2 : 1);
          entries.emplace_back(found->second, number_.at(node->vertex), share);
        }
    mass_.resize(static_cast<Eigen::Index>(node_.size()), static_cast<Eigen::Index>(node_.size()));
    mass_.setFromTriplets(entries.begin(), entries.end());
  }

  const Nodes<D>& nodes_;
  const ContactSurface<D, D> surface_;
  std::vector<const ContactNode<D>*> node_;
  std::map<Index, int> number_;
  Eigen::SparseMatrix<double> mass_;
};

template <int D>
double distance(const Point<D>& x) {
  return D == 2 ? std::abs(x[0]) : std::hypot(x[0], x[1]);
}

template <int D>
Measured::Pressure compare(const Recoveries<D>& all, const Nodes<D>& nodes, const Eigen::VectorXd& pressure,
                           const Hertz& hertz) {
  const Eigen::VectorXd areas = all.areas();
  double squares = 0;
  for (Eigen::Index k = 0; k < pressure.size(); ++k) {
    const Point<D>& x = nodes.at(all.nodes()[static_cast<std::size_t>(k)]->vertex);
    squares += areas[k] * std::pow(pressure[k] - hertz.at(distance<D>(x)), 2);
  }
  return {pressure.maxCoeff() / hertz.peak - 1, std::sqrt(squares / areas.sum()) / hertz.peak};
}

template <int D>
void measure(const BodyRun<D, D>& run, const Scene& scene, Measured& out) {
  const Scene::Body& body = scene.bodies[0];
  const double nu = *body.poisson.constant(), modulus = *body.young.constant() / (1 - nu * nu);
  const ContactSummary<D>& contact = run.results().contact.obstacles[0];
  const bool round = D == 3 || body.plane == Plane::axisymmetric;
  out.force = contact.force[D - 1];
  const Hertz hertz(round, out.force, modulus);
  double nodal_area = 0, nodal_peak = 0;
  for (const ContactNode<D>& node : run.results().contact.nodes) {
    nodal_area += node.pressure > 0 ? node.area : 0;
    nodal_peak = std::max(nodal_peak, node.pressure);
  }
  const auto radius = [&](double area) { return (round ? std::sqrt(area / pi) : area / 2) / hertz.radius - 1; };
  out.radius = radius(contact.area);
  out.nodal_radius = radius(nodal_area);
  out.nodal.peak = nodal_peak / hertz.peak - 1;
  out.recovered.peak = contact.max_pressure / hertz.peak - 1;
  if (body.plane == Plane::axisymmetric) return;
  Model<D> model;
  model.obstacles = {{nullptr, scene.obstacles[0].on, ""}};
  const Recoveries<D> all(run.nodes(), model, run.results().contact);
  out.nodal = compare<D>(all, run.nodes(), all.pressures(), hertz);
  out.averaged = compare<D>(all, run.nodes(), all.averaged(), hertz);
  out.mass = compare<D>(all, run.nodes(), all.by_mass(), hertz);
  out.ring = compare<D>(all, run.nodes(), all.ring(), hertz);
  out.recovered = compare<D>(all, run.nodes(), all.recovered(), hertz);
}

Measured solve(const std::string& file, std::vector<std::string> overrides, int refinements) {
  overrides.push_back(fmt::format("refine.uniform={}", refinements));
  Driver driver(linear_scene(file, std::move(overrides)));
  const Stopwatch watch;
  driver.solve([] {});
  Measured out;
  out.seconds = watch.elapsed();
  if (!driver.report().last().summary.converged())
    throw Error(Exit::not_converged, driver.report().last().summary.reason);
  out.unknowns = static_cast<double>(driver.report().last().summary.level_unknowns.back());
  driver.visit(0, [&]<int D, int B>(const BodyRun<D, B>& run) {
    if constexpr (D == B) measure<D>(run, driver.scene(), out);
  });
  return out;
}

std::string percent(double part) { return fmt::format("{:+.2f} %", 100 * part); }

void print_recoveries(const char* title, const std::string& file, int from, int to) {
  fmt::print(
      "### {}\n\nDifferences from Hertz for the same force: of the largest pressure, and in brackets in the mean "
      "square "
      "over the contact.\n\n| unknowns | nodal | averaged | mass matrix | linear fit | recovered | radius, nodal | "
      "radius |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n",
      title);
  for (int k = from; k <= to; ++k) {
    const Measured m = solve(file, {}, k);
    fmt::print("| {} |", m.unknowns);
    for (const auto& p : {m.nodal, m.averaged, m.mass, m.ring, m.recovered})
      fmt::print(" {} ({:.2f}) |", percent(p.peak), 100 * p.mean);
    fmt::print(" {} | {} |\n", percent(m.nodal_radius), percent(m.radius));
    std::fflush(stdout);
  }
  fmt::print("\n");
}

void print_ball(const char* title, const std::string& file, int from, int to) {
  fmt::print("### {}\n\n| unknowns | force | largest pressure | radius | seconds |\n| --- | --- | --- | --- | --- |\n",
             title);
  for (int k = from; k <= to; ++k) {
    const Measured m = solve(file, {}, k);
    fmt::print("| {} | {:.6e} | {} | {} | {:.3f} |\n", m.unknowns, m.force, percent(m.recovered.peak),
               percent(m.radius), m.seconds);
    std::fflush(stdout);
  }
  fmt::print("\n");
}

}  // namespace

void print_pressures(bool quick) {
  const int less = quick ? 1 : 0;
  print_recoveries("Cylinder on a plane", "cylinder_on_plane_2d.toml", 1, 6 - less);
  print_recoveries("Ball on a plane", "ball_on_plane.toml", 0, 3 - less);
  print_ball("The ball in space", "ball_on_plane.toml", 0, 3 - less);
  print_ball("The axisymmetric ball", "ball_axisymmetric.toml", 0, 6 - less);
}

}  // namespace signorini::bench
