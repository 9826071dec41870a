#include "sim/backend.hpp"

#include "core/error.hpp"

namespace ream::sim {

Backend make_backend(const Model& model, voxel::BoneModel& bone) {
  const std::string& wish = model.settings.backend;
  const collide::NarrowPhaseInput contact{model.contact_shell, bone, model.distance};
  const collide::RemovalInput removal{model.profile, bone};
  if (wish == "cpu" || wish == "auto")
    return {"cpu", collide::make_narrow_phase_cpu(contact), collide::make_removal_cpu(removal)};
  throw Error(ErrorKind::usage, "backend '" + wish + "' is not known; use auto, cpu, opencl or opencl:N");
}

}  // namespace ream::sim
