#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "case/case.hpp"
#include "device/script.hpp"
#include "shell/tool.hpp"
#include "sim/state.hpp"

namespace ream::app {

/// What somebody asked to be simulated.
struct RunRequest {
  std::string case_name = "demo";    ///< `demo`, an id in the data folder, or the path of a case folder
  std::string script_name = "demo";  ///< `demo` or the path of a script
  std::string backend = "auto";
  sim::RemovalLaw removal = sim::RemovalLaw::profile;
  std::string feed_model;  ///< empty: the script's
  std::string tool;        ///< empty: the plan's reamer
  std::optional<shell::ToolAxis> tool_axis;
  double tool_spacing_mm = 0.2;
  std::optional<double> force_scale;  ///< overrides the script's
  uint64_t random_seed = 1;
};

/// One case, one tool, one script, ready for the first tick. Everything in it stays where it is (the model
/// refers to the bone), so it is made once and neither copied nor moved.
class Rig {
 public:
  /// Errors: not_found and invalid_input of case, script and tool; conflict when the case has no plan;
  /// unavailable for the backend. `data` is where cases are looked up; the demo case is made there on first
  /// use.
  Rig(const RunRequest& request, const std::filesystem::path& data);
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  const RunRequest request;
  device::Script script;
  case_::Case bone_case;
  std::unique_ptr<device::HapticDevice> device;  ///< before the model, which needs its limits
  sim::Model model;
  sim::State state;

  /// What was simulated, by which build; the header of recordings and session.json.
  nlohmann::json description() const;
};

/// The case that a name means; see RunRequest::case_name.
case_::Case find_case(const std::string& name, const std::filesystem::path& data);

}  // namespace ream::app
