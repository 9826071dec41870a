#include "collide/contact/contact_schedule.hpp"

namespace ream::collide {
namespace {

class NarrowPhaseCpu final : public NarrowPhase {
 public:
  NarrowPhaseCpu(const NarrowPhaseInput& input, Instructions instructions)
      : in_(input),
        functions_(instructions == Instructions::best ? best_contact_kernels() : portable_contact_kernels()),
        view_(contact_view(input)),
        schedule_(input),
        touched_(input.shell.chunk_count()) {}

  bool contact(const QuantisedPose& grid_from_tool, const Voi& voi, ContactSums& sums) noexcept override {
    sums = {};
    if (!voi.touching) return true;
    const VoxelTransform transform = voxel_transform(grid_from_tool, in_.bone.grid, in_.shell.place_unit_mm);
    view_.look_from(transform);
    const auto due = schedule_.due(grid_from_tool, voi, transform);
    functions_.look(view_, due, touched_.data(), sums);
    schedule_.visited(view_, functions_.is_clear, touched_);
    return true;
  }

 private:
  NarrowPhaseInput in_;
  ContactKernels functions_;
  ContactView view_;
  ContactSchedule schedule_;
  std::vector<uint8_t> touched_;  ///< per entry of the schedule's list
};

}  // namespace

std::unique_ptr<NarrowPhase> make_narrow_phase_cpu(const NarrowPhaseInput& input, Instructions instructions) {
  return std::make_unique<NarrowPhaseCpu>(input, instructions);
}

}  // namespace ream::collide
