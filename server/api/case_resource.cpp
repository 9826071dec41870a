#include "api/case_resource.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/request_body.hpp"
#include "case/case.hpp"
#include "case/plan.hpp"
#include "core/error.hpp"
#include "core/log.hpp"

namespace ream::api {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

json summary_json(const case_::Case& c) {
  const Vec3i& dims = c.bone.grid.dims;
  const Vec3& spacing = c.bone.grid.spacing_mm;
  return {{"id", c.id},
          {"name", c.name},
          {"side", case_::to_text(c.side)},
          {"dims", {dims.x(), dims.y(), dims.z()}},
          {"spacing_mm", {spacing.x(), spacing.y(), spacing.z()}},
          {"planned", c.plan.has_value()}};
}

/// Every key is there; pilot hole and plan are null where there are none.
json whole_json(const case_::Case& c) {
  json value = summary_json(c);
  value["warnings"] = c.warnings;
  value["plan"] = nullptr;
  if (c.plan) {
    json plan = case_::to_json(*c.plan);
    for (const char* key : {"pilot_diameter_mm", "pilot_depth_mm"})
      if (!plan.contains(key)) plan[key] = nullptr;
    plan["guide"] = case_::to_text(c.plan->guide);
    value["plan"] = std::move(plan);
  }
  return value;
}

std::vector<fs::path> case_folders(const fs::path& folder) {
  std::vector<fs::path> list;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed))
    if (is_name(entry.path().filename().string()) && fs::is_regular_file(entry.path() / "case.json", failed))
      list.push_back(entry.path());
  std::sort(list.begin(), list.end());
  return list;
}

net::Response list_cases(const fs::path& folder) {
  json cases = json::array();
  for (const fs::path& path : case_folders(folder)) {
    try {
      cases.push_back(summary_json(case_::load_case_description(path)));
    } catch (const Error& error) {
      log::warn(std::string("case left out of the list: ") + error.what());
    }
  }
  return net::json_response(200, {{"cases", std::move(cases)}});
}

net::Response get_case(const fs::path& folder, const std::string& id) {
  if (!is_name(id) || !fs::is_regular_file(folder / id / "case.json"))
    throw Error(ErrorKind::not_found, "no case '" + id + "'; GET /api/v1/cases lists them");
  return net::json_response(200, whole_json(case_::load_case_description(folder / id)));
}

}  // namespace

void add_case_routes(net::Router& router, const fs::path& cases_folder) {
  router.on("GET", "/api/v1/cases", [cases_folder](const net::Request&) { return list_cases(cases_folder); });
  router.on("GET", "/api/v1/cases/{id}", [cases_folder](const net::Request& request) {
    return get_case(cases_folder, request.parameters.at("id"));
  });
}

}  // namespace ream::api
