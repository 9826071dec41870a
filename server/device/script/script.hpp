#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "device/haptic_device.hpp"
#include "device/scapula_mount.hpp"
#include "force/spindle.hpp"

namespace ream::device {

/// What a script says about the reamer's vibration (force/vibration_settings.hpp says what it means).
struct ScriptVibration {
  std::string source = "synthesized";                               ///< synthesized, recording or off
  std::filesystem::path cortical_file, cancellous_file, idle_file;  ///< WAV or CSV, for recording
  double rate_hz = 0.0;           ///< of CSV files without times; 0: not said
  std::optional<double> n_per_g;  ///< hand newtons per g; empty: the device's handle shakes as the drill does

  /// Files as they are found from `folder`, where the script lies.
  void resolve(const std::filesystem::path& folder);
};

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
  DriveControls drive{};
};

/// How the hand turns under torque, about the orientation that it holds.
struct Wrist {
  double stiffness_n_mm_rad = 5000.0;
  double damping_n_mm_s_rad = 200.0;
  double inertia_kg_mm2 = 10000.0;  ///< of hand and drill
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
  double arm_stiffness_n_mm = 0.0;     ///< pulls the hand back along its line to where it began
  double tremor_rms_n = 0.0;           ///< noise of 8 to 12 Hz on the push, each of three directions
  /// The hand corrects its push by this share of what it meant to push less what it felt `reaction_time_s`
  /// ago.
  double correction_gain = 0.0;
  double reaction_time_s = 0.2;
  std::optional<Wrist> wrist;        ///< empty: the hand holds its orientation whatever it feels
  double grip_stiffness_n_mm = 5.0;  ///< between hand and handle, on admittance devices
  double grip_damping_n_s_mm = 0.1;
};

/// Robot of the experiments (thesis 5.1): drives until it touches, presses with a force that rises linearly
/// and stays, and withdraws when the tool has advanced by `depth_mm` since it touched. Simulated newtons.
struct RobotParameters {
  Vec3 start_mm = Vec3(0.0, 0.0, -5.0);  ///< plan frame
  Vec3 tilt_rad = Vec3::Zero();          ///< rotation vector of its line, plan frame
  double approach_mm_s = 2.0;            ///< in the air, there and back
  double force_n = 52.0;
  double ramp_s = 2.0;
  double depth_mm = 2.0;
  double line_stiffness_n_mm = 20.0;  ///< of its arm, across its line: a light, compliant one
};

enum class ScriptKind {
  hand,
  poses,
  robot,
  remote,  ///< somebody else holds the device; the script only says how the session is set up
};

/// Input of a headless run; see proto/script.schema.json.
struct Script {
  ScriptKind kind = ScriptKind::hand;
  double duration_s = 0.0;
  double force_scale = 1.0;     ///< simulated N per hand N
  double stiffness_n_mm = 0.0;  ///< of the coupling, hand side; 0: the device's own
  /// Whose limits the hand feels through; device/profiles.hpp. Empty, of remote ones only: the device's
  /// usual.
  std::string device_profile = "ideal";
  double spindle_rpm = 156.0;
  std::string feed_model = "edge";                    ///< one of force::feed_models()
  double specimen_factor = 1.0;                       ///< feed of this specimen over the feed law's
  std::optional<force::CuttingCoefficients> cutting;  ///< empty: the case's
  /// Empty: the spindle turns as it is asked to, whatever holds it.
  std::optional<force::SpindleSettings> drive = force::SpindleSettings{};
  ScriptVibration vibration;
  std::optional<ScapulaMount> mount;  ///< empty: the bone is held rigidly
  HandParameters hand;
  RobotParameters robot;
  std::vector<TimedPose> poses;       ///< at least one for ScriptKind::poses, times ascending
  std::vector<TimedButtons> buttons;  ///< times ascending; before the first: spindle on, no pause
};

/// Unknown keys, wrong types, missing or non-ascending times: Error invalid_input naming file and key.
Script load_script(const std::filesystem::path& path);
/// `where` names the text's origin in error messages.
Script parse_script(const nlohmann::json& json, const std::string& where);

/// The script `demo` that always exists.
Script demo_script();

/// The script `practice` that always exists: for somebody with a device of their own, without an end. Force
/// scale and profile are the device's (fit_to_remote).
Script practice_script();

/// Fits a script to a remote device: `profile`, no more stiffness than that renders, and where the script
/// leaves it open (0) the least whole force scale at which 80 simulated N are not too much for it.
/// Error invalid_input for an unknown profile.
void fit_to_remote(const std::string& profile, Script& script);

/// Linear between neighbours, constant before the first and after the last entry.
double force_at(const std::vector<TimedForce>& profile, double t_s) noexcept;
TimedPose pose_at(const std::vector<TimedPose>& poses, double t_s) noexcept;
/// The last entry that has begun; spindle on and no pause before the first.
TimedButtons buttons_at(const std::vector<TimedButtons>& buttons, double t_s) noexcept;

}  // namespace ream::device
