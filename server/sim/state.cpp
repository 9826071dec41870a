#include "sim/state.hpp"

#include "core/error.hpp"

namespace ream::sim {

State::State(const Model& model, voxel::BoneModel& bone_in)
    : bone(bone_in),
      schedule(model.profile, bone_in),
      changed(bone_in.grid.brick_count()),
      empty(bone_in.grid.brick_count()) {
  narrow_phase = collide::make_narrow_phase_cpu({model.contact_shell, bone, model.distance});
  removal = collide::make_removal_cpu({model.profile, bone});
}

}  // namespace ream::sim
