#pragma once
#include <cstdint>

#include "gpu/device.hpp"

namespace ream::gpu {

/// What a queue has been given to do, for measuring. Shared memory is not copied.
struct Traffic {
  uint64_t launches = 0, bytes_to_device = 0, bytes_from_device = 0;
};

/// A context on one device and one in-order command queue in it. Buffers, programs and kernels made with a
/// queue belong to it and must not outlive it. Used by one thread at a time.
class Queue {
 public:
  /// Throws Error unavailable.
  explicit Queue(const Device& device);

  const Device& device() const { return device_; }
  /// True when kernels work on the host's own arrays without copies; tried out once with the device, not
  /// taken from its description.
  bool shares_host_memory() const { return shares_host_memory_; }

  /// Waits until everything enqueued is done. Throws Error unavailable when any of it failed.
  void finish() const;

  Traffic& traffic() const { return traffic_; }

  _cl_context* context() const { return context_.get(); }
  _cl_command_queue* handle() const { return queue_.get(); }

 private:
  bool try_sharing() const;

  Device device_;
  Handle<_cl_context> context_;
  Handle<_cl_command_queue> queue_;
  bool shares_host_memory_ = false;
  mutable Traffic traffic_;
};

}  // namespace ream::gpu
