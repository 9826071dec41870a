#include "session/live/resume_point.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/log.hpp"
#include "device/registry/device_registry.hpp"
#include "record/log_sink.hpp"
#include "session/folder/recorded_annotations.hpp"
#include "session/folder/session_folder.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "session/simulation/session_setup.hpp"
#include "session/simulation/simulation.hpp"
#include "shell/parametric_profile.hpp"
#include "shell/reamer_library.hpp"

namespace ream::session {
namespace {

namespace fs = std::filesystem;

/// By words only: whoever asks over the network names no files of this machine.
Reamer reamer_of_words(const std::string& words) {
  if (!shell::is_parametric(words))
    throw Error(ErrorKind::invalid_input, "reamer \"" + words +
                                              "\" is not known; \"sphere R\" and \"ellipse A,B\" are, in "
                                              "mm, and the names " +
                                              shell::built_in_names());
  return reamer_asked_for(words, std::nullopt);
}

shell::Tool made(const Reamer& reamer) {
  try {
    return tool_of(reamer);
  } catch (const Error& e) {
    throw Error(ErrorKind::invalid_input, e.what());
  }
}

uint64_t last_session_hash(const record::Recording& recording) {
  const uint32_t count = recording.tick_count();
  return count == 0 ? 0 : recording.ticks(count - 1, count).back().session_hash;
}

FileLock lock_of_recorded(const fs::path& folder) {
  require_recording(folder);
  return locked(folder);
}

record::Recording undamaged(const fs::path& folder) {
  record::Recording recording(recording_file(folder), record::Recording::Trust::checked);
  require_undamaged(recording, folder);
  return recording;
}

}  // namespace

FileLock locked(const fs::path& folder) {
  if (auto lock = FileLock::attempt(lock_file(folder))) return std::move(*lock);
  throw Error(ErrorKind::conflict,
              "session '" + folder.filename().string() + "' is in use by another process");
}

void ResumePoint::cut_to_its_end() const {
  try {
    record::continue_log_file(recording_.log().path(), recording_.log().whole_bytes())->sync();
  } catch (const Error& e) {
    log::error(std::string("a recording that did not go on could not be put back: ") + e.what());
  }
}

ResumePoint::ResumePoint(const fs::path& folder, const fs::path& data)
    : data_(data),
      lock_(lock_of_recorded(folder)),
      recording_(undamaged(folder)),
      case_(case_of(recording_, {}, data)),
      start_coverage_(case_.bone.coverage),
      bone_(recording_, case_.bone.grid, start_coverage_),
      metrics_(accumulated(recording_)),
      state_(read_session_folder(folder).status.state) {
  bone_.seek(ticks(), [](const voxel::BrickImage&) {});
  if (bone_.ticks() != ticks())
    throw Error(ErrorKind::invalid_input,
                recording_.log().path().string() + " does not hold the bone of its end");
  bone_.write_to(case_.bone.coverage);
}

SimulationSetup ResumePoint::setup(const RunRequest& request, const std::string& reamer) {
  const record::ops::Segment& before = recording_.segments().back();
  const uint64_t session_hash = last_session_hash(recording_);
  SimulationSetup setup =
      recorded_setup(recording_, before, std::move(case_), {ticks(), session_hash}, request.backend);
  if (!reamer.empty() && reamer != before.tool) {
    setup.reamer = reamer_of_words(reamer);
    setup.tool = made(setup.reamer);
  }
  const case_::Case native = recorded_case(recording_, {}, data_);
  setup.anatomy = recorded_anatomy(recording_, native, {}, data_);
  setup.native = measured_glenoid(native, setup.anatomy, setup.tool);
  setup.request.script_name = request.script_name;
  setup.request.random_seed = recording_.header().random_seed;
  setup.script = find_script(request);
  setup.request.device = request.device;
  setup.request.device_profile = request.device_profile;
  device::settle_for_device(request.device, request.device_profile, setup.script);
  setup.script.force_scale = setup.settings.force_scale;
  device::MadeDevice made = device::make_device({request.device, request.device_profile, &setup.script,
                                                 sim::world_from_plan(plan_of(setup.bone_case)),
                                                 recording_.header().random_seed, data_});
  setup.device = std::move(made.device);
  setup.link = std::move(made.link);
  return setup;
}

}  // namespace ream::session
