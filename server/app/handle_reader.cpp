#include "app/handle_reader.hpp"

#include "core/error.hpp"
#include "core/signal_handlers.hpp"
#include "sim/realtime.hpp"
#include "sim/watchdogs.hpp"

namespace ream::app {

HandleReader::HandleReader(device::HapticDevice& device, const device::DeviceSetup& setup,
                           const Pose& world_from_start)
    : device_(device),
      device_from_world_mm_(
          (device::world_from_person(world_from_start.rotation.col(2)) * setup.person_from_device)
              .transpose() /
          setup.scale) {
  device.open();
  guard_.emplace(device);
  thread_ = start_thread([this] { read(); });
}

HandleReader::~HandleReader() {
  leaving_ = true;
  thread_.join();
}

void HandleReader::read() noexcept {
  sim::TickClock clock;
  device::DeviceInput input;
  while (!leaving_.load(std::memory_order_relaxed)) {
    clock.wait();
    const bool whole =
        device_.read(input) == device::DeviceStatus::ok && device_.write({}) == device::DeviceStatus::ok;
    const auto link = sim::link_state(input.age_ms, device_.traits().stale);
    const Vec3 mm = device_from_world_mm_ * input.world_from_handle.translation_mm;
    newest_.store({{mm.x(), mm.y(), mm.z()}});
    answers_.store(whole && link != device::LinkState::lost, std::memory_order_release);
  }
}

Vec3 HandleReader::place_mm() {
  if (!answers())
    throw Error(ErrorKind::unavailable, "the device does not answer; check that it is there and connected");
  newest_.take(last_);
  return {last_.mm[0], last_.mm[1], last_.mm[2]};
}

}  // namespace ream::app
