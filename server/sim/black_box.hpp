#pragma once
#include <filesystem>
#include <vector>

#include "record/tick_report.hpp"

namespace ream::sim {

/// When a tick began and how long its parts took, us.
struct TickTiming {
  double lateness_us = 0.0, read_us = 0.0, step_us = 0.0, write_us = 0.0;
};

/// The last seconds of the loop, kept in a fixed ring for the case of a fault. remember() is called from the
/// tick; write() after the loop has ended.
class BlackBox {
 public:
  explicit BlackBox(size_t ticks = 2000);

  void remember(const record::TickReport& report, const TickTiming& timing) noexcept;
  /// CSV, oldest tick first, with the trace's columns and the timing of each tick. Error io.
  void write(const std::filesystem::path& path) const;
  size_t size() const { return count_ < entries_.size() ? count_ : entries_.size(); }

 private:
  struct Entry {
    record::TickReport report;
    TickTiming timing;
  };
  std::vector<Entry> entries_;
  size_t count_ = 0;
};

}  // namespace ream::sim
