#include "gpu/kernel_source.hpp"

#include <set>

#include "core/error.hpp"
#include "ream_embedded_kernels.hpp"

namespace ream::gpu {
namespace {

void append_file(std::string_view name, std::set<std::string, std::less<>>& done, std::string& source) {
  if (!done.emplace(name).second) return;
  std::string_view text = embedded::ream_embedded_kernels::find(name);
  if (text.empty())
    throw Error(ErrorKind::not_found, "no kernel file '" + std::string(name) + "' in this program");
  constexpr std::string_view include = "#include \"";
  while (!text.empty()) {
    const size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (line.starts_with(include))
      append_file(line.substr(include.size(), line.rfind('"') - include.size()), done, source);
    else
      source.append(line).append("\n");
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

}  // namespace

std::string kernel_source(std::string_view file_name) {
  std::set<std::string, std::less<>> done;
  std::string source;
  append_file(file_name, done, source);
  return source;
}

}  // namespace ream::gpu
