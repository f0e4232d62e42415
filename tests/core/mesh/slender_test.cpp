#include "core/mesh/slender.hpp"

#include <gtest/gtest.h>

#include "core/mesh/structured.hpp"

namespace signorini {
namespace {

TEST(LayerShape, CountsVerticesAcrossAndLayersAlongInAnyDirection) {
  for (const Mesh<2>& mesh : {rectangle({0, 0}, {50, 1}, {100, 2}), rectangle({0, 0}, {1, 50}, {2, 100})}) {
    const LayerShape shape = layer_shape(mesh);
    EXPECT_NEAR(shape.across, 3, 0.1);
    EXPECT_NEAR(shape.along, 101, 3);
  }
  const LayerShape bar = layer_shape(box({0, 0, 0}, {1, 100, 1}, {1, 100, 1}));
  EXPECT_NEAR(bar.across, 4, 0.2);
  EXPECT_NEAR(bar.along, 101, 4);
}

}  // namespace
}  // namespace signorini
