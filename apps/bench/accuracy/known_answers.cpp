#include "apps/bench/accuracy/known_answers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "apps/bench/accuracy/ring_mesh.hpp"
#include "apps/bench/problems.hpp"
#include "core/io/read_file.hpp"

namespace signorini::bench {
namespace {

using std::numbers::pi;
using Series = AccuracyProblem::Series;

const std::string order_1 = "body.0.order=1", order_2 = "body.0.order=2";

std::string refined(int times) { return fmt::format("refine.uniform={}", times); }

std::vector<Series> both_orders(int linear, int quadratic) {
  return {{"linear", {order_1}, linear}, {"quadratic", {order_2}, quadratic}};
}

/// Takes the answer from a run with quadratic elements, and says by how much it is off Hertz's for its force.
/// @param modulus E / (1 - nu^2); the radius of the body, or of what it is pressed on, is `radius`
void refer_to(AccuracyProblem& problem, const Question& question, int refinements, double modulus = 0,
              double radius = 1) {
  Answer& exact = problem.exact = solve(question, {order_2, refined(refinements)});
  problem.pressure = profile(exact.pressure);
  if (!problem.probe) exact.probe = not_there;
  problem.about += fmt::format(
      "The answer is that of quadratic elements with {:.0f} unknowns: force {:.6e}, largest pressure {:.6f}, {} {:.6f}",
      exact.unknowns, exact.force, exact.peak, problem.width, exact.radius);
  if (modulus > 0) {
    const double F = exact.force;
    const double width = question.round ? std::cbrt(3 * F * radius / (4 * modulus))
                                        : 2 * std::sqrt(4 * F * radius / (pi * modulus));  // Johnson, ch. 4
    const double peak = question.round ? 3 * F / (2 * pi * width * width) : 4 * F / (pi * width);
    problem.about += fmt::format(
        ". That is {:+.2f} % and {:+.2f} % off Hertz's pressure and {} for that force: the body is no half space",
        100 * (exact.peak / peak - 1), 100 * (exact.radius / width - 1), problem.width);
  }
  problem.about += ".";
}

/// Below the lowest point of a round body, at multiples of the contact's radius.
/// @param make a point from a distance to the axis and a height
template <class Make>
std::vector<Position> below(double bottom, double radius, const Make& make) {
  std::vector<Position> out;
  for (const double r : {0.0, 0.5, 1.0, 1.5})
    for (const double depth : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0})
      out.push_back(make(r * radius, bottom + depth * radius));
  return out;
}

constexpr double modulus = 1 / (1 - 0.09);  // of young = 1, poisson = 0.3
const auto in_plane = [](double x, double y) { return Position{x, y, 0}; };

Question scene_of(const char* file) {
  return {.scene = read_file(scene_file(file), "scene"), .folder = scene_file(file).parent_path()};
}

constexpr double ball_radius = 0.1076;  // of its contact, about

Question axisymmetric_question() {
  Question out = scene_of("ball_axisymmetric.toml");
  out.round = true;
  out.samples = below(-1, ball_radius, in_plane);
  return out;
}

AccuracyProblem axisymmetric_ball(int less, const std::filesystem::path&) {
  AccuracyProblem out{.title = "Ball on a plane, axisymmetric",
                      .about = "`ball_axisymmetric.toml`. ",
                      .question = axisymmetric_question(),
                      .series = both_orders(6 - less, 5 - less)};
  refer_to(out, out.question, 7 - less, modulus);
  return out;
}

AccuracyProblem cylinder_on_plane(int less, const std::filesystem::path&) {
  AccuracyProblem out{.title = "Cylinder on a plane, plane strain",
                      .about = "`cylinder_on_plane_2d.toml`. ",
                      .question = scene_of("cylinder_on_plane_2d.toml"),
                      .width = "width",
                      .series = both_orders(6 - less, 5 - less)};
  out.question.samples = below(-1, 0.045, in_plane);
  refer_to(out, out.question, 7 - less, modulus);
  return out;
}

/// Under internal pressure in a bore that is a little larger; Lame's formulas.
AccuracyProblem ring_in_bore(int less, const std::filesystem::path& scratch) {
  constexpr double E = 100, nu = 0.3, a = 1, b = 2, inside = 1, gap = 0.002;
  write_quarter_ring(scratch / "ring.msh", a, b);
  AccuracyProblem out{
      .title = "Ring in a bore",
      .about =
          "1 < r < 2 under internal pressure 1 in a rigid bore of radius 2.002, E = 100, ν = 0.3, plane strain; a "
          "quarter, from a mesh whose edges are chords of 15 degrees. The answer is Lamé's; `displacement` is that "
          "of the inner edge.",
      .question = {.scene = R"toml([[body]]
name = "ring"
mesh = "ring.msh"
young = 100
poisson = 0.3
[symmetry]
x = 0
y = 0
[[load]]
body = "ring"
on = "inner"
value = ["-nx", "-ny"]
[[obstacle]]
type = "contact"
body = "ring"
on = "outer"
shape = "sphere"
center = [0, 0]
radius = 2.002
inside = true
[[probe]]
name = "inside"
body = "ring"
at = [0, 1]
)toml",
                   .folder = scratch,
                   .along = [](const Position& x) { return std::atan2(x[1], x[0]); }},
      .probe = "displacement",
      .series = both_orders(6 - less, 5 - less)};
  // sigma_rr = A - B / r^2 with A = (a^2 - p b^2) / (b^2 - a^2), B = (1 - p) a^2 b^2 / (b^2 - a^2), and
  // u = (1 + nu) / E ((1 - 2 nu) A r + B / r), which is `gap` at r = b.
  const double over = b * b - a * a, c = (1 + nu) / E / over;
  const double p =
      (c * ((1 - 2 * nu) * a * a * b + a * a * b) * inside - gap) / (c * ((1 - 2 * nu) * b * b * b + a * a * b));
  const double A = (inside * a * a - p * b * b) / over, B = (inside - p) * a * a * b * b / over;
  out.exact.peak = p;
  out.exact.probe = (1 + nu) / E * ((1 - 2 * nu) * A * a + B / a);
  out.pressure = [p](double) { return p; };
  for (const double angle : {0.1, 0.4, 0.7, 1.0, 1.3})
    for (const double r : {1.01, 1.1, 1.3, 1.6, 1.9, 1.98}) {
      out.question.samples.push_back({r * std::cos(angle), r * std::sin(angle), 0});
      out.exact.stress.push_back(von_mises({A - B / (r * r), A + B / (r * r), 2 * nu * A, 0, 0, 0}));
    }
  return out;
}

