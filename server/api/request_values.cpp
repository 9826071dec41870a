#include "api/request_values.hpp"

#include <set>

#include "core/text.hpp"
#include "net/problem.hpp"

namespace ream::api {
using nlohmann::json;

const json& body_of(const net::Request& request) {
  static const json nothing = json::object();
  return request.json ? *request.json : nothing;
}

std::string query_text(const net::Request& request, const std::string& name, const std::string& otherwise) {
  const auto given = request.query.find(name);
  return given == request.query.end() ? otherwise : given->second;
}

double query_number(const net::Request& request, const std::string& name, double otherwise) {
  const std::string given = query_text(request, name);
  return given.empty() ? otherwise : parse_json(given).get<double>();
}

std::vector<std::string> different_texts_in(const json& body, const char* key) {
  auto texts = optional_in<std::vector<std::string>>(body, key).value_or(std::vector<std::string>());
  if (std::set<std::string>(texts.begin(), texts.end()).size() == texts.size()) return texts;
  const std::string fault = "'" + std::string(key) + "' must be a list of different items";
  throw net::RequestError(422, "the request body cannot be used: " + fault, {{pointer_to(key), fault}});
}

std::optional<Vec3> point_in(const json& body, const char* key) {
  const json point = body.value(key, json());
  if (point.is_null()) return std::nullopt;
  return Vec3(point[0].get<double>(), point[1].get<double>(), point[2].get<double>());
}

}  // namespace ream::api
