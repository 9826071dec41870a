#pragma once
#include "device/haptic_device.hpp"
#include "sim/state.hpp"

namespace ream::sim {

/// Removes what the tool cuts at `grid_from_tool` by the law of the settings, tells the followers, and folds
/// the changes into report and session hash. False when the device failed and nothing could take over.
bool remove_bone(State& state, const QuantisedPose& grid_from_tool, TickReport& report) noexcept;

enum class StepStatus {
  ok,
  collision_failed,  ///< the narrow phase's or removal's device failed
  not_finite,        ///< a pose or force is not a number
};

/// One millisecond: contact, force, motion, removal, hash; in that order, readable top to bottom. The report
/// says what happened; on any status but ok it must not be used and the device must be given zero force. When
/// the device that computes fails, the reserve takes over within the tick and the hand feels nothing for it.
/// No lock, allocation, log, file, socket or exception.
StepStatus step(const Model& model, State& state, const device::DeviceInput& input,
                TickReport& report) noexcept;

}  // namespace ream::sim
