#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "case/case.hpp"

namespace ream::workup {

/// Whether a folder holds a case, built or still only a CT.
bool is_case_folder(const std::filesystem::path& folder);

/// A case in a list, and all of it, from what lies in its folder. Errors: those of reading the folder.
nlohmann::json case_summary_json(const std::filesystem::path& folder);
nlohmann::json case_json(const std::filesystem::path& folder);

/// As plan.json, with null for what it lacks.
nlohmann::json plan_json(const case_::Plan& plan);

}  // namespace ream::workup
