#pragma once
#include "record/tick_report.hpp"
#include "support/random_pose.hpp"

namespace ream::test {

/// A report with every field set to something of its own; `random` decides what.
inline record::TickReport random_report(std::mt19937& random, uint32_t tick) {
  std::uniform_real_distribution<double> number(-100.0, 100.0);
  std::uniform_int_distribution<int> count(0, 1000);
  record::TickReport r;
  r.tick = tick;
  r.spindle_on = count(random) % 2 == 0;
  r.paused = count(random) % 2 == 0;
  r.engaged = count(random) % 2 == 0;
  r.failed_over = count(random) % 2 == 0;
  r.world_from_handle = random_pose(random);
  r.world_from_tool = random_pose(random);
  r.world_from_bone_rest = random_pose(random);
  r.world_from_handle_q = quantised(r.world_from_handle);
  r.grid_from_tool = quantised(random_pose(random));
  r.hand_force_n = random_vector(random, 50.0);
  r.hand_torque_n_mm = random_vector(random, 500.0);
  for (double* field : {&r.thrust_n, &r.torque_n_mm, &r.feed_rate_mm_s, &r.density_g_cc})
    *field = number(random);
  for (double& share : r.share) share = number(random);
  for (int64_t& removed : r.coverage_removed) removed = count(random);
  r.engaged_points = count(random);
  r.changed_bricks = static_cast<uint32_t>(count(random));
  r.session_hash = static_cast<uint64_t>(random()) << 32 | random();
  return r;
}

}  // namespace ream::test
