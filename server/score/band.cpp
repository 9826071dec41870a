#include "score/band.hpp"

#include <nlohmann/json.hpp>

namespace ream::score {
using nlohmann::json;

std::optional<Verdict> verdict(const Band& band, double value) {
  switch (band.better) {
    case Better::report_only: return std::nullopt;
    case Better::less:
      return value <= band.pass ? Verdict::pass : value <= band.warn ? Verdict::warn : Verdict::fail;
    case Better::more:
      return value >= band.pass ? Verdict::pass : value >= band.warn ? Verdict::warn : Verdict::fail;
    case Better::between: return value >= band.low && value <= band.pass ? Verdict::pass : Verdict::warn;
  }
  return std::nullopt;
}

std::string_view to_text(Verdict verdict) {
  constexpr std::string_view texts[] = {"pass", "warn", "fail"};
  return texts[static_cast<size_t>(verdict)];
}

std::string_view to_text(Better better) {
  constexpr std::string_view texts[] = {"report only", "less", "more", "between"};
  return texts[static_cast<size_t>(better)];
}

json band_json(const Band& band) {
  json value = {{"better", to_text(band.better)}};
  if (band.better == Better::report_only) return value;
  value["pass"] = band.pass;
  if (band.better == Better::between)
    value["low"] = band.low;
  else
    value["warn"] = band.warn;
  return value;
}

Band band_from_json(JsonReader reader) {
  Band band;
  const std::string better = reader.text("better");
  for (const Better each : {Better::less, Better::more, Better::between})
    if (better == to_text(each)) band.better = each;
  if (band.better == Better::report_only) reader.refuse("better", "must be less, more or between");
  band.pass = reader.number("pass");
  if (band.better == Better::between) {
    band.low = reader.number("low");
    band.warn = band.pass;
    if (band.low >= band.pass) reader.refuse("low", "must be below pass");
  } else {
    band.warn = reader.number("warn");
    const bool ordered = band.better == Better::less ? band.warn >= band.pass : band.warn <= band.pass;
    if (!ordered) reader.refuse("warn", "must not be better than pass");
  }
  reader.finish();
  return band;
}

}  // namespace ream::score
