// What a session's causes say, computed by the twin in this program.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "record/recorded_bone.hpp"
#include "session/simulation/recorded_session.hpp"
#include "stream/mesh_publisher.hpp"
#include "support/changed_recording.hpp"
#include "support/expect_error.hpp"
#include "support/recorded_reaming.hpp"
#include "support/seed.hpp"
#include "support/twin/cause_file.hpp"
#include "support/twin/killed_recording.hpp"
#include "twin/twin_player.hpp"

namespace ream::test {
namespace {

using twin::TwinPlayer;
using Outcome = TwinPlayer::Outcome;

/// How often each level comes, of packed ones.
std::array<size_t, 16> levels_in(const std::vector<uint8_t>& packed) {
  std::array<size_t, 16> count{};
  for (const uint8_t two : packed) ++count[two & 15u], ++count[two >> 4u];
  return count;
}

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

TEST_F(CauseExport, OfAKilledSessionEndAtItsLastCheckpoint) {
  const auto recording = reaming_.record(RecordedReaming::push("ideal"));
  const auto cut = killed_recording(recording, reaming_.folder().path() / "killed.ream", 1500);
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
    const surface::BlockMesh mesh = player.twin()->surface_of(block).mesh;
    EXPECT_EQ(mesh.vertices, extractor.extract(player.twin()->bone().coverage.data(), block).vertices);
    triangles += mesh.indices.size() / 3;
  }
  EXPECT_GT(triangles, 100u);
  EXPECT_TRUE(player.twin()->take_changed_blocks().empty());
}

/// Parts before the end, and how many ticks have passed after each.
struct Course {
  std::vector<twin::Bytes> parts;
  std::vector<uint32_t> ticks_after;
};

Course course_of(const std::vector<twin::Bytes>& parts) {
  Course course;
  uint32_t ticks = 0;
  for (const twin::Bytes& part : parts) {
    if (code_of(part) == twin::PartCode::end) break;
    if (code_of(part) == twin::PartCode::ticks)
      ticks += static_cast<uint32_t>(twin::read_ticks(std::span(part).subspan(1))->ticks.size());
    course.parts.push_back(part);
    course.ticks_after.push_back(ticks);
  }
  return course;
}

/// Back and forth, over a change of the reamer; every hash on the way is compared by the player itself.
TEST_F(CauseExport, AMomentThatWasKeptIsGoneBackToWhole) {
  const nlohmann::json script = RecordedReaming::push("omega.6", 1.5);
  const auto recording = reaming_.record(script);
  reaming_.go_on(recording, script, "sphere 10,6");
  const Course course = course_of(parts_of(causes_of(reaming_, recording)));
  std::vector<std::vector<uint8_t>> bone_after;
  {
    TwinPlayer straight;
    for (const twin::Bytes& part : course.parts) {
      ASSERT_EQ(straight.take(part), Outcome::agrees);
      bone_after.push_back(straight.twin()->bone().coverage);
    }
  }
  ASSERT_NE(bone_after.front(), bone_after.back());
  std::mt19937 random(seed());
  TwinPlayer player;
  std::vector<size_t> next_of_snapshot;
  size_t next = 0, furthest = 0;
  const auto surfaces = [](twin::BoneTwin& twin) {
    std::vector<surface::BlockMesh> meshes;
    for (uint32_t block = 0; block < twin.block_count(); ++block)
      meshes.push_back(twin.surface_of(block).mesh);
    return meshes;
  };
  std::vector<surface::BlockMesh> shown;
  for (int round = 0; round < 40; ++round) {
    if (!next_of_snapshot.empty() && random() % 2 == 0) {
      const size_t moment = random() % next_of_snapshot.size();
      ASSERT_TRUE(player.go_to(moment));
      next = next_of_snapshot[moment];
    }
    for (size_t steps = random() % 8; steps > 0 && next < course.parts.size(); --steps) {
      ASSERT_EQ(player.take(course.parts[next]), Outcome::agrees);
      ++next;
      const bool is_snapshot =
          std::find(next_of_snapshot.begin(), next_of_snapshot.end(), next) != next_of_snapshot.end();
      if (is_snapshot || (next > furthest && next % 3 == 0)) {
        const auto moment = player.keep_snapshot();
        ASSERT_TRUE(moment);
        if (*moment == next_of_snapshot.size()) next_of_snapshot.push_back(next);
        EXPECT_EQ(next_of_snapshot.at(*moment), next) << "it is the one that was kept here";
      }
      furthest = std::max(furthest, next);
    }
    if (next == 0) continue;
    EXPECT_EQ(player.agreed_ticks(), course.ticks_after[next - 1]);
    ASSERT_TRUE(player.twin()->bone().coverage == bone_after[next - 1]) << "round " << round;
    // What a viewer holds who has taken every block that was said to have changed.
    if (shown.empty()) shown.resize(player.twin()->block_count());
    for (const uint32_t block : player.twin()->take_changed_blocks())
      shown[block] = player.twin()->surface_of(block).mesh;
    const auto now = surfaces(*player.twin());
    for (size_t block = 0; block < now.size(); ++block)
      ASSERT_TRUE(shown[block].vertices == now[block].vertices && shown[block].indices == now[block].indices)
          << "block " << block;
  }
  EXPECT_GT(next_of_snapshot.size(), 2u);
  EXPECT_FALSE(player.go_to(next_of_snapshot.size())) << "no such moment";
}

/// Maps go by the order of its vertices.
TEST_F(CauseExport, TheWholeSurfaceIsThatOfTheProgramsFiles) {
  TwinPlayer player;
  for (const twin::Bytes& part :
       parts_of(causes_of(reaming_, reaming_.record(RecordedReaming::push("ideal")))))
    ASSERT_EQ(player.take(part), Outcome::agrees);
  const TriangleMesh ours = player.twin()->whole_surface();
  const voxel::BoneModel& bone = player.twin()->bone();
  const TriangleMesh files = surface::whole_surface(bone.grid, bone.coverage.data());
  EXPECT_GT(files.triangles.size(), 1000u);
  EXPECT_TRUE(ours.vertices_mm == files.vertices_mm);
  EXPECT_TRUE(ours.normals == files.normals);
  EXPECT_TRUE(ours.triangles == files.triangles);
}

/// A damaged part changes nothing, one that differs is taken back.
TEST_F(CauseExport, ASnapshotIsThereAfterPartsThatAreNoGood) {
  const Course course =
      course_of(parts_of(causes_of(reaming_, reaming_.record(RecordedReaming::push("ideal")))));
  ASSERT_GT(course.parts.size(), 7u);
  for (const Outcome wrong : {Outcome::damaged, Outcome::differs}) {
    TwinPlayer player;
    for (size_t i = 0; i < 5; ++i) ASSERT_EQ(player.take(course.parts[i]), Outcome::agrees);
    const auto kept = player.keep_snapshot();
    ASSERT_TRUE(kept);
    const std::vector<uint8_t> bone = player.twin()->bone().coverage;
    twin::Bytes bad = course.parts[5];
    if (wrong == Outcome::damaged)
      bad.resize(bad.size() / 2);
    else
      bad[9] ^= std::byte{1};  // of the hash
    EXPECT_EQ(player.take(bad), wrong);
    EXPECT_FALSE(player.keep_snapshot());
    ASSERT_TRUE(player.go_to(*kept));
    EXPECT_TRUE(player.twin()->bone().coverage == bone);
    for (size_t i = 5; i < course.parts.size(); ++i) ASSERT_EQ(player.take(course.parts[i]), Outcome::agrees);
  }
}

/// As a server's replay tells them, of the same bone.
TEST_F(CauseExport, APictureHasTheMarksThatAServerSends) {
  const auto path = reaming_.record(RecordedReaming::push("ideal"));
  const record::Recording recording(path);
  const case_::Case start = session::case_of(recording, "", reaming_.data());
  const auto file = reaming_.folder().path() / "pictures.causes";
  write_file_atomically(file, session::causes_of(recording, start, session::CauseUse::pictures, no_progress));
  TwinPlayer player;
  for (const twin::Bytes& part : parts_of(file)) ASSERT_EQ(player.take(part), Outcome::agrees);
  stream::Fanout fanout;
  stream::MeshPublisher publisher(start.bone, fanout);
  publisher.publish_all();
  record::RecordedBone bone(recording, start.bone.grid, start.bone.coverage);
  bone.seek(UINT32_MAX, [&](const voxel::BrickImage& image) { publisher.take(image, 0); });
  publisher.flush(0);
  const auto mailbox = fanout.subscribe([] {}, 1);
  size_t with_removed = 0, with_classes = 0;
  for (const stream::SharedBlock& block : mailbox->take().blocks) {
    SCOPED_TRACE(block->block);
    const twin::MarkedSurface surface = player.twin()->surface_of(block->block);
    const stream::SurfaceClasses classes(player.twin()->bone());
    // The server's vertices come in another order.
    const stream::EncodedBlock own = stream::encode(surface.mesh, 0, 0, 1, &classes);
    EXPECT_EQ(own.vertices, block->vertices);
    EXPECT_EQ(own.classes, block->classes);
    EXPECT_EQ(surface.classes.size(), block->classes.size());
    EXPECT_EQ(surface.removed.size(), block->removed.size());
    EXPECT_EQ(surface.densities.size(), block->densities.size());
    EXPECT_EQ(levels_in(surface.removed), levels_in(block->removed));
    EXPECT_EQ(levels_in(surface.densities), levels_in(block->densities));
    with_removed += !block->removed.empty();
    with_classes += !block->classes.empty();
  }
  EXPECT_GT(with_removed, 0u);
  EXPECT_GT(with_classes, with_removed);
}

}  // namespace
}  // namespace ream::test
