#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "record/op_log.hpp"

namespace ream::record {

/// Files of revision 1: "reamrec1", u64 bytes of a JSON text, u64 checksum of it, the text; then chunks of up
/// to 1000 ticks: u32 stored bytes, u32 raw bytes, u64 checksum of the stored bytes, a zstd frame of 28 words
/// of 32 bits a tick (tick, flags, world_from_handle, grid_from_tool, session_hash). The text is read as a
/// chunk of its own, the first.
inline constexpr char old_magic[8] = {'r', 'e', 'a', 'm', 'r', 'e', 'c', '1'};

/// A chunk that is whole.
struct OldChunk {
  ChunkPlace place;
  uint64_t stored_at = 0, checksum = 0;
};
/// `bytes`: the whole file. Stops before the first chunk that is not whole; empty when the text is not.
std::vector<OldChunk> old_chunks(std::span<const std::byte> bytes);

/// The ops that stand for the text, and for the stored bytes of a chunk of ticks (empty when they are
/// damaged). What revision 1 did not record is zero or empty.
ops::Bytes ops_of_old_text(std::span<const std::byte> text);
std::optional<ops::Bytes> ops_of_old_ticks(std::span<const std::byte> stored, uint32_t raw_bytes);

}  // namespace ream::record
