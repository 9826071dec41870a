#include "sim/state.hpp"

namespace ream::sim {

Moment::Moment(const Model& model, const voxel::BoneModel& bone, const ResumeState& from)
    : schedule(model.profile, bone),
      tick(from.tick),
      spindle(model.settings.spindle),
      output(model.settings.start_up_ramp_s),
      vibration(model.vibration, model.settings.random_seed),
      world_from_grid(bone.grid.world_from_grid),
      session_hash(from.session_hash) {}

State::State(const Model& model, voxel::BoneModel& bone_in, const ResumeState& from)
    : State(model, bone_in, Moment(model, bone_in, from)) {}

State::State(const Model& model, voxel::BoneModel& bone_in, const Moment& from)
    : Moment(from),
      bone(bone_in),
      cells(bone_in),
      backend(make_backend(model, bone_in, cells)),
      reserve(backend.name == "cpu" ? Backend{} : make_cpp_backend(model, bone_in, cells)) {}

bool fail_over(State& state) noexcept {
  if (state.failed_over_tick >= 0 || state.reserve.narrow_phase == nullptr) return false;
  std::swap(state.backend, state.reserve);
  state.failed_over_tick = state.tick - 1;  // the step has counted its tick already
  return true;
}

}  // namespace ream::sim
