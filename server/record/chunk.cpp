#include "record/chunk.hpp"

#include <zstd.h>

#include <cstring>
#include <new>

#include "core/hash.hpp"

namespace ream::record {
namespace {

enum Flag : uint32_t { key = 1, notes = 2 };

/// Level 3 makes the ticks of a real session half a percent smaller and takes a fifth longer.
constexpr int level = 1;

}  // namespace

ops::Bytes file_header(uint32_t revision, uint64_t& chain) {
  const auto magic = std::as_bytes(std::span(log_magic));
  ops::Bytes out(magic.begin(), magic.end());
  ops::put_field(out, revision);
  chain = hash_bytes(out);
  ops::put_field(out, chain);
  return out;
}

std::optional<FileHeader> take_file_header(std::span<const std::byte> bytes) {
  ops::FieldReader in(bytes);
  const auto magic = in.take_bytes(sizeof log_magic);
  FileHeader header;
  in.take(header.revision);
  in.take(header.chain);
  if (!in.fits() || std::memcmp(magic.data(), log_magic, sizeof log_magic) != 0) return std::nullopt;
  if (hash_bytes(bytes.first(file_header_bytes - 8)) != header.chain) return std::nullopt;
  return header;
}

void put_chunk_header(ops::Bytes& out, ChunkHeader& header) {
  const size_t begin = out.size();
  const ChunkPlace& place = header.place;
  ops::put_field(out, place.stored_bytes);
  ops::put_field(out, place.raw_bytes);
  ops::put_field(out, place.first_tick);
  ops::put_field(out, place.ticks);
  ops::put_field(out, (place.has_key ? Flag::key : 0u) | (place.has_notes ? Flag::notes : 0u));
  ops::put_field(out, header.stored_checksum);
  header.chain = hash_bytes(std::span(out).subspan(begin), header.chain);
  ops::put_field(out, header.chain);
}

std::optional<ChunkHeader> take_chunk_header(std::span<const std::byte> bytes, uint64_t chain) {
  ops::FieldReader in(bytes);
  ChunkHeader header;
  uint32_t flags = 0;
  in.take(header.place.stored_bytes);
  in.take(header.place.raw_bytes);
  in.take(header.place.first_tick);
  in.take(header.place.ticks);
  in.take(flags);
  in.take(header.stored_checksum);
  in.take(header.chain);
  if (!in.fits() || hash_bytes(bytes.first(chunk_header_bytes - 8), chain) != header.chain)
    return std::nullopt;
  if (header.place.raw_bytes > max_raw_bytes) return std::nullopt;
  header.place.has_key = (flags & Flag::key) != 0;
  header.place.has_notes = (flags & Flag::notes) != 0;
  return header;
}

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
