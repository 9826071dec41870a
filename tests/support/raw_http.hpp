#pragma once
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ream::test {

/// A blocking TCP connection to 127.0.0.1 with a timeout on every call, written on plain sockets so that it
/// shares no code with the server. Failures throw std::runtime_error.
class RawSocket {
 public:
  explicit RawSocket(uint16_t port, int receive_buffer_bytes = 0);
  virtual ~RawSocket();
  RawSocket(const RawSocket&) = delete;
  RawSocket& operator=(const RawSocket&) = delete;

  void send(const std::string& bytes);
  /// False when the peer closed or reset on the way.
  bool try_send(const std::string& bytes);
  /// No more will be sent; receiving goes on.
  void end_sending();
  /// Exactly that many bytes.
  std::string receive(size_t bytes);
  /// Everything until the peer closes.
  std::string receive_all();
  /// Bytes up to and including `mark`.
  std::string receive_until(const std::string& mark);

 protected:
  /// As recv and send of the system.
  virtual long read_some(char* into, size_t bytes);
  virtual long write_some(const char* from, size_t bytes);
  int descriptor() const { return socket_; }

 private:
  bool fill();

  int socket_ = -1;
  std::string buffer_;
};

struct HttpReply {
  int status = 0;
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
};

/// Reads one reply with Content-Length (none after HEAD or 304).
HttpReply receive_reply(RawSocket& socket, bool has_body = true);

/// One request on a connection of its own.
HttpReply http_request(RawSocket& socket, uint16_t port, const std::string& method, const std::string& target,
                       const std::string& body = {}, const std::map<std::string, std::string>& headers = {});
HttpReply http_request(uint16_t port, const std::string& method, const std::string& target,
                       const std::string& body = {}, const std::map<std::string, std::string>& headers = {});

/// The client's side of a WebSocket (RFC 6455), unfragmented messages only.
class RawWebSocket {
 public:
  RawWebSocket(uint16_t port, const std::string& target,
               const std::map<std::string, std::string>& headers = {}, int receive_buffer_bytes = 0);
  /// Over a socket that is connected to `port`.
  RawWebSocket(std::unique_ptr<RawSocket> socket, uint16_t port, const std::string& target,
               const std::map<std::string, std::string>& headers = {});

  /// 101 when open.
  const HttpReply& handshake() const { return handshake_; }
  void send_binary(const std::string& payload);
  void send_close(uint16_t code);
  /// One masked frame of at most 65535 bytes.
  void send_frame(int opcode, const std::string& payload, bool final = true);

  struct Message {
    int opcode = 0;  ///< 1 text, 2 binary, 8 close, 9 ping
    std::string payload;
    std::optional<uint16_t> close_code() const;
  };
  /// The next frame that is not a ping.
  Message receive();
  RawSocket& socket() { return *socket_; }

 private:
  std::unique_ptr<RawSocket> socket_;
  HttpReply handshake_;
};

}  // namespace ream::test
