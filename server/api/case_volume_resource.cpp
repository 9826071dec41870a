#include <charconv>
#include <optional>

#include "api/case_work_resource.hpp"
#include "core/temporary_file.hpp"
#include "net/file_body.hpp"
#include "net/problem.hpp"

namespace ream::api {
namespace {

int axis_of(const std::string& word) {
  if (word == "u") return 0;
  if (word == "v") return 1;
  if (word == "w") return 2;
  throw net::RequestError(404, "slices lie across u, v or w");
}

int index_of(const std::string& text) {
  int index = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (failed != std::errc() || end != text.data() + text.size())
    throw net::RequestError(404, "slices are numbered from 0");
  return index;
}

bool wants_labels(const net::Request& request) {
  const auto found = request.query.find("of");
  if (found == request.query.end() || found->second == "hu") return false;
  if (found->second == "labels") return true;
  throw net::RequestError(422, "?of must be hu or labels");
}

/// The segmentation that a client believes to look at, if it says so.
std::optional<int> revision_of(const net::Request& request) {
  const auto found = request.query.find("revision");
  if (found == request.query.end()) return std::nullopt;
  return index_of(found->second);
}

net::SharedBytes shared(net::Bytes bytes) { return std::make_shared<const net::Bytes>(std::move(bytes)); }

/// Kept by no cache: what an address shows changes when its case is made anew.
net::Response slice(workup::CaseService& case_service, const net::Request& request) {
  const auto& parameters = request.parameters;
  net::Bytes bytes =
      case_service.slice(parameters.at("id"), axis_of(parameters.at("axis")),
                         index_of(parameters.at("index")), wants_labels(request), revision_of(request));
  net::Response response = net::bytes_response(200, "application/octet-stream", shared(std::move(bytes)));
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

/// Made now, sent, and gone.
net::Response volume(workup::CaseService& case_service, jobs::LowPriorityExecutor& executor,
                     const std::filesystem::path& temporary_folder, const net::Request& request) {
  const std::string& id = request.parameters.at("id");
  case_service.workup(id);
  const TemporaryFile file(temporary_folder, ".nrrd");
  executor.run([&] { case_service.write_volume(id, file.path()); });
  return net::file_response(request, {file.path(), "application/octet-stream", id + ".nrrd"});
}

net::Response mesh(workup::CaseService& case_service, const net::Request& request) {
  net::Response response =
      net::bytes_response(200, "application/ply", net::share(case_service.mesh(request.parameters.at("id"))));
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

}  // namespace

void add_case_volume_routes(net::Router& router, workup::CaseService& case_service,
                            jobs::LowPriorityExecutor& executor,
                            const std::filesystem::path& temporary_folder) {
  router.on("GET", "/api/v1/cases/{id}/volume", [&, temporary_folder](const net::Request& request) {
    return volume(case_service, executor, temporary_folder, request);
  });
  router.on("GET", "/api/v1/cases/{id}/volume/slices/{axis}/{index}",
            [&case_service](const net::Request& request) { return slice(case_service, request); });
  router.on("GET", "/api/v1/cases/{id}/mesh",
            [&case_service](const net::Request& request) { return mesh(case_service, request); });
}

}  // namespace ream::api
