#pragma once
#include <gtest/gtest.h>

#include <iostream>

#include "gpu/queue.hpp"

namespace ream::test {

/// Runs `check` with a queue on every OpenCL device of the machine. PoCL is a requirement of the project, so no device
/// at all is a failure.
template <class Check>
void on_every_device(Check check) {
  const std::vector<gpu::Device> devices = gpu::list_devices();
  ASSERT_FALSE(devices.empty()) << "no OpenCL device: install pocl-opencl-icd";
  for (const gpu::Device& device : devices) {
    SCOPED_TRACE(device.name);
    std::cout << "on " << device.name << '\n';
    const gpu::Queue queue(device);
    check(queue);
  }
}

}  // namespace ream::test
