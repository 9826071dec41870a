#include "collide/contact_schedule.hpp"

namespace ream::collide {
namespace {

class NarrowPhaseCpu final : public NarrowPhase {
 public:
  NarrowPhaseCpu(const NarrowPhaseInput& input, Instructions instructions)
      : in_(input),
        functions_(instructions == Instructions::best ? best_block_functions() : portable_block_functions()),
        view_(contact_view(input)),
        schedule_(input),
        engaged_(input.shell.blocks.size()) {}

  bool contact(const QuantisedPose& grid_from_tool, const Voi& voi, ContactSums& sums) noexcept override {
    sums = {};
    if (!voi.touching) return true;
    const VoxelTransform transform = voxel_transform(grid_from_tool, in_.bone.grid, in_.shell.place_unit_mm);
    view_.per_unit = transform.per_unit;
    view_.bits = transform.bits;
    const auto due = schedule_.due(grid_from_tool, voi, transform);
    for (size_t i = 0; i < due.size(); ++i) engaged_[i] = functions_.add(view_, due[i], sums) != 0;
    schedule_.visited(view_, functions_.clear, [this](size_t i) { return engaged_[i] != 0; });
    return true;
  }

 private:
  NarrowPhaseInput in_;
  BlockFunctions functions_;
  ContactView view_;
  ContactSchedule schedule_;
  std::vector<uint8_t> engaged_;  ///< per entry of the schedule's list
};

}  // namespace

std::unique_ptr<NarrowPhase> make_narrow_phase_cpu(const NarrowPhaseInput& input, Instructions instructions) {
  return std::make_unique<NarrowPhaseCpu>(input, instructions);
}

}  // namespace ream::collide
