#include "gpu/queue.hpp"

#include <array>
#include <cstdint>

#include "gpu/check.hpp"

namespace ream::gpu {

Queue::Queue(const Device& device) : device_(device) {
  cl_int status = CL_SUCCESS;
  context_.reset(clCreateContext(nullptr, 1, &device.id, nullptr, nullptr, &status));
  check(status, "clCreateContext", device.name);
  queue_.reset(clCreateCommandQueue(context_.get(), device.id, 0, &status));
  check(status, "clCreateCommandQueue", device.name);
  shares_host_memory_ = device.may_share_host_memory && try_sharing();
}

void Queue::finish() const { check(clFinish(queue_.get()), "clFinish"); }

bool Queue::try_sharing() const {
  // Arrays of std::vector are aligned to 16 bytes only, so the trial is too.
  alignas(64) std::array<uint8_t, 4096 + 16> memory{};
  uint8_t* host = memory.data() + 16;
  cl_int status = CL_SUCCESS;
  const Handle<_cl_mem> trial(
      clCreateBuffer(context_.get(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, 4096, host, &status));
  if (status != CL_SUCCESS) return false;
  const uint8_t from_device = 0x5a;
  if (clEnqueueFillBuffer(queue_.get(), trial.get(), &from_device, 1, 0, 2048, 0, nullptr, nullptr) !=
      CL_SUCCESS)
    return false;
  if (clFinish(queue_.get()) != CL_SUCCESS || host[0] != from_device || host[2047] != from_device)
    return false;
  host[4095] = 0xa5;
  uint8_t seen = 0;
  return clEnqueueReadBuffer(queue_.get(), trial.get(), CL_TRUE, 4095, 1, &seen, 0, nullptr, nullptr) ==
             CL_SUCCESS &&
         seen == 0xa5;
}

}  // namespace ream::gpu
