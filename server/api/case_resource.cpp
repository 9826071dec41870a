#include "api/case_resource.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/json_page.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
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
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed))
    if (is_case(folder, entry.path().filename().string())) list.push_back(entry.path());
  std::sort(list.begin(), list.end());
  return list;
}

net::Response list_cases(const fs::path& folder, const net::Request& request) {
  std::vector<json> cases;
  for (const fs::path& path : case_folders(folder)) {
    try {
      cases.push_back(workup::case_summary_json(path));
    } catch (const Error& error) {
      log::warn(std::string("case left out of the list: ") + error.what());
    }
  }
  return page_of(request, "cases", std::move(cases), "id");
}

net::Response get_case(const fs::path& folder, const std::string& id) {
  if (!is_case(folder, id))
    throw Error(ErrorKind::not_found, "no case '" + id + "'; GET /api/v1/cases lists them");
  return net::json_response(200, workup::case_json(folder / id));
}

}  // namespace

void add_case_routes(net::Router& router, const fs::path& cases_folder) {
  router.on("GET", "/api/v1/cases",
            [cases_folder](const net::Request& request) { return list_cases(cases_folder, request); });
  router.on("GET", "/api/v1/cases/{id}", [cases_folder](const net::Request& request) {
    return get_case(cases_folder, request.parameters.at("id"));
  });
}

}  // namespace ream::api
