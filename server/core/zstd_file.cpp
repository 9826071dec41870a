#include "core/zstd_file.hpp"

#include <zstd.h>

#include <string>

#include "core/error.hpp"
#include "core/file.hpp"

namespace ream {
namespace {

constexpr int compression_level = 1;

}  // namespace

void read_zstd_file(const std::filesystem::path& path, std::span<std::byte> raw, const char* description) {
  const auto packed = read_binary_file(path);
  const unsigned long long size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN)
    throw Error(ErrorKind::invalid_input, path.string() + " is not zstd data; import the case again");
  if (size != raw.size())
    throw Error(ErrorKind::invalid_input, path.string() + " holds " + std::to_string(size) + " bytes, " +
                                              description + " says " + std::to_string(raw.size()) +
                                              "; import the case again");
  const size_t read = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
  if (ZSTD_isError(read) || read != raw.size())
    throw Error(ErrorKind::invalid_input, path.string() + " is damaged or cut short; import the case again");
}

void write_zstd_file(const std::filesystem::path& path, std::span<const std::byte> raw) {
  std::vector<std::byte> packed(ZSTD_compressBound(raw.size()));
  const size_t size = ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), compression_level);
  if (ZSTD_isError(size))
    throw Error(ErrorKind::io, "cannot compress " + path.string() + ": " + ZSTD_getErrorName(size));
  write_file_atomically(path, std::span<const std::byte>(packed.data(), size));
}

}  // namespace ream
