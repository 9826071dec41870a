#pragma once
#include <nlohmann/json.hpp>

#include "case/case.hpp"
#include "record/recording.hpp"
#include "score/metrics.hpp"

namespace ream::app {

/// The case of a recording as far as its figures need it: grid and plan, no voxels. Errors: those of
/// load_case_description; conflict when the case has another grid than the one that was recorded.
case_::Case recorded_case_description(const record::Recording& recording, const std::filesystem::path& data);

/// All ticks of a recording, as the live session had added them up after the last of them. `bone_case`: with
/// the recording's grid; its plan is not used, the recorded one is. Error invalid_input for a damaged chunk.
score::MetricsAccumulator recorded_metrics(const record::Recording& recording, const case_::Case& bone_case);

/// What metrics.json is to hold about it.
nlohmann::json recorded_metrics_json(const record::Recording& recording, const case_::Case& bone_case);

/// The bone's hash after the last recorded tick, as the last checkpoint has it; empty when there is none.
std::optional<uint64_t> recorded_grid_hash(const record::Recording& recording);

}  // namespace ream::app
