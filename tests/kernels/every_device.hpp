#pragma once
#include <gtest/gtest.h>

#include <iostream>

#include "gpu/queue.hpp"

namespace ream::test {

/// Runs `check` with every OpenCL device of the machine, and with those that share the host's memory once
/// more as if they did not. PoCL is a requirement of the project, so no device at all is a failure.
template <class Check>
void on_every_device(Check check) {
  const std::vector<gpu::Device> devices = gpu::list_devices();
  ASSERT_FALSE(devices.empty()) << "no OpenCL device: install pocl-opencl-icd";
  for (gpu::Device device : devices) {
    std::cout << "on " << device.name << '\n';
    SCOPED_TRACE(device.name);
    check(device);
    if (!device.may_share_host_memory) continue;
    device.may_share_host_memory = false;
    SCOPED_TRACE("with copies");
    check(device);
  }
}

}  // namespace ream::test
