#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "core/error.hpp"
#include "core/progress.hpp"
#include "record/recording.hpp"
#include "score/metrics.hpp"
#include "score/native_glenoid.hpp"

namespace ream::session {

/// Computes metrics.json anew from recordings. Keeps the case of the last one and what was measured of its
/// untouched bone, as many sessions are of one. Used by one thread.
class Rescorer {
 public:
  /// `case_name`: where the cases are, as for find_case(); empty: under the names that the recordings give.
  explicit Rescorer(std::filesystem::path data, std::string case_name = {})
      : data_(std::move(data)), case_name_(std::move(case_name)) {}

  /// The same bytes as when the session ended. Where the case cannot be had any more, what needs its bone is
  /// null, with the reason. Error invalid_input at damage that opening did not show.
  nlohmann::json metrics(const record::Recording& recording, const Progress& progress = no_progress);

 private:
  /// A case under a plan, with a reamer: all that sessions have in common that are scored alike.
  struct Start {
    std::string said;  ///< by the recordings, of plan, anatomy and reamer
    Pose world_from_plan;
    std::shared_ptr<const score::NativeGlenoid> glenoid;
    std::vector<uint8_t> coverage;  ///< its pilot hole cut; empty until it is needed
  };

  void load_case(const record::Recording& recording);
  void measure_start(const record::Recording& recording);
  void cut_start();
  score::MetricResults bone_results(const record::Recording& recording,
                                    const score::MetricsAccumulator& ticks) const;

  const std::filesystem::path data_;
  const std::string case_name_;
  std::optional<case_::Case> case_;  ///< of the last recording, its pilot hole not cut
  uint64_t case_hash_ = 0;
  std::optional<Start> start_;  ///< of case_
};

/// One of many sessions.
struct Rescored {
  std::string name;
  nlohmann::json metrics;                     ///< null with an error
  std::string error;                          ///< one line; empty: it could be scored
  ErrorKind kind = ErrorKind::invalid_input;  ///< of the error
};

/// Sessions by name, as recording_path() takes them, in their order. A session that cannot be scored does not
/// stop the others. Error cancelled (or what else `progress` throws) ends it.
std::vector<Rescored> rescore(std::span<const std::string> names, const std::string& case_name,
                              const std::filesystem::path& data, const Progress& progress);

/// Ids of all sessions of the data folder that have a recording, sorted.
std::vector<std::string> recorded_sessions(const std::filesystem::path& data);

}  // namespace ream::session
