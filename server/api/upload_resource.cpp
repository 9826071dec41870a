#include <nlohmann/json.hpp>

#include "api/json_page.hpp"
#include "api/replies.hpp"
#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
#include "net/problem.hpp"

namespace ream::api {
namespace {

/// A file's name may be a patient's: others than the sender and operators learn its ending only.
nlohmann::json upload_json(const net::Request& request, const workup::Upload& upload) {
  const bool open = request.caller.role == "operator" || upload.owner == request.caller.user_id;
  return {{"id", upload.id},
          {"name", open ? upload.name : "*" + upload.name.substr(upload.name.rfind('.'))},
          {"bytes", upload.bytes},
          {"received", upload.received}};
}

net::Response begin_upload(const Services& services, const net::Request& request) {
  const nlohmann::json& body = body_of(request);
  const workup::Upload upload = services.uploads.create(
      body.at("name"), static_cast<uint64_t>(body.at("bytes").get<double>()), request.caller.user_id);
  return created("/api/v1/uploads/" + upload.id, upload_json(request, upload));
}

net::Response append_upload(const Services& services, const net::Request& request) {
  if (request.header("content-type") != "application/octet-stream")
    throw net::RequestError(415, "a piece of a file must be sent as application/octet-stream");
  const auto offset = static_cast<uint64_t>(query_number(request, "offset", 0.0));
  return net::json_response(
      200, upload_json(request, services.uploads.append(id_of(request), offset, request.body)));
}

net::Response list_uploads(const Services& services, const net::Request& request) {
  std::vector<nlohmann::json> all;
  for (const workup::Upload& upload : services.uploads.list()) all.push_back(upload_json(request, upload));
  return page_of(request, "uploads", std::move(all), "name");
}

net::Response get_upload(const Services& services, const net::Request& request) {
  return net::json_response(200, upload_json(request, services.uploads.get(id_of(request))));
}

net::Response remove_upload(const Services& services, const net::Request& request) {
  services.uploads.remove(id_of(request));
  return no_content();
}

}  // namespace

std::vector<Route> upload_routes() {
  using access::staff;
  const std::string all = "/api/v1/uploads", one = all + "/{id}";
  return {{"GET", all, staff, not_audited, list_uploads},
          {"POST", all, staff, changes("upload.begin"), begin_upload, {}, net::Urgency::usual, true},
          {"GET", one, staff, not_audited, get_upload},
          {"PUT", one, staff, not_audited, append_upload},
          {"DELETE", one, staff, changes("upload.remove"), remove_upload}};
}

}  // namespace ream::api
