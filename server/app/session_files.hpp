#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/rig.hpp"
#include "record/recorder.hpp"
#include "record/trace_csv.hpp"
#include "score/metrics.hpp"
#include "sim/haptic_loop.hpp"

namespace ream::app {

/// What a run leaves behind: follows the loop's reports into trace.csv and recording.ream and writes
/// metrics.json, timing.json and session.json at the end. Used by one follower thread.
class SessionFiles {
 public:
  /// Opens trace and recording in `folder`, which must exist. Error io.
  SessionFiles(const Rig& rig, const std::filesystem::path& folder);

  void add(const record::TickReport& report);
  score::Metrics metrics() const { return metrics_.metrics(); }

  struct Results {
    nlohmann::json metrics, timing;
  };
  /// Closes and writes everything; only after the loop has ended. `extra` is merged into session.json.
  Results finish(const sim::LoopHealth& health, const nlohmann::json& extra);

 private:
  const Rig& rig_;
  const std::filesystem::path folder_;
  const nlohmann::json description_;  ///< of the rig before the first tick
  record::TraceCsv trace_;
  record::Recorder recorder_;
  score::MetricsAccumulator metrics_;
};

}  // namespace ream::app
