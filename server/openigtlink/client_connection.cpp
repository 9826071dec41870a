#include "openigtlink/client_connection.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <algorithm>
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

/// Of what a client says, looked at in one round.
constexpr int max_reads = 16;
/// Between two calls that come one after the other.
constexpr int64_t max_counted_ns = 1'000'000'000;

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

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
  socket_ = FileDescriptor(
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

FileDescriptor ListeningSocket::accept() const {
  FileDescriptor client(::accept4(socket_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client) return client;
  set(client.get(), IPPROTO_TCP, TCP_NODELAY, 1);
  set(client.get(), SOL_SOCKET, SO_SNDBUF, send_buffer_bytes);
  return client;
}

bool ClientConnection::drain_input() {
  std::array<std::byte, 4096> heard;
  for (int i = 0; i < max_reads; ++i) {
    const ssize_t count = ::recv(socket_.get(), heard.data(), heard.size(), 0);
    if (count == 0) return false;
    if (count < 0) return would_block();
  }
  return true;
}

bool ClientConnection::choose(const MessageCache& cache) {
  for (size_t i = 0; i < topic_count; ++i) {
    const size_t topic = (turn_ + i) % topic_count;
    const MessageCache::CachedMessage& cached = cache.message(topic);
    if (!cached.message || cached.version == sent_versions_[topic]) continue;
    sent_versions_[topic] = cached.version;
    writing_ = cached.message;
    written_ = 0;
    turn_ = topic + 1;
    return true;
  }
  return false;
}

bool ClientConnection::serve(const MessageCache& cache, int64_t now_ns) {
  waited_ns_ += std::min(now_ns - served_ns_, max_counted_ns);
  served_ns_ = now_ns;
  if (!drain_input()) return false;
  while (writing_ || choose(cache)) {
    const ssize_t count =
        ::send(socket_.get(), writing_->data() + written_, writing_->size() - written_, MSG_NOSIGNAL);
    if (count < 0) return would_block() && waited_ns_ < timeout_ns;
    waited_ns_ = 0;
    written_ += static_cast<size_t>(count);
    if (written_ == writing_->size()) writing_.reset();
  }
  waited_ns_ = 0;
  return true;
}

}  // namespace ream::openigtlink
