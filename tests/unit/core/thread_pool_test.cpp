#include "core/thread_pool.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>

namespace ream {
namespace {

TEST(ThreadPool, EveryPieceIsWorkedOnOnceWhateverTheThreads) {
  for (const int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    for (const size_t count : {0, 1, 2, 3, 1000}) {
      std::vector<std::atomic<int>> times(count);
      std::atomic<bool> known_worker = true;
      pool.run(count, [&](size_t piece, int worker) {
        ++times[piece];
        if (worker < 0 || worker >= threads) known_worker = false;
      });
      EXPECT_TRUE(known_worker);
      for (const auto& n : times) EXPECT_EQ(n, 1) << count << " pieces, " << threads << " threads";
    }
  }
}

TEST(ThreadPool, TheAskingThreadIsWorkerZeroAndHearsHowFarItIs) {
  ThreadPool pool(1);
  const auto asking = std::this_thread::get_id();
  std::vector<double> shares;
  pool.run(
      4, [&](size_t, int) { EXPECT_EQ(std::this_thread::get_id(), asking); },
      [&](double share) { shares.push_back(share); });
  EXPECT_EQ(shares, (std::vector<double>{0.0, 0.25, 0.5, 0.75}));
  EXPECT_THROW(pool.run(
                   3, [](size_t, int) {}, [](double) { throw std::runtime_error("progress"); }),
               std::runtime_error);
}

TEST(ThreadPool, AnErrorEndsTheJobAndTheNextOneIsAsEver) {
  for (const int threads : {1, 3}) {
    ThreadPool pool(threads);
    std::atomic<size_t> begun = 0;
    EXPECT_THROW(pool.run(100000,
                          [&](size_t, int) {
                            ++begun;
                            throw std::runtime_error("piece");
                          }),
                 std::runtime_error);
    EXPECT_LE(begun, static_cast<size_t>(threads));
    std::atomic<size_t> sum = 0;
    pool.run(10, [&](size_t piece, int) { sum += piece; });
    EXPECT_EQ(sum, 45u);
  }
}

/// Pieces may wait for those before them: one that was taken and then given up would never come.
TEST(ThreadPool, NoPieceIsTakenInVainWhenProgressThrows) {
  constexpr auto patience = std::chrono::seconds(5);
  constexpr size_t count = 1000;
  ThreadPool pool(2);
  std::atomic<size_t> begun = 0, done = 0;
  std::atomic<bool> progress_once = false, waited_in_vain = false;
  const auto until = [&](const auto& true_now) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!true_now() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    return true_now();
  };
  EXPECT_THROW(pool.run(
                   count,
                   [&](size_t piece, int worker) {
                     ++begun;
                     if (!until([&] { return done == piece && (progress_once || worker == 0); }))
                       waited_in_vain = true;
                     done = piece + 1;
                   },
                   [&](double share) {
                     if (share == 0.0) return;
                     const size_t seen = begun;
                     progress_once = true;
                     until([&] { return begun > seen || begun == count; });
                     throw std::runtime_error("progress");
                   }),
               std::runtime_error);
  EXPECT_FALSE(waited_in_vain);
}

/// A helper that wakes late must not take pieces of a job that is not its own, nor miss the end.
TEST(ThreadPool, ManyShortJobsFollowEachOther) {
  ThreadPool pool(3);
  for (size_t job = 0; job < 3000; ++job) {
    std::atomic<size_t> sum = 0;
    pool.run(job % 5, [&](size_t piece, int) { sum += piece + 1; });
    ASSERT_EQ(sum, (job % 5) * (job % 5 + 1) / 2) << job;
  }
}

}  // namespace
}  // namespace ream
