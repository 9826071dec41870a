// Bytes of a connection, through parser, guard, router and static files, to the heads of the replies.
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "fuzz_input.hpp"
#include "net/guard.hpp"
#include "net/message.hpp"
#include "net/problem.hpp"
#include "net/request_parser.hpp"
#include "net/router.hpp"
#include "net/static_files.hpp"

namespace ream::fuzz {
namespace {

net::Limits small_limits() {
  net::Limits limits;
  limits.header_bytes = 2048;
  limits.header_lines = 20;
  limits.header_line_bytes = 512;
  limits.target_bytes = 256;
  limits.body_bytes = 1024;
  return limits;
}

net::Router make_router() {
  net::Router router;
  const auto echo = [](const net::Request& request) {
    net::Response response = net::bytes_response(200, "text/plain", net::share(request.body));
    response.headers.emplace_back("Location", request.path);
    for (const auto& [name, value] : request.query) response.headers.emplace_back(name, value);
    return response;
  };
  router.on("GET", "/api/v1/sessions", echo);
  router.on("POST", "/api/v1/sessions", echo);
  router.on("PUT", "/api/v1/uploads/{id}", echo);
  router.on("DELETE", "/api/v1/sessions/{id}/annotations/{number}", echo);
  router.on_websocket("/api/v1/sessions/{id}/stream",
                      [](const net::Request& request) -> std::unique_ptr<net::WebSocketSession> {
                        throw Error(ErrorKind::not_found, "no session '" + request.parameters.at("id") + "'");
                      });
  router.otherwise([files = net::StaticFiles(std::filesystem::temp_directory_path() / "no-such-page")](
                       const net::Request& request) { return files.respond(request); });
  return router;
}

/// What was read: a line for every request, and the status of the refusal at the end, if there was one.
std::vector<std::string> read_all(std::string_view bytes, size_t piece, const net::Limits& limits) {
  std::vector<std::string> seen;
  try {
    net::RequestParser parser(limits);
    for (size_t at = 0; at < bytes.size(); at += piece) {
      parser.feed(bytes.substr(at, piece));
      for (; parser.stage() == net::RequestParser::Stage::whole; parser.next()) {
        std::string line = parser.request().method + " " + parser.request().path + " ";
        for (const auto& [name, value] : parser.request().headers) line += name + "=" + value + "\n";
        seen.push_back(line + parser.take_body());
      }
    }
  } catch (const net::RequestError& refusal) {
    seen.push_back(std::to_string(refusal.status()));
  }
  return seen;
}

/// A head is lines that end in CRLF, and an empty one only at its end.
void require_sound(const std::string& head) {
  require(head.ends_with("\r\n\r\n") && head.find("\r\n\r\n") == head.size() - 4, "a reply's head is broken");
}

void answer_all(std::string_view bytes, const net::Limits& limits, const net::Router& router) {
  static const std::vector<std::string> public_names{"ream.example.org"};
  static const std::string local = "192.168.1.4";
  try {
    net::RequestParser parser(limits);
    parser.feed(bytes);
    for (; parser.stage() == net::RequestParser::Stage::whole; parser.next()) {
      net::Request request = parser.request();
      request.body = parser.take_body();
      const bool is_websocket = net::wants_websocket(request);
      if (const auto refusal = net::refuse_foreign(request, is_websocket, {public_names, local})) {
        require_sound(net::response_head(*refusal, net::security_headers(true), false));
        continue;
      }
      const net::Response response = is_websocket ? router.open(request).refusal : router.respond(request);
      require_sound(net::response_head(response, net::security_headers(false), true));
    }
  } catch (const net::RequestError& refusal) {
    require_sound(net::response_head(net::problem(refusal.status(), refusal.what()), {}, false));
  }
}

}  // namespace
}  // namespace ream::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ream;
  static const net::Limits limits = fuzz::small_limits();
  static const net::Router router = fuzz::make_router();
  fuzz::Input input(data, size);
  const size_t piece = 1 + input.byte() % 64;
  const std::string_view bytes = input.rest();
  fuzz::answer_all(bytes, limits, router);
  fuzz::require(fuzz::read_all(bytes, piece, limits) == fuzz::read_all(bytes, bytes.size() + 1, limits),
                "what is read depends on how the bytes are cut");
  return 0;
}
