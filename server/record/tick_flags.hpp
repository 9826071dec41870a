#pragma once
#include <cstdint>

namespace ream::record {

/// Bits of ops::Tick::flags; proto/recording.json names them.
enum TickFlag : uint32_t {
  spindle_on_flag = 1,
  paused_flag = 2,
  failed_over_flag = 4,
  engaged_flag = 8,
  cutting_flag = 16,
  weakened_flag = 32,
  stale_flag = 64
};

}  // namespace ream::record