std::string block(const char* shape, const char* from, const char* to, const char* cells) {
  return fmt::format(
      "[[body]]\nname = \"block\"\nshape = \"{}\"\nfrom = {}\nto = {}\ncells = {}\nyoung = 1\npoisson = 0.3\n", shape,
      from, to, cells);
}

/// In space between smooth walls, with the answer of the plane.
AccuracyProblem block_on_cylinder(int less, const std::filesystem::path&) {
  const std::string plane = block("rectangle", "[-1, 0]", "[1, 1]", "[16, 8]") + R"toml([symmetry]
x = 0
[[fix]]
body = "block"
on = "top"
value = ["free", -0.02]
[[obstacle]]
type = "contact"
body = "block"
on = "bottom"
shape = "sphere"
center = [0, -4]
radius = 4
)toml";
  AccuracyProblem out{
      .title = "Block on a cylinder, in space",
      .about =
          "−1 < x < 1, −1/2 < y < 1/2, 0 < z < 1, pressed by 0.02 on a rigid cylinder of radius 4 along y; the ends "
          "across y are held there, so that plane strain is the answer. A quarter. ",
      .question = {.scene = block("box", "[-1, -0.5, 0]", "[1, 0.5, 1]", "[16, 4, 8]") + R"toml([symmetry]
x = 0
y = 0
[[fix]]
body = "block"
on = "top"
value = ["free", "free", -0.02]
[[fix]]
body = "block"
on = "back"
value = ["free", 0, "free"]
[[obstacle]]
type = "contact"
body = "block"
on = "bottom"
shape = "cylinder"
center = [0, 0, -4]
axis = [0, 1, 0]
radius = 4
)toml"},
      .width = "width",
      .series = both_orders(4 - less, 3 - less)};
  Question flat{.scene = plane};
  constexpr double half_width = 0.2;  // of the contact, about
  flat.samples = below(0, half_width, in_plane);
  out.question.samples = below(0, half_width, [](double x, double z) { return Position{x, 0.2, z}; });
  refer_to(out, flat, 6 - less);
  return out;
}

