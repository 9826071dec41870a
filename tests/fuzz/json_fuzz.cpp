// JSON of requests and files: bodies, landmarks, plans, scripts.
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

void read(uint8_t kind, std::string_view text) {
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
