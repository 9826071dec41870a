#pragma once
#include <cstdint>

#include "record/tick_report.hpp"

namespace ream::score {

/// Counts episodes of contact with over 5 N; gaps of up to half a second do not part them (science 2.2).
class ContactPasses {
 public:
  /// Once a tick.
  void add(const record::TickReport& report);
  int count() const { return count_; }

 private:
  static constexpr int64_t gap_ticks = 500;

  int count_ = 0;
  int64_t ticks_since_ = gap_ticks + 1;  ///< with less force
};

}  // namespace ream::score
