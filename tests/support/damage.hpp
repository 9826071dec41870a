#pragma once
#include <filesystem>
#include <fstream>

namespace ream::test {

/// Changes two bytes of a file from `offset` on, whatever they were.
inline void damage(const std::filesystem::path& path, uint64_t offset) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.exceptions(std::ios::badbit | std::ios::failbit);
  char bytes[2];
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(bytes, 2);
  for (char& byte : bytes) byte = static_cast<char>(byte ^ 0x5a);
  file.seekp(static_cast<std::streamoff>(offset));
  file.write(bytes, 2);
}

}  // namespace ream::test
