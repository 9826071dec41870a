#pragma once
#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "fe/materials.hpp"
#include "score/component.hpp"
#include "solve/seated_component.hpp"

namespace ream::session {

/// The glenoid in one of the states that are compared, with a component on it.
struct SeatState {
  std::string name;          ///< "before", "planned", "reamed"
  const uint8_t* coverage;   ///< in the order of VoxelGrid::index; outlives this
  score::AchievedFace face;  ///< of bone, cartilage left out
  score::Component component;
  /// Bone that lies less deep on its ray is gone though `coverage` has it, mm; empty: none.
  std::vector<double> removed_to_mm;
};

/// Before: the untouched face without its cartilage, and with the pilot hole; planned: what the plan's reamer
/// leaves; reamed: what the session left. Those are missing in which no component can be seated, or which
/// nobody knows: `line` is the achieved axis, frame of the lattice. `start`: before tick 0, `left`:
/// afterwards.
std::vector<SeatState> seat_states(const score::NativeGlenoid& native, const voxel::VoxelGrid& grid,
                                   const uint8_t* start, const uint8_t* left,
                                   const std::optional<score::CutLine>& line);

/// The box of cells that all states have in common: cubes along the lattice of the rays, from in front of
/// every component to 25 mm behind the face, and 8 mm beyond the component all around.
struct SeatBox {
  static constexpr double behind_face_mm = 25.0, beyond_component_mm = 8.0;

  double cell_mm = 1.25;
  Vec3 corner_mm = Vec3::Zero();  ///< frame of the lattice
  Vec3i dims = Vec3i::Zero();

  /// Error usage where there would be too many cells.
  SeatBox(const score::NativeGlenoid& native, const std::vector<SeatState>& states, double cell_mm);

  size_t index(int x, int y, int z) const {
    return static_cast<size_t>(x) +
           static_cast<size_t>(dims.x()) *
               (static_cast<size_t>(y) + static_cast<size_t>(dims.y()) * static_cast<size_t>(z));
  }
  size_t columns() const { return static_cast<size_t>(dims.x()) * static_cast<size_t>(dims.y()); }
  /// Middle of a cell, frame of the lattice.
  Vec3 middle_mm(int x, int y, int z) const {
    return corner_mm + cell_mm * (Vec3(x, y, z) + Vec3::Constant(0.5));
  }
};

/// Whether a column lies over the pilot hole of the plan, or beside it within a millimetre: nothing carries
/// there.
bool is_over_pilot_hole(const score::NativeGlenoid& native, const SeatBox& box, int x, int y);

/// Which columns of the box lie under the component, those over the pilot hole, too.
std::vector<uint8_t> footprint_of(const score::NativeGlenoid& native, const score::Component& component,
                                  const SeatBox& box);

/// Bone and component in cells. Bone's modulus is that of its density; cartilage is none. Bone carries where
/// it lies within Component::contact_mm of the back.
solve::SeatedCells seat_cells(const score::NativeGlenoid& native, const voxel::BoneModel& bone,
                              const SeatState& state, const SeatBox& box, const fe::ModulusLaw& law);

}  // namespace ream::session
