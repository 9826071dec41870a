#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

struct ZSTD_CCtx_s;

namespace ream::record {

/// Makes zstd frames, one after the other in the same memory. Used by one thread.
class Compressor {
 public:
  Compressor();
  /// Throws std::bad_alloc when there is no memory.
  std::vector<std::byte> compress(std::span<const std::byte> raw);

 private:
  std::unique_ptr<ZSTD_CCtx_s, size_t (*)(ZSTD_CCtx_s*)> context_;
};

/// What one zstd frame holds; empty when it is damaged or not of exactly `raw_bytes`. From any thread.
std::optional<std::vector<std::byte>> decompressed(std::span<const std::byte> stored, size_t raw_bytes);

}  // namespace ream::record
