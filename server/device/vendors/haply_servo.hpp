#pragma once
#include <memory>

#include "device/device_setup.hpp"
#include "device/vendors/servo.hpp"

namespace ream::device {

/// The driver of an Inverse3 behind Haply's Inverse Service (3.x): one message with a force and one state
/// back each turn, over a WebSocket. The grip, where there is one, gives orientation and buttons: a turns the
/// spindle, b is the clutch, c pauses. The service forgets a force that is not renewed, so a process that
/// dies leaves none behind. Its emergency brake pauses.
std::unique_ptr<Servo> make_haply_servo(const DeviceSetup& setup, const DeviceTraits& traits);

/// Whether the service and the device of the set-up are there now: empty, or one line that says what is
/// missing and what to do. Takes a second at most.
std::string haply_fault(const DeviceSetup& setup);

}  // namespace ream::device
