// After a solve the functionals of obstacles are asked whether the result is due to faults of theirs.
#include "core/constraints/check_functionals.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "core/base/error.hpp"
#include "core/fem/conditions/model_places.hpp"
#include "core/sdk/functional_obstacle.hpp"
#include "tests/core/fem/support.hpp"

namespace signorini::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

enum class Fault { none, change, slope, minimise, linearise, idle, other_minimum, doubled_change, other_slope };
Fault fault = Fault::none;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// v^2 / 2, and what it is told to do wrong.
struct Square {
  static double change(const Slot<1>&, const double* from, const double* to) {
    const double change = 0.5 * (*to - *from) * (*to + *from);
    return fault == Fault::change ? nan : fault == Fault::doubled_change ? 2 * change : change;
  }
  static double slope(const Slot<1>&, const double* at, const double* step) {
    return fault == Fault::slope ? nan : (fault == Fault::other_slope ? *at + 0.01 : *at) * *step;
  }
  static void minimise(const Slot<1>& slot, const double* M, const double* r, const double* x, double* y) {
    const double stiffness = fault == Fault::other_minimum ? 0.9 : 1;
    *y = fault == Fault::minimise ? nan
         : fault == Fault::idle   ? *x
                                  : block::clamp((*r + *M * *x) / (*M + stiffness), *slot.lower, *slot.upper);
  }
  static void linearise(const Slot<1>&, const double* x, const QuadraticModel<1>& out) {
    *out.gradient = fault == Fault::linearise ? nan : *x;
    *out.hessian = 1;
  }
};

class SquareObstacle final : public FunctionalObstacle<1, Square> {
 public:
  ObstacleDescriptor descriptor() const noexcept override { return {1, {{"value", 1, 2}}, 0}; }
  void assemble(const SurfaceVertex*, std::size_t count, LocalConstraint<1>* out, Status&) const noexcept override {
    std::fill_n(out, count, bound<1>({1}, -0.5, 2));
  }
};

class CheckFunctionals : public ::testing::Test {
 protected:
  CheckFunctionals() {
    model_.loads = {{{}, {1.0}}};
    model_.obstacles = {{std::make_shared<SquareObstacle>(), Selection{"right", {}, ""}, "scene.toml:8: o"}};
    discretization_ = discretize<2, 1>(Nodes<2>(mesh_), model_);
    x_.assign(static_cast<std::size_t>(mesh_.vertices()), 0.25);
  }
  ~CheckFunctionals() override { fault = Fault::none; }

  void check() const { check_functionals<1>(places_, discretization_.problem, discretization_.functional, x_); }
  void probe() const { probe_functionals<1>(places_, discretization_.problem, discretization_.functional, x_); }
  void blame() const { blame_functionals<1>(places_, discretization_.problem, discretization_.functional, x_); }
  double& at_slot() { return x_[discretization_.problem.constraints.vector.front()]; }

  template <class Ask>
  static void expect_blamed(const Ask& ask, const std::string& what) {
    try {
      ask();
      ADD_FAILURE() << "not told: " << what;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::plugin);
      EXPECT_THAT(error.what(), AllOf(HasSubstr("scene.toml:8: o: at (1, "), HasSubstr(what)));
    }
  }

  const Mesh<2> mesh_ = unit_mesh<2>(2);
  const Nodes<2> nodes_{mesh_};
  Model<1> model_;
  const ModelPlaces<2, 1> places_{nodes_, model_};
  Discretization<1> discretization_;
  std::vector<double> x_;
};

TEST_F(CheckFunctionals, SaysNothingOfWhatIsRight) {
  EXPECT_NO_THROW(probe());
  EXPECT_NO_THROW(check());
  EXPECT_NO_THROW(blame());
  at_slot() = -0.5 * (1 + 1e-12);  // rounding
  EXPECT_NO_THROW(check());
}

TEST_F(CheckFunctionals, TellsWhatIsBeyondTheBounds) {
  for (const double beyond : {-0.501, -7.0, 2.1}) {
    at_slot() = beyond;
    expect_blamed([this] { check(); }, "with the bounds (-0.5) and (2) the local solver leads to");
  }
}

TEST_F(CheckFunctionals, TellsUnknownsThatAreNotFinite) {
  at_slot() = nan;
  expect_blamed([this] { check(); }, "(nan)");
}

TEST_F(CheckFunctionals, TellsAnswersThatAreNotFinite) {
  const std::pair<Fault, const char*> faults[] = {{Fault::change, "the change is (nan)"},
                                                  {Fault::slope, "the slope is (nan)"},
                                                  {Fault::linearise, "the gradient is (nan)"}};
  for (const auto& [what, text] : faults) {
    fault = what;
    expect_blamed([this] { check(); }, text);
    expect_blamed([this] { blame(); }, text);
  }
}

// What returns its argument else calls any x a solution.
TEST_F(CheckFunctionals, TellsLocalSolversThatDoNotMinimise) {
  for (const Fault what : {Fault::idle, Fault::other_minimum}) {
    fault = what;
    expect_blamed([this] { probe(); }, "which is no minimiser: there is less energy at");
    expect_blamed([this] { check(); }, "which is no minimiser: there is less energy at");
  }
}

TEST_F(CheckFunctionals, TellsChangesAndSlopesThatContradictEachOther) {
  for (const Fault what : {Fault::doubled_change, Fault::other_slope}) {
    fault = what;
    expect_blamed([this] { probe(); }, "");
  }
  fault = Fault::other_slope;  // whose minimisers are right
  expect_blamed([this] { probe(); }, "changes the functional by");
}

TEST_F(CheckFunctionals, TellLocalSolversThatHaveEndedASolve) {
  fault = Fault::minimise;
  std::ranges::fill(x_, nan);
  expect_blamed([this] { blame(); }, "the result of the local solver is (nan)");
}

// Nobody has an answer then.
TEST_F(CheckFunctionals, DoNotBlameThemForMatricesAndLoadsThatAreNotFinite) {
  discretization_.problem.b.front() = nan;
  fault = Fault::minimise;
  std::ranges::fill(x_, nan);
  EXPECT_NO_THROW(blame());
}

}  // namespace
}  // namespace signorini::testing
