#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "case/landmarks.hpp"
#include "device/haptic_device.hpp"
#include "device/network/remote_link.hpp"
#include "device/script/script.hpp"
#include "score/native_glenoid.hpp"
#include "session/simulation/reamer.hpp"
#include "sim/state.hpp"

namespace ream::session {

/// What somebody asked to be simulated.
struct RunRequest {
  std::string case_name = "demo";    ///< `demo`, an id in the data folder, or the path of a case folder
  std::string script_name = "demo";  ///< `demo`, `practice` or the path of a script
  std::optional<device::Script> script = std::nullopt;  ///< in place of the one of that name
  std::string backend = "auto";
  sim::RemovalLaw removal = sim::RemovalLaw::profile;
  std::string feed_model;  ///< empty: the script's
  std::string tool;        ///< empty: the plan's reamer
  std::optional<shell::ToolAxis> tool_axis;
  double tool_spacing_mm = 0.3;
  std::optional<double> force_scale;   ///< overrides the script's
  bool at_most_scripts_scale = false;  ///< more than the script's is refused
  uint64_t random_seed = 1;
  std::string device = "script";  ///< device/registry/device_registry.hpp
  std::string device_profile;     ///< empty: the script's
};

/// What a simulation is made of, each thing found, read and checked beforehand.
struct SimulationSetup {
  RunRequest request;
  device::Script script;
  case_::Case bone_case;   ///< with a plan; its coverage is what is left when the simulation begins
  uint64_t case_hash = 0;  ///< of the case as it was loaded
  case_::Anatomy anatomy;
  std::shared_ptr<const score::NativeGlenoid> native;  ///< may be null where nobody scores
  Reamer reamer;
  shell::Tool tool;  ///< made of it
  sim::Settings settings;
  std::unique_ptr<device::HapticDevice> device;  ///< may be null where somebody else steps the state
  std::shared_ptr<device::RemoteLink> link;      ///< of devices that connect over the network
  sim::ResumeState from;
};

/// One case, one tool, one device, ready for the first tick of a segment. Everything in it stays where it is
/// (the model refers to the bone), so it is made once and neither copied nor moved.
class Simulation {
 public:
  /// Errors: those of make_model; unavailable for the backend.
  explicit Simulation(SimulationSetup parts);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  const RunRequest request;
  device::Script script;
  case_::Case bone_case;
  const uint64_t case_hash;
  const case_::Anatomy anatomy;
  const std::shared_ptr<const score::NativeGlenoid> native;  ///< what is scored against; may be null
  const Reamer reamer;
  std::unique_ptr<device::HapticDevice> device;
  std::shared_ptr<device::RemoteLink> link;
  sim::Model model;
  sim::State state;

  /// What was simulated, by which build, for people. Of a simulation with a device, before its first tick.
  nlohmann::json description() const;
};

/// The plan of a case. Error conflict when it has none.
const case_::Plan& plan_of(const case_::Case& c);

}  // namespace ream::session
