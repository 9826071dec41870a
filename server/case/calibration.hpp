#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "case/case.hpp"

namespace ream::case_ {

/// `calibration` of case.json (proto/case.schema.json). Only intercept, slope and threshold are needed; the
/// rest of the chain is that of Calibration's defaults where it is not given. Error invalid_input names place
/// and key: slopes and ratio must be over 0, so that the chain can be inverted.
Calibration calibration_from_json(const nlohmann::json& value, const std::string& place);
nlohmann::json to_json(const Calibration& calibration);

}  // namespace ream::case_
