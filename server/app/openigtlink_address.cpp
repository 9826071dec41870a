#include "app/openigtlink_address.hpp"

#include <charconv>

#include "core/error.hpp"
#include "net/guard.hpp"

namespace ream::app {
namespace {

uint16_t port_of(const std::string& digits, const std::string& text) {
  uint16_t port = 0;
  const char* end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, port);
  if (read.ec != std::errc() || read.ptr != end)
    throw Error(ErrorKind::usage, "--openigtlink " + text + ": give PORT or HOST:PORT, such as 18944");
  return port;
}

}  // namespace

openigtlink::ServerOptions openigtlink_address(const std::string& text, const ServerAddress& server) {
  openigtlink::ServerOptions options;
  options.host = server.host;
  const size_t colon = text.rfind(':');
  options.port = port_of(colon == std::string::npos ? text : text.substr(colon + 1), text);
  if (colon != std::string::npos) options.host = text.substr(0, colon);
  if (options.host.size() > 2 && options.host.front() == '[' && options.host.back() == ']')
    options.host = options.host.substr(1, options.host.size() - 2);
  if (!net::is_loopback_host(options.host) && !server.insecure)
    throw Error(ErrorKind::usage, "--openigtlink " + text + ": everybody who reaches " + options.host +
                                      " could watch, without a login; give 127.0.0.1:PORT, or --insecure "
                                      "where something else guards the port");
  return options;
}

}  // namespace ream::app
