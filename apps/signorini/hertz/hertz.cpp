/// signorini_hertz REPORT.json SCENE.toml: contact radius and peak pressure of a solved ball or cylinder beside those
/// that Hertz's theory gives for the same force (K. L. Johnson, Contact Mechanics, Cambridge 1985, ch. 4).
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/base/error.hpp"
#include "core/scene/scene.hpp"

namespace signorini {
namespace {
using std::numbers::pi;

/// What the theory needs to know about a scene.
struct Bodies {
  double radius;   ///< 1 / (1/R_body + 1/R_obstacle)
  double modulus;  ///< E / (1 - nu^2), the obstacle is rigid
};

/// Contact radius (half width in 2D) and peak pressure.
struct Contact {
  double radius, pressure;
};

/// F: force on a ball.
Contact ball(const Bodies& bodies, double force) {
  const double a = std::cbrt(3 * force * bodies.radius / (4 * bodies.modulus));
  return {a, 3 * force / (2 * pi * a * a)};
}

/// P: force per length on a cylinder.
Contact cylinder(const Bodies& bodies, double force) {
  const double a = std::sqrt(4 * force * bodies.radius / (pi * bodies.modulus));
  return {a, 2 * force / (pi * a)};
}

double constant(const Field& field, const std::string& place) {
  if (!field.constant()) input_error(place, "a number was expected, to compare with Hertz");
  return *field.constant();
}

double body_radius(const Scene::Body& body) {
  if (const auto* disk = std::get_if<geometry::Disk>(&body.shape)) return disk->radius;
  if (const auto* round = std::get_if<geometry::Ball>(&body.shape)) return round->radius;
  input_error(body.source.table, "a ball, half_ball, disk or half_disk was expected, to compare with Hertz");
}

double obstacle_curvature(const Scene::Obstacle& obstacle) {
  if (obstacle.shape && std::holds_alternative<Scene::PlaneShape>(*obstacle.shape)) return 0;
  if (const auto* sphere = obstacle.shape ? std::get_if<Scene::SphereShape>(&*obstacle.shape) : nullptr)
    return (sphere->inside ? -1 : 1) / constant(sphere->radius, obstacle.source.of("radius"));
  input_error(obstacle.source.table, "a plane or a sphere was expected, to compare with Hertz");
}

Bodies bodies(const Scene& scene) {
  const Scene::Body& body = scene.bodies.front();
  if (scene.obstacles.empty()) input_error(scene.file.string(), "the scene has no obstacle to compare with Hertz");
  if (body.orthotropic) input_error(body.source.of("orthotropic"), "Hertz's formulas are for isotropic bodies");
  const double young = constant(body.young, body.source.of("young"));
  const double poisson = constant(body.poisson, body.source.of("poisson"));
  return {1 / (1 / body_radius(body) + obstacle_curvature(scene.obstacles.front())), young / (1 - poisson * poisson)};
}

nlohmann::json read_report(const std::string& file) {
  std::ifstream in(file);
  if (!in) input_error(file, "cannot be read");
  return nlohmann::json::parse(in);
}

void print_row(const char* what, double computed, double hertz) {
  fmt::print("  {:<16} {:12.6g} {:12.6g} {:+10.2f} %\n", what, computed, hertz, 100 * (computed / hertz - 1));
}

void compare(const std::string& report_file, const std::string& scene_file) {
  const Scene scene = read_scene(scene_file);
  const auto contact = read_report(report_file).at("contact").at(0);
  double squares = 0;
  for (const double component : contact.at("force")) squares += component * component;
  const double force = std::sqrt(squares), area = contact.at("area");
  const bool plane = scene.dimension == 2 && scene.bodies.front().plane != Plane::axisymmetric;
  const Contact hertz = plane ? cylinder(bodies(scene), force) : ball(bodies(scene), force);
  fmt::print("Comparison with Hertz for the force {:.6g}{}\n", force, plane ? " per length" : "");
  fmt::print("  {:<16} {:>12} {:>12} {:>12}\n", "", "computed", "Hertz", "difference");
  print_row(plane ? "half width" : "contact radius", plane ? area / 2 : std::sqrt(area / pi), hertz.radius);
  print_row("peak pressure", contact.at("max_pressure"), hertz.pressure);
}
}  // namespace
}  // namespace signorini

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: signorini_hertz REPORT.json SCENE.toml\n");
    return 1;
  }
  try {
    signorini::compare(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "signorini_hertz: error: %s\n", error.what());
    return 2;
  }
}
