#include "session/export/reamed_bone.hpp"

#include <algorithm>

#include "score/alignment.hpp"
#include "score/component_library.hpp"
#include "score/deviation.hpp"
#include "score/wall_thickness.hpp"
#include "session/simulation/find_case.hpp"
#include "session/simulation/recorded_coverages.hpp"
#include "session/simulation/recorded_session.hpp"
#include "session/simulation/recorded_setup.hpp"
#include "session/simulation/simulation.hpp"
#include "sim/model.hpp"
#include "surface/removed_share.hpp"

namespace ream::session {
namespace {

constexpr int implant_segments = 96;

Aabb box_of_cut(const TriangleMesh& surface, const score::BoneStates& states) {
  const std::vector<uint8_t> cut = score::cut_vertices(surface.vertices_mm, states);
  Aabb box;
  for (size_t i = 0; i < cut.size(); ++i)
    if (cut[i]) box.include(surface.vertices_mm[i].cast<double>());
  return box.empty() ? box : box.grown(score::deviation_range_mm);
}

score::PlacedFront placed(score::SweptFront front, const score::Placement& at, const voxel::VoxelGrid& grid) {
  return {std::move(front), at.world_from_body().inverse() * grid.world_from_grid};
}

void compare(const score::NativeGlenoid& native_glenoid, const score::Placements& placements,
             const score::BoneStates& states, ComparedBone& compared) {
  const score::Task& task = native_glenoid.task();
  report::ReamedBone& bone = compared.bone;
  const double range_mm = 2.0 * score::deviation_range_mm;
  if (placements.achieved)
    bone.achieved = report::WorldAxis{placements.achieved->apex_mm, placements.achieved->axis};
  if (placements.planned) {
    const Aabb near_cut = box_of_cut(bone.after, states);
    const TriangleTree native(surface::whole_surface(states.grid, states.native), &near_cut);
    bone.from_plan = score::deviation_from_plan(
        bone.after.vertices_mm, states,
        placed({task.reamer, task.plan->depth_mm + range_mm}, *placements.planned, states.grid), native);
  }
  const score::CoverageView coverage{states.grid, states.left};
  const score::AchievedFace left = score::achieved_face(native_glenoid, coverage);
  const std::vector<double> wall = score::wall_thickness_mm(native_glenoid, left, coverage);
  if (std::any_of(wall.begin(), wall.end(), [](double mm) { return mm != score::no_surface_mm; }))
    bone.wall = score::wall_codes(native_glenoid, wall, left, states.grid, bone.after.vertices_mm);
  if (!placements.implant) return;
  const score::PlacedFront back =
      placed(score::implant_back(task, score::component_of(task.plan).thickness_mm), *placements.implant,
             states.grid);
  bone.from_implant = score::deviation_from_implant(bone.after.vertices_mm, states, back);
  score::keep_face_only(native_glenoid, left, states.grid, bone.after.vertices_mm, bone.from_implant);
  compared.implant =
      shell::revolve(back.front.profile(), implant_segments).transformed(back.front_from_grid.inverse());
}

}  // namespace

ComparedBone reamed_bone(const record::Recording& recording, const score::MetricsAccumulator& ticks,
                         const std::string& case_name, const std::filesystem::path& data) {
  case_::Case bone_case = recorded_case(recording, case_name, data);
  const auto native = recorded_glenoid(recording, bone_case, case_name, data);
  const Coverages coverages = coverages_of(recording, bone_case);
  const voxel::VoxelGrid& grid = bone_case.bone.grid;

  ComparedBone compared;
  report::ReamedBone& bone = compared.bone;
  bone.before = surface::whole_surface(grid, coverages.start.data());
  bone.after = surface::whole_surface(grid, coverages.left.data());
  bone.world_from_grid = grid.world_from_grid;
  bone.plan = *bone_case.plan;
  bone.side = bone_case.side;
  bone.glenoid = bone_case.glenoid;
  const score::BoneStates states{grid, coverages.native.data(), coverages.start.data(),
                                 coverages.left.data()};
  bone.removed = surface::removed_shares(bone.after.vertices_mm, grid, states.start, states.left);
  const score::Placements placements = score::placements_of(
      *native, {grid, coverages.left.data()}, ticks.cut_line(), sim::world_from_plan(*bone_case.plan));
  compare(*native, placements, states, compared);
  return compared;
}

}  // namespace ream::session
