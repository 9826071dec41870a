#pragma once
#include <filesystem>
#include <vector>

#include "record/tick_report.hpp"

namespace ream::sim {

using record::TickTiming;

/// The last seconds of a loop, kept in a fixed ring for the case of a fault. The loop has one of its own,
/// which knows its last tick too and can be written once it has ended; who follows the loop may keep another
/// from the reports, to be written while it goes on. remember() may be called from the tick.
class BlackBox {
 public:
  explicit BlackBox(size_t ticks = 2000);

  void remember(const record::TickReport& report) noexcept;
  /// CSV, oldest tick first, with the trace's columns and the timing of each tick. Error io.
  void write(const std::filesystem::path& path) const;
  size_t size() const { return count_ < reports_.size() ? count_ : reports_.size(); }

 private:
  std::vector<record::TickReport> reports_;
  size_t count_ = 0;
};

}  // namespace ream::sim
