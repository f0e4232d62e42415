#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

/// What scenes are warned of, and refused for.
namespace signorini::test {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

inline Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml", "."); }

inline Warnings warnings(const std::string& text) {
  Driver driver(scene_of(text));
  EXPECT_TRUE(driver.solve().converged());
  return driver.report().warnings;
}

inline std::string refused(const std::string& text) {
  try {
    Driver(scene_of(text)).solve();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::input);
    return error.what();
  }
  return "not refused";
}

}  // namespace signorini::test
