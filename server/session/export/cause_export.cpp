#include "session/export/cause_export.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "collide/removal/removal_schedule.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "record/recorded_bone.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "shell/swept_profile.hpp"
#include "stream/surface_classes.hpp"
#include "twin/part_file.hpp"
#include "voxel/solid_cells.hpp"

namespace ream::session {
namespace {

/// A hash stands for as many ticks.
constexpr uint32_t ticks_of_part = 250;

/// More than people change reamers in a session; each costs a table.
constexpr size_t max_segments = 1000;

void require_twin(const record::Recording& recording, const voxel::VoxelGrid& grid) {
  const sim::Settings settings = recorded_settings(recording, "cpu");
  if (recording.segments().empty() || recording.segments().front().first_tick != 0)
    throw Error(ErrorKind::invalid_input,
                recording.log().path().string() + " does not say which reamer it begins with");
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
                 const voxel::VoxelGrid& grid, twin::PartFileWriter& file) {
  const shell::Tool tool = tool_of(recorded_reamer(recording, segment));
  const shell::SweptProfile profile =
      shell::swept_profile(tool.profile, collide::RemovalSchedule::needed_margin_mm(grid));
  if (!twin::fits_twin(profile))
    throw Error(ErrorKind::conflict,
                "the reamer '" + segment.tool + "' is too large or too fine to be computed in a browser");
  file.add(twin::segment_part(segment.first_tick, profile));
}

void add_ticks(const record::Recording& recording, uint32_t first, uint32_t last, twin::PartFileWriter& file,
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

/// Which voxels lie within `reach` voxels, along each axis, of one that `is` so. `outside`: whether what lies
/// beside the grid is.
template <typename Is>
std::vector<uint8_t> within_reach(const voxel::VoxelGrid& grid, int reach, bool outside, Is is) {
  std::vector<uint8_t> near(grid.voxel_count());
  for (size_t i = 0; i < near.size(); ++i) near[i] = is(i);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<uint8_t> before = near;
    for (int w = 0; w < grid.dims.z(); ++w)
      for (int v = 0; v < grid.dims.y(); ++v)
        for (int u = 0; u < grid.dims.x(); ++u) {
          Vec3i beside(u, v, w);
          const int at = beside[axis];
          uint8_t any = 0;
          for (int step = -reach; step <= reach; ++step) {
            beside[axis] = at + step;
            any |= beside[axis] >= 0 && beside[axis] < grid.dims[axis] ? before[grid.index(beside)]
                                                                       : static_cast<uint8_t>(outside);
          }
          near[grid.index(u, v, w)] = any;
        }
  }
  return near;
}

/// What pictures show of densities (stream::SurfaceClasses), where a surface can come by: the density of a
/// vertex is looked up less than two voxels from one that is gone. Each code is one that looks the same, so
/// that there are few.
std::vector<uint8_t> shown_density(const voxel::BoneModel& start, const record::RecordedBone& left) {
  const stream::SurfaceClasses classes(start);
  std::map<std::pair<voxel::BoneClass, std::vector<uint8_t>>, uint8_t> first_that_looks;
  std::array<uint8_t, 256> shown{};  // 0 stands for what is not told
  for (size_t i = 1; i < shown.size(); ++i) {
    const auto code = static_cast<uint8_t>(i);
    const std::pair looks(classes.class_of(code), stream::SurfaceClasses::packed_densities(std::array{code}));
    shown[code] = first_that_looks.try_emplace(looks, code).first->second;
  }
  std::vector<uint8_t> coverage = start.coverage;
  left.write_to(coverage);
  const auto near_gone =
      within_reach(start.grid, 2, true, [&](size_t i) { return coverage[i] < voxel::solid_coverage; });
  const auto near_bone = within_reach(start.grid, 2, false,
                                      [&](size_t i) { return start.coverage[i] >= voxel::solid_coverage; });
  std::vector<uint8_t> density(start.grid.voxel_count());
  for (size_t i = 0; i < density.size(); ++i)
    if (near_gone[i] != 0 && near_bone[i] != 0) density[i] = shown[std::max<uint8_t>(start.density[i], 1)];
  return density;
}

}  // namespace

uint32_t whole_ticks(const record::Recording& recording) {
  const auto checkpoint = recording.last_checkpoint();
  return checkpoint ? static_cast<uint32_t>(
                          std::min<uint64_t>(uint64_t{checkpoint->tick} + 1, recording.tick_count()))
                    : 0;
}

twin::Bytes causes_of(const record::Recording& recording, const case_::Case& start, CauseUse use,
                      const Progress& progress) {
  const voxel::BoneModel& bone = start.bone;
  require_twin(recording, bone.grid);
  const uint32_t ticks = whole_ticks(recording);
  progress(0.0, "reading the bone");
  if (ticks == 0) throw Error(ErrorKind::conflict, "the recording holds no bone to compare with");
  record::RecordedBone left(recording, bone.grid, bone.coverage);
  left.seek(ticks, [](const voxel::BrickImage&) {});
  twin::PartFileWriter file(twin::cause_file_magic, twin::cause_file_revision);
  file.add(twin::start_part(bone));
  if (use == CauseUse::pictures && !bone.density.empty())
    file.add(twin::density_part(shown_density(bone, left), bone.cortical_threshold_g_cc));
  const auto& segments = recording.segments();
  for (size_t i = 0; i < segments.size() && segments[i].first_tick < ticks; ++i) {
    const uint32_t end = i + 1 < segments.size() ? segments[i + 1].first_tick : ticks;
    progress(static_cast<double>(segments[i].first_tick) / ticks, "writing the reamer");
    add_segment(recording, segments[i], bone.grid, file);
    add_ticks(recording, segments[i].first_tick, std::min(end, ticks), file, progress);
  }
  file.add(twin::end_part(ticks, left.coverage_hash(), recording.tick_count()));
  return file.finish();
}

void write_causes(const ExportRequest& request, const std::filesystem::path& out, const Progress& progress) {
  progress(0.0, "reading the case");
  const record::Recording recording = recording_of(request);
  const case_::Case start = case_of(recording, request.case_name, request.data);
  write_file_atomically(out,
                        causes_of(recording, start, CauseUse::verification, part_of(progress, 0.2, 0.9)));
}

}  // namespace ream::session
