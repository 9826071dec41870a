#include "record/old_log.hpp"

#include <charconv>
#include <nlohmann/json.hpp>

#include "core/hash.hpp"

namespace ream::record {
namespace {

constexpr uint32_t old_revision = 1;
constexpr size_t text_header_bytes = sizeof old_magic + 2 * 8, old_chunk_header_bytes = 2 * 4 + 8;
constexpr size_t old_tick_bytes = 4 * (2 + 12 + 12 + 2);
constexpr uint32_t largest_old_raw_bytes = 64u << 20;

std::string text_or_empty(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

uint64_t hash_or_zero(const nlohmann::json& object, const char* key) {
  const std::string hex = text_or_empty(object, key);
  uint64_t value = 0;
  const auto [end, error] = std::from_chars(hex.data(), hex.data() + hex.size(), value, 16);
  return error == std::errc() && end == hex.data() + hex.size() ? value : 0;
}

ops::Tick take_old_tick(ops::FieldReader& in) {
  ops::Tick tick;
  in.take(tick.tick);
  in.take(tick.flags);
  in.take(tick.world_from_handle);
  in.take(tick.grid_from_tool);
  in.take(tick.session_hash);
  return tick;
}

/// The chunk of ticks that begins at `at`; empty when none is whole there.
std::optional<OldChunk> old_chunk_at(std::span<const std::byte> bytes, size_t at) {
  ops::FieldReader in(bytes.subspan(at));
  OldChunk chunk;
  in.take(chunk.place.stored_bytes);
  in.take(chunk.place.raw_bytes);
  in.take(chunk.checksum);
  const auto stored = in.take_bytes(chunk.place.stored_bytes);
  if (!in.fits() || chunk.place.raw_bytes > largest_old_raw_bytes || hash_bytes(stored) != chunk.checksum)
    return std::nullopt;
  const auto raw = decompressed(stored, chunk.place.raw_bytes);
  if (!raw || raw->empty() || raw->size() % old_tick_bytes != 0) return std::nullopt;
  ops::FieldReader ticks(*raw);
  chunk.place.offset = at;
  chunk.place.first_tick = take_old_tick(ticks).tick;
  chunk.place.ticks = static_cast<uint32_t>(raw->size() / old_tick_bytes);
  chunk.stored_at = at + old_chunk_header_bytes;
  return chunk;
}

}  // namespace

std::vector<OldChunk> old_chunks(std::span<const std::byte> bytes) {
  std::vector<OldChunk> chunks;
  ops::FieldReader in(bytes);
  uint64_t text_bytes = 0;
  OldChunk first;
  in.take_bytes(sizeof old_magic);
  in.take(text_bytes);
  in.take(first.checksum);
  const auto text = in.take_bytes(text_bytes);
  if (!in.fits() || text.size() > largest_old_raw_bytes || hash_bytes(text) != first.checksum) return chunks;
  first.place.stored_bytes = first.place.raw_bytes = static_cast<uint32_t>(text.size());
  first.place.has_notes = true;
  first.stored_at = text_header_bytes;
  size_t at = text_header_bytes + text.size();
  for (std::optional<OldChunk> chunk = first; chunk; chunk = old_chunk_at(bytes, at)) {
    chunks.push_back(*chunk);
    at = chunk->stored_at + chunk->place.stored_bytes;
  }
  return chunks;
}

ops::Bytes ops_of_old_text(std::span<const std::byte> text) {
  ops::Header header;
  header.description.assign(reinterpret_cast<const char*>(text.data()), text.size());
  ops::Segment segment;
  segment.reason = "start";
  const auto json = nlohmann::json::parse(header.description, nullptr, false);
  if (json.is_object()) {
    header.build = text_or_empty(json, "build");
    header.case_id = text_or_empty(json, "case");
    header.start_grid_hash = hash_or_zero(json, "start_grid_hash");
    const auto seed = json.find("random_seed");
    if (seed != json.end() && seed->is_number_unsigned()) header.random_seed = seed->get<uint64_t>();
    const auto scale = json.find("force_scale");
    if (scale != json.end() && scale->is_number()) header.force_scale = scale->get<double>();
    segment.tool = text_or_empty(json, "tool");
    segment.backend = text_or_empty(json, "backend");
  }
  ops::Bytes out;
  ops::put(out, header, old_revision);
  ops::put(out, segment, old_revision);
  return out;
}

std::optional<ops::Bytes> ops_of_old_ticks(std::span<const std::byte> stored, uint32_t raw_bytes) {
  const auto raw = decompressed(stored, raw_bytes);
  if (!raw) return std::nullopt;
  std::vector<ops::Tick> ticks;
  for (ops::FieldReader in(*raw); in.rest().size() >= old_tick_bytes;) ticks.push_back(take_old_tick(in));
  ops::Bytes out;
  ops::put_rows<ops::Tick>(out, ticks, old_revision);
  return out;
}

}  // namespace ream::record
