// A block that a rising plane presses against its support: read once, solved, changed and solved again.
#include <cstdio>

#include <signorini/driver/driver.hpp>

const char* const block = R"(
[[body]]
name = "block"
shape = "box"
from = [0, 0, 0]
to = [1, 1, 1]
cells = [3, 3, 3]
young = 1
poisson = 0.3

[[fix]]
body = "block"
on = "top"
value = [0, 0, 0]

[[obstacle]]
type = "contact"
body = "block"
on = "bottom"
shape = "plane"
point = [0.5, 0.5, 0]
normal = [0, 0, 1]

[refine]
uniform = 2
)";

int main() {
  signorini::Driver driver(signorini::parse_scene(block, "block.toml", "."));
  auto& plane = std::get<signorini::Scene::PlaneShape>(*driver.scene().obstacles[0].shape);
  for (const double height : {0.01, 0.02, 0.03}) {
    plane.point[2] = height;
    const signorini::Report& report = driver.solve();  // from the last solution
    if (!report.converged()) return 1;
    std::printf("plane at %g: force %.6f, %d iterations, %d matrices assembled\n", height,
                report.last().contact[0].force[2], report.last().summary.iterations, report.time.assemblies.stiffness);
  }
  double deepest = 0;
  for (const double u : driver.solution()) deepest = u > deepest ? u : deepest;
  std::printf("largest displacement %.3f\n", deepest);
}
