#include "gpu/check.hpp"

#include "core/error.hpp"
#include "gpu/device.hpp"

namespace ream::gpu {

std::string status_name(cl_int status) {
  switch (status) {
    case CL_DEVICE_NOT_FOUND: return "CL_DEVICE_NOT_FOUND";
    case CL_DEVICE_NOT_AVAILABLE: return "CL_DEVICE_NOT_AVAILABLE";
    case CL_COMPILER_NOT_AVAILABLE: return "CL_COMPILER_NOT_AVAILABLE";
    case CL_MEM_OBJECT_ALLOCATION_FAILURE: return "CL_MEM_OBJECT_ALLOCATION_FAILURE";
    case CL_OUT_OF_RESOURCES: return "CL_OUT_OF_RESOURCES";
    case CL_OUT_OF_HOST_MEMORY: return "CL_OUT_OF_HOST_MEMORY";
    case CL_BUILD_PROGRAM_FAILURE: return "CL_BUILD_PROGRAM_FAILURE";
    case CL_INVALID_VALUE: return "CL_INVALID_VALUE";
    case CL_INVALID_BINARY: return "CL_INVALID_BINARY";
    case CL_INVALID_BUILD_OPTIONS: return "CL_INVALID_BUILD_OPTIONS";
    case CL_INVALID_KERNEL_NAME: return "CL_INVALID_KERNEL_NAME";
    case CL_INVALID_ARG_INDEX: return "CL_INVALID_ARG_INDEX";
    case CL_INVALID_ARG_VALUE: return "CL_INVALID_ARG_VALUE";
    case CL_INVALID_ARG_SIZE: return "CL_INVALID_ARG_SIZE";
    case CL_INVALID_KERNEL_ARGS: return "CL_INVALID_KERNEL_ARGS";
    case CL_INVALID_WORK_GROUP_SIZE: return "CL_INVALID_WORK_GROUP_SIZE";
    case CL_INVALID_BUFFER_SIZE: return "CL_INVALID_BUFFER_SIZE";
    default: return "status " + std::to_string(status);
  }
}

void check(cl_int status, const char* call, const std::string& what) {
  if (status == CL_SUCCESS) return;
  throw Error(ErrorKind::unavailable, std::string("OpenCL: ") + call + " failed with " + status_name(status) +
                                          (what.empty() ? "" : " (" + what + ")") +
                                          "; --backend cpu works without OpenCL");
}

void Release::operator()(_cl_context* object) const noexcept { clReleaseContext(object); }
void Release::operator()(_cl_command_queue* object) const noexcept { clReleaseCommandQueue(object); }
void Release::operator()(_cl_mem* object) const noexcept { clReleaseMemObject(object); }
void Release::operator()(_cl_program* object) const noexcept { clReleaseProgram(object); }
void Release::operator()(_cl_kernel* object) const noexcept { clReleaseKernel(object); }

}  // namespace ream::gpu
