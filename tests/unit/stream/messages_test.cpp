#include "stream/messages.hpp"

#include <cstring>

#include "unit/stream/viewer.hpp"

namespace ream::stream {
namespace {

HelloInfo example_hello() {
  HelloInfo info;
  info.session_id = "s1";
  info.server_epoch = 0x1234567890ull;
  info.case_id = "demo";
  info.case_name = "Phantom";
  info.side = "right";
  info.grid.dims = {64, 72, 80};
  info.grid.spacing_mm = {0.5, 0.6, 0.7};
  info.grid.world_from_grid.translation_mm = {1, 2, 3};
  info.tool.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  info.tool.triangles = {{0, 1, 2}};
  info.tool_name = "sphere 18";
  info.axis_entry_mm = {4, 5, 6};
  info.axis_direction = {0, 0, 1};
  info.planned_depth_mm = 2.5;
  info.force_scale = 26;
  info.force_max_n = 3.3;
  return info;
}

TelemetryBatch example_telemetry() {
  TelemetryBatch batch;
  batch.stamp_us = 1'234'567;
  for (uint32_t i = 0; i < 33; ++i) {
    TelemetrySample sample;
    sample.tick = 100 + i;
    sample.thrust_n = static_cast<float>(i);
    sample.density_g_cc = 1.5f;
    sample.vibration_g = 0.25f * static_cast<float>(i);
    sample.state = SessionState::fault;
    sample.world_from_tool.translation_mm = {7, 8, 9};
    std::strcpy(sample.fault.data(), "device gone");
    batch.samples.push_back(sample);
  }
  return batch;
}

TEST(Messages, HelloCarriesEveryField) {
  const Message message = hello_message(example_hello());
  ASSERT_TRUE(verified(message->data(), message->size()));
  const wire::Hello* hello = wire::GetServerMessage(message->data())->body_as_Hello();
  ASSERT_NE(hello, nullptr);
  EXPECT_EQ(hello->protocol_revision(), protocol_revision);
  EXPECT_EQ(hello->session_id()->str(), "s1");
  EXPECT_EQ(hello->server_epoch(), 0x1234567890ull);
  EXPECT_EQ(hello->case_id()->str(), "demo");
  EXPECT_EQ(hello->case_name()->str(), "Phantom");
  EXPECT_EQ(hello->side()->str(), "right");
  ASSERT_EQ(hello->grid_dims()->size(), 3u);
  EXPECT_EQ(hello->grid_dims()->Get(1), 72);
  EXPECT_FLOAT_EQ(hello->voxel_spacing_mm()->z(), 0.7f);
  EXPECT_FLOAT_EQ(hello->world_from_grid()->translation_mm().y(), 2);
  EXPECT_FLOAT_EQ(hello->world_from_grid()->rotation().w(), 1);
  EXPECT_EQ(hello->block_edge_voxels(), 32u);
  EXPECT_EQ(hello->tool_positions_mm()->size(), 9u);
  EXPECT_EQ(hello->tool_indices()->size(), 3u);
  EXPECT_EQ(hello->tool_name()->str(), "sphere 18");
  EXPECT_FLOAT_EQ(hello->axis_entry_mm()->x(), 4);
  EXPECT_FLOAT_EQ(hello->axis_direction()->z(), 1);
  EXPECT_FLOAT_EQ(hello->planned_depth_mm(), 2.5f);
  EXPECT_FLOAT_EQ(hello->force_scale(), 26);
  EXPECT_FLOAT_EQ(hello->force_max_n(), 3.3f);
}

TEST(Messages, TelemetryIsParallelArraysAndTheNewestValues) {
  const Message message = telemetry_message(example_telemetry(), 5);
  ASSERT_TRUE(verified(message->data(), message->size()));
  const wire::Telemetry* t = wire::GetServerMessage(message->data())->body_as_Telemetry();
  ASSERT_NE(t, nullptr);
  EXPECT_EQ(t->first_tick(), 100u);
  EXPECT_EQ(t->tick(), 132u);
  ASSERT_EQ(t->thrust_n()->size(), 33u);
  EXPECT_FLOAT_EQ(t->thrust_n()->Get(32), 32);
  EXPECT_FLOAT_EQ(t->density_g_cc()->Get(0), 1.5f);
  EXPECT_EQ(t->hand_force_n()->size(), 33u);
  EXPECT_EQ(t->stamp_us(), 1'234'567u);
  ASSERT_EQ(t->vibration_g()->size(), 33u);
  EXPECT_FLOAT_EQ(t->vibration_g()->Get(32), 8.0f);
  EXPECT_FLOAT_EQ(t->world_from_tool()->translation_mm().x(), 7);
  EXPECT_EQ(t->state(), wire::SessionState::fault);
  EXPECT_EQ(t->fault()->str(), "device gone");
  EXPECT_EQ(t->dropped(), 5u);
  EXPECT_EQ(t->world_from_bone_rest(), nullptr);
}

TEST(Messages, TelemetryTellsWhereABoneThatMovesIs) {
  TelemetryBatch batch = example_telemetry();
  batch.samples.back().world_from_bone_rest = Pose{Mat3::Identity(), Vec3(0.5, -1.0, 2.0)};
  const Message message = telemetry_message(batch, 0);
  ASSERT_TRUE(verified(message->data(), message->size()));
  const wire::Pose* bone =
      wire::GetServerMessage(message->data())->body_as_Telemetry()->world_from_bone_rest();
  ASSERT_NE(bone, nullptr);
  EXPECT_FLOAT_EQ(bone->rotation().w(), 1.0f);
  EXPECT_FLOAT_EQ(bone->translation_mm().z(), 2.0f);
}

TEST(Messages, OnlyAReplaySaysThatItIsOne) {
  HelloInfo info = example_hello();
  const Message live = hello_message(info);
  EXPECT_EQ(wire::GetServerMessage(live->data())->body_as_Hello()->replay_of(), nullptr);
  info.replay_of = "abcdefgh";
  info.duration_ticks = 61234;
  const Message replay = hello_message(info);
  const wire::Hello* hello = wire::GetServerMessage(replay->data())->body_as_Hello();
  EXPECT_EQ(hello->replay_of()->str(), "abcdefgh");
  EXPECT_EQ(hello->duration_ticks(), 61234u);

  TelemetryBatch batch = example_telemetry();
  const Message present = telemetry_message(batch, 0);
  EXPECT_EQ(wire::GetServerMessage(present->data())->body_as_Telemetry()->playback(), nullptr);
  batch.samples.back().playback = Playback{133, 0.25f, true, 7};
  batch.samples.back().state = SessionState::replaying;
  const Message past = telemetry_message(batch, 0);
  const wire::Telemetry* t = wire::GetServerMessage(past->data())->body_as_Telemetry();
  ASSERT_NE(t->playback(), nullptr);
  EXPECT_EQ(t->state(), wire::SessionState::replaying);
  EXPECT_EQ(t->playback()->position_ticks(), 133u);
  EXPECT_EQ(t->playback()->speed(), 0.25f);
  EXPECT_TRUE(t->playback()->playing());
  EXPECT_EQ(t->playback()->jump(), 7u);
}

TEST(Messages, WhereTheScapulaLiesIsSaidWhole) {
  HelloInfo info = example_hello();
  info.scapula.reset();
  const Message without = hello_message(info);
  const wire::Hello* unknown = wire::GetServerMessage(without->data())->body_as_Hello();
  EXPECT_EQ(unknown->glenoid_centre_mm(), nullptr);
  EXPECT_EQ(unknown->trigonum_mm(), nullptr);
  EXPECT_EQ(unknown->inferior_angle_mm(), nullptr);
  info.scapula = {Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9)};
  const Message with = hello_message(info);
  const wire::Hello* hello = wire::GetServerMessage(with->data())->body_as_Hello();
  ASSERT_NE(hello->inferior_angle_mm(), nullptr);
  EXPECT_EQ(hello->glenoid_centre_mm()->x(), 1.0f);
  EXPECT_EQ(hello->trigonum_mm()->y(), 5.0f);
  EXPECT_EQ(hello->inferior_angle_mm()->z(), 9.0f);
}

TEST(Messages, AChangeOfToolCarriesItsMesh) {
  const HelloInfo info = example_hello();
  const Message message = tool_message(info.tool, "sphere 8");
  ASSERT_TRUE(verified(message->data(), message->size()));
  const wire::ToolChange* change = wire::GetServerMessage(message->data())->body_as_ToolChange();
  ASSERT_NE(change, nullptr);
  EXPECT_EQ(change->tool_name()->str(), "sphere 8");
  EXPECT_EQ(change->tool_positions_mm()->size(), 9u);
  EXPECT_EQ(change->tool_indices()->size(), 3u);
}

TEST(Messages, TruncationsAreRefused) {
  const std::vector<SharedBlock> blocks = {small_block(1, 1), small_block(2, 5), small_block(3, 1, true)};
  for (const Message& message : {hello_message(example_hello()), mesh_message(blocks, true),
                                 telemetry_message(example_telemetry(), 0)})
    // Longer ones lack at most the padding of the last field.
    for (size_t size = 0; size + 8 < message->size(); ++size) {
      const std::vector<std::byte> shorter(message->begin(),
                                           message->begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_FALSE(verified(shorter.data(), shorter.size())) << size;
    }
}

TEST(Messages, BlocksSurviveTheirMessage) {
  const std::vector<SharedBlock> blocks = {small_block(1, 11), small_block(2, 12)};
  Viewer viewer;
  viewer.receive(mesh_message(blocks, true));
  ASSERT_EQ(viewer.blocks.size(), 2u);
  EXPECT_TRUE(viewer.blocks[2].surface == decoded(*blocks[1]));
  EXPECT_EQ(viewer.key_completes, 1);
}

}  // namespace
}  // namespace ream::stream
