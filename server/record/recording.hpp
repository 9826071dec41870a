#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "record/op_log.hpp"
#include "record/tick_report.hpp"
#include "voxel/voxel_grid.hpp"

namespace ream::record {

/// A tick as it is kept: what TickReport says in the precision of the log. Whoever scores, shows or exports
/// takes as_recorded(report), so that a live session and its recording give the same bytes.
ops::Tick tick_op(const TickReport& report);
/// `world_from_grid`: of the case, with the bone at rest.
TickReport report_of(const ops::Tick& tick, const Pose& world_from_grid);
TickReport as_recorded(const TickReport& report, const Pose& world_from_grid);

/// A recording.ream opened for reading: its notes in memory, its ticks read as they are asked for.
class Recording {
 public:
  /// Whether chunks are read when they are needed, or all of them now.
  enum class Trust { until_read, checked };

  /// Errors: those of OpLogReader; invalid_input when there is no header. What is damaged further on is left
  /// out and said in log().damage().
  explicit Recording(const std::filesystem::path& path, Trust trust = Trust::until_read);

  const ops::Header& header() const { return header_; }
  /// Of the bone at rest. Error invalid_input in recordings that do not say it.
  voxel::VoxelGrid grid() const;
  const std::vector<ops::Segment>& segments() const { return segments_; }  ///< the first begins at tick 0
  const std::vector<ops::Event>& events() const { return events_; }
  const std::vector<ops::Annotation>& annotations() const { return annotations_; }
  const std::optional<ops::End>& end() const { return end_; }  ///< empty: it was never closed
  uint32_t tick_count() const { return tick_count_; }
  const OpLogReader& log() const { return log_; }

  /// Calls `told` with ticks first..last-1 (of those there are), in order.
  /// Error invalid_input at the first damaged chunk; ticks before it have been told.
  void for_each_tick(uint32_t first, uint32_t last, const std::function<void(const ops::Tick&)>& visit) const;
  std::vector<ops::Tick> ticks(uint32_t first, uint32_t last) const;
  /// Of the chunk that holds the tick; the last chunk with ticks for ticks beyond it.
  size_t chunk_of(uint32_t tick) const;
  /// The last one; empty without any (reads chunks from the end until it is found).
  std::optional<ops::Checkpoint> last_checkpoint() const;
  /// All checkpoints, in order (reads the whole file).
  std::vector<ops::Checkpoint> checkpoints() const;

 private:
  void read_notes();
  /// The ticks of chunk `i`. Error invalid_input when they are not those that its header announces.
  std::vector<ops::Tick> rows_of(size_t i) const;

  OpLogReader log_;
  ops::Header header_;
  std::vector<ops::Segment> segments_;
  std::vector<ops::Event> events_;
  std::vector<ops::Annotation> annotations_;
  std::optional<ops::End> end_;
  std::vector<size_t> tick_chunks_;  ///< chunks with ticks
  uint32_t tick_count_ = 0;
};

/// A grid as JSON text, to the bit.
std::string grid_to_text(const voxel::VoxelGrid& grid);
/// Error invalid_input naming what is missing, or as voxel::validate().
voxel::VoxelGrid grid_from_text(const std::string& text);

}  // namespace ream::record
