#include "bench/femesh/femesh_run.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <vector>

#include "core/clock.hpp"
#include "core/error.hpp"

namespace ream::bench {
namespace fs = std::filesystem;

BenchFolder::BenchFolder() : path_(fs::temp_directory_path() / ("ream-bench-" + std::to_string(::getpid()))) {
  fs::create_directories(path_);
}

BenchFolder::~BenchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

nlohmann::json run_femesh(const std::string& words) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "ream";
  FILE* const out = ::popen((program.string() + " femesh " + words + " --json 2>/dev/null").c_str(), "r");
  if (out == nullptr) throw Error(ErrorKind::unavailable, "cannot run " + program.string());
  std::string text;
  std::array<char, 4096> piece{};
  while (const size_t n = std::fread(piece.data(), 1, piece.size(), out)) text.append(piece.data(), n);
  if (::pclose(out) != 0) throw Error(ErrorKind::unavailable, "ream femesh " + words + " failed");
  return nlohmann::json::parse(text);
}

double plain_write_s(const fs::path& file, uint64_t bytes) {
  const std::vector<char> piece(4 << 20, 'a');
  const auto start = SteadyClock::now();
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  bool written = fd >= 0;
  for (uint64_t left = bytes; written && left > 0;) {
    const ssize_t n = ::write(fd, piece.data(), std::min<uint64_t>(left, piece.size()));
    written = n > 0;
    left -= written ? static_cast<uint64_t>(n) : 0;
  }
  written = written && ::fsync(fd) == 0;
  ::close(fd);
  if (!written) throw Error(ErrorKind::io, "cannot write " + file.string());
  const double seconds = elapsed_us(start) * 1e-6;
  fs::remove(file);
  return seconds;
}

}  // namespace ream::bench
