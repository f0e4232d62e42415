// Passes that follow each other chunk by chunk give bitwise what whole passes give.
#include "core/solver/passes.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>

#include "core/algebra/products.hpp"
#include "core/solver/multigrid.hpp"
#include "tests/support/random_problem.hpp"

namespace signorini::test {
namespace {

constexpr Index n = 400;

/// A chain with couplings over `reach` vectors, and one that spans all where `far`.
BlockMatrix<1> banded(Random& random, Index reach, bool far) {
  BlockMatrix<1> A;
  const auto coupled = [&](Index p, Index q) { return std::abs(p - q) <= reach || (far && std::abs(p - q) == n - 1); };
  for (Index p = 0; p < n; ++p) {
    A.column.push_back(p);
    A.value.push_back(4.0 * reach);
    for (Index q = 0; q < n; ++q)
      if (p != q && coupled(p, q)) {
        A.column.push_back(q);
        A.value.push_back(random.between(-1, 0));
      }
    A.row.push_back(static_cast<Offset>(A.column.size()));
  }
  return A;
}

/// The order in which two passes treat the chunks: numbers c and count + c.
std::vector<Index> visits(const Chunks& chunks, Order first, Order second) {
  std::vector<Index> out;
  Passes passes;
  passes.add(first, [&](Index begin, Index) { out.push_back(begin / chunks.size); });
  passes.add(second, [&](Index begin, Index) { out.push_back(chunks.count() + begin / chunks.size); });
  Crew alone(1);
  passes.run(chunks, alone);
  return out;
}

TEST(Passes, FollowEachOtherCloselyWhereTheMatrixIsBanded) {
  Random random(3);
  for (const Order order : {Order::forward, Order::backward}) {
    const Chunks chunks = divide(banded(random, 3, false), 1000);
    ASSERT_GT(chunks.count(), 10);
    const std::vector<Index> order_of = visits(chunks, order, order);
    ASSERT_EQ(order_of.size(), 2u * chunks.count());
    for (std::size_t i = 2; i + 2 < order_of.size(); ++i)
      EXPECT_NE(order_of[i] < chunks.count(), order_of[i + 1] < chunks.count()) << "the passes take turns";
  }
}

TEST(Passes, WaitForEachOtherWhereTheMatrixReachesFarOrTheOrderTurns) {
  Random random(4);
  const auto second_after_first = [](const Chunks& chunks, Order first, Order second) {
    const std::vector<Index> order_of = visits(chunks, first, second);
    for (Index i = 0; i < chunks.count(); ++i) EXPECT_LT(order_of[i], chunks.count());
  };
  second_after_first(divide(banded(random, 3, true), 1000), Order::forward, Order::forward);
  second_after_first(divide(banded(random, 3, false), 1000), Order::forward, Order::backward);
}

TEST(Passes, GiveTheResultOfWholePassesWithAnyNumberOfThreads) {
  Random random(5);
  for (const Index reach : {1, 20, 90}) {
    DiscreteProblem<1> problem;
    problem.A = banded(random, reach, reach == 1);
    for (Index p = 0; p < n; ++p) problem.b.push_back(random.between(-1, 1));
    problem.fixed.assign(n, 0);
    problem.start.assign(n, 0);
    Level<1> level = finest_level(problem);
    const auto run = [&](const Chunks& chunks, int threads) {
      std::vector<double> x(n, 0.0), r(n);
      level.x = x.data();
      Passes passes;
      for (const Order order : {Order::forward, Order::forward, Order::backward, Order::forward})
        passes.add(order, [&level, order](Index first, Index last) { level.sweep(order, first, last); });
      passes.add(
          [&](Index first, Index last) { residual<1>(problem.A, level.x, level.b, first, last, r.data() + first); });
      Crew crew(threads);
      passes.run(chunks, crew);
      x.insert(x.end(), r.begin(), r.end());
      return x;
    };
    const Chunks whole = divide(problem.A, Offset{1} << 40), parts = divide(problem.A, 800);
    ASSERT_EQ(whole.count(), 1);
    ASSERT_GT(parts.count(), 10);
    for (const int threads : {1, 2, 3, 8})
      EXPECT_EQ(run(parts, threads), run(whole, 1)) << "reach " << reach << ", threads " << threads;
  }
}

TEST(Passes, GoOnAtTheSameTimeOnSeveralThreads) {
  Random random(6);
  const Chunks chunks = divide(banded(random, 1, false), 100);
  Crew pair(2);
  std::atomic<int> inside = 0, together = 0;
  const auto meet = [&](Index, Index) {  // waits for the other pass, but not for ever
    ++inside;
    for (int patience = 0; patience < 100 && together == 0 && inside < 2; ++patience)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    together += inside == 2;
    --inside;
  };
  Passes passes;
  passes.add(Order::forward, meet);
  passes.add(Order::forward, meet);
  passes.run(chunks, pair);
  EXPECT_GT(together, 0);
}

TEST(Passes, WhatOneThrowsEndsAllOnEveryThread) {
  Random random(7);
  const Chunks chunks = divide(banded(random, 3, false), 100);
  for (const int threads : {1, 2, 3}) {
    Crew crew(threads);
    Passes passes;
    passes.add([](Index, Index) {});
    passes.add([](Index first, Index) {
      if (first > n / 2) throw std::runtime_error("half way");
    });
    EXPECT_THROW(passes.run(chunks, crew), std::runtime_error) << threads;
    Passes next;
    std::atomic<int> count = 0;
    for (int pass = 0; pass < 2; ++pass) next.add([&](Index, Index) { ++count; });
    next.run(chunks, crew);
    EXPECT_EQ(count, 2 * chunks.count()) << "the crew works on";
  }
}

}  // namespace
}  // namespace signorini::test
