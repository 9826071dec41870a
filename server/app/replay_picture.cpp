#include "app/replay_picture.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "app/reamer.hpp"
#include "app/stream_words.hpp"
#include "core/clock.hpp"

namespace ream::app {
namespace {

/// After a jump viewers are sent this much of the trace before it, every tenth tick of it.
constexpr uint32_t history_ticks = 20'000, history_stride = 10;

}  // namespace

ReplayPicture::ReplayPicture(const record::Recording& recording, const case_::Case& before,
                             const MetricsTimeline& timeline, stream::HelloInfo hello, stream::Fanout& fanout)
    : recording_(recording),
      world_from_grid_(before.bone.grid.world_from_grid),
      timeline_(timeline),
      hello_(std::move(hello)),
      fanout_(fanout),
      bone_(recording, before.bone.grid, before.bone.coverage),
      publisher_(before.bone, fanout),
      batcher_(fanout) {
  const shell::Tool tool = tool_of_segment(0);
  hello_.tool = tool.mesh;
  hello_.tool_name = tool.name;
  fanout_.publish_hello(stream::hello_message(hello_));
  publisher_.publish_all();
  jump_to(0);
  tell(stream::SessionState::replaying);
}

void ReplayPicture::show(const ReplayMoment& moment) {
  const bool jumped = moment.jump != shown_.jump || moment.position_ticks < shown_.position_ticks;
  const bool moved = moment.position_ticks != shown_.position_ticks;
  const bool changed = jumped || moment.speed != shown_.speed || moment.playing != shown_.playing ||
                       moment.fault != shown_.fault;
  if (jumped || moved) seek_bone(moment.position_ticks);
  shown_.jump = moment.jump;
  shown_.speed = moment.speed;
  shown_.playing = moment.playing;
  set_fault(moment.fault);
  sample_.playback = {moment.position_ticks, moment.speed, moment.playing, moment.jump};
  if (jumped)
    jump_to(moment.position_ticks);
  else if (moved)
    play_to(moment.position_ticks);
  show_tool();
  catch_up_metrics();
  // Ticks that were played have told of changes themselves.
  if (jumped || (changed && !moved)) tell(stream::SessionState::replaying);
}

void ReplayPicture::seek_bone(uint32_t ticks) {
  const int64_t now_ns = steady_ns();
  bone_.seek(ticks, [&](const voxel::BrickImage& image) { publisher_.take(image, now_ns); });
}

void ReplayPicture::jump_to(uint32_t ticks) {
  publisher_.flush(steady_ns());
  batcher_.jump();
  shown_.position_ticks = ticks;
  metrics_.reset();
  catch_up_metrics();
  sample_.playback = {ticks, shown_.speed, shown_.playing, shown_.jump};
  sample_.state = stream::SessionState::replaying;
  if (ticks > 0) {
    publish_history(ticks);
    take_tick(ticks - 1);
    return;
  }
  // Before the first tick: where it is going to begin, without force.
  const record::TickReport first = record::report_of(tick_at(0), world_from_grid_);
  sample_ = {};
  sample_.world_from_tool = first.world_from_tool;
  sample_.world_from_handle = first.world_from_handle;
  sample_.playback = {0, shown_.speed, shown_.playing, shown_.jump};
  sample_.state = stream::SessionState::replaying;
}

void ReplayPicture::play_to(uint32_t ticks) {
  for (uint32_t tick = shown_.position_ticks; tick < ticks; ++tick) {
    if (metrics_) metrics_->add(record::report_of(tick_at(tick), world_from_grid_));
    take_tick(tick);
    shown_.position_ticks = tick + 1;
    sample_.playback->position_ticks = tick + 1;
    batcher_.add(sample_);
  }
}

void ReplayPicture::take_tick(uint32_t tick) {
  fill_in(record::report_of(tick_at(tick), world_from_grid_), sample_);
}

const record::ops::Tick& ReplayPicture::tick_at(uint32_t tick) {
  if (window_.empty() || tick < window_.front().tick || tick > window_.back().tick) {
    const record::ChunkPlace& place = recording_.log().chunks().at(recording_.chunk_of(tick));
    window_ = recording_.ticks(place.first_tick, place.first_tick + place.ticks);
  }
  return window_.at(tick - window_.front().tick);
}

/// Ends one step before `end_tick`, so that the trace goes on from there without a gap.
void ReplayPicture::publish_history(uint32_t end_tick) {
  const uint32_t entries = std::min(end_tick, history_ticks) / history_stride;
  if (entries == 0) return;
  const uint32_t first = end_tick - entries * history_stride;
  auto batch = std::make_shared<stream::TelemetryBatch>();
  batch->tick_stride = history_stride;
  recording_.for_each_tick(first, end_tick, [&](const record::ops::Tick& tick) {
    if ((tick.tick - first) % history_stride != 0) return;
    fill_in(record::report_of(tick, world_from_grid_), sample_);
    batch->samples.push_back(sample_);
  });
  fanout_.publish_telemetry(std::move(batch));
}

shell::Tool ReplayPicture::tool_of_segment(size_t segment) const {
  const record::ops::Segment& s = recording_.segments().at(segment);
  return tool_of({s.tool, axis_from_text(s.tool_axis, recording_.log().path().string()), s.tool_file});
}

void ReplayPicture::show_tool() {
  const auto& segments = recording_.segments();
  const auto next = std::find_if(segments.begin(), segments.end(), [this](const auto& segment) {
    return segment.first_tick > 0 && segment.first_tick >= shown_.position_ticks;
  });
  const auto now = static_cast<size_t>(std::max<std::ptrdiff_t>(next - segments.begin(), 1)) - 1;
  const record::ops::Segment &before = segments.at(segment_), &after = segments.at(now);
  segment_ = now;
  if (before.tool == after.tool && before.tool_axis == after.tool_axis && before.tool_file == after.tool_file)
    return;
  const shell::Tool tool = tool_of_segment(now);
  hello_.tool = tool.mesh;
  hello_.tool_name = tool.name;
  fanout_.publish_tool(stream::hello_message(hello_), stream::tool_message(tool.mesh, tool.name));
}

void ReplayPicture::catch_up_metrics() {
  if (!metrics_) metrics_ = timeline_.at(shown_.position_ticks);
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  const score::Metrics metrics = metrics_ ? metrics_->metrics() : score::Metrics{};
  sample_.depth_mm = metrics_ ? static_cast<float>(metrics.reaming_depth_mm) : unknown;
  sample_.removed_volume_mm3 = metrics_ ? static_cast<float>(metrics.removed_volume_mm3) : unknown;
}

void ReplayPicture::poll(int64_t now_ns) {
  publisher_.poll(now_ns);
  batcher_.publish_if_due(now_ns);
}

void ReplayPicture::set_fault(const std::string& fault) {
  shown_.fault = fault;
  sample_.fault.fill('\0');
  std::memcpy(sample_.fault.data(), fault.data(), std::min(fault.size(), sample_.fault.size() - 1));
}

void ReplayPicture::tell(stream::SessionState state) {
  sample_.state = state;
  batcher_.add(sample_);
  batcher_.flush();
}

}  // namespace ream::app
