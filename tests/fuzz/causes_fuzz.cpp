// Parts of a file of causes, as the twin takes them in a browser.
#include <algorithm>
#include <cmath>
#include <span>

#include "collide/removal/removal_schedule.hpp"
#include "fuzz_input.hpp"
#include "record/tick_report.hpp"
#include "twin/cause_parts.hpp"
#include "twin/twin_player.hpp"

namespace {

using namespace ream;

voxel::BoneModel small_bone() {
  voxel::VoxelGrid grid;
  grid.dims = {32, 24, 16};
  grid.spacing_mm = {0.25, 0.3, 0.2};
  voxel::BoneModel bone = voxel::make_bone(grid);
  std::fill(bone.coverage.begin() + 1024, bone.coverage.end(), uint8_t{255});
  return bone;
}

/// A ball, by its table alone.
shell::SweptProfile ball(const voxel::VoxelGrid& grid) {
  shell::SweptProfile p;
  p.z_min_mm = -8.0f;
  p.z_step_mm = 0.5f, p.inverse_z_step = 2.0f;
  p.r2_step_mm2 = 1.0f, p.inverse_r2_step = 1.0f;
  p.z_count = 33, p.r2_count = 65;
  for (int z = 0; z < p.z_count; ++z)
    for (int r2 = 0; r2 < p.r2_count; ++r2) {
      const float height = p.z_min_mm + p.z_step_mm * static_cast<float>(z);
      p.distance_mm.push_back(std::sqrt(static_cast<float>(r2) + height * height) - 2.0f);
    }
  p.max_radius_mm = 2.0, p.body_min_z_mm = -2.0, p.body_max_z_mm = 2.0;
  p.margin_mm = collide::RemovalSchedule::needed_margin_mm(grid);
  return p;
}

constexpr uint32_t rows_of_good_part = 10;

/// Parts that follow each other after the segment and agree: the ball sinks into the bone.
std::vector<twin::Bytes> good_ticks() {
  twin::BoneTwin twin(small_bone());
  twin.begin_segment(ball(twin.bone().grid));
  std::vector<twin::Bytes> parts;
  const Vec3 middle_mm = twin.bone().grid.bounds_mm().centre();
  for (uint32_t first = 0; first < 8 * rows_of_good_part; first += rows_of_good_part) {
    std::vector<twin::CauseTick> rows(rows_of_good_part);
    for (uint32_t i = 0; i < rows_of_good_part; ++i) {
      Pose pose;
      pose.translation_mm = middle_mm + Vec3(0.0, 0.0, 3.0 - 0.05 * (first + i));
      rows[i] = {first + i, record::engaged_flag | record::cutting_flag, quantised(pose)};
      twin.step(rows[i]);
    }
    parts.push_back(twin::ticks_part(rows, twin.session_hash()));
  }
  return parts;
}

}  // namespace

/// First byte: how many good parts come first. Then what is done: a part is taken, after two bytes of its
/// length, or the next good one, or a snapshot is kept, or gone to.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const twin::Bytes start = twin::start_part(small_bone());
  static const twin::Bytes segment = twin::segment_part(0, ball(small_bone().grid));
  static const std::vector<twin::Bytes> ticks = good_ticks();
  fuzz::Input input(data, size);
  const int good = input.byte() % 3;
  twin::TwinPlayer player;
  size_t snapshots = 0;
  if (good > 0) player.take(start);
  if (good > 1) player.take(segment);
  while (!input.empty()) {
    const uint8_t what = input.byte();
    const auto before = player.agreed_ticks();
    switch (what % 4) {
      case 0: {
        const std::string_view part = input.piece();
        player.take(std::as_bytes(std::span(part.data(), part.size())));
        fuzz::require(player.agreed_ticks() >= before, "ticks were taken back");
        break;
      }
      case 1: player.take(ticks[before / rows_of_good_part % ticks.size()]); break;
      case 2:
        if (const auto kept = player.keep_snapshot()) snapshots = std::max(snapshots, *kept + 1);
        break;
      default: {
        const size_t to = what / 4 % 8;
        fuzz::require(player.go_to(to) == (to < snapshots),
                      "a snapshot that was not kept, or one that is gone");
      }
    }
  }
  if (twin::BoneTwin* twin = player.twin()) {
    for (const uint32_t block : twin->take_changed_blocks()) twin->surface_of(block);
    twin->whole_surface();
  }
  return 0;
}
