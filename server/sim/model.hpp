#pragma once
#include <memory>
#include <optional>

#include "case/case.hpp"
#include "collide/contact/contact_shell.hpp"
#include "collide/contact/narrow_phase.hpp"
#include "collide/removal/removal_schedule.hpp"
#include "core/units.hpp"
#include "force/guide.hpp"
#include "shell/point_shell.hpp"
#include "shell/swept_profile.hpp"
#include "sim/cutting_surface.hpp"
#include "sim/settings.hpp"

namespace ream::sim {

/// Everything that does not change while reaming. Built before the first tick; const from then on.
struct Model {
  Settings settings;
  case_::Plan plan;
  Pose world_from_plan;  ///< plan frame: origin at the entry, z along the axis into the bone
  shell::Tool tool;
  shell::SweptProfile profile;
  collide::ContactShell contact_shell;
  collide::ResistanceTable resistances{};  ///< force::edge_resistances
  collide::DecayShell decay_shell;         ///< empty unless bone is removed by decay
  voxel::BrickDistance distance;
  SurfacePlace surface_place;
  Aabb tool_box_tool;  ///< around probes and swept body
  std::unique_ptr<force::FeedModel> feed;
  std::shared_ptr<const force::VibrationTracks> vibration;     ///< empty: the reamer does not vibrate
  std::array<double, 3> vibration_of_specimen{1.0, 1.0, 1.0};  ///< see force::specimen_vibration
  force::CouplingParameters coupling;
  std::optional<force::VirtualMass> virtual_mass;
  std::optional<force::Guide> guide;
  std::optional<device::ScapulaMount> mount;  ///< as simulated, see sim/scapula_mount.hpp
  double thin_step_mm =
      0.1;  ///< no point of the tool moves farther between two looks for contact (one voxel)
  /// As near as bone must be to a point of the tool to be felt by it, at most.
  double contact_reach_mm = 0.2;
};

/// Prepares a planned case for a tool: cuts the pilot hole into `bone` and builds the rest. Errors: conflict
/// when the case has no plan or the guide does not fit, those of make_point_shell, swept_profile and
/// make_feed_model.
Model make_model(const case_::Plan& plan, voxel::BoneModel& bone, shell::Tool tool, const Settings& settings);

/// Plan frame of a plan, chosen the same way every time.
Pose world_from_plan(const case_::Plan& plan);

}  // namespace ream::sim
