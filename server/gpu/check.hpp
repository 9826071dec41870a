#pragma once
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <string>

// Only sources of this room include this header.
namespace ream::gpu {

/// Name of an OpenCL status, like "CL_OUT_OF_RESOURCES", or its number.
std::string status_name(cl_int status);

/// Throws Error unavailable naming the OpenCL call and `what` it was for, unless `status` is CL_SUCCESS.
void check(cl_int status, const char* call, const std::string& what = {});

}  // namespace ream::gpu
