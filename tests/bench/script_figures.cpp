#include "bench/script_figures.hpp"

#include <stdio.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace ream::bench {

nlohmann::json script_figures(const std::string& command, const std::string& needs) {
  FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) throw Error(ErrorKind::unavailable, "cannot run " + command);
  std::string told;
  std::array<char, 4096> part;
  while (const size_t count = ::fread(part.data(), 1, part.size(), pipe)) told.append(part.data(), count);
  if (::pclose(pipe) != 0) throw Error(ErrorKind::unavailable, needs);
  return nlohmann::json::parse(told);
}

std::string shell_word(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

}  // namespace ream::bench
