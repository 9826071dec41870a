#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace ream::bench {

inline constexpr const char* thesis_case = "thesis-5-4-2";

/// The bench case thesis-5-4-2, with the thesis' reamer, in a data folder.
void keep_thesis_case(const std::filesystem::path& data);

/// A script: press with `press_n`, lift for a look, press again every five seconds; the last press lasts to
/// the end. `specimen_factor`: of the feed.
nlohmann::json pecking(double duration_s, double press_n, double specimen_factor = 1.0);

}  // namespace ream::bench
