// What `ream replay --verify --json` computes, in a program of just the rooms that take part in it, so that
// it can be built with sanitizers in a short time.
//   verify-recording FOLDER    a folder with recording.ream; the case is looked for in REAM_DATA
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/data_folder.hpp"
#include "core/hash.hpp"
#include "session/replay/verify_replay.hpp"
#include "session/simulation/recorded_setup.hpp"

int main(int argc, char** argv) {
  using namespace ream;
  if (argc != 2) {
    std::cerr << "usage: verify-recording FOLDER\n";
    return 2;
  }
  try {
    const record::Recording recording(std::filesystem::path(argv[1]) / "recording.ream",
                                      record::Recording::Trust::checked);
    case_::Case bone_case = case_::load_case(case_path(recording.header().case_id, {}));
    const session::VerifyResult found =
        session::verify_replay(recording, session::case_as_recorded(recording, std::move(bone_case)), {});
    nlohmann::json answer = {{"ticks", found.ticks},
                             {"verified", !found.difference},
                             {"session_hash", to_hex(found.session_hash)},
                             {"grid_hash", to_hex(found.grid_hash)}};
    if (!found.left_out.empty()) answer["left_out"] = found.left_out;
    std::cout << answer.dump() << '\n';
    return found.difference || !recording.log().damage().empty() ? 1 : 0;
  } catch (const std::exception& failure) {
    std::cerr << "verify-recording: " << failure.what() << '\n';
    return 1;
  }
}
