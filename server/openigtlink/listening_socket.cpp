#include "openigtlink/listening_socket.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "core/error.hpp"

namespace ream::openigtlink {
namespace {

constexpr int waiting_clients = 8;
/// What a client that reads slowly leaves in the kernel, so that newer news need not wait behind it for long.
constexpr int send_buffer_bytes = 256 * 1024;

uint16_t port_of(int descriptor) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port);
  return ntohs(reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

void set(int descriptor, int level, int option, int value) {
  ::setsockopt(descriptor, level, option, &value, sizeof value);
}

}  // namespace

ListeningSocket::ListeningSocket(const std::string& host, uint16_t port) {
  const std::string place = "OpenIGTLink at " + host + ", port " + std::to_string(port) + ": ";
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (failed != 0) throw Error(ErrorKind::invalid_input, place + ::gai_strerror(failed));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owned(found, &::freeaddrinfo);
  socket_ = SocketHandle(
      ::socket(found->ai_family, found->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, found->ai_protocol));
  if (socket_) set(socket_.get(), SOL_SOCKET, SO_REUSEADDR, 1);
  if (!socket_ || ::bind(socket_.get(), found->ai_addr, found->ai_addrlen) != 0 ||
      ::listen(socket_.get(), waiting_clients) != 0) {
    const int reason = errno;
    const char* advice = reason == EADDRINUSE ? "; another program has the port, choose another" : "";
    throw Error(ErrorKind::unavailable, place + std::strerror(reason) + advice);
  }
  port_ = port_of(socket_.get());
}

SocketHandle ListeningSocket::accept() const {
  SocketHandle client(::accept4(socket_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client) return client;
  set(client.get(), IPPROTO_TCP, TCP_NODELAY, 1);
  set(client.get(), SOL_SOCKET, SO_SNDBUF, send_buffer_bytes);
  return client;
}

}  // namespace ream::openigtlink
