// JSON of requests and files: bodies, landmarks, plans, scripts.
#include <contract.hpp>
#include <nlohmann/json.hpp>

#include "api/request_contract.hpp"
#include "api/request_values.hpp"
#include "case/landmarks.hpp"
#include "case/plan.hpp"
#include "core/error.hpp"
#include "device/script/script.hpp"
#include "fuzz_input.hpp"

namespace ream::fuzz {
namespace {

net::Request request_with(std::string_view text) {
  net::Request request;
  request.headers["content-type"] = "application/json";
  request.body = text;
  return request;
}

constexpr const char* described = R"(
paths:
  /things:
    post:
      requestBody:
        required: true
        content: {application/json: {schema: {}}}
    put:
      requestBody:
        required: true
        content:
          application/json:
            schema:
              type: object
              additionalProperties: false
              required: [case]
              properties:
                case: {type: string, pattern: '^[a-z0-9-]{1,64}$'}
                title: {type: string, maxLength: 10}
                force_scale: {type: number, exclusiveMinimum: 0, maximum: 1000}
                place_mm: {oneOf: [{type: array, minItems: 3, maxItems: 3, items: {type: number}}, {type: 'null'}]}
                blinded: {type: boolean}
)";

/// The body of a request as its handler gets it.
nlohmann::json checked(const char* method, std::string_view text) {
  static const api::Contract contract{described};
  net::Request request = request_with(text);
  request.method = method;
  contract.check(request, "/things");
  return api::body_of(request);
}

void read_body(std::string_view text) {
  const nlohmann::json body = checked("PUT", text);
  require(!body.at("case").get<std::string>().empty(), "a body without a case was taken");
  api::text_in(body, "title");
  api::optional_in<double>(body, "force_scale");
  api::point_in(body, "place_mm");
  body.value("blinded", false);
}

/// What is read must be the same when it has been written and read again.
template <typename Read>
void read_twice(const nlohmann::json& json, Read read) {
  const auto once = to_json(read(json, "request"));
  require(to_json(read(once, "request")) == once, "what was written is read as something else");
}

struct Operation {
  const char *method, *pattern;
};
/// Of the server itself; those with the widest bodies.
constexpr Operation operations[] = {{"POST", "/api/v1/sessions"},
                                    {"PATCH", "/api/v1/sessions/{id}"},
                                    {"POST", "/api/v1/sessions/{id}/annotations"},
                                    {"POST", "/api/v1/sessions/{id}/exports"},
                                    {"POST", "/api/v1/cases"},
                                    {"POST", "/api/v1/cases/{id}/segmentation"},
                                    {"POST", "/api/v1/cases/{id}/build"},
                                    {"PUT", "/api/v1/cases/{id}/plan"},
                                    {"POST", "/api/v1/studies"},
                                    {"PUT", "/api/v1/studies/{id}"},
                                    {"PUT", "/api/v1/studies/{id}/participants/{code}/answers"},
                                    {"POST", "/api/v1/rubrics"},
                                    {"POST", "/api/v1/benchmarks"},
                                    {"POST", "/api/v1/rescorings"},
                                    {"POST", "/api/v1/users"}};

void check_served(uint8_t which, std::string_view text) {
  static const api::Contract contract{std::string(embedded::contract::find("openapi.yaml"))};
  const Operation& operation = operations[which % std::size(operations)];
  net::Request request = request_with(text);
  request.method = operation.method;
  request.parameters = {{"id", "a"}, {"code", "b"}};
  contract.check(request, operation.pattern);
  require(request.json != nullptr, "a body was let through unread");
}

void read(uint8_t kind, std::string_view text) {
  if (kind >= 0x80) {
    check_served(kind & 0x7f, text);
    return;
  }
  if (kind % 4 == 0) {
    read_body(text);
    return;
  }
  const nlohmann::json json = checked("POST", text);
  if (kind % 4 == 1)
    read_twice(json, case_::landmarks_from_json);
  else if (kind % 4 == 2)
    read_twice(json, case_::plan_from_json);
  else
    device::parse_script(json, "request");
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  ream::fuzz::Input input(data, size);
  const uint8_t kind = input.byte();
  try {
    ream::fuzz::read(kind, input.rest());
  } catch (const ream::Error&) {
  }
  return 0;
}
