#pragma once
#include <string>
#include <string_view>

namespace ream::bench {

/// Source of a kernel file of this folder, its layout in front. Throws Error not_found for another name.
std::string baseline_source(std::string_view file_name);

}  // namespace ream::bench
