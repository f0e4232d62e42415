#include "core/geometry/cgal/sizing.hpp"

#include "geometry_checks.hpp"

namespace signorini {
namespace {

using geometry::Sizing;
using testing::HasSubstr;

TEST(Sizing, BoundsTheQueriesByTheElementsToBeExpected) {
  const auto size = test::constant<3>(0.1);
  Sizing<3> sizing(size, 1, 2, {}, "shape");
  EXPECT_EQ(sizing(Point<3>{}), 0.1);
  sizing.expect(1000);
  for (int i = 0; i < 10'000'000; ++i) sizing.count_query();
  const std::string complaint = test::input_error_of([&] {
    for (int i = 0; i < 10'000'000; ++i) sizing.count_query();
  });
  EXPECT_THAT(complaint, HasSubstr("shape: size: the mesh does not come to an end"));
  EXPECT_THAT(complaint, HasSubstr("expected a size that varies gradually"));
  EXPECT_GT(sizing.most_vertices(), 1000u);
  EXPECT_LT(sizing.most_vertices(), 1'000'000u);
}

TEST(Sizing, IsTheSameInAllUnits) {
  for (const double unit : {1e-300, 1e-6, 1e-3, 25.4, 1e3, 1e6, 1e300})
    for (const auto& [asked, found] : {std::pair{0.1, 0.1}, {1e-3 / 3, 3.33333e-4}, {0.9999999, 1.0}}) {
      const geometry::Size<3> size = [&, h = asked](const Point<3>& p) { return h * p[0]; };
      const Sizing<3> sizing(size, 2, 2, {{unit, 0, 0}, unit}, "shape");
      EXPECT_EQ(sizing(Point<3>{}), found);
    }
}

TEST(Sizing, AQueryNowAndThenLetsTheSizeFieldEndTheWork) {
  int calls = 0;
  const geometry::Size<3> size = [&](const Point<3>&) {
    return ++calls == 3 ? throw Error(Exit::interrupted, "") : 1.0;
  };
  const Sizing<3> sizing(size, 1, 2, {}, "shape");
  const auto queries = [&] {
    for (int i = 0; i < 1000; ++i) sizing.count_query();
  };
  EXPECT_THROW(queries(), Error);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace signorini
