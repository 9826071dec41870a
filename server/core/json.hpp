#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

/// Compiled once, in json.cpp: nlohmann's class takes each source that uses it a tenth of its compile time.
extern template class nlohmann::basic_json<>;

namespace ream {

/// How deep lists and objects may stand in each other in JSON from outside: copies, comparisons and the end
/// of a value go one level down the stack for each.
inline constexpr size_t max_json_depth = 32;

/// What a text says as JSON, wherever it comes from. Throws Error invalid_input with words that go on from
/// its name ("is not valid JSON: ..."): no JSON, nested too deep, a number too large, a key twice in one
/// object.
nlohmann::json parse_json(std::string_view text);
/// The same; a discarded value where parse_json throws.
nlohmann::json parse_json_or_discard(std::string_view text);

/// Null for what is not there.
template <typename T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}
/// Null for an empty text.
inline nlohmann::json or_null(std::string_view text) {
  return text.empty() ? nlohmann::json(nullptr) : nlohmann::json(text);
}

}  // namespace ream
