#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

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

/// What a device is used for. PoCL offers the same processor twice: `basic` runs kernels on the calling
/// thread and starts one in under a microsecond (the tick), `pthread` uses every core (bulk work).
enum class Use { tick, bulk };

/// One OpenCL device of any installed driver (ICD).
struct Device {
  _cl_device_id* id = nullptr;  ///< owned by the OpenCL runtime, valid until the process ends
  int index = 0;                ///< the N of "opencl:N"
  std::string name, platform, driver;
  bool is_cpu = false;
  bool is_pocl = false;
  bool knows_doubles = false;       ///< cl_khr_fp64
  bool keeps_small_floats = false;  ///< below 1e-38, denormalized: they do not become zero
  /// CPUs are tried for working on the host's own arrays; false makes every buffer a copy.
  bool may_share_host_memory = false;
  size_t memory_bytes = 0;  ///< for all buffers together
  size_t max_buffer_bytes = 0;
  size_t max_local_size = 0;
};

/// Every device, in the order of the installed drivers; empty when there is none. Unless POCL_DEVICES is set,
/// PoCL is asked for both "basic" and "pthread". The first call touches the environment: make it before
/// threads start.
std::vector<Device> list_devices();

/// The device that `name` names: "auto" or "opencl" (PoCL's device that fits `use`, else the first of the
/// list), "opencl:N" (the N-th of list_devices), or part of a device's or platform's name, in any case.
/// Errors: usage for an N or a name that is not there (lists what is), unavailable when there is no device at
/// all.
Device choose_device(std::string_view name, Use use);

}  // namespace ream::gpu
