#pragma once
#include <string>
#include <vector>

#include "device/haptic_device.hpp"

namespace ream::device {

/// What the named device can render, hand side. Values are the makers' as CHAI3D's device table gives them,
/// where profiles.cpp says nothing else. Throws Error invalid_input, listing the names, for an unknown one.
/// The traits' `name` and `profile` are both `name`.
DeviceTraits device_profile(const std::string& name);

/// Every name that device_profile knows, in the order of its table.
std::vector<std::string> device_profile_names();

/// One more, by the traits' name, of a plug-in's device: what it renders, its reach, mass and sensed degrees
/// of freedom are said; angular stiffness, ramp and vibration follow as for the table. To be called before
/// there are sessions. Error conflict when the name is taken.
void add_device_profile(DeviceTraits traits);

/// The axes of a kind of device, "haply" say, that go to the person's right, up and towards them.
const char* device_axes(const std::string& device);

}  // namespace ream::device
