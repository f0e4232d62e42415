// Partial slip of a line contact and of a point contact, loaded, unloaded and loaded the other way, against Cattaneo
// and Mindlin. docs/measured/friction.md has finer meshes.
#include "apps/bench/friction/partial_slip.hpp"
#include "run.hpp"
#include "tests/support/nightly.hpp"

namespace signorini::test {
namespace {
using namespace bench;

/// The radius that sticks is a sum of areas of nodes: known to about the distance of two.
double spacing(const PartialSlipStep& step, int dimension) {
  return dimension == 2 ? 2 * step.contact / step.nodes : step.contact * std::sqrt(pi / step.nodes);
}

void show_step(const PartialSlipStep& s) {
  show("force {:+.3e}: stick radius {:.4f} and {:.4f}, traction off by {:.1f} %, {:.0f} % at most, {} iterations\n",
       s.tangential, s.stick, s.stick_in_theory, 100 * s.mean_error, 100 * s.largest_error, s.iterations);
}

void expect_loading_converges(int dimension, int coarsest, int finest) {
  Errors traction;
  PartialSlipStep last;
  for (int k = coarsest; k <= finest; ++k) {
    const PartialSlip slip = solve_partial_slip({dimension, k, false});
    ASSERT_EQ(slip.steps.size(), 2u);
    EXPECT_EQ(slip.steps[0].stick, 0) << "pressed without friction";
    last = slip.steps[1];
    show_step(last);
    EXPECT_LE(std::abs(last.stick - last.stick_in_theory), spacing(last, dimension));
    traction.add(last.mean_error);
  }
  traction.expect_falling();
  EXPECT_GE(traction.mean_order(), 0.9);
}

TEST(PartialSlip, OfALineContactConverges) {
  expect_loading_converges(2, 1, 3);
  const PartialSlipStep last = solve_partial_slip({2, 4, false}).steps[1];
  show_step(last);
  EXPECT_NEAR(last.contact, last.contact_in_theory, 0.01 * last.contact);
  EXPECT_NEAR(last.stick, last.stick_in_theory, 0.03 * last.stick);
  EXPECT_LE(last.mean_error, 0.012);
  EXPECT_LE(last.largest_error, 0.06) << "beside the kink at the edge of what sticks";
  EXPECT_LT(last.mean_error, last.nodal_mean_error) << "recovered tractions are nearer than forces over areas";
  EXPECT_LT(last.largest_error, last.nodal_largest_error);
}

TEST(PartialSlip, OfAPointContactConverges) { expect_loading_converges(3, 0, 1); }

/// Every step of a closed loop, and the energy that it dissipates.
void expect_loop(const PartialSlip& slip, int dimension, double tolerance) {
  EXPECT_EQ(slip.steps[0].stick, 0) << "pressed without friction";
  double before = 0;
  for (std::size_t k = 1; k < slip.steps.size(); ++k) {
    const PartialSlipStep& step = slip.steps[k];
    show_step(step);
    EXPECT_LE(std::abs(step.stick - step.stick_in_theory), spacing(step, dimension));
    EXPECT_GE(step.dissipated, before);
    before = step.dissipated;
    EXPECT_LE(step.iterations, 20);
  }
  show("dissipated {:.4e}, enclosed {:.4e}, in theory {:.4e}\n", slip.dissipated, slip.enclosed, slip.loop);
  EXPECT_NEAR(slip.dissipated, slip.loop, tolerance * slip.loop);
}

TEST(PartialSlip, OfALineContactDissipatesInALoop) { expect_loop(solve_partial_slip({2, 3}), 2, 0.03); }
TEST(PartialSlip, OfAPointContactDissipatesInALoop) { expect_loop(solve_partial_slip({3, 1}), 3, 0.05); }

// The work that is put in from one turn to the same turn is what the report calls dissipated; and that does not depend
// on the steps.
TEST(PartialSlip, TheLoopEnclosesWhatIsDissipated) {
  const PartialSlip few = solve_partial_slip({2, nightly(2, 1)}),
                    many = solve_partial_slip({2, nightly(2, 1), true, {"steps.count=110"}});
  show("{:.5e} in few steps, {:.5e} in many, enclosed {:.5e}\n", few.dissipated, many.dissipated, many.enclosed);
  EXPECT_NEAR(many.enclosed, many.dissipated, 0.01 * many.dissipated);
  EXPECT_NEAR(few.dissipated, many.dissipated, 0.01 * many.dissipated);
}

}  // namespace
}  // namespace signorini::test
