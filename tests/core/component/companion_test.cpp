// Of a build with SIGNORINI_GPL=OFF: core/component/companion.cpp is compiled into this program once more.
#include "core/component/companion.hpp"

#include <gmock/gmock.h>

#include "core/base/error.hpp"
#include "core/component/failure.hpp"

namespace signorini::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string error_of(const Companion& companion) {
  try {
    load_function(companion, "anything", std::filesystem::path("/none") / companion.file);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    return error.what();
  }
  ADD_FAILURE() << "there is one";
  return {};
}

TEST(Companion, ThatIsMissingBecauseOfItsLicenceIsToldSo) {
  EXPECT_THAT(
      error_of(geometry_library),
      AllOf(HasSubstr("/none/libsignorini_geometry.so: the geometry library cannot be loaded"),
            HasSubstr("configured with SIGNORINI_GPL=OFF, without what is linked with CGAL (GPL-3.0-or-later)")));
  EXPECT_THAT(error_of(direct_solvers), HasSubstr("linked with CHOLMOD and UMFPACK"));
  EXPECT_THAT(error_of(picture_library), AllOf(Not(HasSubstr("GPL=OFF")), HasSubstr("beside the core library")));
}

// Also of plugins that were compiled with headers where 0 was kept as it is.
TEST(Status, ThatFailsWithNoStatusIsAFailureOfThePlugin) {
  Status now, before;
  EXPECT_TRUE(now.ok());
  now.fail(0, "why");
  std::snprintf(before.message, sizeof before.message, "why");
  for (const Status& status : {now, before}) {
    EXPECT_FALSE(status.ok());
    try {
      throw_failure(status, "scene.toml:3: obstacle.0");
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Exit::plugin);
      EXPECT_STREQ(error.what(), "scene.toml:3: obstacle.0: why");
    }
  }
}

}  // namespace
}  // namespace signorini::test
