#include "sim/state.hpp"

namespace ream::sim {

State::State(const Model& model, voxel::BoneModel& bone_in)
    : bone(bone_in),
      cells(bone_in),
      backend(make_backend(model, bone_in, cells)),
      schedule(model.profile, bone_in),
      changed(bone_in.grid.brick_count()),
      empty(bone_in.grid.brick_count()) {}

}  // namespace ream::sim
