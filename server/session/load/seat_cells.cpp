#include "session/load/seat_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "score/alignment.hpp"
#include "score/component_library.hpp"
#include "score/planned_face.hpp"

namespace ream::session {
namespace {

using score::AchievedFace;
using score::Component;
using score::CutLine;
using score::no_surface_mm;

/// Points of a cell along each axis at which bone is looked up.
constexpr int points = 3;
/// Of a box; some gigabytes of memory are needed then.
constexpr double max_cells = 4e6;

/// Depth of bone where cartilage may lie on it.
AchievedFace of_bone(const score::NativeGlenoid& native, AchievedFace face) {
  for (size_t ray = 0; ray < face.surface_mm.size(); ++ray)
    if (face.surface_mm[ray] != no_surface_mm)
      face.surface_mm[ray] = std::max(face.surface_mm[ray], native.subchondral_mm()[ray]);
  return face;
}

AchievedFace untouched(const score::NativeGlenoid& native) {
  AchievedFace face;
  face.surface_mm = native.subchondral_mm();
  face.removed_mm.assign(face.surface_mm.size(), 0.0);
  return face;
}

/// Least depth of a component; its rim comes forward where it is tilted.
double front_of(const Component& component, double thickness_mm) {
  const double rim_mm = component.outline_radius_mm();
  return component.apex_mm().z() - component.back().behind_mm(rim_mm) - thickness_mm -
         rim_mm * component.axis().head<2>().norm();
}

double thickness_of(const score::NativeGlenoid& native) {
  return score::component_of(native.task().plan).thickness_mm;
}

bool in_pilot_hole(const score::NativeGlenoid& native, double x_mm, double y_mm) {
  const auto& plan = native.task().plan;
  return plan && plan->pilot_hole && std::hypot(x_mm, y_mm) < 0.5 * plan->pilot_hole->diameter_mm + 1.0;
}

/// A point against a component: how deep along its axis from its apex, and how far from the axis.
struct AlongAxis {
  double depth_mm, radius_mm;
  Vec3 outwards;

  AlongAxis(const Component& component, const Vec3& point_mm) {
    const Vec3 offset = point_mm - component.apex_mm();
    depth_mm = offset.dot(component.axis());
    const Vec3 across = offset - depth_mm * component.axis();
    radius_mm = across.norm();
    outwards = radius_mm > 1e-9 ? Vec3(across / radius_mm) : Vec3(Vec3::Zero());
  }
};

/// Share and modulus of the bone in cells.
class BoneSampler {
 public:
  BoneSampler(const score::NativeGlenoid& native, const voxel::BoneModel& bone, const SeatState& state,
              const fe::ModulusLaw& law)
      : native_(native), bone_(bone), state_(state), grid_from_world_(bone.grid.world_from_grid.inverse()) {
    for (int code = 0; code <= voxel::max_density_code; ++code)
      moduli_[static_cast<size_t>(code)] = std::max(0.0, law.modulus_mpa(code * voxel::density_step_g_cc));
  }

  /// Whether the case has voxels there.
  bool is_known(const Vec3& at_mm) const { return in_grid(voxel_at(at_mm)); }

  void sample(const SeatBox& box, int x, int y, int z, float& share, float& modulus) const {
    double covered = 0.0, stiffness = 0.0;
    const double step_mm = box.cell_mm / points;
    const Vec3 first = box.middle_mm(x, y, z) - Vec3::Constant(0.5 * (points - 1) * step_mm);
    for (int i = 0; i < points * points * points; ++i) {
      const Vec3i place(i % points, i / points % points, i / (points * points));
      const Vec3 at = first + step_mm * place.cast<double>();
      const double here = share_at(at, stiffness);
      covered += here;
    }
    share = static_cast<float>(covered / (points * points * points));
    modulus = covered > 0.0 ? static_cast<float>(stiffness / covered) : 0.0f;
  }