/// The edges are numbered from the lower one.
AccuracyProblem cooks_membrane(int less, const std::filesystem::path&) {
  AccuracyProblem out{
      .title = "Cook's membrane, nearly incompressible, on a disk",
      .about =
          "Corners (0, 0), (48, 44), (48, 60), (0, 44), clamped at the left, E = 1, ν = 0.4999, plane strain, "
          "pressure 0.005 on the upper edge, below the lower one a rigid disk of radius 200 that touches it. "
          "`deflection` is that of (48, 60). *Linear* is what locks: `order = 1`, `pressure = \"none\"`; *quadratic* "
          "the default, with a pressure of its own. Linear elements on the next mesh are not solved in 200 cycles. ",
      .question = {.scene = R"toml([[body]]
name = "membrane"
shape = "polygon"
points = [[0, 0], [48, 44], [48, 60], [0, 44]]
size = 4
young = 1
poisson = 0.4999
[[fix]]
body = "membrane"
on = "edge3"
value = [0, 0]
[[load]]
body = "membrane"
on = "edge2"
value = ["-0.005*nx", "-0.005*ny"]
[[obstacle]]
type = "contact"
body = "membrane"
on = "edge0"
shape = "sphere"
center = ["33.6 + 200*44/sqrt(44^2 + 48^2)", "30.8 - 200*48/sqrt(44^2 + 48^2)"]
radius = 200
[[probe]]
name = "corner"
body = "membrane"
at = [48, 60]
)toml"},
      .width = "width",
      .probe = "deflection",
      .series = {{"linear", {order_1, "body.0.pressure=none"}, 4 - less}, {"quadratic", {order_2}, 4 - less}}};
  for (const double x : {16, 24, 32, 40})
    for (const double part : {0.1, 0.3, 0.5, 0.7, 0.9})
      out.question.samples.push_back({x, (1 - part) * (44.0 / 48 * x) + part * (44 + x / 3), 0});
  refer_to(out, out.question, 6 - less);
  return out;
}

/// Timoshenko and Goodier, Theory of Elasticity, ch. 3: the shear stress is a parabola over the ends, and the left end
/// moves as that wants. E = P = D = 1, nu = 0.3, L = 10.
AccuracyProblem cantilever(int less, const std::filesystem::path&) {
  AccuracyProblem out{
      .title = "Cantilever",
      .about =
          "L/H = 10, ν = 0.3, plane stress, the exact solution's forces and displacements at its ends; "
          "4 cells through the "
          "thickness on the coarsest mesh, 8 on the next; solved to 1e-11. The answer is Timoshenko's and Goodier's.",
      .question = {.scene = R"toml([[body]]
name = "beam"
shape = "rectangle"
from = [0, -0.5]
to = [10, 0.5]
cells = [40, 4]
plane = "stress"
young = 1
poisson = 0.3
[[fix]]
body = "beam"
on = "left"
value = ["-4.6*y*(y^2 - 0.25)", "18*y^2"]
[[load]]
body = "beam"
on = "right"
value = [0, "6*(0.25 - y^2)"]
[[probe]]
name = "tip"
body = "beam"
at = [10, 0]
[solver]
tolerance = 1e-11
)toml"},
      .probe = "tip",
      .series = both_orders(5 - less, 4 - less)};
  out.exact.probe = 4027.5;  // 2 ((4 + 5 nu) L / 4 + 2 L^3)
  for (const double x : {1, 3, 5, 7, 9})
    for (const double y : {-0.45, -0.3, -0.1, 0.2, 0.4}) {
      out.question.samples.push_back({x, y, 0});
      out.exact.stress.push_back(von_mises({-12 * (10 - x) * y, 0, 0, 6 * (0.25 - y * y), 0, 0}));
    }
  return out;
}

}  // namespace

AccuracyProblem ball_in_space(int less, const std::filesystem::path&) {
  AccuracyProblem out{.title = "Ball on a plane, in space",
                      .about = "`ball_on_plane.toml`; *a quarter* has `[symmetry]` x = 0, y = 0. ",
                      .question = scene_of("ball_on_plane.toml"),
                      .series = {{"linear", {order_1}, 4 - less},
                                 {"quadratic", {order_2}, 3 - less},
                                 {"quadratic, a quarter", {order_2, "symmetry.x=0", "symmetry.y=0"}, 3 - less}}};
  out.question.round = true;
  out.question.along = [](const Position& x) { return std::hypot(x[0], x[1]); };
  out.question.samples = below(-1, ball_radius, [](double r, double z) { return Position{r, 0, z}; });
  refer_to(out, axisymmetric_question(), 7 - less, modulus);
  return out;
}

const std::vector<NamedProblem>& accuracy_problems() {
  static const std::vector<NamedProblem> all{{"ball", ball_in_space},         {"ball_axisymmetric", axisymmetric_ball},
                                             {"cylinder", cylinder_on_plane}, {"ring", ring_in_bore},
                                             {"block", block_on_cylinder},    {"cook", cooks_membrane},
                                             {"cantilever", cantilever}};
  return all;
}

}  // namespace signorini::bench
