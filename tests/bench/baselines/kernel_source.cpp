#include "bench/baselines/kernel_source.hpp"

#include "core/error.hpp"
#include "ream_embedded_baselines.hpp"

namespace ream::bench {

std::string baseline_source(std::string_view file_name) {
  const std::string_view file = embedded::ream_embedded_baselines::find(file_name);
  if (file.empty())
    throw Error(ErrorKind::not_found, "no baseline kernel '" + std::string(file_name) + "' in this program");
  return std::string(embedded::ream_embedded_baselines::find("layout.h")).append("\n").append(file);
}

}  // namespace ream::bench
