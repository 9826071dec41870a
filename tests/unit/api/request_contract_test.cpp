#include "api/request_contract.hpp"

#include <gtest/gtest.h>

#include <contract.hpp>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "access/password_hasher.hpp"
#include "api/idempotency.hpp"
#include "api/json_page.hpp"
#include "api/request_values.hpp"
#include "api/yaml_json.hpp"
#include "net/problem.hpp"
#include "session/running_replay.hpp"
#include "support/json_schema.hpp"
#include "workup/upload_store.hpp"

namespace ream::api {
namespace {

using nlohmann::json;

constexpr const char* described = R"(
openapi: 3.1.0
paths:
  /things/{id}:
    parameters:
      - {$ref: '#/components/parameters/ThingId'}
    get:
      parameters:
        - {name: limit, in: query, schema: {type: integer, minimum: 1, maximum: 500}}
        - {name: sort, in: query, schema: {enum: [name, -name]}}
        - {name: at, in: query, required: true, schema: {type: number}}
    post:
      parameters:
        - {name: Idempotency-Key, in: header, schema: {type: string}}
      requestBody:
        required: true
        content: {application/json: {schema: {$ref: '#/components/schemas/NewThing'}}}
    patch:
      requestBody:
        required: false
        content: {application/json: {schema: {$ref: '#/components/schemas/NewThing'}}}
    delete: {summary: gone}
components:
  parameters:
    ThingId: {name: id, in: path, required: true, schema: {$ref: '#/components/schemas/Id'}}
  schemas:
    Id: {type: string, pattern: '^[a-z]{1,8}$'}
    Point: {type: array, minItems: 3, maxItems: 3, items: {type: number, minimum: -10}}
    NewThing:
      type: object
      additionalProperties: false
      required: [name]
      dependentRequired: {from: [to]}
      properties:
        name: {type: string, minLength: 1, maxLength: 4}
        count: {type: integer, exclusiveMinimum: 0, maximum: 10}
        place: {oneOf: [{$ref: '#/components/schemas/Point'}, {type: 'null'}]}
        kind: {enum: [big, small]}
        id: {$ref: '#/components/schemas/Id'}
        flag: {type: boolean}
        from: {type: number}
        to: {type: [number, 'null']}
        parts: {type: array, items: {type: object, required: [id], properties: {id: {$ref: '#/components/schemas/Id'}}}}
)";

class RequestContractTest : public testing::Test {
 protected:
  static net::Request request(const std::string& method, const std::string& body = {}) {
    net::Request made;
    made.method = method;
    made.path = "/things/ring";
    made.parameters["id"] = "ring";
    made.body = body;
    if (!body.empty()) made.headers["content-type"] = "application/json";
    return made;
  }
  /// Status of the refusal; 0: it passes.
  int status(net::Request asked) {
    try {
      contract.check(asked, "/things/{id}");
    } catch (const net::RequestError& refusal) {
      last = refusal.errors();
      return refusal.status();
    } catch (const Error& refusal) {
      return net::http_status(refusal.kind());
    }
    return 0;
  }
  /// "pointer: words" of the first fault of a body.
  std::string fault(const std::string& body) {
    if (status(request("POST", body)) != 422) return "none";
    return last.at(0).pointer + ": " + last.at(0).detail;
  }

