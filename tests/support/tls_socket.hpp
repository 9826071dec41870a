#pragma once
#include <memory>
#include <string>

#include "support/raw_http.hpp"

namespace ream::test {

/// RawSocket under TLS, by OpenSSL's own blocking calls. It trusts anybody.
class TlsSocket final : public RawSocket {
 public:
  struct Settings {
    int max_version = 0;       ///< TLS1_2_VERSION, say; 0: the newest
    std::string ciphers = {};  ///< of TLS 1.2; empty: the usual
  };
  /// Throws when the handshake fails.
  explicit TlsSocket(uint16_t port, const Settings& settings);
  explicit TlsSocket(uint16_t port) : TlsSocket(port, Settings{}) {}
  ~TlsSocket() override;

  /// "TLSv1.3", say.
  std::string version() const;
  std::string cipher() const;

 private:
  long read_some(char* into, size_t bytes) override;
  long write_some(const char* from, size_t bytes) override;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace ream::test
