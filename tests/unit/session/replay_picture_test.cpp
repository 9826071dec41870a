#include "session/replay/replay_picture.hpp"

#include <gtest/gtest.h>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "session/replay/recorded_stream.hpp"
#include "stream/fanout.hpp"
#include "support/damage.hpp"
#include "support/recorded_cutting.hpp"
#include "support/seed.hpp"
#include "support/temporary_folder.hpp"
#include "unit/stream/viewer.hpp"

namespace ream::session {
namespace {

using stream::Surface;
using test::RecordedCutting;

constexpr uint32_t reamer_changed_at = 1500, ticks_in_all = 3130;
constexpr uint32_t replay_picture_seed = 4711;
constexpr auto patience = std::chrono::minutes(1);

using Surfaces = std::map<uint32_t, Surface>;

Surfaces surfaces_of(const voxel::VoxelGrid& grid, const std::vector<uint8_t>& coverage) {
  surface::BlockExtractor extractor(grid, 1);
  Surfaces surfaces;
  for (uint32_t block = 0; block < extractor.layout().count(); ++block) {
    const surface::BlockMesh mesh = extractor.extract(coverage.data(), block);
    if (!mesh.indices.empty()) surfaces[block] = stream::surface_of(mesh.vertices, mesh.indices);
  }
  return surfaces;
}

std::array<double, 7> place_in(const wire::Pose& pose) {
  const wire::Quat& q = pose.rotation();
  const wire::Vec3& t = pose.translation_mm();
  return {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
}

/// A viewer who keeps what telemetry says, too.
struct ReplayViewer {
  std::shared_ptr<stream::Mailbox> mailbox;
  stream::Viewer bone;
  std::vector<std::pair<uint32_t, float>> trace;  ///< tick and thrust, of the newest jump
  std::vector<uint32_t> strides;                  ///< of the batches of the newest jump
  uint32_t jump = 0, position_ticks = 0;
  float depth_mm = 0, removed_mm3 = 0, hand_force_n = 0, spindle_speed_rad_s = 0;
  std::array<double, 7> tool_place{}, handle_place{};
  bool playing = false, always_replaying = true;
  std::string tool;
  wire::SessionState state = wire::SessionState::created;

  void pull() {
    while (const stream::Message message = mailbox->next()) {
      bone.receive(message);
      const wire::ServerMessage* m = wire::GetServerMessage(message->data());
      if (const wire::Hello* hello = m->body_as_Hello()) tool = hello->tool_name()->str();
      if (const wire::ToolChange* change = m->body_as_ToolChange()) tool = change->tool_name()->str();
      if (const wire::Telemetry* t = m->body_as_Telemetry()) take(*t);
    }
  }

 private:
  void take(const wire::Telemetry& t) {
    always_replaying =
        always_replaying && t.playback() != nullptr && t.state() == wire::SessionState::replaying;
    if (t.playback() == nullptr) return;
    if (t.playback()->jump() != jump) {
      trace.clear();
      strides.clear();
    }
    jump = t.playback()->jump();
    position_ticks = t.playback()->position_ticks();
    playing = t.playback()->playing();
    state = t.state();
    depth_mm = t.depth_mm();
    removed_mm3 = t.removed_volume_mm3();
    tool_place = place_in(*t.world_from_tool());
    handle_place = place_in(*t.world_from_handle());
    hand_force_n = t.hand_force_n()->Get(t.hand_force_n()->size() - 1);
    spindle_speed_rad_s = t.spindle_speed_rad_s();
    strides.push_back(t.tick_stride());
    for (uint32_t i = 0; i < t.thrust_n()->size(); ++i)
      trace.emplace_back(t.first_tick() + i * t.tick_stride(), t.thrust_n()->Get(i));
  }
};

class ReplayPictureTest : public testing::Test {
 protected:
  ReplayPictureTest() {
    before_.bone = session_.bone;
    record::ops::Segment segment = RecordedCutting::segment(0);
    segment.tool = "sphere 10";
    {
      record::Recorder recorder(record::create_log_file(path_), session_.header(), segment,
                                session_.follower.data());
      session_.run(recorder, reamer_changed_at);
      recorder.finish("stopped");
    }
    const record::Recording so_far(path_);
    record::RecordedBone bone(so_far, before_.bone.grid, before_.bone.coverage);
    bone.seek(so_far.tick_count(), [](const voxel::BrickImage&) {});
    segment.first_tick = reamer_changed_at;
    segment.reason = "reamer";
    segment.tool = "sphere 8";
    record::Recorder recorder(record::continue_log_file(path_, so_far.log().whole_bytes()), so_far, bone,
                              segment, session_.follower.data());
    session_.run(recorder, ticks_in_all - reamer_changed_at);
    recorder.finish("finished");
  }

  /// A picture of the recording as it is in the file now, and a viewer.
  void open() {
    recording_.emplace(path_);
    timeline_.emplace(*recording_, before_.bone.grid.world_from_grid, start());
    picture_.emplace(*recording_, before_, native_, *timeline_, stream::HelloInfo{}, fanout_);
    viewer_.mailbox = fanout_.subscribe({}, 1);
    viewer_.pull();
  }
  score::MetricsAccumulator start() const { return {before_.bone.grid.voxel_volume_mm3(), Pose{}}; }

  record::ChunkPlace damage_chunk(size_t chunk) {
    const record::ChunkPlace damaged = record::Recording(path_).log().chunks().at(chunk);
    EXPECT_GT(damaged.ticks, 0u);
    EXPECT_FALSE(damaged.has_notes);
    test::damage(path_, damaged.offset + 60);
    return damaged;
  }

  void jump(uint32_t ticks) {
    picture_->show({ticks, ++jumps_, 1.0f, false, {}});
    picture_->poll(now_ns_ += 1'000'000'000);
    viewer_.pull();
  }

  void expect_bone_as_it_was() {
    Surfaces held;
    for (const auto& [block, h] : viewer_.bone.blocks) held[block] = h.surface;
    EXPECT_TRUE(held == surfaces_of(before_.bone.grid, coverage_after(picture_->bone_ticks())))
        << "after " << picture_->bone_ticks() << " ticks";
  }
  const std::vector<uint8_t>& coverage_after(uint32_t ticks) const {
    return ticks == 0 ? session_.start : session_.after.at(ticks);
  }

  /// A block of which the bone of the session is what is left; measured from above.
  std::shared_ptr<const score::NativeGlenoid> session_native() const {
    const voxel::VoxelGrid& grid = before_.bone.grid;
    score::Task task;
    task.plan = case_::Plan{};
    task.plan->entry_mm = grid.world_from_grid.point(grid.bounds_mm().centre());
    task.plan->axis_direction = grid.world_from_grid.direction(-Vec3::UnitZ());
    task.reamer = shell::make_tool("sphere 10,4").profile;
    voxel::BoneModel block = before_.bone;
    std::fill(block.coverage.begin(), block.coverage.end(), uint8_t{255});
    return std::make_shared<const score::NativeGlenoid>(task, block);
  }

  test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "recording.ream";
  RecordedCutting session_{test::seed(replay_picture_seed), Vec3i(40, 24, 24)};
  case_::Case before_;
  std::shared_ptr<const score::NativeGlenoid> native_;
  stream::Fanout fanout_;
  std::optional<record::Recording> recording_;
  std::optional<MetricsTimeline> timeline_;
  std::optional<ReplayPicture> picture_;
  ReplayViewer viewer_;
  uint32_t jumps_ = 0;
  int64_t now_ns_ = steady_ns();
};

TEST_F(ReplayPictureTest, BeginsWithTheBoneBeforeTheFirstTick) {
  open();
  EXPECT_EQ(viewer_.bone.key_completes, 1);
  EXPECT_EQ(viewer_.tool, "sphere 10");
  EXPECT_EQ(viewer_.position_ticks, 0u);
  expect_bone_as_it_was();
}

TEST_F(ReplayPictureTest, AnyMomentLooksAsItDidForwardsAndBackwards) {
  std::mt19937 random(test::seed());
  open();
  for (int i = 0; i < 40; ++i) {
    const auto ticks = static_cast<uint32_t>(random() % (ticks_in_all + 1));
    jump(ticks);
    EXPECT_LE(picture_->bone_ticks(), ticks);
    EXPECT_GT(picture_->bone_ticks() + record::ticks_per_chunk, ticks);
    EXPECT_EQ(viewer_.position_ticks, ticks);
    expect_bone_as_it_was();
  }
  jump(ticks_in_all);
  EXPECT_EQ(picture_->bone_ticks(), ticks_in_all);
  EXPECT_EQ(picture_->bone_hash(), session_.bone.coverage_hash());
  expect_bone_as_it_was();
  EXPECT_TRUE(viewer_.always_replaying);
}

/// What a page without a server shows is what a replay shows.
TEST_F(ReplayPictureTest, TheStreamOfAFileSaysTheSame) {
  before_.plan = case_::Plan{};
  native_ = session_native();
  open();
  constexpr uint32_t interval_ticks = 20;
  stream::HelloInfo hello;
  hello.grid = before_.bone.grid;
  std::string tool = "sphere 10";
  uint32_t next = 0, compared = 0, hellos = 0;
  const auto take = [&](RecordedMessage kind, uint32_t at_ticks, const stream::Message& message) {
    const wire::ServerMessage* m = wire::GetServerMessage(message->data());
    if (kind == RecordedMessage::hello) {
      ASSERT_NE(m->body_as_Hello(), nullptr);
      EXPECT_EQ(m->body_as_Hello()->duration_ticks(), ticks_in_all);
      EXPECT_EQ(m->body_as_Hello()->tool_name()->str(), tool);
      ++hellos;
      return;
    }
    if (kind == RecordedMessage::tool) {
      ASSERT_NE(m->body_as_ToolChange(), nullptr);
      tool = m->body_as_ToolChange()->tool_name()->str();
      EXPECT_EQ(at_ticks, reamer_changed_at + 1);
      return;
    }
    const wire::Telemetry* t = m->body_as_Telemetry();
    ASSERT_NE(t, nullptr);
    EXPECT_EQ(at_ticks, std::min(next, ticks_in_all));
    next = at_ticks + interval_ticks;
    if (at_ticks % 300 != 0 && at_ticks != ticks_in_all) return;
    ++compared;
    jump(at_ticks);
    EXPECT_EQ(t->playback()->position_ticks(), viewer_.position_ticks);
    EXPECT_EQ(t->state(), wire::SessionState::replaying);
    EXPECT_EQ(tool, viewer_.tool) << at_ticks;
    EXPECT_FLOAT_EQ(t->removed_volume_mm3(), viewer_.removed_mm3) << at_ticks;
    EXPECT_FLOAT_EQ(t->depth_mm(), viewer_.depth_mm) << at_ticks;
    EXPECT_EQ(place_in(*t->world_from_tool()), viewer_.tool_place) << at_ticks;
    EXPECT_EQ(place_in(*t->world_from_handle()), viewer_.handle_place) << at_ticks;
    EXPECT_EQ(t->hand_force_n()->Get(0), viewer_.hand_force_n) << at_ticks;
    EXPECT_EQ(t->spindle_speed_rad_s(), viewer_.spindle_speed_rad_s) << at_ticks;
    if (at_ticks > 0) {
      EXPECT_EQ(t->tick(), at_ticks - 1);
    }
  };
  recorded_stream(*recording_, before_, native_, hello, ticks_in_all, interval_ticks, take, no_progress);
  EXPECT_EQ(hellos, 1u);
  EXPECT_GT(compared, 10u);
  EXPECT_EQ(next, ticks_in_all + interval_ticks) << "the last moment, too";
  EXPECT_EQ(tool, "sphere 8");
}

TEST_F(ReplayPictureTest, PlayingShowsEveryTickOnceAndTheBoneWithIt) {
  open();
  for (uint32_t ticks = 0; ticks < ticks_in_all;) {
    ticks = std::min(ticks + 97, ticks_in_all);
    picture_->show({ticks, 0, 2.0f, true, {}});
    picture_->poll(now_ns_ += 50'000'000);
    viewer_.pull();
  }
  std::map<uint32_t, float> shown;
  for (const auto& [tick, thrust] : viewer_.trace)
    if (tick > 0) {
      EXPECT_TRUE(shown.emplace(tick, thrust).second || tick + 1 == viewer_.position_ticks) << tick;
    }
  ASSERT_EQ(shown.size(), ticks_in_all - 1);
  for (uint32_t tick = 1; tick < ticks_in_all; ++tick)
    ASSERT_EQ(shown.at(tick), static_cast<float>(session_.reports[tick].thrust_n)) << tick;
  EXPECT_EQ(viewer_.bone.dropped, 0u);
  EXPECT_TRUE(viewer_.playing);
  for (int i = 0; i < 20; ++i) picture_->poll(now_ns_ += 1'000'000'000);
  viewer_.pull();
  expect_bone_as_it_was();
}

TEST_F(ReplayPictureTest, AJumpBringsTheTraceBeforeItAndNothingElse) {
  open();
  jump(3000);
  jump(1234);
  ASSERT_FALSE(viewer_.trace.empty());
  EXPECT_EQ(viewer_.strides.front(), 10u);
  EXPECT_EQ(viewer_.trace.front().first, 4u);
  for (size_t i = 0; i + 1 < viewer_.trace.size(); ++i) {
    const auto& [tick, thrust] = viewer_.trace[i];
    EXPECT_EQ(tick, 4 + 10 * i);
    EXPECT_EQ(thrust, static_cast<float>(session_.reports[tick].thrust_n));
  }
  EXPECT_EQ(viewer_.trace.back().first, 1233u);
  EXPECT_EQ(viewer_.bone.dropped, 0u);
}

TEST_F(ReplayPictureTest, TheReamerIsTheOneOfTheMomentForLateJoinersToo) {
  open();
  jump(reamer_changed_at);
  EXPECT_EQ(viewer_.tool, "sphere 10");
  jump(reamer_changed_at + 1);
  EXPECT_EQ(viewer_.tool, "sphere 8");
  const int hellos = viewer_.bone.hellos;
  ReplayViewer late;
  late.mailbox = fanout_.subscribe({}, 1);
  late.pull();
  EXPECT_EQ(late.tool, "sphere 8");
  EXPECT_TRUE(late.bone.same_picture(viewer_.bone));
  jump(10);
  EXPECT_EQ(viewer_.tool, "sphere 10");
  EXPECT_EQ(viewer_.bone.hellos, hellos);
}

TEST_F(ReplayPictureTest, MetricsAreThoseUpToTheMoment) {
  open();
  timeline_->wait_for(ticks_in_all, patience);
  for (const uint32_t ticks : {2999u, 3000u, 3001u, 7u, 0u, ticks_in_all, 1000u}) {
    score::MetricsAccumulator metrics = start();
    for (uint32_t tick = 0; tick < ticks; ++tick)
      metrics.add(record::as_recorded(session_.reports[tick], before_.bone.grid.world_from_grid));
    jump(ticks);
    EXPECT_EQ(viewer_.removed_mm3, static_cast<float>(metrics.removed_volume_mm3())) << ticks;
    EXPECT_TRUE(std::isnan(viewer_.depth_mm)) << "nothing says what this bone is measured against";
    EXPECT_EQ(timeline_->wait_for(ticks, patience).session_hash(), metrics.session_hash());
  }
}

TEST_F(ReplayPictureTest, DepthIsThatOfTheBoneThatIsShown) {
  native_ = session_native();
  open();
  score::DepthGauge gauge(native_);
  float deepest = 0.0f;
  for (const uint32_t ticks : {2999u, 7u, 0u, ticks_in_all, 1000u}) {
    jump(ticks);
    const auto left = coverage_after(picture_->bone_ticks());
    EXPECT_EQ(viewer_.depth_mm, static_cast<float>(gauge.measure({before_.bone.grid, left.data()}))) << ticks;
    deepest = std::max(deepest, viewer_.depth_mm);
  }
  EXPECT_GT(deepest, score::reamed_mm);
}

TEST_F(ReplayPictureTest, ADamagedMomentIsSaidAndAllBeforeItCanBeSeen) {
  const record::ChunkPlace damaged = damage_chunk(10);
  open();
  jump(700);
  const uint32_t shown_before = picture_->ticks();
  for (const uint32_t ticks : {3000u, damaged.first_tick + 1, damaged.first_tick + damaged.ticks}) {
    EXPECT_THROW(jump(ticks), Error);
    EXPECT_EQ(picture_->ticks(), shown_before) << "after a jump to " << ticks;
    viewer_.pull();
    EXPECT_EQ(viewer_.position_ticks, shown_before);
  }
  jump(700);
  expect_bone_as_it_was();
  jump(damaged.first_tick);
  EXPECT_EQ(viewer_.position_ticks, damaged.first_tick);
  expect_bone_as_it_was();
  EXPECT_THROW(timeline_->wait_for(3000, patience), Error);
  EXPECT_THROW(timeline_->wait_for(damaged.first_tick + 1, patience), Error);
  EXPECT_NO_THROW(timeline_->wait_for(damaged.first_tick, patience));
  EXPECT_FALSE(timeline_->at(damaged.first_tick + 1).has_value());
  EXPECT_EQ(timeline_->damage().after_ticks, damaged.first_tick);
  EXPECT_FALSE(timeline_->damage().words.empty());
}

TEST_F(ReplayPictureTest, PlayingIntoDamageRestsBeforeIt) {
  const record::ChunkPlace damaged = damage_chunk(10);
  open();
  jump(damaged.first_tick - 600);
  const ReplayMoment beyond{damaged.first_tick + damaged.ticks + 20, jumps_, 1.0f, true, {}};
  EXPECT_THROW(picture_->show(beyond), Error);
  EXPECT_EQ(picture_->ticks(), damaged.first_tick);
  EXPECT_EQ(picture_->bone_ticks(), damaged.first_tick);
  EXPECT_NO_THROW(picture_->show({damaged.first_tick, jumps_, 1.0f, false, "damaged"}));
  for (int i = 0; i < 20; ++i) picture_->poll(now_ns_ += 1'000'000'000);
  viewer_.pull();
  EXPECT_EQ(viewer_.trace.back().first, damaged.first_tick - 1);
  expect_bone_as_it_was();
}

TEST_F(ReplayPictureTest, MetricsAreNotWaitedForLongerThanAsked) {
  open();
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const MetricsTimeline fresh(*recording_, before_.bone.grid.world_from_grid, start());
    try {
      fresh.wait_for(ticks_in_all, std::chrono::milliseconds(0));
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::unavailable);
      EXPECT_NO_THROW(fresh.wait_for(ticks_in_all, patience));
      return;
    }
  }
  FAIL() << "the recording was always read at once";
}

}  // namespace
}  // namespace ream::session
