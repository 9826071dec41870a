#include "record/recorder.hpp"

#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/file.hpp"
#include "core/hash.hpp"

namespace ream::record {
namespace {

constexpr char magic[8] = {'r', 'e', 'a', 'm', 'r', 'e', 'c', '1'};
/// After the magic number: how long the header's JSON is, and its checksum.
struct FileHeader {
  uint64_t text_bytes = 0, checksum = 0;
};

constexpr uint32_t ticks_per_chunk = 1000;
constexpr size_t words_per_tick = 2 + 12 + 12 + 2;  ///< tick, flags, two poses, hash in two halves
constexpr uint32_t largest_chunk = 64u << 20;

/// Precedes each chunk; the checksum is over the stored (compressed) bytes.
struct ChunkHeader {
  uint32_t stored_bytes = 0, raw_bytes = 0;
  uint64_t checksum = 0;
};

void put(std::vector<std::byte>& out, uint32_t word) {
  for (int k = 0; k < 4; ++k) out.push_back(static_cast<std::byte>(word >> (8 * k)));
}

void put(std::vector<std::byte>& out, const QuantisedPose& pose) {
  for (const int32_t q : pose.rotation_q30) put(out, static_cast<uint32_t>(q));
  for (const int32_t q : pose.translation_nm) put(out, static_cast<uint32_t>(q));
}

uint32_t take(const std::byte*& in) {
  uint32_t word = 0;
  for (int k = 0; k < 4; ++k) word |= std::to_integer<uint32_t>(*in++) << (8 * k);
  return word;
}

QuantisedPose take_pose(const std::byte*& in) {
  QuantisedPose pose;
  for (int32_t& q : pose.rotation_q30) q = static_cast<int32_t>(take(in));
  for (int32_t& q : pose.translation_nm) q = static_cast<int32_t>(take(in));
  return pose;
}

std::vector<std::byte> compressed(const std::vector<std::byte>& raw) {
  std::vector<std::byte> out(ZSTD_compressBound(raw.size()));
  out.resize(ZSTD_compress(out.data(), out.size(), raw.data(), raw.size(), 1));
  return out;
}

void append_ticks(const std::vector<std::byte>& raw, std::vector<RecordedTick>& ticks) {
  const std::byte* in = raw.data();
  for (size_t i = 0; i < raw.size() / (4 * words_per_tick); ++i) {
    RecordedTick t;
    t.tick = take(in);
    const uint32_t flags = take(in);
    t.spindle_on = (flags & 1) != 0;
    t.paused = (flags & 2) != 0;
    t.failed_over = (flags & 4) != 0;
    t.world_from_handle = take_pose(in);
    t.grid_from_tool = take_pose(in);
    const uint32_t low = take(in);
    t.session_hash = low | static_cast<uint64_t>(take(in)) << 32;
    ticks.push_back(t);
  }
}

/// Takes the header's JSON and returns where the chunks begin.
size_t read_header(const std::vector<std::byte>& bytes, const std::filesystem::path& path,
                   std::string& json) {
  FileHeader header;
  const size_t fixed = sizeof magic + sizeof header;
  if (bytes.size() < sizeof magic || std::memcmp(bytes.data(), magic, sizeof magic) != 0)
    throw Error(ErrorKind::invalid_input, path.string() + " is not a recording of this program");
  if (bytes.size() >= fixed) std::memcpy(&header, bytes.data() + sizeof magic, sizeof header);
  if (bytes.size() < fixed || header.text_bytes > bytes.size() - fixed)
    throw Error(ErrorKind::invalid_input, path.string() + " ends inside its header; the recording is lost");
  json.assign(reinterpret_cast<const char*>(bytes.data()) + fixed, header.text_bytes);
  if (hash_text(json) != header.checksum)
    throw Error(ErrorKind::invalid_input, path.string() + " is damaged in its header; the recording is lost");
  return fixed + json.size();
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& path, const nlohmann::json& header) : path_(path) {
  file_ = std::fopen(path.c_str(), "wb");
  if (file_ == nullptr)
    throw Error(ErrorKind::io, "cannot write " + path.string() + ": " + std::strerror(errno));
  const std::string text = header.dump();
  const FileHeader fixed{text.size(), hash_text(text)};
  write_all(magic, sizeof magic);
  write_all(&fixed, sizeof fixed);
  write_all(text.data(), text.size());
}

Recorder::~Recorder() {
  if (file_ != nullptr) std::fclose(file_);
}

void Recorder::add(const TickReport& report) {
  put(pending_, report.tick);
  put(pending_, static_cast<uint32_t>(report.spindle_on) | static_cast<uint32_t>(report.paused) << 1 |
                    static_cast<uint32_t>(report.failed_over) << 2);
  put(pending_, report.world_from_handle_q);
  put(pending_, report.grid_from_tool);
  put(pending_, static_cast<uint32_t>(report.session_hash));
  put(pending_, static_cast<uint32_t>(report.session_hash >> 32));
  if (++pending_ticks_ == ticks_per_chunk) write_chunk();
}

void Recorder::finish() {
  if (pending_ticks_ > 0) write_chunk();
  if (std::fflush(file_) != 0 || ::fsync(fileno(file_)) != 0)
    throw Error(ErrorKind::io, "cannot write " + path_.string() + ": " + std::strerror(errno));
}

void Recorder::write_chunk() {
  const std::vector<std::byte> stored = compressed(pending_);
  const ChunkHeader header{static_cast<uint32_t>(stored.size()), static_cast<uint32_t>(pending_.size()),
                           hash_bytes(stored)};
  write_all(&header, sizeof header);
  write_all(stored.data(), stored.size());
  if (std::fflush(file_) != 0)
    throw Error(ErrorKind::io, "cannot write " + path_.string() + ": " + std::strerror(errno));
  pending_.clear();
  pending_ticks_ = 0;
}

void Recorder::write_all(const void* data, size_t size) {
  if (std::fwrite(data, 1, size, file_) != size)
    throw Error(ErrorKind::io, "cannot write " + path_.string() + ": " + std::strerror(errno));
}

Recording read_recording(const std::filesystem::path& path) {
  const std::vector<std::byte> bytes = read_binary_file(path);
  Recording recording;
  size_t at = read_header(bytes, path, recording.header_json);
  ChunkHeader header;
  while (bytes.size() - at >= sizeof header) {
    std::memcpy(&header, bytes.data() + at, sizeof header);
    const std::span<const std::byte> stored(
        bytes.data() + at + sizeof header,
        std::min<size_t>(header.stored_bytes, bytes.size() - at - sizeof header));
    if (stored.size() != header.stored_bytes || header.raw_bytes > largest_chunk ||
        hash_bytes(stored) != header.checksum)
      break;
    std::vector<std::byte> raw(header.raw_bytes);
    if (ZSTD_decompress(raw.data(), raw.size(), stored.data(), stored.size()) != raw.size()) break;
    append_ticks(raw, recording.ticks);
    at += sizeof header + stored.size();
  }
  recording.complete = at == bytes.size();
  return recording;
}

}  // namespace ream::record
