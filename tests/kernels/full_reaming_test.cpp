#include "collide/contact/narrow_phase_cl.hpp"
#include "collide/removal/removal_cl.hpp"
#include "every_device.hpp"
#include "support/small_run.hpp"

namespace ream::test {
namespace {

/// A hand that comes down from the side, leans on with changing force and tilt, and withdraws.
device::Script whole_reaming() {
  device::Script script;
  script.duration_s = 3.0;
  script.stiffness_n_mm = 100.0;
  script.hand.start_mm = Vec3(0.4, -0.3, -6.0);
  script.hand.tilt_rad = Vec3(0.12, -0.08, 0.05);
  script.hand.force_profile = {{0.0, 5.0}, {0.6, 52.0}, {1.2, 1500.0}, {2.6, 1500.0}, {2.8, -30.0}};
  return script;
}

struct Outcome {
  std::vector<uint64_t> hashes;
  uint64_t grid_hash = 0;
  int64_t removed = 0;
};

/// Narrow phase and removal on a device with memory of its own, or one that is treated so.
sim::Backend with_copies(gpu::Device device, const sim::Model& model, SmallRun& run) {
  device.may_share_host_memory = false;
  const auto buffers = std::make_shared<collide::BoneBuffers>(device, run.bone);
  const auto shape = collide::LaunchShape::fitting(device);
  sim::Backend backend;
  backend.name = "copies on " + device.name;
  backend.narrow_phase = collide::make_narrow_phase_cl(
      {model.contact_shell, run.bone, model.distance, run.state.cells}, buffers, shape);
  if (model.settings.removal == sim::RemovalLaw::decay)
    backend.decay =
        collide::make_decay_cl({model.decay_shell, run.bone, model.settings.decay_levels}, buffers, shape);
  else
    backend.removal = collide::make_removal_cl({model.profile, run.bone}, buffers, shape);
  return backend;
}

Outcome ream_with(const std::string& backend, sim::RemovalLaw removal,
                  const gpu::Device* with_copies_on = nullptr) {
  voxel::BoneModel bone = slab({96, 96, 96}, 0.15, 9.0, 0.5);
  // Cortical bone over cancellous, with half-covered voxels throughout the crust.
  for (size_t i = 0; i < bone.coverage.size(); ++i) {
    const int w = bone.grid.coordinates(i).z();
    if (w >= 54) bone.density.writable()[i] = voxel::density_code(1.4);
    if (w >= 58 && bone.coverage[i] == 255) bone.coverage[i] = static_cast<uint8_t>(140 + i % 100);
  }
  const case_::Plan plan = slab_plan(bone, 9.0);
  SmallRun run(std::move(bone), plan, "ellipse 6,4", whole_reaming(), backend, removal);
  if (with_copies_on != nullptr) run.state.backend = with_copies(*with_copies_on, run.model, run);
  Outcome outcome;
  for (const auto& report : run.run()) {
    outcome.hashes.push_back(report.session_hash);
    for (const int64_t levels : report.coverage_removed) outcome.removed += levels;
  }
  outcome.grid_hash = run.bone.coverage_hash();
  EXPECT_EQ(run.state.failed_over_tick, -1);
  return outcome;
}

void expect_equal(const Outcome& a, const Outcome& b) {
  ASSERT_EQ(a.hashes.size(), b.hashes.size());
  for (size_t i = 0; i < a.hashes.size(); ++i) ASSERT_EQ(a.hashes[i], b.hashes[i]) << "tick " << i;
  EXPECT_EQ(a.grid_hash, b.grid_hash);
  EXPECT_EQ(a.removed, b.removed);
}

TEST(FullReaming, EveryTickOfItHasTheSameHashOnEveryDevice) {
  for (const sim::RemovalLaw removal : {sim::RemovalLaw::profile, sim::RemovalLaw::decay}) {
    SCOPED_TRACE(sim::to_text(removal));
    const Outcome cpp = ream_with("cpu", removal);
    EXPECT_EQ(cpp.hashes.size(), 3000u);
    EXPECT_GT(cpp.removed, 255 * 1000);
    for (const gpu::Device& device : gpu::list_devices()) {
      SCOPED_TRACE(device.name);
      expect_equal(ream_with("opencl:" + std::to_string(device.index), removal), cpp);
      SCOPED_TRACE("with copies");
      expect_equal(ream_with("cpu", removal, &device), cpp);
    }
  }
}

}  // namespace
}  // namespace ream::test
