#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

namespace ream::bench {

/// Where a session is found by those who come, as plain data that goes through a pipe.
struct Door {
  Door() = default;
  /// `token`: of an operator; empty where none is needed. Both at most 127 bytes.
  Door(uint16_t of_server, const std::string& session, const std::string& token) : port(of_server) {
    std::strncpy(session_.data(), session.c_str(), session_.size() - 1);
    std::strncpy(token_.data(), token.c_str(), token_.size() - 1);
  }

  std::string session() const { return session_.data(); }
  /// "/api/v1/sessions/ID"
  std::string session_path() const { return "/api/v1/sessions/" + session(); }
  bool needs_token() const { return token_.front() != 0; }
  /// Value of the header Authorization.
  std::string authorization() const { return std::string("Bearer ") + token_.data(); }

  uint16_t port = 0;

 private:
  std::array<char, 128> session_{}, token_{};
};

}  // namespace ream::bench
