#include "sim/backend.hpp"

#include "collide/decay_cl.hpp"
#include "collide/narrow_phase_cl.hpp"
#include "collide/removal_cl.hpp"
#include "core/error.hpp"
#include "sim/measured_backend.hpp"

namespace ream::sim {
namespace {

std::string in_words(const std::vector<BackendTiming>& timings) {
  std::string text = "measured";
  for (const BackendTiming& t : timings) {
    text += (&t == timings.data() ? " " : ", ") + t.name + ": ";
    text += t.failure.empty() ? std::to_string(static_cast<int>(t.p50_us)) + " us, slow ones " +
                                    std::to_string(static_cast<int>(t.slow_us)) + " us"
                              : t.failure;
  }
  return text;
}

}  // namespace

Backend make_cpp_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells) {
  Backend backend;
  backend.name = "cpu";
  backend.narrow_phase = collide::make_narrow_phase_cpu({model.contact_shell, bone, model.distance, cells});
  if (model.settings.removal == RemovalLaw::decay)
    backend.decay = collide::make_decay_cpu({model.decay_shell, bone, model.settings.decay_levels});
  else
    backend.removal = collide::make_removal_cpu({model.profile, bone});
  return backend;
}

Backend make_opencl_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells,
                            const gpu::Device& device) {
  const auto buffers = std::make_shared<collide::BoneBuffers>(device, bone);
  const auto shape = collide::LaunchShape::fitting(device);
  Backend backend;
  backend.name = "opencl: " + device.name;
  backend.narrow_phase =
      collide::make_narrow_phase_cl({model.contact_shell, bone, model.distance, cells}, buffers, shape);
  if (model.settings.removal == RemovalLaw::decay)
    backend.decay =
        collide::make_decay_cl({model.decay_shell, bone, model.settings.decay_levels}, buffers, shape);
  else
    backend.removal = collide::make_removal_cl({model.profile, bone}, buffers, shape);
  return backend;
}

Backend make_backend(const Model& model, voxel::BoneModel& bone, const voxel::SolidCells& cells) {
  const std::string& wish = model.settings.backend;
  if (wish == "cpu") return make_cpp_backend(model, bone, cells);
  if (wish == "auto") {
    std::vector<BackendTiming> timings;
    Backend backend = make_measured_backend(model, bone, cells, timings);
    backend.choice = in_words(timings);
    return backend;
  }
  if (!wish.starts_with("opencl"))
    throw Error(ErrorKind::usage, "backend '" + wish + "' is not known; use auto, cpu, opencl or opencl:N");
  return make_opencl_backend(model, bone, cells, gpu::choose_device(wish, gpu::Use::tick));
}

}  // namespace ream::sim
