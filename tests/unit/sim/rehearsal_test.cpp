#include "sim/rehearsal.hpp"

#include <gtest/gtest.h>

#include "support/small_run.hpp"

namespace ream::test {
namespace {

double rehearsed_us(double tool_spacing_mm) {
  const voxel::BoneModel block = slab({96, 96, 64}, 0.25, 10.0, 1.4);
  const device::Script script = steady_push(52.0, 0.1);
  sim::Settings settings = SmallRun::settings(script, "cpu");
  settings.tool_spacing_mm = tool_spacing_mm;
  SmallRun run(block, slab_plan(block, 10.0), "sphere 8", script, settings);
  const std::vector<uint8_t> before = run.bone.coverage;
  const double us = sim::rehearsed_tick_us(run.model, run.state);
  EXPECT_EQ(run.bone.coverage, before) << "a rehearsal changes no bone";
  EXPECT_EQ(run.state.tick, 0u);
  return us;
}

TEST(Rehearsal, ChangesNothing) { EXPECT_GT(rehearsed_us(0.25), 0.0); }

// 64 times the points: far more than a busy machine can hide.
TEST(Rehearsal, FindsAFinerToolSlower) { EXPECT_GT(rehearsed_us(0.05), 2.0 * rehearsed_us(0.4)); }

}  // namespace
}  // namespace ream::test
