#pragma once
#include <filesystem>
#include <string>

namespace ream::bench {

/// What scoring a session took, by the clock of the thread that scores where it says cpu.
struct ScoredReaming {
  double duration_s = 0.0;  ///< of the session
  double depth_mm = 0.0, removed_mm3 = 0.0;
  double live_cpu_s =
      0.0;  ///< metrics of every tick, of the bone, and as JSON, as a server keeps them up to date
  double measurement_ms = 0.0;  ///< of the bone, one while it goes on; the mean
  int measurements = 0;
  double native_ms = 0.0;  ///< measuring the untouched bone before the first tick
  double final_ms = 0.0;   ///< from the last tick until metrics.json is written
};

/// Somebody presses, lifts and presses again on a hard specimen, in virtual time; the session is left in
/// `data`, which has the thesis' case, under `id`, recording and all.
ScoredReaming ream_and_score(const std::filesystem::path& data, const std::string& id, double duration_s);

}  // namespace ream::bench
