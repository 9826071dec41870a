// JSON of requests and files: bodies, landmarks, plans, scripts.
#include <nlohmann/json.hpp>

#include "api/request_body.hpp"
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

void read_body(std::string_view text) {
  api::RequestBody body(request_with(text));
  body.name_or("case", "");
  body.words("title", 0, 10);
  body.number_or_none("force_scale", 0.0, 1000.0);
  body.number_within_or_none("spacing_mm", 0.1, 2.0);
  body.point_or_none("place_mm", 500.0);
  body.flag_or_none("blinded");
  body.finish();
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
  const nlohmann::json json = api::json_object_in(request_with(text));
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
