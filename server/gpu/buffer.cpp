#include "gpu/buffer.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "gpu/check.hpp"

namespace ream::gpu {
namespace {

void check_size(const Queue& queue, size_t bytes) {
  const Device& device = queue.device();
  if (bytes > device.max_buffer_bytes)
    throw Error(ErrorKind::unavailable, "OpenCL: a buffer of " + std::to_string(bytes) +
                                            " bytes is more than " + device.name + " allows (" +
                                            std::to_string(device.max_buffer_bytes) +
                                            "); use a coarser grid or --backend cpu");
}

}  // namespace

Buffer::Buffer(const Queue& queue, size_t bytes) : bytes_(bytes) {
  check_size(queue, bytes);
  cl_int status = CL_SUCCESS;
  memory_.reset(
      clCreateBuffer(queue.context(), CL_MEM_READ_WRITE, std::max<size_t>(bytes, 1), nullptr, &status));
  check(status, "clCreateBuffer", std::to_string(bytes) + " bytes");
}

Buffer Buffer::over_bytes(const Queue& queue, const void* host, size_t bytes) {
  if (!queue.shares_host_memory() || bytes == 0) {
    Buffer copy(queue, bytes);
    copy.write(queue, host, bytes);
    return copy;
  }
  check_size(queue, bytes);
  Buffer buffer;
  cl_int status = CL_SUCCESS;
  buffer.memory_.reset(clCreateBuffer(queue.context(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes,
                                      const_cast<void*>(host), &status));
  check(status, "clCreateBuffer", std::to_string(bytes) + " bytes shared with the host");
  buffer.bytes_ = bytes;
  buffer.shared_ = true;
  return buffer;
}

void Buffer::write(const Queue& queue, const void* from, size_t bytes, size_t offset) {
  if (bytes == 0) return;
  queue.traffic().bytes_to_device += bytes;
  check(
      clEnqueueWriteBuffer(queue.handle(), memory_.get(), CL_TRUE, offset, bytes, from, 0, nullptr, nullptr),
      "clEnqueueWriteBuffer");
}

void Buffer::read(const Queue& queue, void* to, size_t bytes, size_t offset) const {
  if (bytes == 0) return;
  queue.traffic().bytes_from_device += bytes;
  check(clEnqueueReadBuffer(queue.handle(), memory_.get(), CL_TRUE, offset, bytes, to, 0, nullptr, nullptr),
        "clEnqueueReadBuffer");
}

void Buffer::fill(const Queue& queue, unsigned char value) {
  if (bytes_ == 0) return;
  check(clEnqueueFillBuffer(queue.handle(), memory_.get(), &value, 1, 0, bytes_, 0, nullptr, nullptr),
        "clEnqueueFillBuffer");
}

}  // namespace ream::gpu
