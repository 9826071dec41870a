#pragma once
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/json_schema.hpp"
#include "net/message.hpp"

namespace ream::api {

/// What openapi.yaml asks of requests, enforced in one place before any handler. Thread-safe.
class Contract {
 public:
  /// `yaml`: the whole description. Throws Error invalid_input.
  explicit Contract(const std::string& yaml);

  /// `pattern`: of the route. Paths that are not described pass. RequestErrors: 404 for a path that names
  /// nothing; 400 for a query that lacks something, or a body that is no JSON; 415 for a body of another
  /// type; 422 for a query or body that does not fit, with the places at fault. Sets Request::json.
  void check(net::Request& request, const std::string& pattern) const;

  /// Whether repeating a request there with the same Idempotency-Key gives the same answer.
  bool takes_idempotency_key(const std::string& method, const std::string& pattern) const;

 private:
  struct Parameter {
    std::string name;
    bool in_path = false, required = false, is_text = true;
    JsonSchema schema;
  };
  struct Operation {
    std::vector<Parameter> parameters;
    std::optional<JsonSchema> body;  ///< none: not JSON
    bool body_required = false, idempotency_key = false;
  };
  using Operations = std::map<std::pair<std::string, std::string>, Operation>;  ///< by method and pattern

  static Operation operation_of(const nlohmann::json& item, const nlohmann::json& operation,
                                const nlohmann::json& document);
  static void add_parameter(const nlohmann::json& parameter, const nlohmann::json& document, Operation& to);
  const Operation* find(const std::string& method, const std::string& pattern) const;
  static void check_path(const Operation& operation, const net::Request& request);
  static void check_query(const Operation& operation, const net::Request& request);

  Operations operations_;
};

}  // namespace ream::api
