#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/cli/terminal_progress.hpp"
#include "app/open_database.hpp"
#include "app/plugin_option.hpp"
#include "core/clock.hpp"
#include "core/data_folder.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/interrupt.hpp"
#include "session/replay/review_recording.hpp"
#include "session/replay/verify_replay.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"

namespace ream::app {
namespace {

using nlohmann::json;

struct ReplayOptions {
  std::string recording, case_name;
  bool verify = false;
  std::string backend = "cpu";
  double until_s = -1.0;
  std::vector<std::filesystem::path> plugins;
};

uint32_t until_tick(const ReplayOptions& options) {
  return options.until_s < 0.0 ? UINT32_MAX : static_cast<uint32_t>(std::lround(options.until_s / tick_s));
}

/// How the session ended; one that nobody closed was interrupted.
std::string state_of(const record::Recording& recording) {
  return recording.end() ? recording.end()->state : "interrupted";
}

json difference_json(uint32_t tick, const record::Difference& difference) {
  return {{"tick", tick},
          {"kind", difference.kind},
          {"field", difference.field},
          {"recorded", difference.recorded},
          {"found", difference.found}};
}

/// What both kinds of replay say first.
json about(const record::Recording& recording, uint32_t ticks) {
  json answer = {{"recording", recording.log().path().string()},
                 {"case", recording.header().case_id},
                 {"build", recording.header().build},
                 {"state", state_of(recording)},
                 {"ticks", ticks},
                 {"duration_s", ticks * tick_s},
                 {"segments", recording.segments().size()}};
  if (!recording.log().damage().empty()) answer["damage"] = recording.log().damage();
  return answer;
}

void print(const json& answer, const GlobalOptions& global) {
  if (global.json) {
    std::cout << answer.dump() << '\n';
    return;
  }
  for (const auto& [key, value] : answer.items()) {
    if (value.is_array())
      for (const auto& line : value) std::cout << line.get<std::string>() << '\n';
    else
      std::cout << key << ": " << (value.is_string() ? value.get<std::string>() : value.dump()) << '\n';
  }
}

/// Exit code 1 and one line where the recording is not what it should be.
void end_with(uint32_t tick, const std::optional<record::Difference>& difference,
              const record::Recording& recording) {
  if (difference)
    throw Error(ErrorKind::invalid_input,
                recording.log().path().string() + ": " + session::difference_words(tick, *difference));
}

void review(const ReplayOptions& options, const GlobalOptions& global, const record::Recording& recording,
            case_::Case bone_case) {
  const auto native =
      session::glenoid_if_known(recording, bone_case, options.case_name, data_folder(global.data));
  const session::Review found =
      session::review_recording(recording, std::move(bone_case), native, until_tick(options));
  json answer = about(recording, found.ticks);
  answer["checkpoints"] = found.checkpoints;
  answer["removed_volume_mm3"] = found.removed_volume_mm3;
  answer["reaming_depth_mm"] = found.reaming_depth_mm ? json(*found.reaming_depth_mm) : json();
  answer["session_hash"] = to_hex(found.session_hash);
  answer["grid_hash"] = to_hex(found.grid_hash);
  if (found.grid_ticks != found.ticks) answer["grid_ticks"] = found.grid_ticks;
  if (found.difference && global.json)
    answer["difference"] = difference_json(found.difference_tick, *found.difference);
  if (!found.difference || global.json) print(answer, global);
  end_with(found.difference_tick, found.difference, recording);
}

void verify(const ReplayOptions& options, const GlobalOptions& global, const record::Recording& recording,
            case_::Case bone_case) {
  session::VerifyRequest request;
  request.backend = options.backend;
  request.until_tick = until_tick(options);
  const session::VerifyResult found = [&] {
    const TerminalProgress progress;
    request.progress = std::cref(progress);
    return session::verify_replay(recording, std::move(bone_case), request);
  }();
  json answer = about(recording, found.ticks);
  answer["verified"] = !found.difference && recording.log().damage().empty();
  answer["backend"] = found.backend;
  answer["session_hash"] = to_hex(found.session_hash);
  answer["grid_hash"] = to_hex(found.grid_hash);
  if (!found.left_out.empty()) answer["left_out"] = found.left_out;
  if (found.difference && global.json) answer["difference"] = difference_json(found.ticks, *found.difference);
  if (!found.difference || global.json) print(answer, global);
  end_with(found.ticks, found.difference, recording);
}

void replay(const ReplayOptions& options, const GlobalOptions& global) {
  catch_interrupts();
  const auto data = data_folder(global.data);
  note_reading(global.db, data, "session.replay", {options.recording});
  // All chunks are looked at first, so that what comes before damage is gone through to its end.
  const record::Recording recording(session::recording_path(options.recording, data),
                                    record::Recording::Trust::checked);
  case_::Case bone_case = session::recorded_case(recording, options.case_name, data);
  (options.verify ? verify : review)(options, global, recording, std::move(bone_case));
  if (const std::string& damage = recording.log().damage(); !damage.empty())
    throw Error(ErrorKind::invalid_input, damage);
}

}  // namespace

void add_replay_command(CLI::App& app, GlobalOptions& global) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command =
      app.add_subcommand("replay", "Go through a recording, or prove it by computing it again");
  command
      ->add_option("recording", options->recording,
                   "Id of a session of the data folder, a folder with recording.ream, or such a file")
      ->required();
  command->add_flag("--verify", options->verify,
                    "Compute every tick again from what the device sent, and stop at the first that differs");
  command->add_option("--backend", options->backend, "For --verify: auto, cpu, opencl or opencl:N")
      ->capture_default_str();
  command->add_option("--at", options->until_s, "Go no farther than this moment, in seconds")
      ->check(CLI::Range(0.0, 1.0e6));
  command->add_option("--case", options->case_name,
                      "Where the recorded case is, if not in the data folder: its id or folder");
  add_plugin_option(*command, options->plugins);
  command->callback([options, &global] {
    use_plugins(options->plugins);
    replay(*options, global);
  });
}

}  // namespace ream::app