 private:
  bool in_grid(const Vec3i& voxel) const {
    return (voxel.array() >= 0).all() && (voxel.array() < bone_.grid.dims.array()).all();
  }
  Vec3i voxel_at(const Vec3& at_mm) const {
    const Vec3 place =
        grid_from_world_.point(native_.rays().world(at_mm)).cwiseQuotient(bone_.grid.spacing_mm);
    return place.array().floor().matrix().cast<int>();
  }
  /// Of the voxel there; adds its share of stiffness.
  double share_at(const Vec3& at_mm, double& stiffness) const {
    const voxel::VoxelGrid& grid = bone_.grid;
    const Vec3i voxel = voxel_at(at_mm);
    if (!in_grid(voxel)) return 0.0;
    const size_t i = grid.index(voxel.x(), voxel.y(), voxel.z());
    const uint8_t code = bone_.density[i];
    if (state_.coverage[i] == 0 || code > voxel::max_density_code || is_removed(at_mm)) return 0.0;
    const double share = state_.coverage[i] / 255.0;
    stiffness += share * moduli_[code];
    return share;
  }

  bool is_removed(const Vec3& at_mm) const {
    if (state_.removed_to_mm.empty()) return false;
    const int ray = native_.rays().nearest(at_mm.x(), at_mm.y());
    return ray >= 0 && at_mm.z() < state_.removed_to_mm[static_cast<size_t>(ray)];
  }

  const score::NativeGlenoid& native_;
  const voxel::BoneModel& bone_;
  const SeatState& state_;
  Pose grid_from_world_;
  std::array<double, voxel::max_density_code + 1> moduli_{};
};

/// Bone goes on where the case's voxels end beside it.
uint8_t goes_on(const BoneSampler& sampler, const SeatBox& box, int x, int y, int z) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double way : {-1.0, 1.0})
      if (!sampler.is_known(box.middle_mm(x, y, z) + way * box.cell_mm * Vec3::Unit(axis))) return 1;
  return 0;
}

void put_component(const score::NativeGlenoid& native, const SeatState& state, const SeatBox& box,
                   solve::SeatedCells& cells) {
  const Component& component = state.component;
  const double thickness_mm = thickness_of(native);
  const std::vector<uint8_t> under = footprint_of(native, component, box);
  for (int y = 0; y < box.dims.y(); ++y)
    for (int x = 0; x < box.dims.x(); ++x) {
      const size_t column = box.index(x, y, 0);
      const Vec3 middle = box.middle_mm(x, y, 0);
      const double bone_mm = native.rays().between(state.face.surface_mm, middle.x(), middle.y());
      const AlongAxis on_bone(component, {middle.x(), middle.y(), bone_mm == no_surface_mm ? 0.0 : bone_mm});
      const double cosine = component.back().slope_cosine(on_bone.radius_mm);
      cells.normals[column] =
          (cosine * component.axis() + std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) * on_bone.outwards)
              .cast<float>();
      if (under[column] == 0) continue;
      const double gap_mm = (on_bone.depth_mm + component.back().behind_mm(on_bone.radius_mm)) * cosine;
      const bool carries = bone_mm != no_surface_mm && gap_mm <= Component::contact_mm;
      cells.supported[column] = carries && !in_pilot_hole(native, middle.x(), middle.y()) ? 1 : 0;
      for (int z = 0; z < box.dims.z(); ++z) {
        const AlongAxis at(component, box.middle_mm(x, y, z));
        const double behind_mm = -component.back().behind_mm(at.radius_mm);
        cells.component[box.index(x, y, z)] =
            at.depth_mm <= behind_mm && at.depth_mm >= behind_mm - thickness_mm ? 1 : 0;
      }
    }
}

}  // namespace

std::vector<SeatState> seat_states(const score::NativeGlenoid& native, const voxel::VoxelGrid& grid,
                                   const uint8_t* start, const uint8_t* left,
                                   const std::optional<score::CutLine>& line) {
  std::vector<SeatState> states;
  const auto add = [&](const char* name, const uint8_t* coverage, AchievedFace face, const CutLine& along,
                       std::vector<double> removed_to_mm) {
    Component component(native, face, along);
    if (!component.seated()) return;
    states.push_back({name, coverage, std::move(face), std::move(component), std::move(removed_to_mm)});
  };
  if (const auto contact = score::first_contact_mm(native)) {
    CutLine planned;
    planned.apex_mm.z() = planned.deepest_mm = *contact;
    add("before", start, untouched(native), planned, {});
  }
  if (const auto cut = score::planned_cut(native)) {
    std::vector<double> removed_to_mm = cut->face.surface_mm;
    for (size_t ray = 0; ray < removed_to_mm.size(); ++ray)
      if (!(cut->face.removed_mm[ray] > 0.0)) removed_to_mm[ray] = -no_surface_mm;
    add("planned", start, of_bone(native, cut->face), cut->line, std::move(removed_to_mm));
  }
  if (line) add("reamed", left, of_bone(native, score::achieved_face(native, {grid, left})), *line, {});
  return states;
}

