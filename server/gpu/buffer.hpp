#pragma once
#include <cstddef>
#include <span>

#include "gpu/queue.hpp"

namespace ream::gpu {

/// Device memory. All copies are blocking and throw Error unavailable naming the failing call; only creating
/// a buffer allocates.
class Buffer {
 public:
  Buffer() = default;
  /// Uninitialised memory, at least one byte.
  Buffer(const Queue& queue, size_t bytes);

  /// The host's own array, without a copy, on devices that share the host's memory; elsewhere a device copy
  /// filled from it. The array must outlive the buffer and stay where it is.
  template <class T>
  static Buffer over(const Queue& queue, std::span<T> host) {
    return over_bytes(queue, host.data(), host.size_bytes());
  }
  /// A device copy of the host's array.
  template <class T>
  static Buffer copy_of(const Queue& queue, std::span<T> host) {
    Buffer buffer(queue, host.size_bytes());
    buffer.write(queue, host.data(), host.size_bytes());
    return buffer;
  }

  /// True when this is the host's own array.
  bool shared() const { return shared_; }
  size_t bytes() const { return bytes_; }

  void write(const Queue& queue, const void* from, size_t bytes, size_t offset = 0);
  void read(const Queue& queue, void* to, size_t bytes, size_t offset = 0) const;
  /// Sets every byte; enqueued, not waited for.
  void fill(const Queue& queue, unsigned char value);

  _cl_mem* handle() const { return memory_.get(); }

 private:
  static Buffer over_bytes(const Queue& queue, const void* host, size_t bytes);

  Handle<_cl_mem> memory_;
  size_t bytes_ = 0;
  bool shared_ = false;
};

}  // namespace ream::gpu
