#pragma once
#include <nlohmann/json_fwd.hpp>

#include "core/json_reader.hpp"
#include "score/metric_catalogue.hpp"

namespace ream::score {

/// {"better": "less" or "more", "pass", "warn"}, {"better": "between", "low", "pass"} or {"better": "report
/// only"}.
nlohmann::json band_json(const Band& band);
/// Back again; not of a band that is only reported. Error invalid_input names place and key; limits must
/// stand in the order that `better` asks for.
Band band_from_json(JsonReader reader);

}  // namespace ream::score
