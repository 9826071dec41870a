#pragma once
#include <vector>

#include "device/registry/device_registry.hpp"

namespace ream::device {

/// Devices on this computer or behind a service that this program connects to by itself, with set-ups in the
/// data folder; server/device/GUIDE.md.
std::vector<DeviceKind> real_device_kinds();

}  // namespace ream::device