SeatBox::SeatBox(const score::NativeGlenoid& native, const std::vector<SeatState>& states, double cell)
    : cell_mm(cell) {
  double front_mm = no_surface_mm, face_mm = -no_surface_mm, reach_mm = 0.0;
  for (const SeatState& state : states) {
    front_mm = std::min(front_mm, front_of(state.component, thickness_of(native)));
    face_mm = std::max(face_mm, state.component.apex_mm().z());
    reach_mm =
        std::max(reach_mm, state.component.apex_mm().head<2>().norm() + state.component.outline_radius_mm());
  }
  const int half = static_cast<int>(std::ceil((reach_mm + beyond_component_mm) / cell_mm));
  dims = {2 * half, 2 * half,
          static_cast<int>(std::ceil((face_mm + behind_face_mm - front_mm) / cell_mm)) + 3};
  if (dims.cast<double>().prod() > max_cells)
    throw Error(ErrorKind::usage,
                "the bone under the component would be more than 4 million cells; give a larger "
                "--cell-mm");
  corner_mm = {-half * cell_mm, -half * cell_mm, front_mm - 2.0 * cell_mm};
}

bool is_over_pilot_hole(const score::NativeGlenoid& native, const SeatBox& box, int x, int y) {
  const Vec3 middle = box.middle_mm(x, y, 0);
  return in_pilot_hole(native, middle.x(), middle.y());
}

std::vector<uint8_t> footprint_of(const score::NativeGlenoid& native, const score::Component& component,
                                  const SeatBox& box) {
  std::vector<uint8_t> of_ray(native.rays().size(), 0), under(box.columns(), 0);
  for (const size_t ray : component.footprint()) of_ray[ray] = 1;
  for (int y = 0; y < box.dims.y(); ++y)
    for (int x = 0; x < box.dims.x(); ++x) {
      const Vec3 middle = box.middle_mm(x, y, 0);
      const int ray = native.rays().nearest(middle.x(), middle.y());
      under[box.index(x, y, 0)] =
          (ray >= 0 && of_ray[static_cast<size_t>(ray)]) || in_pilot_hole(native, middle.x(), middle.y());
    }
  return under;
}

solve::SeatedCells seat_cells(const score::NativeGlenoid& native, const voxel::BoneModel& bone,
                              const SeatState& state, const SeatBox& box, const fe::ModulusLaw& law) {
  solve::SeatedCells cells;
  cells.dims = box.dims;
  cells.cell_mm = box.cell_mm;
  cells.axis = state.component.axis();
  const size_t count = box.columns() * static_cast<size_t>(box.dims.z());
  cells.bone_share.resize(count);
  cells.bone_mpa.resize(count);
  cells.component.assign(count, 0);
  cells.held.assign(count, 0);
  cells.supported.assign(box.columns(), 0);
  cells.normals.assign(box.columns(), Vec3f::UnitZ());
  const BoneSampler sampler(native, bone, state, law);
  for (int z = 0; z < box.dims.z(); ++z)
    for (int y = 0; y < box.dims.y(); ++y)
      for (int x = 0; x < box.dims.x(); ++x) {
        const size_t cell = box.index(x, y, z);
        sampler.sample(box, x, y, z, cells.bone_share[cell], cells.bone_mpa[cell]);
        if (cells.bone_share[cell] > 0.0f) cells.held[cell] = goes_on(sampler, box, x, y, z);
      }
  put_component(native, state, box, cells);
  return cells;
}

}  // namespace ream::session
