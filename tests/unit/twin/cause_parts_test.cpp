#include "twin/cause_parts.hpp"

#include <gtest/gtest.h>

#include <random>

#include "collide/removal/removal_schedule.hpp"
#include "shell/tool.hpp"
#include "support/seed.hpp"
#include "support/test_bone.hpp"
#include "support/twin/reamed_parts.hpp"
#include "twin/twin_player.hpp"

namespace ream::test {
namespace {

using twin::Bytes;
using Outcome = twin::TwinPlayer::Outcome;

std::span<const std::byte> without_code(const Bytes& part) { return std::span(part).subspan(1); }

voxel::BoneModel bone() { return slab({32, 32, 24}, 0.25, 3.0, 0.5); }

shell::SweptProfile profile() {
  return shell::swept_profile(shell::make_tool("sphere 4,2").profile,
                              collide::RemovalSchedule::needed_margin_mm(bone().grid));
}

std::vector<twin::CauseTick> some_ticks(uint32_t first, uint32_t count) {
  std::vector<twin::CauseTick> ticks(count);
  for (uint32_t i = 0; i < count; ++i) {
    ticks[i] = {first + i, 1u | i << 16, {}};
    ticks[i].grid_from_tool.rotation_q30 = {1 << 30, 0, 0, 0, 1 << 30, 0, 0, 0, 1 << 30};
    ticks[i].grid_from_tool.translation_nm = {4'000'000 - static_cast<int>(i), -3, 40'000'000};
  }
  return ticks;
}

Outcome outcome_of(std::initializer_list<Bytes> parts) {
  twin::TwinPlayer player;
  Outcome outcome = Outcome::agrees;
  for (const Bytes& part : parts) outcome = player.take(part);
  return outcome;
}

TEST(CauseParts, ComeBackAsTheyWere) {
  const voxel::BoneModel start = bone();
  const auto read_bone = twin::read_start(without_code(twin::start_part(start)));
  ASSERT_TRUE(read_bone);
  EXPECT_EQ(read_bone->grid.dims, start.grid.dims);
  EXPECT_EQ(read_bone->grid.spacing_mm, start.grid.spacing_mm);
  EXPECT_EQ(read_bone->coverage, start.coverage);

  const shell::SweptProfile sent = profile();
  const auto segment = twin::read_segment(without_code(twin::segment_part(77, sent)));
  ASSERT_TRUE(segment);
  EXPECT_EQ(segment->first_tick, 77u);
  EXPECT_EQ(segment->profile.distance_mm, sent.distance_mm);
  EXPECT_EQ(segment->profile.body_min_z_mm, sent.body_min_z_mm);
  EXPECT_EQ(segment->profile.inverse_r2_step, sent.inverse_r2_step);

  const auto ticks = some_ticks(500, 250);
  const auto read = twin::read_ticks(without_code(twin::ticks_part(ticks, 9)));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->session_hash, 9u);
  ASSERT_EQ(read->ticks.size(), ticks.size());
  for (size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_EQ(read->ticks[i].tick, ticks[i].tick);
    EXPECT_EQ(read->ticks[i].flags, ticks[i].flags);
    EXPECT_EQ(read->ticks[i].grid_from_tool, ticks[i].grid_from_tool);
  }
}

TEST(CauseParts, DensityComesBack) {
  const voxel::VoxelGrid grid = bone().grid;
  std::vector<uint8_t> density(grid.voxel_count());
  for (size_t i = 0; i < density.size(); ++i)
    if (i / voxel::brick_voxels % 3 == 1) density[i] = static_cast<uint8_t>(i % 251);
  const Bytes part = twin::density_part(density, 1.25);
  const auto read = twin::read_density(without_code(part), grid);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->cortical_threshold_g_cc, 1.25);
  EXPECT_EQ(read->codes, density);
  EXPECT_LT(part.size(), density.size() / 2) << "bricks of zeros are left out";
  EXPECT_FALSE(twin::read_density(without_code(part).first(part.size() - 2), grid));
  voxel::VoxelGrid other = grid;
  other.dims.z() *= 2;
  EXPECT_FALSE(twin::read_density(without_code(part), other)) << "of another grid";
}

