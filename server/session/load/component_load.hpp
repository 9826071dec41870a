#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "fe/materials.hpp"
#include "record/recording.hpp"
#include "session/load/seat_cells.hpp"

namespace ream::session {

/// How a component is loaded: by 750 N, the axial load of ASTM F2028, on its middle, and in four directions
/// half way to its rim, where it rocks.
struct ComponentLoadRequest {
  fe::ModulusLaw law = fe::default_density_law().law;
  solve::SeatMaterials materials;
  double force_n = 750.0;
  double cell_mm = 1.25;
  solve::SolverLimits limits{.tolerance = 1e-3, .min_piece_corners = 6};
  int threads = 2;
  size_t loads = 5;  ///< so many of them, in the order above
};

/// What one load does.
struct LoadedSeat {
  std::string name;               ///< "centre", "anterior", "posterior", "superior", "inferior"
  double carrying_percent = 0.0;  ///< of the component's back but for the pilot hole: pressed on bone
  double motion_um =
      0.0;  ///< between component and bone where it lifts off: 99 % of what is supported moves less
  double sinking_um = 0.0;  ///< of where it acts, along the component's axis
  /// Effective strain below which 99 % lies of the subchondral plate under the component, and of all bone
  /// within 3 mm of it; empty where there is none.
  std::optional<double> plate_strain, bone_strain;
  double overstrained_percent = 0.0;  ///< of that bone's volume, above 0.7 % (Pistoia 2002)
  int rounds = 0, iterations = 0;
  bool settled = false;
};

struct LoadedState {
  std::string name;  ///< of the SeatState
  /// Of the back but for the pilot hole: bone within Component::contact_mm of it, without load.
  double supported_percent = 0.0;
  /// Of that support, the most that a load lifts off.
  double support_lost_percent = 0.0;
  size_t elements = 0;
  std::vector<LoadedSeat> loads;
  /// Of each column of the box: the greatest effective strain of bone close below the component under any
  /// load; 0 elsewhere.
  std::vector<float> strain_map;

  /// The greatest of all loads.
  double motion_um() const;
  std::optional<double> plate_strain() const;
  double overstrained_percent() const;
};

struct ComponentLoad {
  ComponentLoadRequest request;
  std::vector<LoadedState> states;
  std::optional<SeatBox> box;
  bool settled() const;
  const LoadedState* state(std::string_view name) const;  ///< null when there is none
};

/// Errors: conflict where no component can be seated in any state; those of the solver.
ComponentLoad load_component(const score::NativeGlenoid& native, const voxel::BoneModel& bone,
                             const std::vector<SeatState>& states, const ComponentLoadRequest& request,
                             const Progress& progress = no_progress);

/// The same of a recorded session, and what it was computed of.
struct RecordedLoad {
  ComponentLoad load;
  std::shared_ptr<const score::NativeGlenoid> native;
  voxel::VoxelGrid grid;
  std::vector<uint8_t> left;  ///< coverage after the session

  /// Strain under the component as reamed, of each vertex of a surface (grid frame): so many
  /// report::strain_step, or score::deviation_unknown.
  std::vector<int8_t> strain_codes(std::span<const Vec3f> vertices_mm) const;
};

/// `case_name` as for recorded_case(). Errors: those of load_component(), of recordings and their cases.
RecordedLoad load_recorded(const record::Recording& recording, const std::string& case_name,
                           const std::filesystem::path& data, const ComponentLoadRequest& request,
                           const Progress& progress = no_progress);

nlohmann::json to_json(const ComponentLoad& load);

}  // namespace ream::session
