#include "core/geometry/cgal/sizing.hpp"

#include "geometry_checks.hpp"

namespace signorini {
namespace {

using geometry::Sizing;
using testing::HasSubstr;

TEST(Sizing, BoundsTheQueriesByTheElementsToBeExpected) {
  const auto size = test::constant<3>(0.1);
  Sizing<3> sizing(size, 1, 2, 1, "shape");
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

TEST(Sizing, AQueryNowAndThenLetsTheSizeFieldEndTheWork) {
  int calls = 0;
  const geometry::Size<3> size = [&](const Point<3>&) {
    return ++calls == 3 ? throw Error(Exit::interrupted, "") : 1.0;
  };
  const Sizing<3> sizing(size, 1, 2, 1, "shape");
  const auto queries = [&] {
    for (int i = 0; i < 1000; ++i) sizing.count_query();
  };
  EXPECT_THROW(queries(), Error);
  EXPECT_EQ(calls, 3);
}

}  // namespace
}  // namespace signorini
