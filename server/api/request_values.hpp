#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "geometry/vec.hpp"
#include "net/message.hpp"

namespace ream::api {

// What handlers read of a request, which the contract has checked (request_contract.hpp).

/// The part {id} of a route's path.
inline const std::string& id_of(const net::Request& request) { return request.parameters.at("id"); }

/// The JSON body; an empty object where none was sent.
const nlohmann::json& body_of(const net::Request& request);

/// A value of the query; `otherwise` when it is absent.
std::string query_text(const net::Request& request, const std::string& name,
                       const std::string& otherwise = {});
double query_number(const net::Request& request, const std::string& name, double otherwise);

/// A value of a body; none when it is absent.
template <typename Value>
std::optional<Value> optional_in(const nlohmann::json& body, const char* key) {
  const auto found = body.find(key);
  return found == body.end() ? std::nullopt : std::optional(found->get<Value>());
}
/// A text of a body; empty when it is absent.
inline std::string text_in(const nlohmann::json& body, const char* key) {
  return body.value(key, std::string());
}
/// A list of texts; empty when it is absent. RequestError 422 when one comes twice: schemas of the contract
/// do not say "uniqueItems", which compares every item of a list of any length with every other.
std::vector<std::string> different_texts_in(const nlohmann::json& body, const char* key);
/// Three numbers; none when they are absent or null.
std::optional<Vec3> point_in(const nlohmann::json& body, const char* key);

}  // namespace ream::api
