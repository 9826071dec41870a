#include "loop/traps.hpp"

#include <gtest/gtest.h>
#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <shared_mutex>
#include <thread>

#include "core/clock.hpp"
#include "core/log.hpp"
#include "sim/realtime.hpp"

namespace ream::test {
namespace {

/// What a thread of its own is caught at.
Caught watched(const std::function<void()>& act) {
  Traps::prepare();
  std::thread([&act] {
    Traps::arm();
    act();
    Traps::disarm();
  }).join();
  return Traps::caught();
}

uint64_t count(const Caught& caught, Trap trap) { return caught.ours[static_cast<size_t>(trap)]; }

template <typename T>
void keep(T* value) {
  asm volatile("" : : "g"(value) : "memory");
}

TEST(Traps, NothingDoneIsNothingCaught) {
  const Caught caught = watched([] {
    volatile double sum = 0.0;
    for (int i = 0; i < 1000; ++i) sum = sum + static_cast<double>(steady_ns());
  });
  EXPECT_EQ(caught.of_ours(), 0u) << caught.words();
  EXPECT_EQ(caught.words(), "");
}

TEST(Traps, WaitingForTheNextTickIsAllowed) {
  sim::TickClock clock;
  const Caught caught = watched([&clock] {
    for (int i = 0; i < 20; ++i) clock.wait();
  });
  EXPECT_EQ(caught.of_ours(), 0u) << caught.words();
}

TEST(Traps, Allocations) {
  for (const auto& allocate : std::vector<std::function<void*()>>{
           [] { return ::malloc(16); }, [] { return ::calloc(2, 8); }, [] { return ::realloc(nullptr, 16); },
           [] { return ::aligned_alloc(64, 64); }, [] { return ::operator new(16); },
           [] { return ::operator new(64, std::align_val_t(64)); }}) {
    void* memory = nullptr;
    const Caught caught = watched([&] {
      memory = allocate();
      keep(memory);
    });
    EXPECT_EQ(count(caught, Trap::allocate), 1u) << caught.words();
    EXPECT_NE(caught.first.find("allocation"), std::string::npos);
    ::free(memory);
  }
}

TEST(Traps, Releases) {
  int* memory = new int(1);
  const Caught caught = watched([&] { delete memory; });
  EXPECT_EQ(count(caught, Trap::release), 1u) << caught.words();
}

TEST(Traps, Locks) {
  std::mutex mutex;
  std::shared_mutex shared;
  std::condition_variable condition;
  const Caught caught = watched([&] {
    { const std::lock_guard lock(mutex); }
    { const std::shared_lock lock(shared); }
    { const std::unique_lock lock(shared); }
    condition.notify_one();
  });
  EXPECT_EQ(count(caught, Trap::lock), 3u) << caught.words();
  EXPECT_EQ(count(caught, Trap::wake), 1u) << caught.words();
}

TEST(Traps, WaitingOnAnAtomicIsASystemCall) {
  std::atomic<int> value{0};
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    value.store(1);
    value.notify_all();
  });
  const Caught caught = watched([&] { value.wait(0); });
  other.join();
  EXPECT_GE(count(caught, Trap::system_call), 1u) << caught.words();
}

TEST(Traps, SystemCallsAreCountedAndDone) {
  pid_t id = 0;
  const Caught caught = watched([&] { id = ::getppid(); });
  EXPECT_EQ(count(caught, Trap::system_call), 1u) << caught.words();
  EXPECT_EQ(id, ::getppid());
  EXPECT_NE(caught.first.find("system call"), std::string::npos);
}

TEST(Traps, Logging) {
  const Caught caught = watched([] { log::info("said in a tick on purpose"); });
  EXPECT_GE(count(caught, Trap::system_call), 1u) << caught.words();
}

TEST(Traps, YieldingAndSleepingOtherwiseThanByTheClock) {
  const Caught caught = watched([] { std::this_thread::yield(); });
  EXPECT_EQ(count(caught, Trap::system_call), 1u) << caught.words();
}

}  // namespace
}  // namespace ream::test
