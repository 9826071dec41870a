#include <algorithm>
#include <vector>

#include "collide/removal/removal_schedule.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "record/recorded_bone.hpp"
#include "session/export/session_tables.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "shell/swept_profile.hpp"
#include "twin/cause_file.hpp"

namespace ream::session {
namespace {

/// A hash stands for as many ticks.
constexpr uint32_t ticks_of_part = 250;

/// More than people change reamers in a session; each costs a table.
constexpr size_t max_segments = 1000;

void require_twin(const record::Recording& recording, const voxel::VoxelGrid& grid) {
  const sim::Settings settings = recorded_settings(recording, "cpu");
  if (settings.removal == sim::RemovalLaw::decay)
    throw Error(ErrorKind::conflict,
                "the session removed bone by decay; only what the reamer's swept body "
                "removes can be computed again from causes");
  require_same_physics(recording, settings);
  if (!recording.log().damage().empty())
    throw Error(ErrorKind::conflict, "the recording is damaged: " + recording.log().damage());
  if (!twin::fits_twin(grid))
    throw Error(ErrorKind::conflict, "the session's case has more voxels than a browser can hold");
  if (recording.segments().size() > max_segments)
    throw Error(ErrorKind::conflict, "the session was resumed more than " + std::to_string(max_segments) +
                                         " times; that is not computed again in a browser");
}

void add_segment(const record::Recording& recording, const record::ops::Segment& segment,
                 const voxel::VoxelGrid& grid, twin::CauseFileWriter& file) {
  const shell::Tool tool = tool_of(recorded_reamer(recording, segment));
  const shell::SweptProfile profile =
      shell::swept_profile(tool.profile, collide::RemovalSchedule::needed_margin_mm(grid));
  if (!twin::fits_twin(profile))
    throw Error(ErrorKind::conflict,
                "the reamer '" + segment.tool + "' is too large or too fine to be computed in a browser");
  file.add(twin::segment_part(segment.first_tick, profile));
}

void add_ticks(const record::Recording& recording, uint32_t first, uint32_t last, twin::CauseFileWriter& file,
               const Progress& progress) {
  std::vector<twin::CauseTick> ticks;
  uint64_t hash = 0;
  uint32_t next = first;
  const auto flush = [&] {
    if (!ticks.empty()) file.add(twin::ticks_part(ticks, hash));
    ticks.clear();
  };
  const auto require = [&](uint32_t tick) {
    if (tick != next)
      throw Error(ErrorKind::invalid_input,
                  recording.log().path().string() + " lacks ticks from " + std::to_string(next) + " on");
  };
  recording.for_each_tick(first, last, [&](const record::ops::Tick& tick) {
    require(tick.tick);
    ++next;
    ticks.push_back({tick.tick, tick.flags, tick.grid_from_tool});
    hash = tick.session_hash;
    if (ticks.size() < ticks_of_part) return;
    flush();
    progress(static_cast<double>(tick.tick) / std::max(recording.tick_count(), 1u), "writing ticks");
  });
  require(last);
  flush();
}

/// Ticks up to which the recording keeps its bone whole: of a session that was killed, images of the bricks
/// that its last ticks changed are missing.
uint32_t whole_ticks(const record::Recording& recording) {
  const auto checkpoint = recording.last_checkpoint();
  return checkpoint ? static_cast<uint32_t>(
                          std::min<uint64_t>(uint64_t{checkpoint->tick} + 1, recording.tick_count()))
                    : 0;
}

}  // namespace

void write_causes(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress) {
  progress(0.0, "reading the case");
  const record::Recording recording = recording_of(request);
  const case_::Case bone_case = case_of(recording, request.case_name, request.data);
  const voxel::BoneModel& bone = bone_case.bone;
  require_twin(recording, bone.grid);
  twin::CauseFileWriter file;
  file.add(twin::start_part(bone));
  const uint32_t ticks = whole_ticks(recording);
  if (ticks == 0) throw Error(ErrorKind::conflict, "the recording holds no bone to compare with");
  const auto& segments = recording.segments();
  for (size_t i = 0; i < segments.size() && segments[i].first_tick < ticks; ++i) {
    const uint32_t end = i + 1 < segments.size() ? segments[i + 1].first_tick : ticks;
    progress(0.2, "writing the reamer");
    add_segment(recording, segments[i], bone.grid, file);
    add_ticks(recording, segments[i].first_tick, std::min(end, ticks), file, part_of(progress, 0.2, 0.9));
  }
  record::RecordedBone left(recording, bone.grid, bone.coverage);
  left.seek(ticks, [](const voxel::BrickImage&) {});
  file.add(twin::end_part(ticks, left.coverage_hash(), recording.tick_count()));
  write_file_atomically(out, file.finish());
}

}  // namespace ream::session
