#pragma once
#include <vector>

#include "core/spsc_ring.hpp"
#include "record/tick_report.hpp"
#include "voxel/bricks.hpp"

namespace ream::session {

/// What lies between the haptic loop and the one thread that follows it.
struct LoopRings {
  explicit LoopRings(const voxel::VoxelGrid& grid) : sender(grid, bricks) {}

  voxel::BrickRing bricks{8192};
  voxel::BrickSender sender;
  SpscRing<record::TickReport> reports{16384};

  /// Gives the follower what has come: first the brick images, then the reports, so that a report's own
  /// images are always there before it. False when there was no report.
  template <typename TakeBrick, typename TakeReport>
  bool drain(TakeBrick take_brick, TakeReport take_report) {
    taken_.clear();
    record::TickReport report;
    while (reports.try_pop(report)) taken_.push_back(report);
    voxel::BrickImage image;
    while (bricks.try_pop(image)) take_brick(image);
    for (const record::TickReport& one : taken_) take_report(one);
    return !taken_.empty();
  }

  /// The same after the loop has ended, with the images that had to wait: they count as the last tick's.
  template <typename TakeBrick, typename TakeReport>
  void drain_rest(const voxel::BoneModel& bone, uint32_t last_tick, TakeBrick take_brick,
                  TakeReport take_report) {
    while (sender.pending() > 0) {
      voxel::BrickImage image;
      sender.send(bone.coverage.data(), last_tick, static_cast<int>(bricks.capacity()));
      // What the loop has sent is older; both go in before the reports are taken.
      while (bricks.try_pop(image)) take_brick(image);
    }
    drain(take_brick, take_report);
  }

 private:
  std::vector<record::TickReport> taken_;
};

}  // namespace ream::session
