#pragma once
#include <string>
#include <string_view>

namespace ream::gpu {

/// Source of an embedded kernel file of kernels/, its #include "..." lines replaced by the embedded files
/// they name, each once. Throws Error not_found naming the file that is not embedded.
std::string kernel_source(std::string_view file_name);

}  // namespace ream::gpu
