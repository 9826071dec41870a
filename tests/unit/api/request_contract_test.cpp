#include "api/request_contract.hpp"

#include <gtest/gtest.h>

#include <contract.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "api/yaml_json.hpp"

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
  int status(const net::Request& asked) {
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
  EXPECT_EQ(status(request("POST", "{")), 400);
  EXPECT_EQ(status(request("POST")), 415);
  EXPECT_EQ(status(request("PATCH")), 0);
  EXPECT_EQ(status(request("PATCH", "{}")), 422);
  EXPECT_EQ(status(request("DELETE")), 0);
  EXPECT_EQ(status(request("PUT", "{")), 0) << "what is not described is for the router to refuse";
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
  const std::regex unbounded(R"((^|[^\\])[*+]|\{[0-9]+,\})");
  for (const auto& [place, value] : document.flatten().items())
    if (place.ends_with("/pattern") && value.is_string()) {
      EXPECT_FALSE(std::regex_search(value.get<std::string>(), unbounded)) << place;
    }
}

TEST(RequestContract, TheContractCanBeEnforced) {
  EXPECT_NO_THROW(Contract(std::string(embedded::contract::find("openapi.yaml"))));
}

}  // namespace
}  // namespace ream::api
