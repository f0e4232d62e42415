// The kit finds every fault, says nothing of what has none, and tells what hangs and crashes.
#include <gmock/gmock.h>

#include <fstream>

#include "conformance/check.hpp"
#include "core/base/error.hpp"

namespace signorini::test {
namespace {

using conformance::Failure;
using conformance::Options;
using conformance::Verdict;
using testing::Contains;
using testing::HasSubstr;

const std::string shipped = SIGNORINI_BINARY_DIR "/lib/signorini/plugins/";

Verdict of_shipped(const std::string& id, Options options = {}) {
  return conformance::check_plugin(shipped + "libsignorini_obstacle_" + id + ".so", options);
}

Verdict with_fault(const std::string& fault) {
  return conformance::check_plugin(SIGNORINI_FAULTY, {{"fault=" + fault}, false, 0.5});
}

std::vector<std::string> ids(const std::vector<Failure>& failures) {
  std::vector<std::string> out;
  for (const Failure& failure : failures) out.emplace_back(failure.check.id);
  return out;
}

std::vector<std::string> passed(const Verdict& verdict) {
  std::vector<std::string> out;
  for (const auto& check : verdict.passed) out.emplace_back(check.id);
  return out;
}

class ShippedPlugin : public testing::TestWithParam<const char*> {};

TEST_P(ShippedPlugin, Conforms) {
  const Verdict verdict = of_shipped(GetParam());
  EXPECT_TRUE(verdict.conforms()) << text_of(verdict);
  EXPECT_THAT(verdict.notes, testing::IsEmpty());
  for (const char* check : {"loads", "ranges", "bounds", "minimise_energy", "solve_agrees", "solve_cycles"})
    EXPECT_THAT(passed(verdict), Contains(check));
}
INSTANTIATE_TEST_SUITE_P(All, ShippedPlugin,
                         testing::Values("scalar", "contact", "tresca", "coulomb", "elastic", "elastic_tresca",
                                         "elastic_coulomb"));

TEST(Conformance, OfOptionsThatTheUserGives) {
  EXPECT_TRUE(of_shipped("coulomb",
                         {{"friction=0.7", "normal=body", "shape=sphere", "center=[0.5, -0.4]", "radius=0.4"}, false})
                  .conforms());
  EXPECT_TRUE(of_shipped("contact", {{"shape=sphere", "radius=0.4", "center=[0.5, -0.4]"}, false}).conforms());
  try {
    of_shipped("coulomb", {{"friction=-1"}, false});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    EXPECT_THAT(error.what(), HasSubstr("friction"));
  }
}

/// A fault, and a check that finds it.
struct Fault {
  const char *name, *check;
};

class FaultyPlugin : public testing::TestWithParam<Fault> {};

TEST_P(FaultyPlugin, IsFound) {
  const auto [fault, check] = GetParam();
  const Verdict verdict = with_fault(fault);
  EXPECT_THAT(ids(verdict.failures), Contains(check)) << text_of(verdict);
  for (const Failure& failure : verdict.failures) {
    EXPECT_NE(failure.found, "") << text_of(verdict);
    EXPECT_NE(failure.example, "") << text_of(verdict);
  }
}

constexpr Fault faults[] = {{"change_of_nothing", "change_zero"},
                            {"change_nan", "change_zero"},
                            {"change_not_antisymmetric", "change_antisymmetric"},
                            {"change_not_additive", "change_adds_up"},
                            {"change_with_cancellation", "change_digits"},
                            {"change_doubled", "slope_derivative"},
                            {"change_crashes", "change_zero"},
                            {"change_hangs", "change_zero"},
                            {"number_not_announced", "change_zero"},
                            {"concave", "convex"},
                            {"slope_of_one_side", "slope_derivative"},
                            {"slope_of_wrong_sign", "slope_derivative"},
                            {"slope_not_homogeneous", "slope_homogeneous"},
                            {"slope_without_kink", "slope_derivative"},
                            {"slope_with_absolute_tolerance", "slope_derivative"},
                            {"minimise_misses_kink", "minimise_energy"},
                            {"minimise_nears_kink", "minimise_slope"},
                            {"minimise_forgets_functional", "minimise_energy"},
                            {"minimise_half_way", "minimise_start"},
                            {"minimise_with_absolute_tolerance", "minimise_slope"},
                            {"minimise_beyond_bounds", "minimise_bounds"},
                            {"minimise_moves_prescribed", "prescribed"},
                            {"minimise_idle", "minimise_slope"},
                            {"minimise_nan", "minimise_finite"},
                            {"kink_missed", "linearise_gradient"},
                            {"kink_everywhere", "linearise_kinks"},
                            {"kink_moves", "linearise_kinks"},
                            {"gradient_zero", "linearise_gradient"},
                            {"gradient_of_wrong_sign", "linearise_gradient"},
                            {"hessian_doubled", "linearise_hessian"},
                            {"hessian_forgotten", "linearise_hessian"},
                            {"hessian_negative", "linearise_definite"},
                            {"hessian_nan", "linearise_bounds"},
                            {"correction_bounds_off", "linearise_bounds"},
                            {"number_forgets_measure", "measure"},
                            {"number_too_many", "numbers"},
                            {"scaling_missing", "scaling"},
                            {"scaling_of_half", "scaling"},
                            {"asks_for_wrong_name", "asked"},
                            {"asks_as_wrong_type", "asked"},
                            {"asks_later_as_wrong_type", "asked"},
                            {"throws", "constructs"},
                            {"throws_at_zero", "ranges"},
                            {"direction_without_name", "descriptor"},
                            {"direction_long", "directions"},
                            {"direction_nan", "directions"},
                            {"direction_fixed", "equivariant"},
                            {"directions_too_many", "directions"},
                            {"directions_dependent", "directions"},
                            {"bounds_not_set", "bounds"},
                            {"bounds_crossed", "bounds"},
                            {"bounds_nan", "bounds"},
                            {"bound_far_off_nan", "far"},
                            {"bound_at_height", "equivariant"},
                            {"number_nan", "numbers"},
                            {"depends_on_order", "repeatable"},
                            {"depends_on_calls", "repeatable"},
                            {"minds_threads", "threads"},
                            {"status_of_plugin", "bounds"},
                            {"writes_beyond", "beyond"},
                            {"reads_beyond", "beyond"},
                            {"crashes_alone", "beyond"},
                            {"renew_nan", "renew"},
                            {"renew_writes_beyond", "renew"},
                            {"law_of_another", "law"},
                            {"box_cut_off", "minimise_energy"},
                            {"box_rounds_beyond", "minimise_bounds"},
                            {"box_nan", "minimise_finite"},
                            {"distance_without_flags", "distance"},
                            {"distance_too_far", "distance"}};

INSTANTIATE_TEST_SUITE_P(All, FaultyPlugin, testing::ValuesIn(faults),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(Conformance, SaysNothingOfWhatHasNoFault) {
  const Verdict verdict = with_fault("none");
  EXPECT_TRUE(verdict.conforms()) << text_of(verdict);
  EXPECT_EQ(verdict.passed.size(), conformance::all_checks().size() - 3) << text_of(verdict);  // needs, and solves
}

TEST(Conformance, TellsWhatCrashesAndHangs) {
  EXPECT_THAT(with_fault("change_crashes").failures.front().found, HasSubstr("a crash (Aborted)"));
  const Verdict hanging = with_fault("change_hangs");
  EXPECT_THAT(hanging.failures.front().found, HasSubstr("no end within 0.5 seconds"));
  EXPECT_EQ(hanging.failures.size(), 1u) << "each of them takes its time";
}

// Two digits, not those of random numbers.
TEST(Conformance, ExamplesAreSimple) {
  for (const Failure& failure : with_fault("slope_of_wrong_sign").failures)
    if (failure.check.id == "convex") {
      EXPECT_THAT(failure.example, testing::ContainsRegex("x = \\(-?[0-9.]{1,5}(e-?[0-9]+)?\\), z = "));
    }
}

TEST(Conformance, ValuesOfTheUserMayBeRefusedForOneSizeOfProblems) {
  const Verdict verdict = with_fault("needs_something");
  EXPECT_THAT(verdict.notes, Contains(HasSubstr("something is missing")));
}

TEST(Conformance, ThePageOfTheDocumentationExplainsEachCheck) {
  std::ifstream in(SIGNORINI_SOURCE_DIR "/docs/plugin_check.md");
  const std::string page(std::istreambuf_iterator<char>(in), {});
  for (const auto& check : conformance::all_checks())
    EXPECT_THAT(page, HasSubstr("| `" + std::string(check.id) + "` | " + std::string(check.expected) + " |"));
}

TEST(Conformance, OfWhatIsNoPluginIsTold) {
  EXPECT_THROW((void)conformance::check_plugin("nowhere.so"), Error);
  EXPECT_THAT(ids(conformance::check_plugin(SIGNORINI_FIXTURES "/libsignorini_obstacle_wrong_major.so").failures),
              testing::ElementsAre("loads"));
  EXPECT_THAT(ids(conformance::check_plugin(SIGNORINI_FIXTURES "/libsignorini_obstacle_misnamed.so").failures),
              Contains("id"));
}

}  // namespace
}  // namespace signorini::test
