#include "api/upload_resource.hpp"

#include <charconv>
#include <nlohmann/json.hpp>

#include "api/json_page.hpp"
#include "api/request_body.hpp"

namespace ream::api {
namespace {

constexpr double most_bytes = 1e15;
constexpr size_t max_upload_name = 200;

nlohmann::json to_json(const workup::Upload& upload) {
  return {{"id", upload.id}, {"name", upload.name}, {"bytes", upload.bytes}, {"received", upload.received}};
}

uint64_t offset_of(const net::Request& request) {
  uint64_t offset = 0;
  const auto found = request.query.find("offset");
  if (found == request.query.end())
    throw net::RequestError(400, "?offset=N is missing: where in the file the piece begins");
  const std::string& text = found->second;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), offset);
  if (failed != std::errc() || end != text.data() + text.size())
    throw net::RequestError(400, "?offset must be a whole number");
  return offset;
}

net::Response begin(workup::UploadStore& uploads, const net::Request& request) {
  RequestBody body(request);
  const std::string name = body.words("name", 1, max_upload_name);
  const auto bytes = body.number_or_none("bytes", 0.0, most_bytes);
  body.finish();
  if (!bytes) throw net::RequestError(422, "'bytes' is missing: the size of the file");
  const workup::Upload upload = uploads.create(name, static_cast<uint64_t>(*bytes));
  net::Response response = net::json_response(201, to_json(upload));
  response.headers.emplace_back("Location", "/api/v1/uploads/" + upload.id);
  return response;
}

net::Response append(workup::UploadStore& uploads, const net::Request& request) {
  if (request.header("content-type") != "application/octet-stream")
    throw net::RequestError(415, "a piece of a file must be sent as application/octet-stream");
  return net::json_response(
      200, to_json(uploads.append(request.parameters.at("id"), offset_of(request), request.body)));
}

}  // namespace

void add_upload_routes(net::Router& router, workup::UploadStore& uploads) {
  router.on("POST", "/api/v1/uploads",
            [&uploads](const net::Request& request) { return begin(uploads, request); });
  router.on("GET", "/api/v1/uploads", [&uploads](const net::Request& request) {
    std::vector<nlohmann::json> all;
    for (const workup::Upload& upload : uploads.list()) all.push_back(to_json(upload));
    return page_of(request, "uploads", std::move(all), "name");
  });
  router.on("GET", "/api/v1/uploads/{id}", [&uploads](const net::Request& request) {
    return net::json_response(200, to_json(uploads.get(request.parameters.at("id"))));
  });
  router.on("PUT", "/api/v1/uploads/{id}",
            [&uploads](const net::Request& request) { return append(uploads, request); });
  router.on("DELETE", "/api/v1/uploads/{id}", [&uploads](const net::Request& request) {
    uploads.remove(request.parameters.at("id"));
    return net::Response{204, {}, nullptr, {}};
  });
}

}  // namespace ream::api
