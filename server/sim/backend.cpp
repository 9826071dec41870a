#include "sim/backend.hpp"

#include "collide/decay_cl.hpp"
#include "collide/narrow_phase_cl.hpp"
#include "collide/removal_cl.hpp"
#include "core/error.hpp"
#include "gpu/device.hpp"

namespace ream::sim {

Backend make_cpp_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells) {
  Backend backend{
      "cpu", collide::make_narrow_phase_cpu({model.contact_shell, bone, model.distance, cells}), {}, {}};
  if (model.settings.removal == RemovalLaw::decay)
    backend.decay = collide::make_decay_cpu({model.decay_shell, bone, model.settings.decay_levels});
  else
    backend.removal = collide::make_removal_cpu({model.profile, bone});
  return backend;
}

Backend make_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells) {
  const std::string& wish = model.settings.backend;
  if (wish == "cpu" || wish == "auto") return make_cpp_backend(model, bone, cells);
  if (!wish.starts_with("opencl"))
    throw Error(ErrorKind::usage, "backend '" + wish + "' is not known; use auto, cpu, opencl or opencl:N");

  const gpu::Device device = gpu::choose_device(wish, gpu::Use::tick);
  const auto buffers = std::make_shared<collide::BoneBuffers>(device, bone);
  const auto shape = collide::LaunchShape::fitting(device);
  Backend backend{
      "opencl: " + device.name,
      collide::make_narrow_phase_cl({model.contact_shell, bone, model.distance, cells}, buffers, shape),
      {},
      {}};
  if (model.settings.removal == RemovalLaw::decay)
    backend.decay =
        collide::make_decay_cl({model.decay_shell, bone, model.settings.decay_levels}, buffers, shape);
  else
    backend.removal = collide::make_removal_cl({model.profile, bone}, buffers, shape);
  return backend;
}

}  // namespace ream::sim