TEST(CauseParts, ComeInOrderOrNotAtAll) {
  const Bytes start = twin::start_part(bone()), segment = twin::segment_part(0, profile());
  const Bytes ticks = twin::ticks_part(some_ticks(0, 3), 1);
  EXPECT_EQ(outcome_of({segment}), Outcome::damaged) << "no bone yet";
  const Bytes density = twin::density_part(std::vector<uint8_t>(bone().grid.voxel_count(), 90), 1.1);
  EXPECT_EQ(outcome_of({density}), Outcome::damaged) << "no bone yet";
  EXPECT_EQ(outcome_of({start, density, segment}), Outcome::agrees);
  EXPECT_EQ(outcome_of({start, segment, density}), Outcome::damaged) << "it comes before the tool";
  EXPECT_EQ(outcome_of({start, ticks}), Outcome::damaged) << "no tool yet";
  EXPECT_EQ(outcome_of({start, start}), Outcome::damaged);
  EXPECT_EQ(outcome_of({start, twin::segment_part(5, profile())}), Outcome::damaged) << "begins later";
  EXPECT_EQ(outcome_of({start, segment, twin::ticks_part(some_ticks(2, 3), 1)}), Outcome::damaged) << "a gap";
  EXPECT_EQ(outcome_of({start, segment, ticks}), Outcome::differs) << "another hash";
  EXPECT_EQ(outcome_of({start, segment, ticks, segment}), Outcome::differs) << "and it stays so";
  EXPECT_EQ(outcome_of({start, segment, twin::end_part(0, 1, 0)}), Outcome::differs) << "another bone";
  const Bytes end = twin::end_part(0, bone().coverage_hash(), 0);
  EXPECT_EQ(outcome_of({start, segment, end}), Outcome::agrees);
  EXPECT_EQ(outcome_of({start, segment, end, segment}), Outcome::damaged) << "nothing comes after the end";
  EXPECT_EQ(outcome_of({Bytes{}}), Outcome::damaged);
  EXPECT_EQ(outcome_of({Bytes{std::byte{9}}}), Outcome::damaged);
}

/// The table's room around the body is what keeps removal within it.
TEST(CauseParts, AToolWithTooLittleRoomIsRefused) {
  shell::SweptProfile narrow = profile();
  narrow.margin_mm = 0.1;
  EXPECT_EQ(outcome_of({twin::start_part(bone()), twin::segment_part(0, narrow)}), Outcome::damaged);
}

Outcome outcome_of(const std::vector<Bytes>& parts) {
  twin::TwinPlayer player;
  Outcome outcome = Outcome::agrees;
  for (const Bytes& part : parts)
    if (outcome == Outcome::agrees) outcome = player.take(part);
  return outcome == Outcome::agrees && !player.ended() ? Outcome::damaged : outcome;
}

TEST(CauseParts, OfAReamingAgree) {
  const auto parts = reamed_parts({64, 64, 48}, {0.25, 0.28, 0.22}, 400);
  EXPECT_EQ(outcome_of(parts), Outcome::agrees);
  const voxel::BoneModel whole = corner_block({64, 64, 48}, {0.25, 0.28, 0.22});
  EXPECT_NE(twin::read_end(without_code(parts.back()))->coverage_hash, whole.coverage_hash())
      << "bone was removed";
}

TEST(CauseParts, CutShortTheyAreDamaged) {
  std::mt19937 random(seed());
  const auto good = reamed_parts({64, 64, 48}, {0.25, 0.28, 0.22}, 200);
  for (int round = 0; round < 60; ++round) {
    std::vector<Bytes> parts = good;
    Bytes& part = parts[static_cast<size_t>(round) % parts.size()];
    part.resize(random() % part.size());
    EXPECT_EQ(outcome_of(parts), Outcome::damaged) << "round " << round;
  }
}

/// From where on a part's bytes all decide. Before lie a voxel size, a table's unused steps, and flags that
/// follow from others.
size_t first_deciding_byte(const Bytes& part) {
  constexpr size_t rows = 100;
  switch (static_cast<twin::PartCode>(part.front())) {
    case twin::PartCode::start: return 1 + 3 * 4 + 3 * 8;
    case twin::PartCode::ticks: return 1 + 4 + 4 + 8 + 13 + 4 * rows;
    default: return 1;
  }
}

TEST(CauseParts, ChangedTheyAreDamagedOrDiffer) {
  std::mt19937 random(seed());
  const auto good = reamed_parts({64, 64, 48}, {0.25, 0.28, 0.22}, 200);
  for (int round = 0; round < 60; ++round) {
    std::vector<Bytes> parts = good;
    const size_t changed = static_cast<size_t>(round) % parts.size();
    Bytes& part = parts[changed];
    const size_t first = first_deciding_byte(part);
    const size_t unproven = changed + 1 == parts.size() ? 4 : 0;  // how long the whole recording is
    const size_t at = first + random() % (part.size() - unproven - first);
    part[at] ^= static_cast<std::byte>(1 + random() % 255);
    const Outcome outcome = outcome_of(parts);
    // Far from where it works, a reamer's table may be another.
    if (changed != 1) {
      EXPECT_NE(outcome, Outcome::agrees) << "round " << round << ", byte " << at << " of part " << changed;
    }
  }
}

}  // namespace
}  // namespace ream::test
