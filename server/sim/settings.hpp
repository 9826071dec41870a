#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "collide/removal/decay.hpp"
#include "device/haptic_device.hpp"
#include "device/scapula_mount.hpp"
#include "force/coupling.hpp"
#include "force/feed_model.hpp"
#include "force/heat.hpp"
#include "force/spindle.hpp"
#include "force/vibration/vibration_tracks.hpp"
#include "force/wrench.hpp"

namespace ream::sim {

/// How bone is removed: by the distance to the swept cutting body, or as in the thesis' algorithm 4.1.
enum class RemovalLaw { profile, decay };

const char* to_text(RemovalLaw law);
/// The words of to_text; Error invalid_input for others.
RemovalLaw removal_law_from_text(const std::string& text);

/// What this build computes. Raised whenever the same input gives other bits. Recordings and scores name the
/// one that they were made with; those from before it was written are of revision 1. Since 2 contact begins
/// where the surfaces meet; since 3 the spindle is a drive with its own speed; since 4 bone lets a reamer go
/// that is drawn back, and friction goes by the radius of the engaged edge.
inline constexpr int physics_revision = 4;

/// How a session is to be simulated; everything that the same input needs to give the same bits.
struct Settings {
  int physics = physics_revision;
  std::string backend = "cpu";  ///< auto, cpu, opencl or opencl:N
  RemovalLaw removal = RemovalLaw::profile;
  int decay_levels = collide::default_decay_levels;  ///< see collide/decay.hpp
  double tool_spacing_mm = 0.2;
  double force_scale = 1.0;     ///< simulated N per hand N
  double stiffness_n_mm = 2.0;  ///< coupling, hand side
  double angular_stiffness_n_mm_rad = 2000.0;
  force::FeedSettings feed;
  std::optional<force::SpindleSettings> spindle;  ///< empty: it turns as it is asked to, whatever holds it
  force::VibrationSettings vibration;
  force::DeviceLimits limits;
  double start_up_ramp_s = 0.0;  ///< see force::StartUpRamp
  bool energy_guarded = true;    ///< see force::EnergyGuard
  /// Set for admittance devices; the coupling is then the mass' (force/virtual_mass.hpp).
  std::optional<force::VirtualMass> virtual_mass;
  std::optional<device::ScapulaMount> mount;  ///< empty: the bone is held rigidly
  force::HeatSettings heat;
  uint64_t random_seed = 1;
};

/// Settings as recordings keep them: all that the same input needs to give the same bits, so not the backend.
/// Numbers keep every bit.
nlohmann::json to_json(const Settings& settings);

/// What to_json wrote; `backend` is left at "cpu". A key that is missing keeps its default, so that
/// recordings from before a setting existed can be read: the default of a new setting is what was done before
/// it. Error invalid_input naming `place` and the key for one that is unknown (of a newer build) or of
/// another type.
Settings settings_from_json(const nlohmann::json& json, const std::string& place);

/// Fits settings to the device that renders them: coupling of `stiffness_n_mm` (hand side; 0: the most the
/// device renders), the device's largest force and torque and their slew, its start-up ramp, how it
/// shakes its handle as the drill shakes, and how much it may, and for an admittance device its virtual mass.
void fit_to_device(const device::DeviceTraits& traits, double stiffness_n_mm, Settings& settings);

}  // namespace ream::sim
