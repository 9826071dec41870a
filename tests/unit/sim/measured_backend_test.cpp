#include "sim/backend.hpp"

#include <gtest/gtest.h>

#include "support/small_run.hpp"

namespace ream::test {
namespace {

TEST(MeasuredBackend, TriesEveryDeviceAndChoosesTheQuickestAtItsWorst) {
  const voxel::BoneModel block = slab({96, 96, 64}, 0.25, 10.0, 1.4);
  SmallRun run(block, slab_plan(block, 10.0), "sphere 8", steady_push(52.0, 0.1));
  const voxel::SolidCells cells(run.bone);
  const std::vector<uint8_t> before = run.bone.coverage;
  std::vector<sim::BackendTiming> timings;
  const sim::Backend chosen = sim::make_measured_backend(run.model, run.bone, cells, timings);
  ASSERT_EQ(timings.size(), 1 + gpu::list_devices().size());
  EXPECT_EQ(timings[0].name, "cpu");
  sim::BackendTiming best = timings[0];
  for (const sim::BackendTiming& t : timings) {
    EXPECT_EQ(t.failure, "") << t.name;
    EXPECT_GT(t.p50_us, 0.0) << t.name;
    EXPECT_LE(t.p50_us, t.p999_us) << t.name;
    if (sim::is_quicker(t, best)) best = t;
  }
  EXPECT_EQ(chosen.name, best.name);
  EXPECT_EQ(run.bone.coverage, before) << "measuring changes no bone";
}

TEST(MeasuredBackend, ThreadsAreWokenOnlyWhereThatIsBetterAtTheWorstToo) {
  const sim::BackendTiming plain{"plain", 30.0, 50.0, 400.0, false, {}};
  sim::BackendTiming woken{"woken", 20.0, 40.0, 500.0, true, {}};
  EXPECT_FALSE(sim::is_quicker(woken, plain));
  woken.p999_us = 300.0;
  EXPECT_TRUE(sim::is_quicker(woken, plain));
  woken.wakes_threads = false;
  woken.p999_us = 500.0;
  EXPECT_TRUE(sim::is_quicker(woken, plain));
  woken.failure = "gone";
  EXPECT_FALSE(sim::is_quicker(woken, plain));
  EXPECT_TRUE(sim::is_quicker(plain, woken));
}

}  // namespace
}  // namespace ream::test
