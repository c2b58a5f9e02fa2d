#include "engine/pipeline/recently_made.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace quorum {
namespace {

TEST(RecentlyMade, WhatIsAskedForAgainIsNotMadeAgain) {
  RecentlyMade<int, int> recent(2);
  int made = 0;
  const auto get = [&](int key) {
    return recent.get(key, [&] {
      ++made;
      return 10 * key;
    });
  };
  for (const int key : {1, 2, 1, 3, 1}) EXPECT_EQ(get(key), 10 * key);
  EXPECT_EQ(made, 3);
  EXPECT_EQ(get(2), 20);  // asked for least recently when 3 came
  EXPECT_EQ(made, 4);
}

TEST(RecentlyMade, ThreadsThatAskAtOnceShareOne) {
  RecentlyMade<int, int> recent(4);
  std::atomic<int> made = 0;
  std::vector<std::thread> threads;
  std::atomic<int> sum = 0;
  for (int i = 0; i < 8; ++i)
    threads.emplace_back([&] {
      sum += recent.get(7, [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return ++made;
      });
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(made, 1);
  EXPECT_EQ(sum, 8);
}

TEST(RecentlyMade, AnExceptionReachesWhoeverAsks) {
  RecentlyMade<int, int> recent(1);
  EXPECT_THROW(recent.get(1, []() -> int { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_THROW(recent.get(1, [] { return 1; }), std::runtime_error);
}

}  // namespace
}  // namespace quorum
