#pragma once
#include <nlohmann/json.hpp>

#include "core/file.hpp"
#include "record/recorder.hpp"
#include "session/live/headless_run.hpp"
#include "session/live/loop_rings.hpp"
#include "session/replay/verify_replay.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "session/simulation/recording_header.hpp"
#include "session/simulation/session_setup.hpp"
#include "sim/step.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_bone.hpp"

namespace ream::test {

/// A data folder with a slab of bone as the case `slab`, and recordings of reaming it.
class RecordedReaming {
 public:
  explicit RecordedReaming(const case_::Plan& plan = small_plan()) {
    case_::Case c;
    c.id = "slab";
    c.name = "Slab";
    c.bone = small_bone();
    c.plan = plan;
    case_::save_case(c, data() / "cases/slab");
  }

  static voxel::BoneModel small_bone() { return slab({64, 64, 64}, 0.2, 9.0, 0.5); }
  static case_::Plan small_plan() {
    case_::Plan plan = slab_plan(small_bone(), 9.0);
    plan.reamer = "sphere 8,5 nipple 1.5,2";
    plan.pilot_hole = case_::PilotHole{3.2, 3.0};
    return plan;
  }

  /// A hand that leans on the bone for `duration_s`, pauses and lets go of the spindle.
  static nlohmann::json push(const std::string& profile, double duration_s = 3.0) {
    using nlohmann::json;
    return {{"device", "hand"},
            {"device_profile", profile},
            {"duration_s", duration_s},
            {"force_scale", 10.0},
            {"vibration", {{"source", "off"}}},
            {"hand",
             {{"start_mm", {0.0, 0.0, -0.6}},
              {"tremor_rms_n", 2.0},
              {"force_profile", {{{"t_s", 0.0}, {"force_n", 45.0}}}}}},
            {"buttons",
             {{{"t_s", 0.1}, {"pause", true}},
              {{"t_s", 0.15}, {"pause", false}},
              {{"t_s", 0.95 * duration_s}, {"spindle", false}}}}};
  }

  session::RunRequest request(const nlohmann::json& script) const {
    write_file_atomically(folder_.path() / "script.json", script.dump());
    session::RunRequest request;
    request.case_name = "slab";
    request.script_name = (folder_.path() / "script.json").string();
    request.backend = "cpu";
    request.tool_spacing_mm = 0.25;
    return request;
  }

  /// Runs it to the end; its recording lies in the returned folder.
  std::filesystem::path record(session::Simulation& simulation) {
    const std::filesystem::path out = folder_.path() / ("run-" + std::to_string(runs_++));
    std::filesystem::create_directories(out);
    const std::vector<uint8_t> start = simulation.bone_case.bone.coverage;
    session::run_headless(simulation, start, out, false);
    return out / "recording.ream";
  }
  std::filesystem::path record(const nlohmann::json& script) {
    session::Simulation simulation(session::build_setup(request(script), data()));
    return record(simulation);
  }

  /// Goes on with a recording with the same script and another reamer (words, or a mesh file).
  void go_on(const std::filesystem::path& path, const nlohmann::json& script, const std::string& reamer) {
    const record::Recording recording(path);
    case_::Case bone_case = session::recorded_case(recording, "", data());
    case_::cut_pilot_hole(bone_case.bone, *bone_case.plan);
    const std::vector<uint8_t> start = bone_case.bone.coverage;
    record::RecordedBone bone(recording, bone_case.bone.grid, start);
    bone.seek(recording.tick_count(), [](const voxel::BrickImage&) {});
    bone.write_to(bone_case.bone.coverage);
    const uint32_t ticks = recording.tick_count();
    session::SimulationSetup parts = session::build_setup(request(script), data());
    parts.bone_case = std::move(bone_case);
    parts.reamer = session::reamer_asked_for(reamer, std::nullopt);
    parts.tool = shell::make_tool(reamer);
    parts.from = {ticks, recording.ticks(ticks - 1, ticks).at(0).session_hash};
    session::Simulation simulation(std::move(parts));
    record::Recorder recorder(record::continue_log_file(path, recording.log().whole_bytes()), recording, bone,
                              session::segment_of(simulation, ticks, "reamer"), start.data());
    run(simulation, recorder);
    recorder.finish("finished");
  }

  /// One tick after the other, with everything told to the recorder.
  static void run(session::Simulation& simulation, record::Recorder& recorder) {
    session::LoopRings rings(simulation.bone_case.bone.grid);
    simulation.state.brick_sender = &rings.sender;
    const auto take_brick = [&](const voxel::BrickImage& image) { recorder.add(image); };
    const auto take_report = [&](const record::TickReport& report) { recorder.add(report); };
    device::DeviceInput input;
    simulation.device->open();
    while (simulation.device->read(input) == device::DeviceStatus::ok) {
      record::TickReport report;
      if (sim::step(simulation.model, simulation.state, input, report) != sim::StepStatus::ok) break;
      simulation.device->write(sim::output_of(report));
      rings.reports.try_push(report);
      rings.drain(take_brick, take_report);
    }
    simulation.state.brick_sender = nullptr;
    rings.drain_rest(simulation.bone_case.bone, simulation.state.tick - 1, take_brick, take_report);
  }

  /// Computed again and compared with every checkpoint.
  session::VerifyResult verify(const std::filesystem::path& path, const std::string& backend = "cpu") const {
    const record::Recording recording(path);
    session::VerifyRequest request;
    request.backend = backend;
    request.ticks_between_grid_hashes = 0;
    return session::verify_replay(recording, session::recorded_case(recording, "", data()), request);
  }

  std::filesystem::path data() const { return folder_.path() / "data"; }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
  int runs_ = 0;
};

}  // namespace ream::test
