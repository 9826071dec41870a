#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "api/session_work.hpp"
#include "core/error.hpp"
#include "core/file.hpp"
#include "score/deviation.hpp"

namespace ream::api {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

/// In a session's folder; made once, and taken away when the session goes on.
constexpr const char* description_name = "deviation.json";

/// What lies in the folder; null where nothing does, or what a version before has made.
json description_in(const fs::path& folder) {
  std::error_code failed;
  if (!fs::is_regular_file(folder / description_name, failed)) return nullptr;
  json description = read_json_file(folder / description_name);
  return description.value("revision", 1) == score::deviation_revision ? std::move(description) : json();
}

/// Bytes of one field of what lies in the folder.
net::Response field(const std::string& id, const fs::path& folder, const json& description,
                    const std::string& to) {
  const json& fields = description.at("fields");
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const json& each) { return each.at("name") == to; });
  if (found == fields.end())
    throw Error(ErrorKind::not_found, "session '" + id + "' has nothing to compare its surface with: " +
                                          (to == "plan"   ? "nothing was removed, or there is no plan"
                                           : to == "wall" ? "nothing of the face was removed"
                                                          : "no implant can be seated"));
  const auto offset = found->at("offset").get<size_t>(), count = description.at("vertices").get<size_t>();
  const std::vector<std::byte> bytes = read_binary_file(folder / description.at("file").get<std::string>());
  if (offset + count > bytes.size())
    throw Error(ErrorKind::io, "session '" + id + "': its deviations are shorter than their description");
  auto part = std::make_shared<const net::Bytes>(bytes.begin() + static_cast<std::ptrdiff_t>(offset),
                                                 bytes.begin() + static_cast<std::ptrdiff_t>(offset + count));
  net::Response response = net::bytes_response(200, "application/octet-stream", std::move(part));
  response.headers.emplace_back("Deviation-Vertices", std::to_string(count));
  const double step_mm = found->value("step_mm", score::deviation_step_mm);
  response.headers.emplace_back("Deviation-Step-Mm", json(step_mm).dump());
  response.headers.emplace_back("Deviation-Range-Mm", json(127.0 * step_mm).dump());
  response.headers.emplace_back("Deviation-Unknown", description.at("unknown").dump());
  return response;
}

net::Response get_deviation(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  const session::SessionRecord record = services.sessions.get(id);
  require_ended(record, "its surface is compared when it has ended");
  const fs::path folder = services.sessions.folder_of(id);
  const json description = description_in(folder);
  if (!description.is_null()) return field(id, folder, description, request.query.at("to"));
  std::error_code failed;
  if (!fs::is_regular_file(session::recording_file(folder), failed))
    throw Error(ErrorKind::not_found, "session '" + id + "' left no recording; it was never started");
  return accepted(request.caller,
                  work_in_folder(services.jobs, "deviation", request.caller, record, folder,
                                 [&engine = services.engine](const fs::path& work, const Progress& progress) {
                                   engine.write_deviations(work, work / description_name, progress);
                                 }));
}

}  // namespace

std::vector<Route> deviation_routes() {
  return {
      {"GET", "/api/v1/sessions/{id}/deviation", access::reamers, reads("session.deviation"), get_deviation}};
}

}  // namespace ream::api
