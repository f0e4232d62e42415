// A bar on a base with a given bound on friction, pulled at its end: slip length, end displacement, hysteresis and
// dissipated energy in closed form (benchmarks of shear lag: the front of slip advances from the end).
#include "core/base/error.hpp"
#include "driver/driver.hpp"
#include "run.hpp"

namespace signorini::test {
namespace {

// Per unit of thickness. Across so thin a bar nothing varies: with its top and bottom guided and no lateral contraction
// the rod equation E h u'' = g sign(u') is off by (2/3)(E/G)(h/slip)^2, some 1e-5.
constexpr double length = 1, height = 0.002, young = 1000, bound = 0.01;
// The front ends a third off a node, whatever the mesh.
constexpr double largest = 2 * bound * length / 3;  // force at the end

double slip_length(double force) { return force / bound; }
double end_displacement(double force) { return force * force / (2 * bound * young * height); }

/// @param path the force over `largest` as an expression in t
std::string bar(int cells, const std::string& path, const std::string& steps) {
  return fmt::format(R"toml(
[[body]]
name = "bar"
shape = "rectangle"
from = [0, 0]
to = [{length}, {height}]
cells = [{cells}, 1]
order = 1
young = {young}
poisson = 0
plane = "stress"
[[fix]]
body = "bar"
on = "bottom"
value = ["free", 0]
[[fix]]
body = "bar"
on = "top"
value = ["free", 0]
[[load]]
body = "bar"
on = "right"
value = ["{traction} * ({path})", 0]
[[obstacle]]
type = "tresca"
bound = {bound}
body = "bar"
on = "bottom"
shape = "plane"
point = [0, 0]
normal = [0, 1]
[[probe]]
name = "end"
body = "bar"
at = [{length}, 0]
[solver]
tolerance = 1e-11
[steps]
{steps}
)toml",
                     fmt::arg("length", length), fmt::arg("height", height), fmt::arg("cells", cells),
                     fmt::arg("young", young), fmt::arg("traction", largest / height), fmt::arg("path", path),
                     fmt::arg("bound", bound), fmt::arg("steps", steps));
}

class Bar {
 public:
  Bar(int cells, const std::string& path, const std::string& steps)
      : driver_(parse_scene(bar(cells, path, steps), "bar.toml", ".")) {
    driver_.solve([&] { fronts_.push_back(slipping()); });
    EXPECT_TRUE(report().converged()) << report().reason();
    EXPECT_TRUE(report().failed.empty()) << report().warnings.front().text;
  }

  const Report& report() const { return driver_.report(); }
  const std::vector<StepReport>& steps() const { return report().steps; }
  const ContactReport& contact(std::size_t step) const { return steps().at(step).contact[0]; }
  double end(std::size_t step) const { return steps().at(step).probes[0].value[0]; }
  /// Length of what slips in a step, half the base of a node counted to each side.
  double slip(std::size_t step) const { return fronts_.at(step); }
  std::vector<double> solution() const { return driver_.solution(); }

 private:
  double slipping() const {
    return driver_.visit(0, []<int D, int B>(const BodyRun<D, B>& run) {
      double sum = 0;
      for (const ContactNode<B>& node : run.results().contact.nodes) sum += node.sticks ? 0 : node.area;
      return sum;
    });
  }

