#include "sim/state.hpp"

namespace ream::sim {

State::State(const Model& model, voxel::BoneModel& bone_in, const CarriedOn& from)
    : bone(bone_in),
      cells(bone_in),
      backend(make_backend(model, bone_in, cells)),
      reserve(backend.name == "cpu" ? Backend{} : make_cpp_backend(model, bone_in, cells)),
      schedule(model.profile, bone_in),
      tick(from.tick),
      output(model.settings.start_up_ramp_s),
      vibration(model.vibration, model.settings.random_seed),
      world_from_grid(bone_in.grid.world_from_grid),
      session_hash(from.session_hash) {}

}  // namespace ream::sim
