#include "apps/signorini/heartbeat.hpp"

#include <gtest/gtest.h>

#include <future>

namespace signorini {
namespace {

TEST(Silence, IsBrokenOnceItIsTooLongAndOnlyThen) {
  Silence silence(10, 100);
  silence.phase("meshing", 100);
  EXPECT_EQ(silence.line(109.9), std::nullopt);
  EXPECT_EQ(silence.line(110), "meshing: 10 s so far");
  EXPECT_EQ(silence.line(110.1), std::nullopt) << "something was just said";
  EXPECT_EQ(silence.line(120), "meshing: 20 s so far");
  silence.spoke(125);  // a cycle
  EXPECT_EQ(silence.line(134), std::nullopt);
  EXPECT_EQ(silence.ends(), 135);
  EXPECT_EQ(silence.line(135), "meshing: 35 s so far");
  silence.phase("level 0", 136);
  EXPECT_EQ(silence.line(145), "level 0: 9 s so far") << "a phase has its own time, and is not said by itself";
}

// However long this phase takes: there is nothing but the thread to say these lines.
TEST(Heartbeat, SpeaksWhileThePhaseIsAtWork) {
  std::promise<void> thrice;
  std::string last;
  int said = 0;
  {
    Heartbeat heartbeat(1e-3, [&](const std::string& line) {
      last = line;
      if (++said == 3) thrice.set_value();
    });
    heartbeat.begin("factorising", [] {});
    thrice.get_future().wait();
  }
  EXPECT_TRUE(last.starts_with("factorising: ")) << last;
  EXPECT_GE(said, 3) << "and it has ended";
}

}  // namespace
}  // namespace signorini
