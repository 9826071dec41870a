#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/progress.hpp"

namespace ream::session {

/// Computes metrics.json anew from what lies in a session's folder. Errors: those of the recording;
/// cancelled. Used by one thread; keeps the case of the last session, as many are of one.
using Measure = std::function<nlohmann::json(const std::filesystem::path& folder, const Progress& progress)>;

/// What scores need of the program around.
struct ScoreMakers {
  std::string scored_by = "ream";  ///< program and version
  std::function<Measure()> make_measure;
  /// Writes the deviations of the surface that a session left (score/deviation_file.hpp). Errors: those of
  /// the recording and its case; io; cancelled.
  std::function<void(const std::filesystem::path& folder, const std::filesystem::path& json,
                     const Progress& progress)>
      write_deviation;
};

/// How a server scores the sessions of a data folder.
ScoreMakers score_makers(const std::filesystem::path& data);

}  // namespace ream::session
