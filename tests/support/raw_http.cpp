#include "support/raw_http.hpp"
#include "core/text.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace ream::test {
namespace {

/// Longer than any answer takes on a machine that is busy with other tests; a server that hangs is found all
/// the same.
constexpr int timeout_s = 120;

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

std::string header_lines(const std::map<std::string, std::string>& headers) {
  std::string lines;
  for (const auto& [name, value] : headers) lines += name + ": " + value + "\r\n";
  return lines;
}

}  // namespace

RawSocket::RawSocket(uint16_t port, int receive_buffer_bytes) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
  if (socket_ < 0) fail("socket");
  const timeval timeout{timeout_s, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
  if (receive_buffer_bytes > 0)
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes, sizeof receive_buffer_bytes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(socket_);
    fail("connect to port " + std::to_string(port));
  }
}

RawSocket::~RawSocket() { ::close(socket_); }

/// A process that is stopped and goes on finds its call interrupted.
long RawSocket::read_some(char* into, size_t bytes) {
  long got = -1;
  do got = ::recv(socket_, into, bytes, 0);
  while (got < 0 && errno == EINTR);
  return got;
}

long RawSocket::write_some(const char* from, size_t bytes) {
  return ::send(socket_, from, bytes, MSG_NOSIGNAL);
}

bool RawSocket::try_send(const std::string& bytes) {
  for (size_t sent = 0; sent < bytes.size();) {
    const long n = write_some(bytes.data() + sent, bytes.size() - sent);
    if (n <= 0) return false;
    sent += static_cast<size_t>(n);
  }
  return true;
}

void RawSocket::send(const std::string& bytes) {
  if (!try_send(bytes)) fail("send");
}

void RawSocket::end_sending() { ::shutdown(socket_, SHUT_WR); }

bool RawSocket::fill() {
  char chunk[65536];
  long n = read_some(chunk, sizeof chunk);
  while (n < 0 && errno == EINTR) n = read_some(chunk, sizeof chunk);  // the test was stopped for a while
  if (n < 0 && errno != ECONNRESET) fail("receive");
  if (n <= 0) return false;
  buffer_.append(chunk, static_cast<size_t>(n));
  return true;
}

std::string RawSocket::receive(size_t bytes) {
  while (buffer_.size() < bytes)
    if (!fill()) throw std::runtime_error("the peer closed before " + std::to_string(bytes) + " bytes came");
  const std::string out = buffer_.substr(0, bytes);
  buffer_.erase(0, bytes);
  return out;
}

std::string RawSocket::receive_all() {
  while (fill()) {
  }
  return std::move(buffer_);
}

std::string RawSocket::receive_until(const std::string& mark) {
  size_t at = 0;
  while ((at = buffer_.find(mark)) == std::string::npos)
    if (!fill())
      throw std::runtime_error("the peer closed before the end of its header; got '" + buffer_ + "'");
  return receive(at + mark.size());
}

HttpReply receive_reply(RawSocket& socket, bool has_body) {
  HttpReply reply;
  const std::string head = socket.receive_until("\r\n\r\n");
  reply.status = std::stoi(head.substr(head.find(' ') + 1, 3));
  for (size_t begin = head.find("\r\n") + 2; begin + 2 < head.size();) {
    const size_t end = head.find("\r\n", begin), colon = head.find(':', begin);
    reply.headers[lower(head.substr(begin, colon - begin))] = head.substr(colon + 2, end - colon - 2);
    begin = end + 2;
  }
  const auto length = reply.headers.find("content-length");
  if (has_body && length != reply.headers.end()) reply.body = socket.receive(std::stoul(length->second));
  return reply;
}

HttpReply http_request(uint16_t port, const std::string& method, const std::string& target,
                       const std::string& body, const std::map<std::string, std::string>& headers) {
  RawSocket socket(port);
  return http_request(socket, port, method, target, body, headers);
}

HttpReply http_request(RawSocket& socket, uint16_t port, const std::string& method, const std::string& target,
                       const std::string& body, const std::map<std::string, std::string>& headers) {
  std::map<std::string, std::string> all = {{"Host", "127.0.0.1:" + std::to_string(port)},
                                            {"Connection", "close"}};
  if (!body.empty() || method == "POST") all["Content-Length"] = std::to_string(body.size());
  if (!body.empty()) all["Content-Type"] = "application/json";
  for (const auto& [name, value] : headers) all[name] = value;
  socket.send(method + " " + target + " HTTP/1.1\r\n" + header_lines(all) + "\r\n" + body);
  return receive_reply(socket, method != "HEAD");
}

RawWebSocket::RawWebSocket(uint16_t port, const std::string& target,
                           const std::map<std::string, std::string>& headers, int receive_buffer_bytes)
    : RawWebSocket(std::make_unique<RawSocket>(port, receive_buffer_bytes), port, target, headers) {}

RawWebSocket::RawWebSocket(std::unique_ptr<RawSocket> socket, uint16_t port, const std::string& target,
                           const std::map<std::string, std::string>& headers)
    : socket_(std::move(socket)) {
  std::map<std::string, std::string> all = {{"Host", "127.0.0.1:" + std::to_string(port)},
                                            {"Upgrade", "websocket"},
                                            {"Connection", "Upgrade"},
                                            {"Sec-WebSocket-Version", "13"},
                                            {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="}};
  for (const auto& [name, value] : headers) all[name] = value;
  socket_->send("GET " + target + " HTTP/1.1\r\n" + header_lines(all) + "\r\n");
  handshake_ = receive_reply(*socket_);
}

void RawWebSocket::send_frame(int opcode, const std::string& payload, bool final) {
  if (payload.size() > 65535) throw std::runtime_error("the test client sends at most 65535 bytes a message");
  std::string frame(1, static_cast<char>((final ? 0x80 : 0) | opcode));
  if (payload.size() < 126) {
    frame += static_cast<char>(0x80 | payload.size());
  } else {
    frame += static_cast<char>(0x80 | 126);
    frame += static_cast<char>(payload.size() >> 8);
    frame += static_cast<char>(payload.size() & 0xff);
  }
  const char mask[4] = {0x12, 0x34, 0x56, 0x78};
  frame.append(mask, 4);
  for (size_t i = 0; i < payload.size(); ++i) frame += static_cast<char>(payload[i] ^ mask[i % 4]);
  socket_->send(frame);
}

void RawWebSocket::send_binary(const std::string& payload) { send_frame(2, payload); }

void RawWebSocket::send_close(uint16_t code) {
  send_frame(8, {static_cast<char>(code >> 8), static_cast<char>(code & 0xff)});
}

RawWebSocket::Message RawWebSocket::receive() {
  for (;;) {
    const std::string head = socket_->receive(2);
    Message message;
    message.opcode = head[0] & 0x0f;
    uint64_t size = static_cast<unsigned char>(head[1]) & 0x7f;
    const int more = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (more > 0) {
      size = 0;
      for (const char byte : socket_->receive(static_cast<size_t>(more)))
        size = size << 8 | static_cast<unsigned char>(byte);
    }
    message.payload = socket_->receive(size);
    if (message.opcode == 9)
      send_frame(10, message.payload);
    else
      return message;
  }
}

std::optional<uint16_t> RawWebSocket::Message::close_code() const {
  if (opcode != 8 || payload.size() < 2) return std::nullopt;
  return static_cast<uint16_t>(static_cast<unsigned char>(payload[0]) << 8 |
                               static_cast<unsigned char>(payload[1]));
}

}  // namespace ream::test
