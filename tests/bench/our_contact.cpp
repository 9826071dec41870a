#include "bench/our_contact.hpp"

#include "collide/contact/narrow_phase_cl.hpp"
#include "core/error.hpp"
#include "core/process_memory.hpp"

namespace ream::bench {

OurBone::OurBone(voxel::BoneModel model)
    : bone(std::move(model)), distance(voxel::brick_distance(bone)), cells(bone) {
  prefer_huge_pages(bone.coverage.data(), bone.coverage.size());
  prefer_huge_pages(bone.density.data(), bone.density.size());
}

OurContact::OurContact(OurBone& bone, const shell::PointShell& shell, double probe_length_mm)
    : bone_(bone),
      shell_(collide::make_contact_shell(
          shell, probe_length_mm > 0.0 ? probe_length_mm : bone.bone.grid.spacing_mm.maxCoeff())) {}

collide::NarrowPhaseInput OurContact::input() const {
  return {shell_, bone_.bone, bone_.distance, bone_.cells};
}

Contender OurContact::contender(const std::string& name, std::shared_ptr<collide::NarrowPhase> phase,
                                bool use_voi) const {
  const double reach_mm = bone_.bone.grid.min_spacing_mm();
  const auto contact = [this, name, phase, use_voi, reach_mm](const QuantisedPose& grid_from_tool) {
    const collide::Voi voi = use_voi ? collide::broad_phase(bone_.cells.bounds_mm(), shell_.bounds_mm,
                                                            dequantised(grid_from_tool), reach_mm)
                                     : collide::Voi{true, shell_.bounds_mm.grown(reach_mm)};
    collide::ContactSums sums;
    if (!phase->contact(grid_from_tool, voi, sums))
      throw Error(ErrorKind::unavailable, name + ": the device failed while contact was measured");
    return sums.engaged();
  };
  return {name, contact};
}

Contender OurContact::cpu(bool use_voi) const {
  return contender("ours, cpu", collide::make_narrow_phase_cpu(input()), use_voi);
}

Contender OurContact::opencl(const gpu::Device& device, bool use_voi) const {
  auto buffers = std::make_shared<collide::BoneBuffers>(device, bone_.bone);
  return contender(
      "ours, OpenCL",
      collide::make_narrow_phase_cl(input(), std::move(buffers), collide::LaunchShape::fitting(device)),
      use_voi);
}

}  // namespace ream::bench