  Driver driver_;
  std::vector<double> fronts_;
};

constexpr const char* loading = "t";

TEST(BarOnBase, SlipLengthAndEndDisplacementConverge) {
  Errors slip, end;
  for (const int cells : {20, 40, 80}) {
    const Bar bar(cells, loading, "count = 1");
    slip.add(std::abs(bar.slip(0) / slip_length(largest) - 1));
    end.add(std::abs(bar.end(0) / end_displacement(largest) - 1));
    EXPECT_LE(slip.value.back() * slip_length(largest), length / cells) << "a cell";
    EXPECT_NEAR(bar.contact(0).tangential_force[0], -largest, 1e-9 * largest);
    EXPECT_EQ(bar.contact(0).normal_force[0], 0);
    show("{} cells: slip length off by {:.2e}, end displacement by {:.2e}\n", cells, slip.value.back(),
         end.value.back());
  }
  EXPECT_LE(end.value.back(), 1e-4);
  EXPECT_GE(end.mean_order(), 1.9);
}

// The force over the end displacement is a loop of two parabolas; what it encloses is dissipated.
TEST(BarOnBase, UnloadingAndReversedLoadingHaveTheirOwnFronts) {
  constexpr int cells = 160;
  const Bar bar(cells, "t <= 0.2 ? 5*t : t <= 0.6 ? 2 - 5*t : 5*t - 4", "count = 40");
  const double last = end_displacement(largest);
  double area = 0, before = 0, force_before = 0, peak = 0;
  for (std::size_t k = 0; k < bar.steps().size(); ++k) {
    const double t = bar.steps()[k].t;
    const double force = largest * (t <= 0.2 ? 5 * t : t <= 0.6 ? 2 - 5 * t : 5 * t - 4);
    const double expected = t <= 0.2   ? end_displacement(force)
                            : t <= 0.6 ? last - 2 * end_displacement((largest - force) / 2)
                                       : -last + 2 * end_displacement((largest + force) / 2);
    EXPECT_NEAR(bar.end(k), expected, 2e-3 * last) << t;
    EXPECT_GE(bar.contact(k).dissipated_in_step, 0);
    EXPECT_NEAR(bar.contact(k).tangential_force[0], -force, 1e-8 * largest) << t;
    if (t > 0.2 + 1e-9) area += 0.5 * (force + force_before) * (bar.end(k) - before);
    if (std::abs(t - 0.2) < 1e-9) peak = bar.contact(k).dissipated;
    before = bar.end(k), force_before = force;
  }
  const double loop = 2 * std::pow(largest, 3) / (3 * bound * young * height);
  const double dissipated = bar.contact(39).dissipated - peak;
  show("loop: dissipated {:.6g}, enclosed by the steps {:.6g}, closed form {:.6g}\n", dissipated, area, loop);
  EXPECT_NEAR(dissipated, loop, 2e-3 * loop);
  EXPECT_NEAR(area, loop, 0.01 * loop) << "trapezia over the steps";
  EXPECT_NEAR(bar.end(39), last, 1e-3 * last) << "the loop is closed";
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

// While the front only advances, what the steps are does not matter; where it turns, they have to hit the turn.
TEST(BarOnBase, MonotoneLoadingKnowsNoStepsAndATurnDoes) {
  constexpr int cells = 40;
  const double last = end_displacement(largest);
  const Bar one(cells, loading, "count = 1"), even(cells, loading, "count = 20"),
      uneven(cells, loading, "at = [0.05, 0.15, 0.7, 1]");
  EXPECT_LE(largest_difference(one.solution(), even.solution()), 1e-8 * last);
  EXPECT_LE(largest_difference(uneven.solution(), even.solution()), 1e-8 * last);
  EXPECT_NEAR(uneven.contact(3).dissipated, even.contact(19).dissipated, 1e-8 * last * largest);
  EXPECT_NEAR(one.contact(0).dissipated, even.contact(19).dissipated, 1e-8 * last * largest);
  // Uneven steps end where even ones that contain them do, also in between.
  EXPECT_NEAR(uneven.end(0), even.end(0), 1e-8 * last);
  EXPECT_NEAR(uneven.end(1), even.end(2), 1e-8 * last);
  EXPECT_NEAR(uneven.end(2), even.end(13), 1e-8 * last);
  const std::string turn = "t <= 0.5 ? 2*t : 2 - 2*t";
  const Bar hits(cells, turn, "count = 4"), too(cells, turn, "at = [0.1, 0.5, 0.6, 1]"),
      misses(cells, turn, "at = [1]");
  EXPECT_LE(largest_difference(hits.solution(), too.solution()), 1e-8 * last);
  EXPECT_NEAR(hits.end(3), last / 2, 0.01 * last);
  EXPECT_EQ(misses.end(0), 0);
}

TEST(BarOnBase, MovesWithoutEndBeyondTheBound) {
  EXPECT_THROW(
      {
        Driver driver(parse_scene(bar(20, "1.7 * t", "count = 2"), "bar.toml", "."));
        driver.solve();
      },
      Error);
}

}  // namespace
}  // namespace signorini::test
