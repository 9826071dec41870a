#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace ream::report {

/// A number with so many decimals, a true minus sign, and never "-0.0".
std::string decimal(double value, int decimals);

/// With as few decimals as it needs: "5", "0.5", "2.25".
std::string shortest(double value);

/// A value of a metric in the precision that its unit deserves, with its unit: "1.2 mm", "90 %", "12.0°".
/// `unit` as the catalogue of metrics has it.
std::string with_unit(double value, std::string_view unit);

/// The unit as it is printed: "mm³", "°".
std::string printed_unit(std::string_view unit);

/// "83 s", "2 min 05 s".
std::string duration_text(double seconds);

/// "2026-01-31T12:00:00Z" as "31 January 2026, 12:00 UTC"; other words as they are.
std::string date_text(const std::string& utc);

}  // namespace ream::report
