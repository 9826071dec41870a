#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "device/haptic_device.hpp"
#include "device/scapula_mount.hpp"

namespace ream::device {

/// Plan frame: origin at the planned entry point, z along the planned axis into the bone. Scripts speak in it
/// so that one script serves every case, left and right.
struct TimedPose {
  double t_s = 0.0;
  Vec3 position_mm = Vec3::Zero();
  Vec3 rotation_vector_rad = Vec3::Zero();  ///< handle relative to the plan frame
};

struct TimedForce {
  double t_s = 0.0;
  double force_n = 0.0;  ///< simulated newtons along the handle's z axis
};

struct TimedButtons {
  double t_s = 0.0;
  bool spindle = true;
  bool pause = false;
};

/// Simulated hand: a mass on a damped arm that pushes along its axis with a force profile. All of it in
/// simulated newtons, so that one script behaves alike at any force scale.
struct HandParameters {
  Vec3 start_mm = Vec3(0.0, 0.0, -10.0);  ///< plan frame
  Vec3 tilt_rad = Vec3::Zero();           ///< rotation vector of the axis it holds, plan frame
  std::vector<TimedForce> force_profile;
  double mass_kg = 1.0;
  double arm_damping_n_s_mm = 1.0;
  double guide_stiffness_n_mm = 20.0;  ///< how firmly the hand keeps to its line sideways
};

enum class ScriptKind { hand, poses };

/// Input of a headless run; see proto/script.schema.json.
struct Script {
  ScriptKind kind = ScriptKind::hand;
  double duration_s = 0.0;
  double force_scale = 1.0;     ///< simulated N per hand N
  double stiffness_n_mm = 0.0;  ///< of the coupling, hand side; 0: the device's own
  double spindle_rpm = 156.0;
  std::optional<ScapulaMount> mount;  ///< empty: the bone is held rigidly
  HandParameters hand;
  std::vector<TimedPose> poses;       ///< at least one for ScriptKind::poses, times ascending
  std::vector<TimedButtons> buttons;  ///< times ascending; before the first: spindle on, no pause
};

/// Unknown keys, wrong types, missing or non-ascending times: Error invalid_input naming file and key.
Script load_script(const std::filesystem::path& path);
/// `where` names the text's origin in error messages.
Script parse_script(const nlohmann::json& json, const std::string& where);

/// The script `demo` that always exists.
Script demo_script();

/// A device that plays `script`; `world_from_plan` puts it on a case. Time advances one tick a read.
std::unique_ptr<HapticDevice> make_scripted_device(const Script& script, const Pose& world_from_plan);

}  // namespace ream::device
