#include "sim/state.hpp"

namespace ream::sim {

State::State(const Model& model, voxel::BoneModel& bone_in)
    : bone(bone_in),
      cells(bone_in),
      backend(make_backend(model, bone_in, cells)),
      reserve(backend.name == "cpu" ? Backend{} : make_cpp_backend(model, bone_in, cells)),
      schedule(model.profile, bone_in),
      output(model.settings.start_up_ramp_s),
      vibration(model.vibration, model.settings.random_seed),
      world_from_grid(bone_in.grid.world_from_grid) {}

}  // namespace ream::sim
