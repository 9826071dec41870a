#include "api/request_contract.hpp"

#include <algorithm>

#include "api/yaml_json.hpp"
#include "core/json.hpp"
#include "net/problem.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

const json& resolved(const json& part, const json& document) {
  if (!part.contains("$ref")) return part;
  return document.at(json::json_pointer(part.at("$ref").get<std::string>().substr(1)));
}

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

bool takes_text(const json& schema, const json& document) {
  const json type = resolved(schema, document).value("type", json("string"));
  return type != "integer" && type != "number" && type != "boolean";
}

/// A parameter arrives as text; what is no JSON stays one and does not fit.
json value_of(const std::string& text, bool is_text) {
  json value = is_text ? json(text) : parse_json_or_discard(text);
  return value.is_discarded() ? json(text) : value;
}

json json_in(const net::Request& request) {
  const std::string_view type = request.header("content-type");
  if (type.substr(0, type.find(';')) != "application/json")
    throw net::RequestError(415, "the request body must be sent as application/json");
  try {
    return parse_json(request.body);
  } catch (const Error& fault) {
    throw net::RequestError(400, std::string("the request body ") + fault.what());
  }
}

[[noreturn]] void refuse(const std::string& what, std::vector<net::FieldError> faults) {
  if (faults.size() > JsonSchema::max_faults) faults.resize(JsonSchema::max_faults);
  std::string detail = what + " cannot be used: ";
  for (size_t i = 0; i < faults.size(); ++i) detail += (i > 0 ? "; " : "") + faults[i].detail;
  throw net::RequestError(422, detail, faults);
}

/// Words about a parameter in place of those about a whole value.
net::FieldError about(const std::string& name, const net::FieldError& fault) {
  std::string words = fault.detail;
  if (words.starts_with("it ")) words = words.substr(3);
  return {"?" + name, "'" + name + "' " + words};
}

}  // namespace

Contract::Contract(const std::string& yaml) {
  const json document = json_from_yaml(yaml);
  for (const auto& [path, item] : document.at("paths").items())
    for (const auto& [verb, operation] : item.items())
      if (verb != "parameters")
        operations_.emplace(std::pair(upper(verb), path), operation_of(item, operation, document));
}

Contract::Operation Contract::operation_of(const json& item, const json& operation, const json& document) {
  Operation made;
  for (const json* part : {&item, &operation})
    for (const json& parameter : part->value("parameters", json::array()))
      add_parameter(resolved(parameter, document), document, made);
  if (!operation.contains("requestBody")) return made;
  const json& body = resolved(operation["requestBody"], document);
  const json& content = body.at("content");
  if (!content.contains("application/json")) return made;
  made.body.emplace(content["application/json"].at("schema"), document);
  made.body_required = body.value("required", false);
  return made;
}

void Contract::add_parameter(const json& parameter, const json& document, Operation& to) {
  const std::string name = parameter.at("name"), in = parameter.at("in");
  to.idempotency_key |= in == "header" && name == "Idempotency-Key";
  if (in != "path" && in != "query") return;
  const json& schema = parameter.at("schema");
  to.parameters.push_back({name, in == "path", parameter.value("required", false),
                           takes_text(schema, document), JsonSchema(schema, document)});
}

const Contract::Operation* Contract::find(const std::string& method, const std::string& pattern) const {
  const auto found = operations_.find({method == "HEAD" ? "GET" : method, pattern});
  return found == operations_.end() ? nullptr : &found->second;
}

bool Contract::takes_idempotency_key(const std::string& method, const std::string& pattern) const {
  const Operation* operation = find(method, pattern);
  return operation != nullptr && operation->idempotency_key;
}

void Contract::check_path(const Operation& operation, const net::Request& request) {
  for (const Parameter& parameter : operation.parameters) {
    if (!parameter.in_path) continue;
    const std::string& text = request.parameters.at(parameter.name);
    if (!parameter.schema.faults(value_of(text, parameter.is_text)).empty())
      throw Error(ErrorKind::not_found, "nothing is served at " + request.path);
  }
}

/// Unknown names are refused where there are known ones, so that a mistyped filter is not passed over.
void Contract::check_query(const Operation& operation, const net::Request& request) {
  std::vector<net::FieldError> faults;
  size_t known = 0, given = 0;
  for (const Parameter& parameter : operation.parameters) {
    if (parameter.in_path) continue;
    ++known;
    const auto value = request.query.find(parameter.name);
    if (value == request.query.end()) {
      if (parameter.required) throw net::RequestError(400, "?" + parameter.name + "= is missing");
      continue;
    }
    ++given;
    for (const net::FieldError& fault : parameter.schema.faults(value_of(value->second, parameter.is_text)))
      faults.push_back(about(parameter.name, fault));
  }
  if (known > 0 && given < request.query.size())
    for (const auto& asked : request.query)
      if (std::none_of(operation.parameters.begin(), operation.parameters.end(),
                       [&](const Parameter& one) { return !one.in_path && one.name == asked.first; }))
        faults.push_back({"?" + asked.first, "'" + asked.first + "' is not known here"});
  if (!faults.empty()) refuse("the query", faults);
}

void Contract::check(net::Request& request, const std::string& pattern) const {
  const Operation* operation = find(request.method, pattern);
  if (operation == nullptr) return;
  check_path(*operation, request);
  check_query(*operation, request);
  if (!operation->body || (request.body.empty() && !operation->body_required)) return;
  json body = json_in(request);
  const auto faults = operation->body->faults(body);
  if (!faults.empty()) refuse("the request body", faults);
  request.json = std::make_shared<const json>(std::move(body));
}

}  // namespace ream::api