  const Contract contract{described};
  std::vector<net::FieldError> last;
};

TEST_F(RequestContractTest, ABodyIsHeldAgainstItsSchemaAndFaultsAreNamed) {
  EXPECT_EQ(fault(R"({"name": "\u00e4\u00f6\u00fc\u00df", "count": 3, "place": [1, 2, 3.5], "kind": "big"})"),
            "none");
  EXPECT_EQ(fault(R"({"name": "a", "count": 3.0, "place": null, "from": 1, "to": null})"), "none");
  EXPECT_EQ(fault("{}"), "#/name: 'name' is missing");
  EXPECT_EQ(fault(R"({"name": "a", "nme": 1})"), "#/nme: 'nme' is not a known key");
  EXPECT_EQ(fault(R"({"name": "a", "a/b'~": 1})"), "#/a~1b'~0: 'a/b'~' is not a known key");
  EXPECT_EQ(fault(R"({"name": "abcde"})"), "#/name: 'name' must be a text of 1 to 4 characters");
  EXPECT_EQ(fault(R"({"name": 3})"), "#/name: 'name' must be a text of 1 to 4 characters");
  EXPECT_EQ(fault(R"({"name": "a", "count": 2.5})"),
            "#/count: 'count' must be a whole number above 0 and at most 10");
  EXPECT_EQ(fault(R"({"name": "a", "count": 0})"),
            "#/count: 'count' must be a whole number above 0 and at most 10");
  EXPECT_EQ(fault(R"({"name": "a", "kind": "huge"})"), "#/kind: 'kind' must be \"big\" or \"small\"");
  EXPECT_EQ(fault(R"({"name": "a", "id": "UP"})"), "#/id: 'id' must be a text that matches ^[a-z]{1,8}$");
  EXPECT_EQ(fault(R"({"name": "a", "flag": 1})"), "#/flag: 'flag' must be true or false");
  EXPECT_EQ(fault(R"({"name": "a", "from": 1})"), "#/to: 'to' is missing");
  EXPECT_EQ(fault(R"({"name": "a", "place": [1, -20, 3]})"),
            "#/place/1: 'place/1' must be a number of at least -10");
  EXPECT_EQ(fault(R"({"name": "a", "place": [1]})"), "#/place: 'place' must be a list of 3 items or null");
  EXPECT_EQ(fault(R"({"name": "a", "parts": [{"id": "x"}, {}]})"), "#/parts/1/id: 'parts/1/id' is missing");
  EXPECT_EQ(fault("[]"), "#: it must be an object");
  ASSERT_EQ(status(request("POST", R"({"count": "x", "flag": 3, "zz": 1})")), 422);
  EXPECT_EQ(last.size(), 4u) << "all faults at once";
}

TEST_F(RequestContractTest, ABodyIsJsonAndThereUnlessItMayBeLeftOut) {
  net::Request text = request("POST", "{}");
  text.headers["content-type"] = "text/plain";
  EXPECT_EQ(status(text), 415);
  for (const char* type : {"", "text/json"}) {
    text.headers["content-type"] = type;
    EXPECT_EQ(status(text), 415) << type;
  }
  text = request("POST", R"({"name": "a"})");
  text.headers["content-type"] = "application/json; charset=utf-8";
  EXPECT_EQ(status(text), 0);
  for (const char* body : {"{", R"({"name": "a"} x)", R"({"from": 1e999})", "\xff", "{'name': 1}"})
    EXPECT_EQ(status(request("POST", body)), 400) << body;
  for (const char* body : {"[]", "3", "null", R"("demo")"})
    EXPECT_EQ(status(request("POST", body)), 422) << body;
  EXPECT_EQ(status(request("POST")), 415);
  EXPECT_EQ(status(request("PATCH")), 0);
  EXPECT_EQ(status(request("PATCH", "{}")), 422);
  EXPECT_EQ(status(request("DELETE")), 0);
  EXPECT_EQ(status(request("PUT", "{")), 0) << "what is not described is for the router to refuse";
}

TEST_F(RequestContractTest, HandlersGetTheBodyThatWasChecked) {
  net::Request asked = request("POST", R"({"name": "a", "count": 3, "place": [1, 2, 3]})");
  contract.check(asked, "/things/{id}");
  EXPECT_EQ(body_of(asked).at("name"), "a");
  EXPECT_EQ(optional_in<int>(body_of(asked), "count"), 3);
  EXPECT_EQ(optional_in<int>(body_of(asked), "other"), std::nullopt);
  EXPECT_EQ(text_in(body_of(asked), "kind"), "");
  EXPECT_EQ(point_in(body_of(asked), "place"), Vec3(1, 2, 3));
  EXPECT_EQ(point_in(json{{"place", nullptr}}, "place"), std::nullopt);
  net::Request without = request("PATCH");
  contract.check(without, "/things/{id}");
  EXPECT_EQ(body_of(without), json::object());
}

TEST_F(RequestContractTest, AListOfDifferentItemsHasNoneTwice) {
  EXPECT_EQ(different_texts_in(json{{"ids", {"a", "b"}}}, "ids"), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(different_texts_in(json::object(), "ids").empty());
  try {
    different_texts_in(json{{"ids", {"a", "b", "a"}}}, "ids");
    FAIL();
  } catch (const net::RequestError& refusal) {
    EXPECT_EQ(refusal.status(), 422);
    EXPECT_EQ(refusal.errors().at(0).pointer, "#/ids");
  }
}

TEST_F(RequestContractTest, AQueryHasKnownNamesAndFittingValues) {
  const auto asked = [&](const std::map<std::string, std::string>& query) {
    net::Request made = request("GET");
    made.query = query;
    return status(made);
  };
  EXPECT_EQ(asked({{"at", "1.5"}}), 0);
  EXPECT_EQ(asked({{"at", "-3"}, {"limit", "500"}, {"sort", "-name"}}), 0);
  EXPECT_EQ(asked({}), 400);
  EXPECT_EQ(asked({{"at", "here"}}), 422);
  EXPECT_EQ(asked({{"at", "1"}, {"limit", "0"}}), 422);
  EXPECT_EQ(last.at(0).detail, "'limit' must be a whole number from 1 to 500");
  EXPECT_EQ(asked({{"at", "1"}, {"limit", "ten"}}), 422);
  EXPECT_EQ(asked({{"at", "1"}, {"limit", ""}}), 422);
  EXPECT_EQ(asked({{"at", "1"}, {"sort", "size"}}), 422);
  EXPECT_EQ(asked({{"at", "1"}, {"limits", "5"}}), 422);
  EXPECT_EQ(last.at(0).detail, "'limits' is not known here");
}

TEST_F(RequestContractTest, APathThatNamesNothingIsNotFound) {
  net::Request made = request("DELETE");
  for (const char* id : {"UP", "toolonganame", "a%00", "../x"}) {
    made.parameters["id"] = id;
    EXPECT_EQ(status(made), 404) << id;
  }
}

TEST_F(RequestContractTest, KnowsWhatMayBeRepeated) {
  EXPECT_TRUE(contract.takes_idempotency_key("POST", "/things/{id}"));
  EXPECT_FALSE(contract.takes_idempotency_key("PATCH", "/things/{id}"));
  EXPECT_FALSE(contract.takes_idempotency_key("POST", "/nowhere"));
}

/// std::regex goes down a level of its stack for each character that such a part takes: a long text would
/// end the server.
TEST(RequestContract, PatternsOfTheContractAreBounded) {
  const json document = json_from_yaml(std::string(embedded::contract::find("openapi.yaml")));
  const json places = document.flatten();
  const std::regex unbounded(R"((^|[^\\])[*+]|\{[0-9]+,\})");
  for (const auto& [place, value] : places.items())
    if (place.ends_with("/pattern") && value.is_string()) {
      EXPECT_FALSE(std::regex_search(value.get<std::string>(), unbounded)) << place;
    }
}

/// Walks the schemas of requests.
class RequestSchemas {
 public:
  explicit RequestSchemas(const json& document) : document_(document) {}

  /// What leaves open how much a request may hold, a line each.
  std::vector<std::string> open;

  void look_at(const json& unresolved, const std::string& place) {
    if (unresolved.contains("$ref") && !seen_.insert(unresolved["$ref"]).second) return;
    const json& schema = followed(unresolved);
    const json type = schema.value("type", json());
    const auto may_be = [&](const char* name) {
      return type == name || (type.is_array() && std::find(type.begin(), type.end(), name) != type.end());
    };
    const auto says = [&](std::initializer_list<const char*> keywords) {
      return std::any_of(keywords.begin(), keywords.end(),
                         [&](const char* one) { return schema.contains(one); });
    };
    if (type.is_null() && !says({"oneOf", "allOf", "const", "enum"}))
      open.push_back(place + " may be anything");
    if (may_be("object") &&
        (!schema.contains("additionalProperties") || schema["additionalProperties"] == true))
      open.push_back(place + " is an open object");
    if (may_be("array") && !(says({"maxItems"}) && says({"items"})))
      open.push_back(place + " is an open list");
    if (may_be("string") && !says({"maxLength", "pattern"}))
      open.push_back(place + " is a text of any length");
    if (may_be("integer") && !says({"enum"}) && !(says({"minimum", "exclusiveMinimum"}) && says({"maximum"})))
      open.push_back(place + " is a whole number of any size");
    for (const char* one : {"items", "additionalProperties"})
      if (schema.contains(one) && schema[one].is_object()) look_at(schema[one], place + "/*");
    for (const char* some : {"properties", "oneOf", "allOf"}) {
      const json parts = schema.value(some, json::object());
      for (const auto& [key, part] : parts.items()) look_at(part, place + "/" + key);
    }
  }

  const json& followed(const json& part) const {
    if (!part.contains("$ref")) return part;
    return followed(document_.at(json::json_pointer(part["$ref"].get<std::string>().substr(1))));
  }

 private:
  const json& document_;
  std::set<std::string> seen_;
};

TEST(RequestContract, NoRequestIsOpen) {
  const json document = json_from_yaml(std::string(embedded::contract::find("openapi.yaml")));
  RequestSchemas schemas(document);
  size_t bodies = 0;
  const auto look_at_parameters = [&](const json& of, const std::string& place) {
    for (const json& unresolved : of.value("parameters", json::array())) {
      const json& parameter = schemas.followed(unresolved);
      if (parameter["in"] != "header")
        schemas.look_at(parameter.at("schema"), place + "?" + parameter["name"].get<std::string>());
    }
  };
  for (const auto& [path, item] : document.at("paths").items()) {
    look_at_parameters(item, path);
    for (const auto& [verb, operation] : item.items()) {
      if (verb == "parameters") continue;
      const std::string place = verb + " " + path;
      look_at_parameters(operation, place);
      if (!operation.contains("requestBody")) continue;
      const json& content = schemas.followed(operation["requestBody"]).at("content");
      if (content.contains("application/json") && ++bodies)
        schemas.look_at(content["application/json"].at("schema"), place);
    }
  }
  EXPECT_GT(bodies, 25u);
  EXPECT_EQ(schemas.open, std::vector<std::string>());
}

TEST(RequestContract, LimitsThatTheCodeKeepsAreThoseOfTheContract) {
  const json document = json_from_yaml(std::string(embedded::contract::find("openapi.yaml")));
  const auto limit = [&](const std::string& place) {
    return document.at("components").at(json::json_pointer("/" + place)).get<double>();
  };
  EXPECT_EQ(limit("parameters/IdempotencyKey/schema/maxLength"), Idempotency::max_key_length);
  EXPECT_EQ(limit("parameters/Limit/schema/default"), default_page_size);
  EXPECT_EQ(limit("schemas/NewUpload/properties/name/maxLength"), workup::max_upload_name);
  for (const char* body : {"NewUser", "UserChange"}) {
    const std::string password = "schemas/" + std::string(body) + "/properties/password/";
    EXPECT_EQ(limit(password + "minLength"), access::min_password_length) << body;
    EXPECT_EQ(limit(password + "maxLength"), access::max_password_bytes) << body;
  }
  const std::string speed = "schemas/Playback/properties/speed/";
  EXPECT_EQ(limit(speed + "minimum"), session::slowest_playback);
  EXPECT_EQ(limit(speed + "maximum"), session::fastest_playback);
}

TEST(RequestContract, DeepBodiesAreNoJson) {
  const Contract contract{std::string(embedded::contract::find("openapi.yaml"))};
  const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
  for (const std::string& body :
       {deep, "{\"name\": \"x\", \"cases\": [\"demo\"], \"questionnaire\": {\"a\": " + deep + "}}"}) {
    net::Request request;
    request.method = "POST";
    request.body = body;
    request.headers["content-type"] = "application/json";
    try {
      contract.check(request, "/api/v1/studies");
      FAIL();
    } catch (const net::RequestError& refusal) {
      EXPECT_EQ(refusal.status(), 400);
      EXPECT_LT(std::string(refusal.what()).size(), 200u);
    }
  }
}

TEST(RequestContract, SchemasOfTheContractSayWhatIsUnderstood) {
  const json document = json_from_yaml(std::string(embedded::contract::find("openapi.yaml")));
  for (const auto& [name, schema] : document.at("components").at("schemas").items())
    test::expect_known_keywords(schema, name);
}

TEST(RequestContract, AKeyThatStandsTwiceIsRefused) {
  EXPECT_THROW(json_from_yaml("a: 1\nb: {c: 1, c: 2}\n"), Error);
}

/// As a session is asked for: status and pointers of what was wrong.
std::pair<int, std::vector<std::string>> refused_session(const Contract& contract, const std::string& body) {
  net::Request request;
  request.method = "POST";
  request.body = body;
  request.headers["content-type"] = "application/json";
  std::vector<std::string> pointers;
  try {
    contract.check(request, "/api/v1/sessions");
  } catch (const net::RequestError& error) {
    for (const auto& field : error.errors()) pointers.push_back(field.pointer);
    return {error.status(), pointers};
  }
  return {0, pointers};
}

TEST(RequestContract, NamesOfSessionsAreNoPathsAndNumbersInRange) {
  using Pointers = std::vector<std::string>;
  const Contract contract{std::string(embedded::contract::find("openapi.yaml"))};
  const auto refused = [&](const std::string& body) { return refused_session(contract, body); };
  EXPECT_EQ(refused(R"({"case": "a-1", "force_scale": 26})").first, 0);
  EXPECT_EQ(refused(R"({"case": 3, "force_scale": "much", "speed/rpm": 1, "x~y": 2})").second,
            (Pointers{"#/case", "#/force_scale", "#/speed~1rpm", "#/x~0y"}));
  EXPECT_EQ(refused(R"({"case": "demo", "force_scale": null})").second, Pointers{"#/force_scale"});
  for (const char* name : {"", "../demo", "/etc", "Demo", "a b", "a.b", "demo\\u0000"})
    EXPECT_EQ(refused(std::string(R"({"case": ")") + name + "\"}").second, Pointers{"#/case"}) << name;
  for (const char* number : {"0", "-1", "1000.5", "0.09", "1e-300"})
    EXPECT_EQ(refused(std::string(R"({"case": "demo", "force_scale": )") + number + "}").second,
              Pointers{"#/force_scale"})
        << number;
  EXPECT_EQ(refused(R"({"case": "demo", "force_scale": 1000})").first, 0);
}

TEST(RequestContract, WordsOfALineHaveNoControlCharactersAndMayBeLong) {
  const Contract contract{std::string(embedded::contract::find("openapi.yaml"))};
  net::Request request;
  request.method = "POST";
  request.headers["content-type"] = "application/json";
  const auto taken = [&](const std::string& name) {
    request.body = json{{"name", name}}.dump();
    try {
      contract.check(request, "/api/v1/links");
      return true;
    } catch (const net::RequestError&) {
      return false;
    }
  };
  EXPECT_TRUE(taken("visitors"));
  std::string longest;
  for (int i = 0; i < 100; ++i) longest += "\xf0\x9f\xa6\xb4";
  EXPECT_TRUE(taken(longest)) << "a hundred characters of four bytes";
  for (const std::string& bad :
       {std::string("two\nlines"), std::string("a\x7f"), longest + "x", std::string(300'000, 'x')})
    EXPECT_FALSE(taken(bad)) << bad.substr(0, 20);
}

}  // namespace
}  // namespace ream::api
