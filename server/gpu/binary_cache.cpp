#include "gpu/binary_cache.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"

namespace ream::gpu {
namespace {

/// Start of a cache file; the second word tells a damaged or truncated file.
struct Header {
  uint64_t key_hash = 0, payload_hash = 0, payload_size = 0;
};

std::filesystem::path file_of(const std::string& key) {
  const std::filesystem::path folder = cache_folder();
  return folder.empty() ? folder : folder / "kernels" / (to_hex(hash_text(key)) + ".bin");
}

/// Independent of the one in the file's name, so that a collision of names is seen.
uint64_t second_hash(const std::string& key) { return hash_text(key, 0x6b65726e656c73ull); }

}  // namespace

std::filesystem::path cache_folder() {
  if (const char* own = std::getenv("REAM_CACHE"); own && *own) return own;
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg && *xdg)
    return std::filesystem::path(xdg) / "ream";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::filesystem::path(home) / ".cache" / "ream";
  return {};
}

std::optional<std::vector<std::byte>> load_binary(const std::string& key) {
  const std::filesystem::path path = file_of(key);
  if (path.empty()) return std::nullopt;
  try {
    std::vector<std::byte> bytes = read_binary_file(path);
    Header header;
    if (bytes.size() < sizeof header) return std::nullopt;
    std::memcpy(&header, bytes.data(), sizeof header);
    bytes.erase(bytes.begin(), bytes.begin() + sizeof header);
    if (header.key_hash != second_hash(key) || header.payload_size != bytes.size() ||
        header.payload_hash != hash_bytes(bytes))
      return std::nullopt;
    return bytes;
  } catch (const Error&) {
    return std::nullopt;
  }
}

void store_binary(const std::string& key, const std::vector<std::byte>& binary) {
  const std::filesystem::path path = file_of(key);
  if (path.empty()) return;
  const Header header{second_hash(key), hash_bytes(binary), binary.size()};
  std::vector<std::byte> bytes(sizeof header + binary.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  std::copy(binary.begin(), binary.end(), bytes.begin() + sizeof header);
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  if (failed) return;
  try {
    write_file_atomically(path, std::span<const std::byte>(bytes));
  } catch (const Error&) {
    return;
  }
}

}  // namespace ream::gpu
