#include "sim/tick_trial.hpp"

#include <gtest/gtest.h>

#include "support/small_run.hpp"

namespace ream::test {
namespace {

TEST(Rehearsal, TakesTimeAndChangesNothing) {
  const voxel::BoneModel block = slab({96, 96, 64}, 0.25, 10.0, 1.4);
  SmallRun run(block, slab_plan(block, 10.0), "sphere 8", steady_push(52.0, 0.1));
  const std::vector<uint8_t> before = run.bone.coverage;
  EXPECT_GT(sim::rehearsed_tick_us(run.model, run.state), 0.0);
  EXPECT_EQ(run.bone.coverage, before);
  EXPECT_EQ(run.state.tick, 0u);
}

}  // namespace
}  // namespace ream::test
