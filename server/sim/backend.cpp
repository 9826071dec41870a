#include "sim/backend.hpp"

#include "collide/narrow_phase_cl.hpp"
#include "collide/removal_cl.hpp"
#include "core/error.hpp"
#include "gpu/device.hpp"

namespace ream::sim {

Backend make_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells) {
  const std::string& wish = model.settings.backend;
  const collide::NarrowPhaseInput contact{model.contact_shell, bone, model.distance, cells};
  const collide::RemovalInput removal{model.profile, bone};
  if (wish == "cpu" || wish == "auto")
    return {"cpu", collide::make_narrow_phase_cpu(contact), collide::make_removal_cpu(removal)};
  if (!wish.starts_with("opencl"))
    throw Error(ErrorKind::usage, "backend '" + wish + "' is not known; use auto, cpu, opencl or opencl:N");

  const gpu::Device device = gpu::choose_device(wish, gpu::Use::tick);
  const auto buffers = std::make_shared<collide::BoneBuffers>(device, bone);
  const auto shape = collide::LaunchShape::fitting(device);
  return {"opencl: " + device.name, collide::make_narrow_phase_cl(contact, buffers, shape),
          collide::make_removal_cl(removal, buffers, shape)};
}

}  // namespace ream::sim
