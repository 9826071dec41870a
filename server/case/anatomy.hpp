#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "case/case.hpp"
#include "case/landmarks.hpp"

namespace ream::case_ {

/// What a case says of the shoulder beside its bone: what directions and angles are measured against.
struct Anatomy {
  Side side = Side::right;
  std::optional<Landmarks> landmarks;
  std::optional<GlenoidFrame> glenoid;
};

/// Of a case and its folder. Errors: those of load_landmarks.
Anatomy anatomy_of(const Case& c, const std::filesystem::path& case_folder);

/// As recordings keep it. Error invalid_input names place and key.
Anatomy anatomy_from_json(const nlohmann::json& value, const std::string& place);
nlohmann::json to_json(const Anatomy& anatomy);

}  // namespace ream::case_
