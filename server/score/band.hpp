#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "core/json_reader.hpp"

namespace ream::score {

/// Which values of a metric are good.
enum class Better { report_only, less, more, between };

/// Limits in the metric's unit. `less`: up to `pass` passes, up to `warn` warns, more fails; `more` the other
/// way round; `between`: from `low` to `pass` passes, all else warns.
struct Band {
  Better better = Better::report_only;
  double pass = 0.0, warn = 0.0, low = 0.0;
};

enum class Verdict { pass, warn, fail };

/// Empty for a band that is only reported.
std::optional<Verdict> verdict(const Band& band, double value);
/// "pass", "warn", "fail".
std::string_view to_text(Verdict verdict);
/// "report only", "less", "more", "between".
std::string_view to_text(Better better);

/// {"better": "less" or "more", "pass", "warn"}, {"better": "between", "low", "pass"} or {"better": "report
/// only"}.
nlohmann::json band_json(const Band& band);
/// Back again; not of a band that is only reported. Error invalid_input names place and key; limits must
/// stand in the order that `better` asks for.
Band band_from_json(JsonReader reader);

}  // namespace ream::score
