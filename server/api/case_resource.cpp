#include <algorithm>

#include "api/json_page.hpp"
#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "core/folder_listing.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "ct/build/ct_workspace.hpp"
#include "net/problem.hpp"
#include "workup/case_json.hpp"

namespace ream::api {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

bool is_case(const fs::path& folder, const std::string& id) {
  return is_name(id) && workup::is_case_folder(folder / id);
}

std::vector<fs::path> case_folders(const fs::path& folder) {
  std::vector<fs::path> list;
  for (const fs::path& path : paths_in(folder))
    if (is_case(folder, path.filename().string())) list.push_back(path);
  return list;
}

net::Response list_cases(const Services& services, const net::Request& request) {
  std::vector<json> cases;
  for (const fs::path& path : case_folders(services.cases_folder)) {
    try {
      cases.push_back(workup::case_summary_json(path));
    } catch (const Error& error) {
      log::warn(std::string("case left out of the list: ") + error.what());
    }
  }
  return page_of(request, "cases", std::move(cases), "id");
}

net::Response get_case(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  if (!is_case(services.cases_folder, id)) throw Error(ErrorKind::not_found, "no case '" + id + "'");
  return net::json_response(200, workup::case_json(services.cases_folder / id));
}

/// A copy takes all but the side from its case.
void require_one_source(const json& body) {
  const bool copied = body.contains("copy_of");
  if (copied ? body.size() == 2 : body.contains("upload_id")) return;
  const std::string fault = copied ? "no other key but 'side' goes with 'copy_of'" : "'upload_id' is missing";
  throw net::RequestError(422, "the request body cannot be used: " + fault,
                          {{copied ? "#/copy_of" : "#/upload_id", fault}});
}

net::Response create_case(const Services& services, const net::Request& request) {
  const json& body = body_of(request);
  require_one_source(body);
  const case_::Side side = body.at("side") == "left" ? case_::Side::left : case_::Side::right;
  if (const auto copied = optional_in<std::string>(body, "copy_of"))
    return accepted(request.caller, services.cases.copy(*copied, side));
  const workup::NewCase wanted{body.at("upload_id"), text_in(body, "id"), text_in(body, "name"),
                               text_in(body, "series_uid"), side};
  return accepted(request.caller, services.cases.import(wanted, services.uploads));
}

net::Response segment_case(const Services& services, const net::Request& request) {
  const auto settings = ct::segmentation_settings_from_json(body_of(request), "the request body");
  return accepted(request.caller, services.cases.segment(id_of(request), settings));
}

net::Response build_case(const Services& services, const net::Request& request) {
  const auto settings = ct::build_settings_from_json(body_of(request), "the request body");
  return accepted(request.caller, services.cases.build(id_of(request), settings));
}

net::Response undo_segmentation(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  services.cases.undo_segmentation(id);
  return net::json_response(200, workup::case_json(services.cases.folder_of(id)));
}

net::Response remove_case(const Services& services, const net::Request& request) {
  services.cases.remove(id_of(request));
  return no_content();
}

}  // namespace

std::vector<Route> case_routes() {
  using namespace access;
  const std::string all = "/api/v1/cases", one = all + "/{id}";
  return {{"GET", all, reamers, not_audited, list_cases},
          {"POST", all, staff, changes("case.import"), create_case},
          {"GET", one, reamers, reads("case.read"), get_case},
          {"DELETE", one, staff, changes("case.delete"), remove_case, {"case", "deleted"}},
          {"POST", one + "/segmentation", staff, changes("case.segment"), segment_case},
          {"POST",
           one + "/segmentation/undo",
           staff,
           changes("case.segment"),
           undo_segmentation,
           {"case", "changed"}},
          {"POST", one + "/build", staff, changes("case.build"), build_case}};
}

}  // namespace ream::api
