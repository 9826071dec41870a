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

net::Response create(workup::CaseWorkshop& workshop, workup::UploadStore& uploads,
                     const net::Request& request) {
  RequestBody body(request);
  const std::string copy_of = body.name_or("copy_of", "");
  workup::NewCase wanted;
  wanted.side = side_in(body);
  if (!copy_of.empty()) {
    body.finish();
    return accepted(workshop.copy(copy_of, wanted.side));
  }
  wanted.upload_id = body.name("upload_id");
  wanted.id = body.name_or("id", "");
  wanted.name = body.words("name", 0, max_case_name);
  wanted.series_uid = body.words("series_uid", 0, longest_uid);
  body.finish();
  return accepted(workshop.import(wanted, uploads));
}

net::Response segment(workup::CaseWorkshop& workshop, const net::Request& request) {
  const auto settings = ct::segmentation_settings_from_json(json_object_in(request), "the request body");
  return accepted(workshop.segment(request.parameters.at("id"), settings));
}

net::Response build(workup::CaseWorkshop& workshop, const net::Request& request) {
  const auto settings = ct::build_settings_from_json(json_object_in(request), "the request body");
  return accepted(workshop.build(request.parameters.at("id"), settings));
}

net::Response undo(workup::CaseWorkshop& workshop, const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  workshop.undo_segmentation(id);
  return net::json_response(200, workup::case_json(workshop.folder_of(id)));
}

}  // namespace

void add_case_work_routes(net::Router& router, workup::CaseWorkshop& workshop, workup::UploadStore& uploads) {
  router.on("POST", "/api/v1/cases", [&workshop, &uploads](const net::Request& request) {
    return create(workshop, uploads, request);
  });
  router.on("DELETE", "/api/v1/cases/{id}", [&workshop](const net::Request& request) {
    workshop.remove(request.parameters.at("id"));
    return net::Response{204, {}, nullptr, {}};
  });
  router.on("POST", "/api/v1/cases/{id}/segmentation",
            [&workshop](const net::Request& request) { return segment(workshop, request); });
  router.on("POST", "/api/v1/cases/{id}/segmentation/undo",
            [&workshop](const net::Request& request) { return undo(workshop, request); });
  router.on("POST", "/api/v1/cases/{id}/build",
            [&workshop](const net::Request& request) { return build(workshop, request); });
}

}  // namespace ream::api
