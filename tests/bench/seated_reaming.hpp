#pragma once
#include <string>

#include "device/simulated/scripted_device.hpp"
#include "sim/model.hpp"

namespace ream::bench {

/// Five seconds at the experiments' thrust after a short approach, as in the thesis' section 5.4.2.
device::Script seated_script();

/// How that script is simulated: the thesis' shell, 0.1 mm.
sim::Settings seated_settings(const device::Script& script, const std::string& backend);

}  // namespace ream::bench
