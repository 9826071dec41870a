#include "session/simulation/recorded_session.hpp"

#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "session/simulation/session_setup.hpp"
#include "sim/model.hpp"

namespace ream::session {
namespace fs = std::filesystem;

fs::path recording_path(const std::string& name, const fs::path& data) {
  std::error_code failed;
  const fs::path given(name);
  if (fs::is_regular_file(given, failed)) return given;
  if (fs::is_directory(given, failed)) {
    if (fs::is_regular_file(given / "recording.ream", failed)) return given / "recording.ream";
    throw Error(ErrorKind::not_found, "the folder " + name + " holds no recording.ream");
  }
  const fs::path kept = sessions_folder(data) / name / "recording.ream";
  if (name.find('/') == std::string::npos && fs::is_regular_file(kept, failed)) return kept;
  throw Error(ErrorKind::not_found, "no session '" + name + "' in " + sessions_folder(data).string() +
                                        ", and no such folder or file; `ream list sessions` lists them");
}

score::MetricsAccumulator accumulated(const record::Recording& recording, const Progress& progress) {
  const voxel::VoxelGrid grid = recording.grid();
  score::MetricsAccumulator metrics(grid.voxel_volume_mm3(),
                                    sim::world_from_plan(recorded_plan(recording)).inverse());
  constexpr uint32_t ticks_a_step = 10'000;
  recording.for_each_tick(0, UINT32_MAX, [&](const record::ops::Tick& tick) {
    if (tick.tick % ticks_a_step == 0)
      progress(static_cast<double>(tick.tick) / recording.tick_count(), "reading ticks");
    metrics.add(record::report_of(tick, grid.world_from_grid));
  });
  return metrics;
}

std::shared_ptr<const score::NativeGlenoid> recorded_glenoid(const record::Recording& recording,
                                                             const case_::Case& native,
                                                             const std::string& case_name,
                                                             const fs::path& data) {
  if (recording.segments().empty())
    throw Error(ErrorKind::invalid_input,
                recording.log().path().string() + " does not say which reamer was used");
  const case_::Anatomy anatomy = recorded_anatomy(recording, native, case_name, data);
  return measured_glenoid(native, anatomy, tool_of(recorded_reamer(recording, recording.segments().back())));
}

std::shared_ptr<const score::NativeGlenoid> glenoid_if_known(const record::Recording& recording,
                                                             const case_::Case& native,
                                                             const std::string& case_name,
                                                             const fs::path& data) {
  try {
    return recorded_glenoid(recording, native, case_name, data);
  } catch (const Error& e) {
    log::warn(std::string("nothing tells how deep the reaming is: ") + e.what());
    return nullptr;
  }
}

case_::Case case_of(const record::Recording& recording, const std::string& case_name, const fs::path& data) {
  return as_before_tick_0(recording, recorded_case(recording, case_name, data));
}

case_::Case as_before_tick_0(const record::Recording& recording, case_::Case native) {
  case_::cut_pilot_hole(native.bone, plan_of(native));
  if (native.bone.coverage_hash() != recording.header().start_grid_hash)
    throw Error(ErrorKind::conflict, "the bone of case '" + native.id + "' is not that of the recording");
  return native;
}

}  // namespace ream::session
