#include "apps/bench/accuracy/quadratic_elements.hpp"

#include <fmt/format.h>

#include "apps/bench/ratios.hpp"

namespace signorini::bench {
namespace {

struct Case {
  const char* name;
  const char* scene;
  std::vector<double> load;  ///< of the linear comparison, which without it may be trivial
  int coarsest, finest;      ///< refinements of quadratic elements; linear ones have one more
};

Problem problem(const Case& c, int order, int uniform) {
  return {c.name, c.scene, {fmt::format("body.0.order={}", order), fmt::format("refine.uniform={}", uniform)}};
}

template <int D, int B>
Solved solved(const Problem& p) {
  return solve_nonlinear<D, B>(p, build_hierarchy<D>(p.scene, B));
}

template <int D, int B>
void cycles(const Case& c) {
  for (int k = c.coarsest; k <= c.finest; ++k) {
    const Solved linear = solved<D, B>(problem(c, 1, k + 1)), quadratic = solved<D, B>(problem(c, 2, k));
    fmt::print("| {} | {:.0f} | {} | {} | {:.2f} |\n", c.name, quadratic.unknowns(), linear.summary.iterations,
               quadratic.summary.iterations,
               static_cast<double>(quadratic.summary.iterations) / linear.summary.iterations);
    std::fflush(stdout);
  }
}

template <int D, int B>
void ratios(const Case& c, double bandwidth) {
  for (const int order : {1, 2}) {
    const Problem p = problem(c, order, c.finest + 2 - order);
    const BesideLinear beside = beside_linear<D, B>(p, c.load);
    const CycleTraffic traffic = cycle_traffic<D, B>(p, bandwidth);
    fmt::print("| {} | {} | {:.0f} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} |\n", c.name,
               order == 1 ? "linear" : "quadratic", beside.nonlinear.unknowns(), beside.nonlinear.summary.iterations,
               beside.linear.iterations, beside.solve(), beside.set_up_and_solve(), beside.assembly(),
               traffic.bytes / 1e6, traffic.time_over);
    std::fflush(stdout);
  }
}

}  // namespace

void print_quadratic_elements(bool quick) {
  const int less = quick ? 1 : 0;
  const Case radial{"radial 2D (S2)", "obstacle_radial_2d.toml", {}, 3, 6 - less},
      cube{"cube 3D (S3)", "obstacle_cube_3d.toml", {}, 1, 4 - less},
      bump{"cube on bump (E3)", "cube_on_bump.toml", {0, 0, -1}, 1, 3 - less},
      ball{"ball on plane", "ball_on_plane.toml", {0, 0, -1}, 0, 3 - less};
  fmt::print(
      "\n## Quadratic elements\n\n| problem | unknowns | linear: cycles | quadratic: cycles | cycles over |\n| --- | "
      "--- "
      "| --- | --- | --- |\n");
  cycles<2, 1>(radial);
  cycles<3, 1>(cube);
  cycles<3, 3>(bump);
  cycles<3, 3>(ball);
  const double bandwidth = stream_bandwidth();
  fmt::print(
      "\n| problem | elements | unknowns | cycles | CG iterations | solve over CG | set-up and solve over CG | "
      "assembly "
      "over CG | MB | cycle over traffic |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  ratios<2, 1>(radial, bandwidth);
  ratios<3, 1>(cube, bandwidth);
  ratios<3, 3>(bump, bandwidth);
  ratios<3, 3>(ball, bandwidth);
}

}  // namespace signorini::bench
