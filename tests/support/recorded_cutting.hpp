#pragma once
#include <filesystem>
#include <map>
#include <random>

#include "record/recorder.hpp"
#include "support/random_bone.hpp"
#include "support/tick_reports.hpp"

namespace ream::test {

/// A session without physics: random bricks lose random coverage in some ticks, and a follower that is as
/// slow as told records them. Keeps what the bone was after every tick that ended a chunk may matter: all of
/// them, so grids are small.
class RecordedCutting {
 public:
  RecordedCutting(unsigned seed, const Vec3i& dims)
      : random(seed),
        bone(random_bone(random, dims, 0.8)),
        follower(bone.coverage),
        sender(bone.grid, ring) {}

  record::ops::Header header() const {
    record::ops::Header h;
    h.case_id = "test";
    h.start_grid_hash = bone.coverage_hash();
    return h;
  }

  static record::ops::Segment segment(uint32_t first_tick) {
    record::ops::Segment s;
    s.first_tick = first_tick;
    s.reason = first_tick == 0 ? "start" : "resume";
    return s;
  }

  /// Simulates `ticks` ticks; the sender may send `budget` images a tick.
  void run(record::Recorder& recorder, uint32_t ticks, int budget = 64) {
    for (uint32_t i = 0; i < ticks; ++i, ++tick) {
      if (random() % 8 == 0) cut();
      record::TickReport report = random_report(random, tick);
      sender.send(bone.coverage.data(), tick, budget);
      report.bricks_waiting = static_cast<uint32_t>(sender.pending());
      after[tick + 1] = bone.coverage;
      voxel::BrickImage image;
      while (ring.try_pop(image)) {
        recorder.add(image);
        voxel::write_brick(bone.grid, follower.data(), image.brick, image.coverage);
      }
      recorder.add(report);
      reports.push_back(report);
    }
  }

  /// What SessionFollower does when the loop has ended.
  void send_rest(record::Recorder& recorder) {
    while (sender.pending() > 0) {
      sender.send(bone.coverage.data(), tick - 1, 1000);
      voxel::BrickImage image;
      while (ring.try_pop(image)) {
        recorder.add(image);
        voxel::write_brick(bone.grid, follower.data(), image.brick, image.coverage);
      }
    }
  }

  std::mt19937 random;
  voxel::BoneModel bone;
  std::vector<uint8_t> start = bone.coverage;
  std::vector<uint8_t> follower;  ///< a replica, brought up to date after the recorder
  voxel::BrickRing ring{4096};
  voxel::BrickSender sender;
  uint32_t tick = 0;
  std::map<uint32_t, std::vector<uint8_t>> after;  ///< coverage by number of ticks passed
  std::vector<record::TickReport> reports;

 private:
  void cut() {
    const auto brick = static_cast<uint32_t>(random() % bone.grid.brick_count());
    uint8_t* coverage = bone.coverage.data() + size_t{brick} * voxel::brick_voxels;
    for (int i = 0; i < voxel::brick_voxels; ++i)
      if (random() % 3 == 0) coverage[i] = static_cast<uint8_t>(coverage[i] * (random() % 5) / 4);
    sender.mark(brick);
  }
};

}  // namespace ream::test
