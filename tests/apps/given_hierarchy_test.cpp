// The example that takes a hierarchy from files. Those in given_hierarchy/ are BoomerAMG's, written by
//     signorini_petsc_hierarchy 16 given_hierarchy -pc_type hypre
#include <gmock/gmock.h>

#include "core/io/matrix_market.hpp"
#include "program.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GivenHierarchy : public Program {
 protected:
  static std::string file(const std::string& name) {
    return std::string(SIGNORINI_SOURCE_DIR) + "/tests/apps/given_hierarchy/" + name + ".mtx.gz";
  }

  Ended run(const std::vector<std::string>& names) const {
    std::vector<std::string> files;
    files.reserve(names.size());
    for (const std::string& name : names) files.push_back(file(name));
    return wait_for(start("signorini_given_hierarchy", files));
  }
};

TEST_F(GivenHierarchy, SolvesLikeTheSolversOwnLevels) {
  const Ended given = run({"A", "b", "lower", "P1", "P2", "P3", "P4", "P5"});
  ASSERT_EQ(given.status, 0) << given.err;
  EXPECT_THAT(given.err, AllOf(HasSubstr("4 cycles on 6 levels"), HasSubstr("99 of 256 unknowns at the bound")));
  const Ended own = signorini({"qp", file("A"), file("b"), "--lower", file("lower"), "--out", "x.mtx"});
  ASSERT_EQ(own.status, 0) << own.err;
  EXPECT_THAT(own.out, HasSubstr("99 unknowns at lower"));
  const auto x = parse_vector(given.out, "output", 256, Infinities::refused);
  const auto expected = read_vector(folder_ / "x.mtx", 256, Infinities::refused);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], expected[i], 1e-8 * 0.01) << i;
}

TEST_F(GivenHierarchy, SaysWhatDoesNotFit) {
  EXPECT_EQ(run({"A", "b", "lower"}).status, 1);
  const Ended gap = run({"A", "b", "lower", "P1", "P3"});
  EXPECT_EQ(gap.status, 2);
  EXPECT_THAT(gap.err, HasSubstr("interpolation 1 of 2, coarsest first: found "));
  EXPECT_EQ(run({"A", "b", "lower", "nothing"}).status, 2);
}

}  // namespace
}  // namespace signorini::test
