#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "net/problem.hpp"

namespace ream::api {

/// One JSON schema of openapi.yaml, ready to check values. Thread-safe.
class Schema {
 public:
  /// `schema` may refer to `document` ("#/components/schemas/..."). Throws Error invalid_input for what is no
  /// schema.
  Schema(const nlohmann::json& schema, const nlohmann::json& document);
  ~Schema();
  Schema(Schema&&) noexcept;

  /// What is wrong with a value, each with its place ("#/place_mm/2") and words for people; empty when it
  /// fits.
  std::vector<net::FieldError> faults(const nlohmann::json& value) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace ream::api
