#pragma once
#include <memory>

// OpenCL's own opaque types, declared here so that no header of ours includes OpenCL.
struct _cl_device_id;
struct _cl_context;
struct _cl_command_queue;
struct _cl_mem;
struct _cl_program;
struct _cl_kernel;

namespace ream::gpu {

/// Gives an OpenCL object back. Never throws: a failing release leaves nothing to do.
struct Release {
  void operator()(_cl_context* object) const noexcept;
  void operator()(_cl_command_queue* object) const noexcept;
  void operator()(_cl_mem* object) const noexcept;
  void operator()(_cl_program* object) const noexcept;
  void operator()(_cl_kernel* object) const noexcept;
};

/// Owns one reference of an OpenCL object.
template <class Object>
using Handle = std::unique_ptr<Object, Release>;

}  // namespace ream::gpu
