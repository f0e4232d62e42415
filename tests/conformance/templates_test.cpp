// The plugins that `signorini plugin new` begins with conform, and their scenes are solved.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "conformance/check.hpp"

namespace signorini::test {
namespace {

class Template : public testing::TestWithParam<const char*> {
 protected:
  std::string library_ = std::string(SIGNORINI_TEMPLATES) + "/" + GetParam() + "/libsignorini_obstacle_my_obstacle.so";
  std::string scene_ = std::string(SIGNORINI_SOURCE_DIR) + "/apps/templates/" + GetParam() + "/my_obstacle.toml";
};

TEST_P(Template, Conforms) {
  const conformance::Verdict verdict = conformance::check_plugin(library_);
  EXPECT_TRUE(verdict.conforms()) << text_of(verdict);
  EXPECT_TRUE(verdict.notes.empty()) << text_of(verdict);
}

TEST_P(Template, HasASceneThatGaussSeidelStepsAgreeWith) {
  const conformance::Comparison found = conformance::compare_with_gauss_seidel(scene_, library_);
  EXPECT_LE(found.difference, 1e-5);
  EXPECT_GT(found.gauss_seidel, found.iterations);
}

INSTANTIATE_TEST_SUITE_P(All, Template, testing::Values("box", "functional", "friction", "between-bodies"),
                         [](const auto& of) { return std::string(of.param).substr(0, 7); });

}  // namespace
}  // namespace signorini::test
