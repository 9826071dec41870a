#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace ream::score {

/// What a session says, metric by metric, and why it does not say the others. Never holds a number that is
/// not finite. Numbers are rounded to 1e-6 of their unit, so that rounding of the computation does not show.
class Findings {
 public:
  /// `key` of the catalogue.
  void say(std::string_view key, double value);
  /// The reason is one sentence without a full stop.
  void leave(std::string_view key, std::string_view reason);
  void say_or_leave(std::string_view key, const std::optional<double>& value, std::string_view reason);
  /// Takes over what `other` says; where both say something, other's.
  void take(const Findings& other);

  std::optional<double> said(std::string_view key) const;
  /// Empty text: it was said, or nothing is known of it.
  std::string unsaid(std::string_view key) const;

  /// Writes every metric of the catalogue that `metrics` does not have yet: its number, or null. Those that
  /// are null, old or new, get their reasons in metrics["unsaid"].
  void write_to(nlohmann::json& metrics) const;

 private:
  std::map<std::string, double, std::less<>> said_;
  std::map<std::string, std::string, std::less<>> unsaid_;
};

}  // namespace ream::score
