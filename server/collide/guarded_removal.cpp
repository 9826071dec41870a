#include "collide/guarded_removal.hpp"

#include "voxel/bricks.hpp"

namespace ream::collide {
namespace {

class GuardedRemoval final : public Removal {
 public:
  GuardedRemoval(std::unique_ptr<Removal> inner, voxel::BoneModel& bone)
      : inner_(std::move(inner)), bone_(bone), before_(most_bricks_a_cut * voxel::brick_voxels) {}

  bool cut(const QuantisedPose& grid_from_tool, std::span<const uint32_t> bricks,
           std::span<BrickOutcome> outcomes, RemovalSums& sums) noexcept override {
    for (size_t i = 0; i < bricks.size(); ++i)
      voxel::read_brick(bone_.grid, bone_.coverage.data(), bricks[i], image(i));
    if (inner_->cut(grid_from_tool, bricks, outcomes, sums)) return true;
    for (size_t i = 0; i < bricks.size(); ++i)
      voxel::write_brick(bone_.grid, bone_.coverage.data(), bricks[i], image(i));
    return false;
  }

 private:
  uint8_t* image(size_t i) noexcept { return before_.data() + i * voxel::brick_voxels; }

  std::unique_ptr<Removal> inner_;
  voxel::BoneModel& bone_;
  std::vector<uint8_t> before_;
};

}  // namespace

std::unique_ptr<Removal> guarded(std::unique_ptr<Removal> inner, voxel::BoneModel& bone) {
  return std::make_unique<GuardedRemoval>(std::move(inner), bone);
}

}  // namespace ream::collide
