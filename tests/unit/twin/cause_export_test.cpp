// What a session's causes say, computed by the twin in this program.
#include <gtest/gtest.h>

#include "record/recorded_bone.hpp"
#include "session/simulation/recorded_session.hpp"
#include "support/changed_recording.hpp"
#include "support/expect_error.hpp"
#include "support/recorded_reaming.hpp"
#include "support/twin/cause_file.hpp"
#include "twin/twin_player.hpp"

namespace ream::test {
namespace {

using twin::TwinPlayer;
using Outcome = TwinPlayer::Outcome;

class CauseExport : public testing::Test {
 protected:
  /// Coverage that the recording itself keeps, in its bricks.
  std::vector<uint8_t> left_in(const std::filesystem::path& path) {
    const record::Recording recording(path);
    const case_::Case c = session::case_of(recording, "", reaming_.data());
    std::vector<uint8_t> coverage = c.bone.coverage;
    record::RecordedBone bone(recording, c.bone.grid, coverage);
    bone.seek(UINT32_MAX, [](const voxel::BrickImage&) {});
    bone.write_to(coverage);
    return coverage;
  }

  /// Every part is taken, and the bone is that of the recording's bricks.
  void expect_agrees(const std::filesystem::path& recording) {
    TwinPlayer player;
    for (const twin::Bytes& part : parts_of(causes_of(reaming_, recording)))
      ASSERT_EQ(player.take(part), Outcome::agrees);
    EXPECT_TRUE(player.ended());
    EXPECT_EQ(player.agreed_ticks(), record::Recording(recording).tick_count());
    ASSERT_TRUE(player.twin());
    EXPECT_TRUE(player.twin()->bone().coverage == left_in(recording));
  }

  RecordedReaming reaming_;
};

TEST_F(CauseExport, TheTwinLeavesTheBoneThatTheSessionLeft) {
  for (const char* profile : {"ideal", "touch", "hapticmaster"}) {
    SCOPED_TRACE(profile);
    const auto recording = reaming_.record(RecordedReaming::push(profile));
    expect_agrees(recording);
    const std::vector<uint8_t> left = left_in(recording);
    const record::Recording read(recording);
    EXPECT_NE(left, session::case_of(read, "", reaming_.data()).bone.coverage) << "bone was removed";
  }
}

TEST_F(CauseExport, AnotherReamerIsAnotherSegment) {
  const nlohmann::json script = RecordedReaming::push("omega.6", 1.5);
  const auto recording = reaming_.record(script);
  reaming_.go_on(recording, script, "sphere 10,6");
  expect_agrees(recording);
}

TEST_F(CauseExport, AMovedReamerIsFoundWithinTheHashThatStandsForIt) {
  const auto recording = reaming_.record(RecordedReaming::push("ideal"));
  const auto forged = reaming_.folder().path() / "forged.ream";
  change_recording(recording, forged, of<record::ops::Tick>([](record::ops::Tick& tick) {
                     if (tick.tick == 1100) tick.grid_from_tool.translation_nm[2] += 1;
                   }));
  TwinPlayer player;
  Outcome outcome = Outcome::agrees;
  for (const twin::Bytes& part : parts_of(causes_of(reaming_, forged)))
    if (outcome == Outcome::agrees) outcome = player.take(part);
  EXPECT_EQ(outcome, Outcome::differs);
  EXPECT_EQ(player.agreed_ticks(), 1000u);
}

/// What a program that is killed leaves: ticks whose bricks never came, and no end.
TEST_F(CauseExport, OfAKilledSessionEndAtItsLastCheckpoint) {
  const auto recording = reaming_.record(RecordedReaming::push("ideal"));
  const auto cut = reaming_.folder().path() / "killed.ream";
  {
    const record::OpLogReader reader(recording);
    record::OpLogWriter writer(record::create_log_file(cut));
    for (size_t i = 0; i < reader.chunks().size(); ++i) {
      record::ops::read(reader.read_chunk(i), reader.revision(), [&](const auto& op) {
        using Op = std::remove_cvref_t<decltype(op)>;
        if constexpr (std::is_same_v<Op, record::ops::Bricks> || std::is_same_v<Op, record::ops::Checkpoint>)
          if (op.tick >= 1500) return;
        if constexpr (!std::is_same_v<Op, record::ops::End>) writer.add(op);
      });
      writer.close_chunk();
    }
    writer.sync();
  }
  const uint32_t last = record::Recording(cut).last_checkpoint()->tick;
  ASSERT_LT(last, 1500u);
  TwinPlayer player;
  for (const twin::Bytes& part : parts_of(causes_of(reaming_, cut)))
    ASSERT_EQ(player.take(part), Outcome::agrees);
  EXPECT_TRUE(player.ended());
  EXPECT_EQ(player.agreed_ticks(), last + 1);
  EXPECT_EQ(player.recorded_ticks(), record::Recording(recording).tick_count())
      << "and says that there is more";
}

TEST_F(CauseExport, OfADamagedRecordingAreRefused) {
  const auto recording = reaming_.record(RecordedReaming::push("ideal"));
  std::filesystem::resize_file(recording, std::filesystem::file_size(recording) / 2);
  expect_error(ErrorKind::conflict, "damaged", [&] { causes_of(reaming_, recording); });
}

TEST_F(CauseExport, BoneThatWentByDecayIsRefused) {
  nlohmann::json script = RecordedReaming::push("ideal", 0.5);
  session::RunRequest request = reaming_.request(script);
  request.removal = sim::RemovalLaw::decay;
  session::Simulation simulation(session::build_setup(request, reaming_.data()));
  const auto recording = reaming_.record(simulation);
  expect_error(ErrorKind::conflict, "decay", [&] { causes_of(reaming_, recording); });
}

TEST_F(CauseExport, ASurfaceChangesWhereBoneDoes) {
  TwinPlayer player;
  size_t blocks_at_first = 0;
  for (const twin::Bytes& part :
       parts_of(causes_of(reaming_, reaming_.record(RecordedReaming::push("ideal"))))) {
    ASSERT_EQ(player.take(part), Outcome::agrees);
    if (code_of(part) == twin::PartCode::start) blocks_at_first = player.twin()->take_changed_blocks().size();
  }
  EXPECT_EQ(blocks_at_first, player.twin()->block_count());
  const std::vector<uint32_t> changed = player.twin()->take_changed_blocks();
  ASSERT_FALSE(changed.empty());
  surface::BlockExtractor extractor(player.twin()->bone().grid);
  size_t triangles = 0;
  for (const uint32_t block : changed) {
    const surface::BlockMesh mesh = player.twin()->surface_of(block);
    EXPECT_EQ(mesh.vertices, extractor.extract(player.twin()->bone().coverage.data(), block).vertices);
    triangles += mesh.indices.size() / 3;
  }
  EXPECT_GT(triangles, 100u);
  EXPECT_TRUE(player.twin()->take_changed_blocks().empty());
}

}  // namespace
}  // namespace ream::test
