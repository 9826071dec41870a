#pragma once
#include <algorithm>
#include <set>

#include "api/yaml_json.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "server_fixture.hpp"
#include "support/json_schema.hpp"
#include "support/places.hpp"

namespace ream::test {

using nlohmann::json;

/// "GET /api/v1/cases" and a status.
using Described = std::set<std::pair<std::string, int>>;

inline std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
  return text;
}

class ContractTest : public ServerTest {
 protected:
  /// The reply must have a status, content type and body that the description of `pattern` states.
  void expect_as_described(const std::string& method, const std::string& pattern, int status,
                           const HttpReply& reply) {
    const std::string operation = method + " " + pattern;
    ASSERT_EQ(reply.status, status) << operation << ": " << reply.body;
    const json& responses = contract.at("paths").at(pattern).at(lower(method)).at("responses");
    ASSERT_TRUE(responses.contains(std::to_string(status))) << operation << " answers " << status;
    const json& response = resolved(responses.at(std::to_string(status)));
    const json headers = response.value("headers", json::object());
    for (const auto& [name, header] : headers.items())
      EXPECT_TRUE(reply.headers.contains(lower(name))) << operation << " has no " << name;
    for (const char* name : {"Location", "Set-Cookie", "WWW-Authenticate", "Retry-After"})
      EXPECT_EQ(reply.headers.count(lower(name)), headers.count(name)) << operation << " " << name;
    seen.insert({operation, status});
    if (!response.contains("content")) return;
    const json& content = response["content"];
    ASSERT_TRUE(content.contains(reply.headers.at("content-type")))
        << operation << " sends " << reply.headers.at("content-type");
    const auto type = reply.headers.at("content-type");
    const json body = type.find("json") == std::string::npos ? json(reply.body) : json::parse(reply.body);
    for (const std::string& fault : faults(content.at(type).at("schema"), body))
      ADD_FAILURE() << operation << " " << status << ": " << fault << " in " << reply.body;
  }

  /// Every reply that can be had has an entity tag; asked again with it, there is nothing new or another tag.
  void expect_get(const std::string& pattern, const std::string& path, int status) {
    const HttpReply reply = get(path);
    expect_as_described("GET", pattern, status, reply);
    if (status != 200) return;
    ASSERT_TRUE(reply.headers.contains("etag")) << path;
    const std::string tag = reply.headers.at("etag");
    const HttpReply again = http_request(server->port(), "GET", path, {}, {{"If-None-Match", tag}});
    if (again.status != 304) {
      EXPECT_EQ(again.status, 200) << path;
      EXPECT_NE(again.headers.at("etag"), tag) << path;
    }
  }
  /// Sent twice under one key it is answered once more, but made once; under that key nothing else is.
  HttpReply expect_repeatable(const std::string& pattern, const std::string& path, int status,
                              const std::string& body = {}) {
    const std::map<std::string, std::string> key = {{"Idempotency-Key", "key-" + std::to_string(keys++)}};
    const HttpReply first = http_request(server->port(), "POST", path, body, key),
                    again = http_request(server->port(), "POST", path, body, key);
    expect_as_described("POST", pattern, status, first);
    expect_as_described("POST", pattern, status, again);
    EXPECT_EQ(first.body, again.body) << pattern;
    EXPECT_TRUE(again.headers.contains("idempotency-replayed")) << pattern;
    expect_post(pattern, path + (path.find('?') == std::string::npos ? "?" : "&") + "other=1", 422, body,
                key);
    expect_post(pattern, path, 400, body, {{"Idempotency-Key", "two words"}});
    return first;
  }
  void expect_post(const std::string& pattern, const std::string& path, int status,
                   const std::string& body = {}, const std::map<std::string, std::string>& headers = {}) {
    expect_as_described("POST", pattern, status, http_request(server->port(), "POST", path, body, headers));
  }
  void expect_stream(const std::string& path, int status,
                     const std::map<std::string, std::string>& headers = {}) {
    const RawWebSocket viewer(server->port(), path, headers);
    expect_as_described("GET", one + "/stream", status, viewer.handshake());
  }
  void expect_request(const std::string& method, const std::string& pattern, const std::string& path,
                      int status, const std::string& body = {},
                      const std::map<std::string, std::string>& headers = {}) {
    expect_as_described(method, pattern, status, http_request(server->port(), method, path, body, headers));
  }

  /// What is wrong with a value by a schema of the contract.
  std::vector<std::string> faults(const json& schema, const json& value) const {
    return schema_faults(schema, value, contract);
  }
  /// The part itself, or what its $ref names in the contract.
  const json& resolved(const json& part) const {
    if (!part.contains("$ref")) return part;
    return contract.at(json::json_pointer(part.at("$ref").get<std::string>().substr(1)));
  }

  /// Every reply that the contract describes for operations with these tags.
  Described described(const std::set<std::string>& tags) const {
    Described all_replies;
    for (const auto& [path, item] : contract.at("paths").items())
      for (const auto& [verb, operation] : item.items())
        if (verb != "parameters" && tags.contains(operation.at("tags").at(0).get<std::string>()))
          for (const auto& [status, response] : operation.at("responses").items())
            all_replies.insert({upper(verb) + " " + path, std::stoi(status)});
    return all_replies;
  }
  /// Whether wire/access proves it, for every operation: refusals of those who may not ask.
  static bool is_refusal(const std::string& operation, int status) {
    return status == 401 || (status == 403 && operation.starts_with("GET "));
  }
  /// `elsewhere`: replies that another test gives.
  void expect_all_given(const std::set<std::string>& tags, const Described& elsewhere = {}) const {
    for (const auto& [operation, status] : described(tags)) {
      if (elsewhere.contains({operation, status})) continue;
      if (is_refusal(operation, status) && !tags.contains("access")) continue;
      EXPECT_TRUE(seen.contains({operation, status})) << operation << " " << status << " was never given";
    }
  }

  const json contract = api::json_from_yaml(read_text_file(source_folder() + "/proto/openapi.yaml"));
  const std::string all = "/api/v1/sessions", one = "/api/v1/sessions/{id}";
  const std::map<std::string, std::string> foreign = {{"Origin", "http://elsewhere.example"}};
  Described seen;
  int keys = 0;
};

}  // namespace ream::test
