#include "session/replay/replay_picture.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "score/live_score.hpp"
#include "session/live/stream_messages.hpp"
#include "session/replay/recorded_stream.hpp"

namespace ream::session {
namespace {

/// After a jump viewers are sent this much of the trace before it, every tenth tick of it.
constexpr uint32_t history_ticks = 20'000, history_stride = 10;

}  // namespace

ReplayPicture::ReplayPicture(const record::Recording& recording, const case_::Case& before,
                             const std::shared_ptr<const score::NativeGlenoid>& native,
                             const MetricsTimeline& timeline, stream::HelloInfo hello, stream::Fanout& fanout)
    : recording_(recording),
      world_from_grid_(before.bone.grid.world_from_grid),
      timeline_(timeline),
      hello_(std::move(hello)),
      fanout_(fanout),
      grid_(before.bone.grid),
      bone_(recording, before.bone.grid, before.bone.coverage),
      publisher_(before.bone, fanout),
      batcher_(fanout) {
  if (native) gauge_.emplace(native);
  const shell::Tool tool = tool_of_segment(recording_, 0);
  hello_.tool = tool.mesh;
  hello_.tool_name = tool.name;
  fanout_.publish_hello(stream::hello_message(hello_));
  publisher_.publish_all();
  jump_to({});
  publish_state(SessionState::replaying);
}

void ReplayPicture::show(const ReplayMoment& moment) {
  const bool jumped = moment.jump != shown_.jump || moment.position_ticks < shown_.position_ticks;
  const bool moved = moment.position_ticks != shown_.position_ticks;
  const bool changed = jumped || moment.speed != shown_.speed || moment.playing != shown_.playing ||
                       moment.fault != shown_.fault;
  if (jumped) {
    jump_to(moment);
  } else {
    settle(moment, shown_.position_ticks);
    play_to(moment.position_ticks);
  }
  show_tool();
  measure_depth(jumped);
  catch_up_metrics();
  // Ticks that were played have told of changes themselves.
  if (jumped || (changed && !moved)) publish_state(SessionState::replaying);
}

void ReplayPicture::settle(const ReplayMoment& moment, uint32_t position_ticks) {
  shown_ = moment;
  shown_.position_ticks = position_ticks;
  sample_.state = SessionState::replaying;
  sample_.playback = {position_ticks, moment.speed, moment.playing, moment.jump};
  sample_.set_fault(moment.fault);
}

void ReplayPicture::seek_bone(uint32_t ticks) {
  const int64_t now_ns = steady_ns();
  bone_.seek(ticks, [&](const voxel::BrickImage& image) { publisher_.take(image, now_ns); });
}

/// All that may be damaged is read before anything of the picture changes.
void ReplayPicture::jump_to(const ReplayMoment& moment) {
  const uint32_t ticks = moment.position_ticks;
  const record::TickReport now = record::report_of(tick_at(ticks > 0 ? ticks - 1 : 0), world_from_grid_);
  const std::vector<record::ops::Tick> history = history_before(ticks);
  std::optional<score::MetricsAccumulator> metrics = timeline_.at(ticks);
  try {
    seek_bone(ticks);
  } catch (const std::exception&) {
    seek_bone(shown_.position_ticks);
    throw;
  }
  publisher_.flush(steady_ns());
  batcher_.jump();
  metrics_ = std::move(metrics);
  sample_ = {};
  settle(moment, ticks);
  measure_depth(true);
  show_metrics();
  publish_history(history);
  if (ticks > 0) {
    update_sample(now, sample_);
  } else {
    // Before the first tick: where it is going to begin, without force.
    sample_.world_from_tool = now.world_from_tool;
    sample_.world_from_handle = now.world_from_handle;
  }
}

/// Chunk after chunk, so that the picture stands at the last whole moment when the next chunk is damaged.
void ReplayPicture::play_to(uint32_t ticks) {
  while (shown_.position_ticks < ticks) {
    tick_at(shown_.position_ticks);
    const uint32_t end = std::min(ticks, window_.back().tick + 1);
    while (shown_.position_ticks < end) {
      const record::TickReport report = record::report_of(tick_at(shown_.position_ticks), world_from_grid_);
      if (metrics_) metrics_->add(report);
      update_sample(report, sample_);
      sample_.playback->position_ticks = ++shown_.position_ticks;
      batcher_.add(sample_);
    }
    seek_bone(end);
  }
}

const record::ops::Tick& ReplayPicture::tick_at(uint32_t tick) {
  if (window_.empty() || tick < window_.front().tick || tick > window_.back().tick) {
    const record::ChunkPlace& place = recording_.log().chunks().at(recording_.chunk_of(tick));
    window_ = recording_.ticks(place.first_tick, place.first_tick + place.ticks);
  }
  const size_t row = window_.empty() ? 0 : size_t{tick} - window_.front().tick;
  if (row >= window_.size() || window_[row].tick != tick)
    throw Error(ErrorKind::invalid_input, recording_.log().path().string() + " is damaged: it lacks tick " +
                                              std::to_string(tick) + " where it should be");
  return window_[row];
}

/// Ends one step before `end_tick`, so that the trace goes on from there without a gap; begins after the last
/// damage on the way.
std::vector<record::ops::Tick> ReplayPicture::history_before(uint32_t end_tick) const {
  std::vector<record::ops::Tick> history;
  const uint32_t entries = std::min(end_tick, history_ticks) / history_stride;
  const uint32_t first = end_tick - entries * history_stride;
  for (uint32_t from = first; from < end_tick;) {
    const record::ChunkPlace& place = recording_.log().chunks().at(recording_.chunk_of(from));
    const uint32_t to = std::min(end_tick, std::max(place.first_tick + place.ticks, from + 1));
    try {
      recording_.for_each_tick(from, to, [&](const record::ops::Tick& tick) {
        if ((tick.tick - first) % history_stride == 0) history.push_back(tick);
      });
    } catch (const Error&) {
      history.clear();
    }
    from = to;
  }
  return history;
}

void ReplayPicture::publish_history(const std::vector<record::ops::Tick>& history) {
  if (history.empty()) return;
  auto batch = std::make_shared<stream::TelemetryBatch>();
  batch->tick_stride = history_stride;
  for (const record::ops::Tick& tick : history) {
    update_sample(record::report_of(tick, world_from_grid_), sample_);
    batch->samples.push_back(sample_);
  }
  fanout_.publish_telemetry(std::move(batch));
}

void ReplayPicture::show_tool() {
  const auto& segments = recording_.segments();
  const auto next = std::find_if(segments.begin(), segments.end(), [this](const auto& segment) {
    return segment.first_tick > 0 && segment.first_tick >= shown_.position_ticks;
  });
  const auto now = static_cast<size_t>(std::max<std::ptrdiff_t>(next - segments.begin(), 1)) - 1;
  const size_t before = std::exchange(segment_, now);
  if (same_reamer(segments.at(before), segments.at(now))) return;
  const shell::Tool tool = tool_of_segment(recording_, now);
  hello_.tool = tool.mesh;
  hello_.tool_name = tool.name;
  fanout_.publish_tool(stream::hello_message(hello_), stream::tool_message(tool.mesh, tool.name));
}

void ReplayPicture::catch_up_metrics() {
  if (!metrics_) metrics_ = timeline_.at(shown_.position_ticks);
  show_metrics();
}

/// Of the bone on the viewers' screens.
void ReplayPicture::measure_depth(bool jumped) {
  const int64_t now_ns = steady_ns();
  if (!gauge_ || bone_.ticks() == measured_ticks_ || (!jumped && now_ns < depth_due_ns_)) return;
  depth_mm_ = gauge_->measure({grid_, publisher_.replica().coverage().data()});
  measured_ticks_ = bone_.ticks();
  depth_due_ns_ = now_ns + score::LiveScore::publish_period_ns;
}

void ReplayPicture::show_metrics() {
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  sample_.depth_mm = depth_mm_ ? static_cast<float>(*depth_mm_) : unknown;
  sample_.removed_volume_mm3 = metrics_ ? static_cast<float>(metrics_->removed_volume_mm3()) : unknown;
}

void ReplayPicture::poll(int64_t now_ns) {
  publisher_.poll(now_ns);
  batcher_.publish_if_due(now_ns);
}

void ReplayPicture::publish_state(SessionState state) {
  sample_.state = state;
  batcher_.add(sample_);
  batcher_.flush();
}

}  // namespace ream::session
