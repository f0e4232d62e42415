#include "core/component/trial.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "core/base/stopwatch.hpp"

namespace signorini {
namespace {

TEST(Trial, TellsHowTheCopyEnded) {
  EXPECT_EQ(fatal_end([] {}), "");
  EXPECT_EQ(fatal_end([] { throw 1; }), "");
  EXPECT_EQ(fatal_end([] { std::raise(SIGKILL); }), "a crash (Killed)");
  EXPECT_EQ(fatal_end([] { _exit(3); }), "the program being ended with status 3");
}

TEST(Trial, EndsACopyThatHangs) {
  const Stopwatch watch;
  const auto hang = [] {
    while (true) pause();
  };
  EXPECT_EQ(fatal_end(hang, 0.1), "no end within 0.1 seconds");
  EXPECT_LT(watch.elapsed(), 5);
}

}  // namespace
}  // namespace signorini
