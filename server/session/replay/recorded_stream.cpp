#include "session/replay/recorded_stream.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/clock.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "record/recorded_bone.hpp"
#include "score/depth_gauge.hpp"
#include "score/metrics.hpp"
#include "session/live/stream_messages.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "sim/model.hpp"
#include "sim/settings.hpp"
#include "stream/telemetry.hpp"

namespace ream::session {
namespace {

constexpr float unknown_depth_mm = std::numeric_limits<float>::quiet_NaN();

double recorded_force_max_n(const record::Recording& recording) {
  const std::string place = "the settings in " + recording.log().path().string();
  const auto settings = parse_json_or_discard(recording.header().settings);
  if (settings.is_discarded()) throw Error(ErrorKind::invalid_input, place + " is not JSON");
  return sim::settings_from_json(settings, place).limits.force_max_n;
}

/// How deep the reaming is at moments that follow each other, by the bricks that the recording keeps.
class RecordedDepth {
 public:
  RecordedDepth(const record::Recording& recording, const voxel::BoneModel& start,
                const std::shared_ptr<const score::NativeGlenoid>& native)
      : bone_(recording, start.grid, start.coverage), now_(start) {
    if (native) gauge_.emplace(native);
  }

  float after(uint32_t ticks) {
    if (!gauge_) return unknown_depth_mm;
    bone_.seek(ticks, [this](const voxel::BrickImage& image) { now_.apply(image); });
    if (bone_.ticks() != measured_ticks_) {
      depth_mm_ = static_cast<float>(gauge_->measure({now_.grid(), now_.coverage().data()}));
      measured_ticks_ = bone_.ticks();
    }
    return depth_mm_;
  }

 private:
  record::RecordedBone bone_;
  voxel::Replica now_;
  std::optional<score::DepthGauge> gauge_;
  uint32_t measured_ticks_ = UINT32_MAX;
  float depth_mm_ = unknown_depth_mm;
};

/// Tells the messages while ticks pass.
class StreamWriter {
 public:
  StreamWriter(const record::Recording& recording, stream::HelloInfo hello, const TakeMessage& take)
      : recording_(recording), take_(take) {
    const shell::Tool tool = tool_of_segment(recording_, 0);
    hello.tool = tool.mesh;
    hello.tool_name = tool.name;
    take_(RecordedMessage::hello, 0, stream::hello_message(hello));
  }

  void show(uint32_t ticks, stream::TelemetrySample& sample) {
    change_tools_until(ticks);
    sample.state = SessionState::replaying;
    sample.playback = {.position_ticks = ticks};
    take_(RecordedMessage::telemetry, ticks, stream::telemetry_message({.samples = {sample}}, 0));
  }

 private:
  void change_tools_until(uint32_t ticks) {
    const auto& segments = recording_.segments();
    for (; segment_ + 1 < segments.size() && segments[segment_ + 1].first_tick < ticks; ++segment_) {
      if (same_reamer(segments[segment_], segments[segment_ + 1])) continue;
      const shell::Tool tool = tool_of_segment(recording_, segment_ + 1);
      take_(RecordedMessage::tool, segments[segment_ + 1].first_tick + 1,
            stream::tool_message(tool.mesh, tool.name));
    }
  }

  const record::Recording& recording_;
  const TakeMessage& take_;
  size_t segment_ = 0;
};

}  // namespace

stream::HelloInfo recorded_hello(const record::Recording& recording, const case_::Case& start) {
  const case_::Anatomy anatomy =
      recording.header().anatomy.empty() ? case_::Anatomy{} : anatomy_in(recording);
  stream::HelloInfo info = make_hello(start, *start.plan, {}, anatomy);
  info.force_scale = recording.header().force_scale;
  info.force_max_n = recorded_force_max_n(recording);
  info.duration_ticks = recording.tick_count();
  return info;
}

std::vector<ReplayMark> recorded_marks(const record::Recording& recording) {
  std::vector<ReplayMark> marks;
  for (const record::ops::Segment& segment : recording.segments())
    if (segment.first_tick > 0) marks.push_back({segment.first_tick * tick_s, segment.reason, segment.tool});
  for (const record::ops::Event& event : recording.events())
    marks.push_back({event.tick * tick_s, event.kind, event.words});
  for (const record::ops::Annotation& annotation : recording.annotations())
    marks.push_back({annotation.tick * tick_s, "annotation", annotation.words});
  std::stable_sort(marks.begin(), marks.end(), [](const auto& a, const auto& b) { return a.at_s < b.at_s; });
  return marks;
}

shell::Tool tool_of_segment(const record::Recording& recording, size_t segment) {
  if (segment >= recording.segments().size())
    throw Error(ErrorKind::invalid_input,
                recording.log().path().string() + " does not say which reamer was used");
  return tool_of(recorded_reamer(recording, recording.segments()[segment]));
}

bool same_reamer(const record::ops::Segment& first, const record::ops::Segment& second) {
  return first.tool == second.tool && first.tool_axis == second.tool_axis &&
         first.tool_file == second.tool_file;
}

void recorded_stream(const record::Recording& recording, const case_::Case& start,
                     const std::shared_ptr<const score::NativeGlenoid>& native, stream::HelloInfo hello,
                     uint32_t ticks, uint32_t interval_ticks, const TakeMessage& take,
                     const Progress& progress) {
  hello.duration_ticks = ticks;
  StreamWriter writer(recording, std::move(hello), take);
  score::MetricsAccumulator metrics(start.bone.grid.voxel_volume_mm3(),
                                    sim::world_from_plan(plan_of(start)).inverse());
  RecordedDepth depth(recording, start.bone, native);
  stream::TelemetrySample sample;
  const auto show = [&](uint32_t passed) {
    sample.depth_mm = depth.after(passed);
    sample.removed_volume_mm3 = static_cast<float>(metrics.removed_volume_mm3());
    writer.show(passed, sample);
    progress(static_cast<double>(passed) / std::max(ticks, 1u), "writing the course");
  };
  recording.for_each_tick(0, ticks, [&](const record::ops::Tick& tick) {
    const record::TickReport report = record::report_of(tick, start.bone.grid.world_from_grid);
    if (tick.tick == 0) {
      // Before the first tick: where it is going to begin, without force.
      sample.world_from_tool = report.world_from_tool;
      sample.world_from_handle = report.world_from_handle;
      show(0);
    }
    metrics.add(report);
    const uint32_t passed = tick.tick + 1;
    if (passed % interval_ticks != 0 && passed != ticks) return;
    update_sample(report, sample);
    show(passed);
  });
}

}  // namespace ream::session
