#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace ream {

/// One thing wrong with a value: where (a JSON pointer, "#/force_scale") and what, for people.
struct SchemaFault {
  std::string pointer, detail;
};

/// One JSON schema (draft 2020-12, as far as ours use it), ready to check values. Thread-safe.
class JsonSchema {
 public:
  static constexpr size_t max_faults = 20;
  /// Of a value and all within it, with every alternative that is tried. What a request of 1 MB can hold
  /// takes a tenth of a second at most.
  static constexpr size_t max_steps = 1'000'000;

  /// `schema` may refer to `document` ("#/components/schemas/..."). Throws Error invalid_input for what is no
  /// schema. Keywords that are unknown mean nothing.
  JsonSchema(const nlohmann::json& schema, const nlohmann::json& document);
  ~JsonSchema();
  JsonSchema(JsonSchema&&) noexcept;

  /// What is wrong with a value, the first `max_faults` of it; empty when it fits. A value that takes more
  /// than `max_steps` does not fit. A list that is too long is not looked into, a text that is too long not
  /// held against its pattern.
  std::vector<SchemaFault> faults(const nlohmann::json& value) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace ream
