#include "record/compression.hpp"

#include <zstd.h>

#include <new>

namespace ream::record {
namespace {

/// Level 3 makes the ticks of a real session half a percent smaller and takes a fifth longer.
constexpr int level = 1;

}  // namespace

Compressor::Compressor() : context_(ZSTD_createCCtx(), ZSTD_freeCCtx) {
  if (!context_) throw std::bad_alloc();
}

std::vector<std::byte> Compressor::compress(std::span<const std::byte> raw) {
  std::vector<std::byte> out(ZSTD_compressBound(raw.size()));
  const size_t size =
      ZSTD_compressCCtx(context_.get(), out.data(), out.size(), raw.data(), raw.size(), level);
  if (ZSTD_isError(size)) throw std::bad_alloc();  // with room for the worst case nothing else is possible
  out.resize(size);
  return out;
}

std::optional<std::vector<std::byte>> decompressed(std::span<const std::byte> stored, size_t raw_bytes) {
  if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != raw_bytes) return std::nullopt;
  std::vector<std::byte> raw(raw_bytes);
  if (ZSTD_decompress(raw.data(), raw.size(), stored.data(), stored.size()) != raw_bytes) return std::nullopt;
  return raw;
}

}  // namespace ream::record
