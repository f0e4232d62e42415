// Quadratic elements: orders of convergence on smooth problems, and the cycles that they take beside linear ones.
#include "core/fem/recovery/error_norm.hpp"
#include "run.hpp"
#include "scene_text.hpp"

namespace signorini::test {
namespace {

constexpr const char* block2 = "shape = \"rectangle\"\nfrom = [0, 0]\nto = [1, 1]\ncells = [{0}, {0}]\norder = {1}\n";
constexpr const char* block3 =
    "shape = \"box\"\nfrom = [0, 0, 0]\nto = [1, 1, 1]\ncells = [{0}, {0}, {0}]\norder = {1}\n";

template <int D>
std::string block(int cells, int order) {
  return fmt::format(fmt::runtime(D == 2 ? block2 : block3), cells, order);
}

/// A smooth solution, with what it needs as text.
template <int D, int B>
struct Smooth;

template <int D>
struct Smooth<D, 1> {
  static constexpr const char* material = "equation = \"diffusion\"\ndiffusion = 2\n";
  // u = sin(2 x + y) (+ cos(3 z - x))
  static std::vector<std::string> value() { return {D == 2 ? "sin(2*x+y)" : "sin(2*x+y)+cos(3*z-x)"}; }
  static std::vector<std::string> source() { return {D == 2 ? "10*sin(2*x+y)" : "10*sin(2*x+y)+20*cos(3*z-x)"}; }
  static std::array<double, 1> at(const Point<D>& x) {
    return {std::sin(2 * x[0] + x[1]) + (D == 3 ? std::cos(3 * x[D - 1] - x[0]) : 0)};
  }
  static Gradient<D, 1> slope(const Point<D>& x) {
    const double c = std::cos(2 * x[0] + x[1]), s = D == 3 ? std::sin(3 * x[D - 1] - x[0]) : 0;
    Gradient<D, 1> g{};
    g[0][0] = 2 * c + s;
    g[0][1] = c;
    if (D == 3) g[0][D - 1] = -3 * s;
    return g;
  }
};

// lambda = mu = 1; f = -(mu Laplace u + (lambda + mu) grad div u)
template <>
struct Smooth<2, 2> {
  static constexpr const char* material = "young = 2.5\npoisson = 0.25\n";
  static std::vector<std::string> value() { return {"sin(x+2*y)", "cos(2*x-y)"}; }
  static std::vector<std::string> source() {
    return {"5*sin(x+2*y) - 2*(-sin(x+2*y)+2*cos(2*x-y))", "5*cos(2*x-y) - 2*(-2*sin(x+2*y)-cos(2*x-y))"};
  }
  static std::array<double, 2> at(const Point<2>& x) { return {std::sin(x[0] + 2 * x[1]), std::cos(2 * x[0] - x[1])}; }
  static Gradient<2, 2> slope(const Point<2>& x) {
    const double c = std::cos(x[0] + 2 * x[1]), s = std::sin(2 * x[0] - x[1]);
    return {{{c, 2 * c}, {-2 * s, s}}};
  }
};

template <>
struct Smooth<3, 3> {
  static constexpr const char* material = "young = 2.5\npoisson = 0.25\n";
  static std::vector<std::string> value() { return {"sin(x+2*y)", "cos(2*y-z)", "sin(z+x)"}; }
  static std::vector<std::string> source() {
    return {"5*sin(x+2*y) - 2*(-sin(x+2*y)-sin(z+x))", "5*cos(2*y-z) - 2*(-2*sin(x+2*y)-4*cos(2*y-z))",
            "2*sin(z+x) - 2*(2*cos(2*y-z)-sin(z+x))"};
  }
  static std::array<double, 3> at(const Point<3>& x) {
    return {std::sin(x[0] + 2 * x[1]), std::cos(2 * x[1] - x[2]), std::sin(x[2] + x[0])};
  }
  static Gradient<3, 3> slope(const Point<3>& x) {
    const double a = std::cos(x[0] + 2 * x[1]), b = std::sin(2 * x[1] - x[2]), c = std::cos(x[2] + x[0]);
    return {{{a, 2 * a, 0}, {0, -2 * b, b}, {c, 0, c}}};
  }
};

std::string list(const std::vector<std::string>& values) {
  std::string out;
  for (const std::string& value : values) out += (out.empty() ? "['" : ", '") + value + "'";
  return out + "]";
}

/// That solution as boundary values and source, in a scene without any obstacle.
template <int D, int B>
std::string smooth(int cells, int order) {
  using P = Smooth<D, B>;
  return fmt::format(
      "[[body]]\nname = \"b\"\n{}{}[[fix]]\nbody = \"b\"\non = \"boundary\"\nvalue = {}\n"
      "[[load]]\nbody = \"b\"\nvalue = {}\n[solver]\ntolerance = 1e-9\n",
      block<D>(cells, order), P::material, list(P::value()), list(P::source()));
}

template <int D, int B>
void expect_orders_on_smooth_problems(int cells, int refinements) {
  using P = Smooth<D, B>;
  for (const int order : {1, 2}) {
    Errors energy, l2;
    for (int k = 0; k <= refinements; ++k) {
      const auto r = run<D, B>(smooth<D, B>(cells, order), {uniform(k)});
      energy.add(energy_error<D, B>(r.nodes(), r.model, r.u(), P::slope));
      l2.add(l2_error<D, B>(r.nodes(), r.u(), P::at));
      show(
          "{}D, {} unknowns per node, order {}: {} nodes, energy {:.3e} order {:.2f}, L2 {:.3e} order {:.2f}, {} "
          "cycles\n",
          D, B, order, r.nodes().size(), energy.value.back(), energy.last_order(), l2.value.back(), l2.last_order(),
          r.summary().iterations);
    }
    EXPECT_NEAR(energy.last_order(), order, 0.1);
    EXPECT_NEAR(l2.last_order(), order + 1, 0.15);
  }
}

TEST(Quadratic, OrdersOnSmoothProblems) {
  expect_orders_on_smooth_problems<2, 1>(4, 3);
  expect_orders_on_smooth_problems<3, 1>(3, 2);
  expect_orders_on_smooth_problems<2, 2>(4, 3);
  expect_orders_on_smooth_problems<3, 3>(2, 2);
}

/// The largest error of stresses at nodes, and that at those on the boundary. Material of the smooth problem.
template <int D>
std::array<double, 2> stress_errors(const Run<D, D>& r) {
  std::vector<char> outermost(r.mesh().points.size());
  for (const Face<D>& face : r.mesh().boundary)
    for (const Index v : face.vertices) outermost[v] = true;
  const auto stress = nodal_stress(r.nodes(), r.model, r.u());
  std::array<double, 2> largest{};
  for (Index v = 0; v < r.mesh().vertices(); ++v) {
    const Gradient<D, D> g = Smooth<D, D>::slope(r.mesh().points[v]);
    double trace = 0, error = 0;
    for (int i = 0; i < D; ++i) trace += g[i][i];
    constexpr int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j)
        error = std::max(error, std::abs(g[i][j] + g[j][i] + (i == j ? trace : 0) - stress[v][place[i][j]]));
    largest[outermost[v]] = std::max(largest[outermost[v]], error);
  }
  return largest;
}

template <int D>
void expect_orders_of_stresses(int cells, int refinements) {
  for (const int order : {1, 2}) {
    Errors inside, outside;
    for (int k = 0; k <= refinements; ++k) {
      const auto [in, out] = stress_errors<D>(run<D, D>(smooth<D, D>(cells, order), {uniform(k)}));
      inside.add(in);
      outside.add(out);
      show("{}D, order {}: stress inside {:.3e} order {:.2f}, at the boundary {:.3e} order {:.2f}\n", D, order, in,
           inside.last_order(), out, outside.last_order());
    }
    EXPECT_GE(inside.last_order(), 1.8);
    EXPECT_GE(outside.last_order(), 1.9);
  }
}

TEST(Quadratic, OrdersOfStressesAtNodes) {
  expect_orders_of_stresses<2>(4, 4);
  expect_orders_of_stresses<3>(3, 2);
}

// A square of irregular triangles that are refined uniformly: elements around vertices of the coarse mesh, and along
// its edges, are not point symmetric.
TEST(Quadratic, OrdersOfStressesOnIrregularMeshes) {
  std::string text = smooth<2, 2>(4, 1);
  const auto begin = text.find("shape"), end = text.find("order");
  ASSERT_NE(end, std::string::npos) << text;
  text.replace(begin, end - begin, "shape = \"polygon\"\npoints = [[0, 0], [1, 0], [1, 1], [0, 1]]\nsize = 0.3\n");
  Errors inside, outside;
  for (int k = 1; k <= 4; ++k) {
    const auto [in, out] = stress_errors<2>(run<2, 2>(text, {uniform(k)}));
    inside.add(in);
    outside.add(out);
    show("irregular: stress inside {:.3e} order {:.2f}, at the boundary {:.3e} order {:.2f}\n", in, inside.last_order(),
         out, outside.last_order());
  }
  EXPECT_GE(inside.mean_order(), 1.3);
  EXPECT_GE(outside.mean_order(), 1.9);
}

/// A block pressed on a parabola by its top.
template <int D>
SceneText pressed(int cells, int order) {
  const bool plane = D == 2;
  return {.body = block<D>(cells, order) + "young = 1\npoisson = 0.3",
          .fixes = {plane ? "on = \"top\"\nvalue = [0, -0.05]" : "on = \"top\"\nvalue = [0, 0, -0.05]"},
          .obstacle = fmt::format("type = \"contact\"\non = \"bottom\"\nshape = \"expression\"\ndistance = '{}'\n"
                                  "normal = [0, {}1]",
                                  plane ? "y + 0.2*(x-0.4)^2" : "z + 0.2*((x-0.4)^2 + (y-0.4)^2)", plane ? "" : "0, ")};
}

template <int D>
SceneText membrane(int cells, int order) {
  return {.body = block<D>(cells, order) + "equation = \"diffusion\"",
          .fixes = {"on = \"boundary\"\nvalue = [0]"},
          .loads = {"value = [-8]"},
          .obstacle = "type = \"scalar\"\nlower = '-0.1 - 0.1*x'"};
}

/// Cycles beside those of linear elements with the same nodes.
template <int D, int B, class Scene>
void expect_few_cycles(const Scene& scene, int cells, int refinements) {
  std::vector<int> found;
  for (int k = 0; k <= refinements; ++k) {
    const auto linear = run<D, B>(scene(cells, 1), {uniform(k + 1)});
    const auto quadratic = run<D, B>(scene(cells, 2), {uniform(k)});
    ASSERT_EQ(quadratic.nodes().size(), linear.nodes().size());
    EXPECT_GT(quadratic.contact().nodes, 2);
    show(
        "{}D, {} unknowns per node: {} nodes, linear {} cycles, quadratic {}; rates {:.2f}, {:.2f}; contact {} and {}, "
        "force {:.5f} and {:.5f}, pressure {:.5f} and {:.5f}, area {:.5f} and {:.5f}\n",
        D, B, linear.nodes().size(), linear.summary().iterations, quadratic.summary().iterations, linear.summary().rate,
        quadratic.summary().rate, linear.contact().nodes, quadratic.contact().nodes, linear.contact().force[B - 1],
        quadratic.contact().force[B - 1], linear.contact().max_pressure, quadratic.contact().max_pressure,
        linear.contact().area, quadratic.contact().area);
    EXPECT_LE(quadratic.summary().iterations, 1.5 * linear.summary().iterations + 1);
    found.push_back(quadratic.summary().iterations);
  }
  EXPECT_LE(found.back(), found[1] + 3);  // the coarsest one has two levels
}

TEST(Quadratic, CyclesAreFewAndDoNotGrow) {
  expect_few_cycles<2, 1>(membrane<2>, 4, 4);
  expect_few_cycles<3, 1>(membrane<3>, 3, 2);
  expect_few_cycles<2, 2>(pressed<2>, 4, 4);
  expect_few_cycles<3, 3>(pressed<3>, 3, 2);
}

/// Between nodes on the parabola the chord of a linear element is 0.05 h^2 inside of it. Quadratic elements follow it,
/// but for the edge of the contact. All is a million times flatter, so that contact is linear.
TEST(Quadratic, PenetrationBetweenNodesFalls) {
  for (const int order : {1, 2}) {
    Errors between;
    for (int k = 0; k <= 4; ++k) {
      SceneText scene = pressed<2>(4, order);
      scene.fixes = {"on = \"top\"\nvalue = [0, -5e-8]"};
      scene.obstacle.replace(scene.obstacle.find("0.2"), 3, "2e-7");
      const auto r = run<2, 2>(scene, {uniform(k)});
      between.add(1e6 * r.results.between_nodes.at(0));
      const double h = 0.25 / std::pow(2, k);
      show("order {}: {:.3e} = {:.4f} h^2\n", order, between.value.back(), between.value.back() / (h * h));
      if (order == 1) {
        EXPECT_NEAR(between.value.back(), 0.05 * h * h, 0.001 * h * h);
      } else {
        EXPECT_LT(between.value.back(), 0.025 * h * h);
      }
    }
    EXPECT_GT(between.mean_order(), 1.9);
  }
}

// An expression that is no number between some nodes, far from where the bound jumps.
TEST(Quadratic, BoundsThatAreUnknownBetweenNodesChangeNothingElsewhere) {
  const auto energy = [](const char* strip) {
    const std::string text =
        "[[body]]\nname = \"m\"\nequation = \"diffusion\"\nshape = \"rectangle\"\nfrom = [-1, -1]\nto = [1, 1]\n"
        "cells = [9, 9]\norder = 2\n[[fix]]\nbody = \"m\"\non = \"boundary\"\nvalue = 0\n[[obstacle]]\ntype = "
        "\"scalar\"\nbody = \"m\"\nlower = \"" +
        std::string(strip) + "x^2 + y^2 < 0.17 ? 0.4 : -1 - 0.1 * x^2\"\n[refine]\nuniform = 1\n";
    return run<2, 1>(text).summary().energy;
  };
  EXPECT_NEAR(energy("x > 0.91 && x < 0.92 ? log(x - 2) : "), energy(""), 1e-9);
}

}  // namespace
}  // namespace signorini::test
