#pragma once
#include <functional>
#include <iosfwd>

#include "device/device_setup.hpp"

namespace ream::app {

/// What a wizard asks of a device: where the handle is now, in the device's own frame, mm. Throws Error
/// unavailable when it does not answer.
using HandlePlace = std::function<Vec3()>;

/// Asks a person in a terminal to hold still, to move the handle to the right, up and towards themselves, and
/// which hand and scale they want; what is not to be changed is left as in `setup` by just pressing Enter. A
/// motion that tells nothing is asked for again. `wait_ms` waits a while between two looks at the handle.
/// Errors: invalid_input when the person leaves (end of input); those of `place`.
device::DeviceSetup ask_for_setup(std::istream& in, std::ostream& out, const device::DeviceSetup& setup,
                                  const HandlePlace& place, const std::function<void(int)>& wait_ms);

}  // namespace ream::app
