#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "record/ops.hpp"

struct ZSTD_CCtx_s;
namespace ream::record {

/// Where a chunk is in the file and what it is about, as its header says.
struct ChunkPlace {
  uint64_t offset = 0;  ///< of its header in the file
  uint32_t stored_bytes = 0, raw_bytes = 0;
  uint32_t first_tick = 0, ticks = 0;  ///< rows of tick that it holds; 0: notes only
  bool has_key = false;                ///< holds a key of bricks
  bool has_notes = false;              ///< holds ops other than tick, bricks and checkpoint
};

/// A file begins with these bytes, u32 revision and u64 checksum of both; the first chunk's header follows.
/// They hold what a transfer as text would change.
inline constexpr char log_magic[8] = {'r', 'e', 'a', 'm', 'r', 'e', 'c', '\n'};
inline constexpr size_t file_header_bytes = 8 + 4 + 8;
/// u32 stored bytes, u32 raw bytes, u32 first tick, u32 ticks, u32 flags (1 has_key, 2 has_notes), u64
/// checksum of the stored bytes, u64 checksum of all this and of the checksum that ended the header before.
inline constexpr size_t chunk_header_bytes = 5 * 4 + 2 * 8;
/// More than any chunk of a session has; a file that says more is damaged.
inline constexpr uint32_t max_raw_bytes = 256u << 20;

/// `chain`: of the header made.
ops::Bytes file_header(uint32_t revision, uint64_t& chain);
struct FileHeader {
  uint32_t revision = 0;
  uint64_t chain = 0;
};
/// Empty when the bytes are no such header.
std::optional<FileHeader> take_file_header(std::span<const std::byte> bytes);

/// A chunk's header and what is needed to check its bytes and the next header.
struct ChunkHeader {
  ChunkPlace place;
  uint64_t stored_checksum = 0;
  uint64_t chain = 0;
};
/// Appends it; `header.chain` is that of the header before and becomes that of this one.
void put_chunk_header(ops::Bytes& out, ChunkHeader& header);
/// Empty when the bytes are no header that follows one with `chain`; place.offset is left 0.
std::optional<ChunkHeader> take_chunk_header(std::span<const std::byte> bytes, uint64_t chain);

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
