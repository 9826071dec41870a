#include "bench/empty_loop.hpp"

#include <thread>

#include "core/clock.hpp"
#include "device/profiles.hpp"
#include "support/still_device.hpp"
#include "support/test_bone.hpp"

namespace ream::bench {
namespace {

class IdleDevice final : public test::StillDevice {
 public:
  IdleDevice(const Pose& world_from_handle, int64_t ticks, double busy_us)
      : ticks_left_(ticks), busy_us_(busy_us) {
    device_traits = device::device_profile("ideal");
    rests_.world_from_handle = world_from_handle;
    rests_.paused = true;
  }
  device::DeviceStatus read(device::DeviceInput& input) noexcept override {
    if (ticks_left_-- <= 0) return device::DeviceStatus::finished;
    input = rests_;
    for (const auto start = SteadyClock::now(); elapsed_us(start) < busy_us_;) {
    }
    return device::DeviceStatus::ok;
  }

 private:
  device::DeviceInput rests_;
  int64_t ticks_left_;
  double busy_us_;
};

}  // namespace

sim::LoopHealth run_empty_loop(double seconds, sim::Realtime realtime, int cpu, double busy_us) {
  constexpr double surface_mm = 2.0;
  voxel::BoneModel bone = test::slab({16, 16, 16}, 0.5, surface_mm, 0.5);
  const case_::Plan plan = test::slab_plan(bone, surface_mm);
  const sim::Model model = sim::make_model(plan, bone, shell::make_tool("sphere 2,1"), sim::Settings{});
  sim::State state(model, bone);
  IdleDevice device(model.world_from_plan, static_cast<int64_t>(seconds / tick_s), busy_us);
  SpscRing<record::TickReport> reports(1024);
  sim::HapticLoop loop(model, state, device, reports, {true, realtime, cpu});
  loop.start();
  record::TickReport report;
  while (!loop.ended()) {
    while (reports.try_pop(report)) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  loop.stop();
  return loop.health();
}

}  // namespace ream::bench
