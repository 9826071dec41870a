#include "api/case_work_resource.hpp"

#include <nlohmann/json.hpp>

#include "api/job_resource.hpp"
#include "api/request_body.hpp"
#include "core/error.hpp"
#include "ct/build/ct_workspace.hpp"
#include "workup/case_json.hpp"

namespace ream::api {
using nlohmann::json;
namespace {

constexpr size_t max_case_name = 200, longest_uid = 64;

case_::Side side_in(RequestBody& body) {
  const std::string side = body.words("side", 1, 10);
  if (side != "left" && side != "right" && !side.empty())
    throw net::RequestError(422, "'side' must be left or right", {{"#/side", "must be left or right"}});
  return side == "left" ? case_::Side::left : case_::Side::right;
}

net::Response create(workup::CaseService& case_service, workup::UploadStore& uploads,
                     const net::Request& request) {
  RequestBody body(request);
  const std::string copy_of = body.name_or("copy_of", "");
  workup::NewCase wanted;
  wanted.side = side_in(body);
  if (!copy_of.empty()) {
    body.finish();
    return accepted(case_service.copy(copy_of, wanted.side));
  }
  wanted.upload_id = body.name("upload_id");
  wanted.id = body.name_or("id", "");
  wanted.name = body.words("name", 0, max_case_name);
  wanted.series_uid = body.words("series_uid", 0, longest_uid);
  body.finish();
  return accepted(case_service.import(wanted, uploads));
}

net::Response segment(workup::CaseService& case_service, const net::Request& request) {
  const auto settings = ct::segmentation_settings_from_json(json_object_in(request), "the request body");
  return accepted(case_service.segment(request.parameters.at("id"), settings));
}

net::Response build(workup::CaseService& case_service, const net::Request& request) {
  const auto settings = ct::build_settings_from_json(json_object_in(request), "the request body");
  return accepted(case_service.build(request.parameters.at("id"), settings));
}

net::Response undo(workup::CaseService& case_service, const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  case_service.undo_segmentation(id);
  return net::json_response(200, workup::case_json(case_service.folder_of(id)));
}

}  // namespace

void add_case_work_routes(net::Router& router, workup::CaseService& case_service,
                          workup::UploadStore& uploads) {
  router.on("POST", "/api/v1/cases", [&case_service, &uploads](const net::Request& request) {
    return create(case_service, uploads, request);
  });
  router.on("DELETE", "/api/v1/cases/{id}", [&case_service](const net::Request& request) {
    case_service.remove(request.parameters.at("id"));
    return net::Response{204, {}, nullptr, {}};
  });
  router.on("POST", "/api/v1/cases/{id}/segmentation",
            [&case_service](const net::Request& request) { return segment(case_service, request); });
  router.on("POST", "/api/v1/cases/{id}/segmentation/undo",
            [&case_service](const net::Request& request) { return undo(case_service, request); });
  router.on("POST", "/api/v1/cases/{id}/build",
            [&case_service](const net::Request& request) { return build(case_service, request); });
}

}  // namespace ream::api
