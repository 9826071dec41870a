#include <charconv>
#include <optional>

#include "api/request_values.hpp"
#include "api/routes.hpp"
#include "api/services.hpp"
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

net::SharedBytes shared(net::Bytes bytes) { return std::make_shared<const net::Bytes>(std::move(bytes)); }

/// Kept by no cache: what an address shows changes when its case is made again.
net::Response get_slice(const Services& services, const net::Request& request) {
  const auto& parameters = request.parameters;
  std::optional<int> revision;  // the segmentation that a client believes to look at
  if (request.query.contains("revision")) revision = index_of(query_text(request, "revision"));
  net::Bytes bytes =
      services.cases.slice(id_of(request), axis_of(parameters.at("axis")), index_of(parameters.at("index")),
                           query_text(request, "of") == "labels", revision);
  net::Response response = net::bytes_response(200, "application/octet-stream", shared(std::move(bytes)));
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

/// Made now, sent, and gone.
net::Response get_volume(const Services& services, const net::Request& request) {
  const std::string& id = id_of(request);
  services.cases.workup(id);
  const TemporaryFile file(services.temporary_folder, ".nrrd");
  services.executor.run([&] { services.cases.write_volume(id, file.path()); });
  return net::file_response(request, {file.path(), "application/octet-stream", id + ".nrrd"});
}

/// Kept by no cache, as the case may be made again.
net::Response ply_response(std::string&& ply) {
  net::Response response = net::bytes_response(200, "application/ply", net::share(std::move(ply)));
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

net::Response get_case_mesh(const Services& services, const net::Request& request) {
  return ply_response(services.cases.mesh(id_of(request)));
}

net::Response get_surroundings(const Services& services, const net::Request& request) {
  return ply_response(services.cases.surroundings(id_of(request)));
}

}  // namespace

std::vector<Route> case_volume_routes() {
  using access::reamers;
  const std::string one = "/api/v1/cases/{id}";
  return {{"GET", one + "/volume", reamers, reads("case.ct"), get_volume},
          {"GET", one + "/volume/slices/{axis}/{index}", reamers, reads("case.ct"), get_slice},
          {"GET", one + "/mesh", reamers, reads("case.mesh"), get_case_mesh},
          {"GET", one + "/surroundings", reamers, reads("case.surroundings"), get_surroundings}};
}

}  // namespace ream::api
