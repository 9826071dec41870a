#pragma once
#include <cstdio>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "record/tick_report.hpp"

namespace ream::record {

/// Writes recording.ream: a JSON header (what was simulated, by which build) and, in chunks of one second,
/// the cause of every tick (handle pose and buttons as they were used, the decided tool pose) with the
/// rolling hash. Each chunk is zstd with length and checksum and is flushed whole, so that a killed process
/// loses at most the last second. The file format is not yet promised. Used by one follower thread, never by
/// the tick.
class Recorder {
 public:
  /// Throws Error io when the file cannot be created.
  Recorder(const std::filesystem::path& path, const nlohmann::json& header);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Throws Error io when the disk is full.
  void add(const TickReport& report);
  /// Writes what is pending and fsyncs. Called once at the end.
  void finish();

 private:
  void write_chunk();
  void write_all(const void* data, size_t size);

  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
  std::vector<std::byte> pending_;
  uint32_t pending_ticks_ = 0;
};

/// One tick as it was recorded.
struct RecordedTick {
  uint32_t tick = 0;
  bool spindle_on = false, paused = false;
  bool failed_over = false;  ///< no cause: the same poses without the failure give the same hash
  QuantisedPose world_from_handle, grid_from_tool;
  uint64_t session_hash = 0;
};

/// A recording read back; stops at the last whole chunk and says in `complete` whether that was the end of
/// the file.
struct Recording {
  std::string header_json;
  std::vector<RecordedTick> ticks;
  bool complete = false;
};

/// Error invalid_input when the file is no recording or its header is damaged; a damaged tail only clears
/// `complete`.
Recording read_recording(const std::filesystem::path& path);

}  // namespace ream::record
