#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "ct/workup.hpp"

namespace ream::ct {

/// ct.json (proto/ct.schema.json).
nlohmann::json to_json(const Workup& workup);
/// Error invalid_input naming `place` and key.
Workup workup_from_json(const nlohmann::json& value, const std::string& place);

/// Keys threshold_hu, sigma_mm, separate, fill_holes and seeds {scapula, humerus, clavicle}, all optional.
/// The side is the case's and no key.
nlohmann::json to_json(const SegmentationSettings& settings);
SegmentationSettings segmentation_settings_from_json(const nlohmann::json& value, const std::string& place);

/// Keys upsample, roi ("glenoid" or "whole") and cartilage_mm, all optional.
nlohmann::json to_json(const BuildSettings& settings);
BuildSettings build_settings_from_json(const nlohmann::json& value, const std::string& place);

nlohmann::json to_json(const BonePart& part);

}  // namespace ream::ct
