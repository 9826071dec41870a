#include "record/replay_device.hpp"

#include <algorithm>

#include "record/tick_report.hpp"

namespace ream::record {
namespace {

void set_input(const QuantisedPose& world_from_handle, uint32_t flags, device::DeviceInput& input) noexcept {
  input.world_from_handle = dequantised(world_from_handle);
  input.spindle_on = (flags & spindle_on_flag) != 0;
  input.paused = (flags & paused_flag) != 0;
  input.stale = (flags & stale_flag) != 0;
  input.drive = drive_of_flags(flags);
}

}  // namespace

device::DeviceInput input_of(const ops::Tick& tick) {
  device::DeviceInput input;
  set_input(tick.world_from_handle, tick.flags, input);
  return input;
}

ReplayDevice::ReplayDevice(std::vector<Cause> causes, device::DeviceTraits traits)
    : causes_(std::move(causes)), traits_(std::move(traits)) {}

ReplayDevice::ReplayDevice(const Recording& recording, uint32_t first, uint32_t last,
                           device::DeviceTraits traits)
    : traits_(std::move(traits)) {
  const uint32_t end = std::min(last, recording.tick_count());
  if (end > first) causes_.reserve(end - first);
  recording.for_each_tick(first, end, [&](const ops::Tick& tick) {
    causes_.push_back({tick.world_from_handle, tick.flags});
  });
}

device::DeviceStatus ReplayDevice::read(device::DeviceInput& input) noexcept {
  if (next_ == causes_.size()) return device::DeviceStatus::finished;
  const Cause& cause = causes_[next_++];
  set_input(cause.world_from_handle, cause.flags, input);
  return device::DeviceStatus::ok;
}

}  // namespace ream::record
