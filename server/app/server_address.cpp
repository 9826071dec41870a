#include "app/server_address.hpp"

#include <unistd.h>

#include <array>
#include <charconv>

#include "core/error.hpp"
#include "net/guard.hpp"

namespace ream::app {
namespace {

bool is_every_address(const std::string& host) { return host == "0.0.0.0" || host == "::"; }

/// Empty when the machine has no name of use.
std::string machine_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  try {
    return net::plain_host(name.data());
  } catch (const Error&) {
    return {};
  }
}

std::vector<std::string> names_of(const ServerAddress& address) {
  std::vector<std::string> names = address.public_names;
  if (const std::string own = machine_name(); !own.empty()) names.push_back(own);
  return names;
}

void require_safe(const ServerAddress& address, bool has_users) {
  const std::string place = "--host " + address.host + ": ";
  if (!has_users)
    throw Error(
        ErrorKind::usage,
        place + "others could use the server without a login; add an operator first: ream user add NAME");
  if (address.certificate_chain.empty() && !address.insecure)
    throw Error(ErrorKind::usage,
                place +
                    "passwords would travel in the clear; give --tls-cert and --tls-key, or --insecure where "
                    "something else encrypts");
}

uint16_t openigtlink_port(const std::string& digits, const std::string& text) {
  uint16_t port = 0;
  const char* end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, port);
  if (read.ec != std::errc() || read.ptr != end)
    throw Error(ErrorKind::usage, "--openigtlink " + text + ": give PORT or HOST:PORT, such as 18944");
  return port;
}

}  // namespace

net::ListenOptions listen_options(const ServerAddress& address, bool has_users) {
  if (address.certificate_chain.empty() != address.key.empty())
    throw Error(ErrorKind::usage, "--tls-cert and --tls-key go together");
  net::ListenOptions options;
  options.host = address.host;
  options.port = address.port;
  options.public_names = address.public_names;
  for (const std::string& proxy : address.trusted_proxies)
    options.trusted_proxies.push_back(net::trusted_proxy(proxy));
  if (!address.certificate_chain.empty()) {
    options.tls = {address.certificate_chain, address.key};
    net::TlsContext{*options.tls};  // what is wrong with them is said before anything is begun
  }
  if (!net::is_loopback_host(address.host)) {
    require_safe(address, has_users);
    options.beyond_loopback = true;
    options.public_names = names_of(address);
  }
  return options;
}

std::string server_url(const ServerAddress& address, uint16_t port) {
  std::string host = address.host;
  if (!address.public_names.empty())
    host = address.public_names.front();
  else if (const std::string own = machine_name(); is_every_address(host) && !own.empty())
    host = own;
  if (host.find(':') != std::string::npos) host = "[" + host + "]";
  return (address.certificate_chain.empty() ? "http://" : "https://") + host + ":" + std::to_string(port);
}

openigtlink::ServerOptions openigtlink_address(const std::string& text, const ServerAddress& server) {
  openigtlink::ServerOptions options;
  options.host = server.host;
  const size_t colon = text.rfind(':');
  options.port = openigtlink_port(colon == std::string::npos ? text : text.substr(colon + 1), text);
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
