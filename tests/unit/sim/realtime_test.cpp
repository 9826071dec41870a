#include "sim/realtime.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <random>
#include <thread>
#include <vector>

namespace ream::test {
namespace {

constexpr int no_such_cpu = CPU_SETSIZE - 1;

/// What a thread that asks is given, and what the kernel says of it and of a thread that it starts.
struct Asked {
  Asked(sim::Realtime mode, int cpu) {
    std::thread([&] {
      grant = sim::ask_for_realtime(mode, cpu);
      policy = ::sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
      cpus = cpus_of_caller();
      std::thread([&] { heirs_policy = ::sched_getscheduler(0); }).join();
    }).join();
  }
  static int cpus_of_caller() {
    cpu_set_t set;
    CPU_ZERO(&set);
    ::sched_getaffinity(0, sizeof set, &set);
    return CPU_COUNT(&set);
  }
  static int first_cpu() {
    cpu_set_t set;
    CPU_ZERO(&set);
    ::sched_getaffinity(0, sizeof set, &set);
    size_t cpu = 0;
    while (!CPU_ISSET(cpu, &set)) ++cpu;
    return static_cast<int>(cpu);
  }

  sim::RealtimeGrant grant;
  int policy = -1, heirs_policy = -1, cpus = 0;
};

TEST(Realtime, OffAsksForNothing) {
  const Asked asked(sim::Realtime::off, Asked::first_cpu());
  EXPECT_FALSE(asked.grant.fifo);
  EXPECT_FALSE(asked.grant.locked);
  EXPECT_EQ(asked.grant.cpu, -1);
  EXPECT_EQ(asked.policy, SCHED_OTHER);
  EXPECT_EQ(asked.cpus, Asked::cpus_of_caller());
  EXPECT_EQ(sim::refusal_message(asked.grant, sim::Realtime::off, 3), "");
}

TEST(Realtime, WhatIsGrantedIsWhatTheKernelDid) {
  const Asked asked(sim::Realtime::attempt, Asked::first_cpu());
  EXPECT_EQ(asked.policy, asked.grant.fifo ? SCHED_FIFO : SCHED_OTHER);
  EXPECT_EQ(asked.heirs_policy, SCHED_OTHER) << "threads started later are ordinary ones";
  EXPECT_EQ(asked.grant.cpu, Asked::first_cpu());
  EXPECT_EQ(asked.cpus, 1);
  EXPECT_GT(Asked::cpus_of_caller(), 0);
}

TEST(Realtime, ACpuThatIsNotThereIsRefusedAndTheRestGoesOn) {
  for (const int cpu : {no_such_cpu, CPU_SETSIZE, CPU_SETSIZE + 7}) {
    const Asked asked(sim::Realtime::attempt, cpu);
    EXPECT_EQ(asked.grant.cpu, -1);
    EXPECT_EQ(asked.cpus, Asked::cpus_of_caller());
    const std::string words = sim::refusal_message(asked.grant, sim::Realtime::require, cpu);
    EXPECT_NE(words.find("CPU " + std::to_string(cpu)), std::string::npos) << words;
  }
}

TEST(Realtime, WordsNameEverythingThatWasRefused) {
  using sim::Realtime;
  EXPECT_EQ(sim::refusal_message({true, true, -1}, Realtime::require, -1), "");
  EXPECT_EQ(sim::refusal_message({true, true, 2}, Realtime::require, 2), "");
  const std::string all = sim::refusal_message({}, Realtime::require, 2);
  for (const char* part : {"priority", "CAP_SYS_NICE", "memory", "ulimit -l", "CPU 2", "--realtime try"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in: " << all;
  const std::string memory = sim::refusal_message({true, false, -1}, Realtime::require, -1);
  EXPECT_NE(memory.find("memory"), std::string::npos);
  EXPECT_EQ(memory.find("priority"), std::string::npos);
}

TEST(WakeMargin, SettlesWhereOneWakeUpInAHundredIsLater) {
  const uint32_t seed = test::seed(6);
  std::mt19937 random(seed);
  std::exponential_distribution<double> late_us(0.05);  // p99 is 20 ln 100 = 92.1 us
  sim::WakeMargin margin;
  for (int i = 0; i < 60000; ++i) margin.note(late_us(random));
  EXPECT_NEAR(static_cast<double>(margin.ns()) * 1e-3, 92.1, 15.0) << "seed " << seed;
}

TEST(WakeMargin, StaysWithinItsBounds) {
  sim::WakeMargin margin;
  EXPECT_EQ(margin.ns(), static_cast<int64_t>(sim::WakeMargin::max_us * 1e3)) << "careful at first";
  for (int i = 0; i < 30000; ++i) margin.note(1.0);
  EXPECT_EQ(margin.ns(), static_cast<int64_t>(sim::WakeMargin::min_us * 1e3));
  margin.note(25000.0);
  EXPECT_LE(margin.ns(), static_cast<int64_t>((sim::WakeMargin::min_us + 1.0) * 1e3))
      << "one stall of the machine says little about its wake-ups";
  for (int i = 0; i < 30000; ++i) margin.note(25000.0);
  EXPECT_EQ(margin.ns(), static_cast<int64_t>(sim::WakeMargin::max_us * 1e3));
}

TEST(TickClock, NeverEarlyAndEveryTickItsOwn) {
  sim::TickClock clock;
  const int64_t begin = steady_ns();
  constexpr int ticks = 50;
  int64_t last = begin;
  for (int i = 0; i < ticks; ++i) {
    const double late_us = clock.wait();
    const int64_t now = steady_ns();
    EXPECT_GE(late_us, 0.0);
    EXPECT_GT(now, last);
    last = now;
  }
  EXPECT_GE(last - begin, (ticks - 1) * tick_ns);
}

}  // namespace
}  // namespace ream::test
