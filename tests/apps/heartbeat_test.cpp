#include "apps/signorini/heartbeat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <future>

#include "apps/signorini/run_status.hpp"

namespace signorini {
namespace {

TEST(Silence, IsBrokenOnceItIsTooLongAndOnlyThen) {
  Silence silence(10, 100);
  EXPECT_FALSE(silence.is_broken(109.9));
  EXPECT_TRUE(silence.is_broken(110));
  EXPECT_FALSE(silence.is_broken(110.1)) << "something was just said";
  EXPECT_TRUE(silence.is_broken(120));
  silence.spoke(125);
  EXPECT_FALSE(silence.is_broken(134));
  EXPECT_EQ(silence.ends(), 135);
  EXPECT_TRUE(silence.is_broken(135));
}

// However long work takes: there is nothing but the thread to say these lines.
TEST(Heartbeat, SpeaksWhileWorkGoesOn) {
  std::promise<void> thrice;
  int said = 0;
  {
    Heartbeat heartbeat(1e-3, [&] {
      if (++said == 3) thrice.set_value();
    });
    heartbeat.speak([] {});
    thrice.get_future().wait();
  }
  EXPECT_GE(said, 3) << "and it has ended";
}

IterationRecord record(int iteration, double residual, Index contact) {
  return {iteration, residual, residual / 2, -1, contact, 0, {}, 0};
}

TEST(RunStatus, SaysWhatGoesOnAndSinceWhen) {
  RunStatus status(100);
  EXPECT_EQ(status.line(103), "at work; 3 s so far");
  status.phase("meshing");
  EXPECT_EQ(status.line(110), "meshing; 10 s so far");
  status.phase("level 1: 4836 vertices");
  status.solving({false, 1e-3});
  status.cycle(record(2, 2.1e-5, 130), 112);
  EXPECT_EQ(status.line(150),
            "level 1: 4836 vertices; iteration 2, residual 2.1e-05, 130 nodes in contact; 50 s so far");
  status.phase("writing");
  EXPECT_EQ(status.line(160), "writing; 60 s so far") << "the cycles are over";
}

// Four of ten steps have taken 20 s each, after 10 s of meshing.
TEST(RunStatus, ExpectsOfTheNextStepsWhatTheFinishedOnesTook) {
  RunStatus status(0);
  for (int k = 1; k <= 5; ++k) {
    status.step({k, 0.1 * (k - 1), 0.1 * k}, 10, 10 + 20 * (k - 1));
    EXPECT_EQ(status.expected(15 + 20 * (k - 1)).has_value(), k > 1);
  }
  EXPECT_DOUBLE_EQ(*status.expected(95), 210);
  EXPECT_DOUBLE_EQ(*status.expected(115), 215) << "this one takes five longer already";
  EXPECT_EQ(status.line(95), "step 5 of 10, t = 0.5; at work; 95 s of about 210 s");
  status.step({5, 0.4, 0.45, 1}, 10, 110);
  EXPECT_EQ(status.line(111), "step 5 of 10, its part from t = 0.4 to 0.45; at work; 111 s of about 211 s");
}

// Where it would be cut, contact and times were what a terminal of 80 columns did not show.
TEST(RunStatus, FitsANarrowTerminalAndKeepsTheTimes) {
  RunStatus status(0);
  status.step({1, 0, 1. / 11}, 11, 10);
  status.step({2, 1. / 11, 2. / 11}, 11, 30);
  status.phase("level 5: 343937 vertices");
  status.cycle(record(117, 6e-9, 26234), 31);
  EXPECT_EQ(status.line(32, 79), "step 2/11, t 0.1818; level 5; it. 117, res. 6e-09, 26234 in contact; 32/230 s");
  EXPECT_EQ(status.line(32, 200), status.line(32));
  EXPECT_EQ(status.line(32, 30), "step 2/11, t 0.1818; l32/230 s");
  EXPECT_EQ(status.line(32, 3), "32/");
}

// The error goes down by ten in 2 s; from 1e-3 to 1e-8 that is 10 s more.
TEST(RunStatus, ExpectsOfASolveThatTheErrorGoesOnDown) {
  RunStatus status(0);
  status.phase("level 3: 13207 vertices");
  status.solving({true, 1e-8});
  for (int k = 1; k <= 3; ++k) {
    EXPECT_FALSE(status.expected(40).has_value()) << k;
    status.cycle(record(k, std::pow(10.0, -k), 5), 30 + 2 * k);
  }
  EXPECT_NEAR(*status.expected(37), 46, 1e-9);
  EXPECT_THAT(status.line(37), testing::EndsWith("; 37 s of about 46 s"));
  status.cycle(record(4, 1, 5), 38);
  EXPECT_FALSE(status.expected(39).has_value()) << "it grows";
  status.solving({false, 1e-3});
  EXPECT_FALSE(status.expected(39).has_value()) << "a start says nothing of the result";
}

}  // namespace
}  // namespace signorini
