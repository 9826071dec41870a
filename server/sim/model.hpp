#pragma once
#include <memory>
#include <optional>
#include <string>

#include "case/case.hpp"
#include "collide/contact_shell.hpp"
#include "collide/decay.hpp"
#include "collide/narrow_phase.hpp"
#include "collide/removal_schedule.hpp"
#include "core/units.hpp"
#include "device/scapula_mount.hpp"
#include "force/coefficients.hpp"
#include "force/coupling.hpp"
#include "force/feed_model.hpp"
#include "force/guide.hpp"
#include "force/limits.hpp"
#include "force/vibration_tracks.hpp"
#include "force/virtual_mass.hpp"
#include "shell/point_shell.hpp"
#include "shell/swept_profile.hpp"
#include "shell/tool.hpp"
#include "sim/surface_place.hpp"

namespace ream::sim {

/// How bone is removed: by the distance to the swept cutting body, or as in the thesis' algorithm 4.1.
enum class RemovalLaw { profile, decay };

const char* to_text(RemovalLaw law);
/// The words of to_text; Error invalid_input for others.
RemovalLaw removal_law_from_text(const std::string& text);

/// How a session is to be simulated; everything that the same input needs to give the same bits.
struct Settings {
  std::string backend = "cpu";  ///< auto, cpu, opencl or opencl:N
  RemovalLaw removal = RemovalLaw::profile;
  int decay_levels = collide::default_decay_levels;  ///< see collide/decay.hpp
  double tool_spacing_mm = 0.2;
  double force_scale = 1.0;     ///< simulated N per hand N
  double stiffness_n_mm = 2.0;  ///< coupling, hand side
  double angular_stiffness_n_mm_rad = 2000.0;
  force::FeedSettings feed;
  force::VibrationSettings vibration;
  force::DeviceLimits limits;
  double start_up_ramp_s = 0.0;  ///< see force::StartUpRamp
  bool energy_guarded = true;    ///< see force::EnergyGuard
  /// Set for admittance devices; the coupling is then the mass' (force/virtual_mass.hpp).
  std::optional<force::VirtualMass> virtual_mass;
  std::optional<device::ScapulaMount> mount;  ///< empty: the bone is held rigidly
  uint64_t random_seed = 1;
};

/// Everything that does not change while reaming. Built before the first tick; const from then on.
struct Model {
  Settings settings;
  case_::Plan plan;
  Pose world_from_plan;  ///< plan frame: origin at the entry, z along the axis into the bone
  shell::Tool tool;
  shell::SweptProfile profile;
  collide::ContactShell contact_shell;
  collide::DecayShell decay_shell;  ///< empty unless bone is removed by decay
  voxel::BrickDistance distance;
  SurfacePlace surface_place;
  Aabb tool_box_tool;  ///< around probes and swept body
  std::unique_ptr<force::FeedModel> feed;
  std::shared_ptr<const force::VibrationTracks> vibration;  ///< empty: the reamer does not vibrate
  force::CouplingParameters coupling;
  std::optional<force::VirtualMass> virtual_mass;
  std::optional<force::Guide> guide;
  std::optional<device::ScapulaMount> mount;  ///< as simulated, see sim/scapula_mount.hpp
  double thin_step_mm =
      0.1;  ///< no point of the tool moves farther between two looks for contact (one voxel)
};

/// Prepares a planned case for a tool: cuts the pilot hole into `bone` and builds the rest. Errors: conflict
/// when the case has no plan or the guide does not fit, those of make_point_shell, swept_profile and
/// make_feed_model.
Model make_model(const case_::Plan& plan, voxel::BoneModel& bone, shell::Tool tool, const Settings& settings);

/// Plan frame of a plan, chosen the same way every time.
Pose world_from_plan(const case_::Plan& plan);

}  // namespace ream::sim
